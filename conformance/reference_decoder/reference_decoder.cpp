// SPDX-License-Identifier: Apache-2.0
// Reference decoder: from the bytes of a prefix to samples (docs/FORMAT.md, sections 1, 9 and 11).
#include "conformance/reference_decoder.hpp"

#include "conformance/reference_decoder/components.hpp"

namespace tetrakis::reference {
namespace {

bool tooLarge(int width, int height, int channels) {
  return uint64_t(width) * uint64_t(height) * uint64_t(channels) > kMaxSamples;
}

}  // namespace

Decoded decode(std::span<const uint8_t> prefix) {
  const Stream stream = readStream(prefix);
  Decoded decoded;
  decoded.outcome = stream.outcome;
  if (decoded.outcome != Outcome::kDone) return decoded;
  const auto& g = stream.geometry;
  const auto& t = stream.texture;
  if ((g && tooLarge(g->width, g->height, 1)) ||
      (t && tooLarge(t->width, t->height, t->channels))) {
    decoded.outcome = Outcome::kTooLarge;
    return decoded;
  }
  if (g) decoded.heights = decodeHeights(*g, stream.codewords[0]);
  if (t) decoded.texture = decodeTexture(*t, stream.codewords[1]);
  return decoded;
}

}  // namespace tetrakis::reference
