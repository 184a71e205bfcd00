// SPDX-License-Identifier: Apache-2.0
#include "texture_wavelet/passed_texture.hpp"

#include <utility>

#include "texture_wavelet/texture_comparison.hpp"

namespace tetrakis::inline texture {

PassedTexture passedOf(const EncodedTexture& encoded) {
  PassedTexture passed{.header = encoded.header, .bytes = bytesOf(encoded.tracks)};
  for (const EncodedTrack& track : encoded.tracks) passed.squares += track.points.back().distortion;
  return passed;
}

void passOver(PassedTextures* list, PassedTexture lost, const EncodedTexture& winner) {
  if (list == nullptr) return;
  const uint64_t bytes = lost.bytes + lost.header.tables.code.size();
  const bool longer = winner.tracks.front().complete && bytes >= bytesOf(winner);
  lost.reason = longer ? PassedFor::kLonger : PassedFor::kShowsWorse;
  list->push_back(std::move(lost));
}

void passOverExpected(PassedTextures* list, bool stored, uint64_t bytes) {
  if (list == nullptr) return;
  TextureHeader header;
  header.stored = stored;
  if (stored) header.planes = kDrawnPlanes;
  list->push_back({std::move(header), PassedFor::kExpectedLonger, bytes});
}

}  // namespace tetrakis::inline texture
