// SPDX-License-Identifier: Apache-2.0
#include "api/height_layers.hpp"

#include <algorithm>
#include <utility>

#include "api/height_steps.hpp"
#include "codec/corrections_decoder.hpp"
#include "lattice/validity_decoder.hpp"

namespace tetrakis {

namespace {

std::span<const uint8_t> firstOf(std::span<const uint8_t> bytes, uint64_t count) {
  return bytes.first(static_cast<size_t>(std::min<uint64_t>(count, bytes.size())));
}

void correctSteps(DecodedGeometry& geometry, const GeometryHeader& header,
                  const GeometryLayers& layers, std::span<const uint8_t> codeword) {
  const std::vector<uint8_t> hints = activityHints(geometry, header.width, header.height);
  const std::vector<int32_t> corrections =
      decodeCorrections(codeword, {header.width, header.height, geometry.valid, hints});
  const uint32_t unit = layers.correction_step << geometry.fraction_bits;
  geometry.quiet_levels = 0;
  for (size_t i = 0; i < corrections.size(); ++i) {
    geometry.heights[i] = static_cast<int32_t>(static_cast<uint32_t>(geometry.heights[i]) +
                                               static_cast<uint32_t>(corrections[i]) * unit);
  }
}

}  // namespace

std::vector<uint8_t> activityHints(const DecodedGeometry& geometry, uint32_t width,
                                   uint32_t height) {
  const std::vector<uint8_t>& marks = geometry.significant;
  std::vector<uint8_t> hints = marks;
  for (uint32_t y = 0; y < height; ++y) {
    for (uint32_t x = 0; x < width; ++x) {
      const size_t i = size_t{y} * width + x;
      if (x > 0) hints[i] += marks[i - 1];
      if (x + 1 < width) hints[i] += marks[i + 1];
      if (y > 0) hints[i] += marks[i - width];
      if (y + 1 < height) hints[i] += marks[i + width];
    }
  }
  return hints;
}

DecodedHeights decodeLayers(std::span<const uint8_t> codeword, const GeometryHeader& header,
                            const GeometryLayers& layers, int level) {
  std::vector<uint8_t> valid;
  if (layers.validity_bytes > 0) {
    const auto validity = firstOf(codeword, layers.validity_bytes);
    valid = decodeValidity(validity, header.width, header.height);
    codeword = codeword.subspan(validity.size());
  }
  const bool corrected = layers.corrections != CorrectionKind::kNone;
  const auto coefficients = corrected ? firstOf(codeword, layers.coefficient_bytes) : codeword;
  codeword = codeword.subspan(coefficients.size());
  DecodedHeights decoded;
  decoded.geometry = decodeGeometry(header, coefficients, std::move(valid), level);
  if (codeword.empty() || level > 0) return decoded;
  if (layers.corrections == CorrectionKind::kSteps) {
    correctSteps(decoded.geometry, header, layers, codeword);
    return decoded;
  }
  const std::vector<uint8_t> hints = sampleHints(wholeSteps(decoded.geometry), header);
  decoded.corrections =
      decodeCorrections(codeword, {header.width, header.height, decoded.geometry.valid, hints});
  return decoded;
}

}  // namespace tetrakis
