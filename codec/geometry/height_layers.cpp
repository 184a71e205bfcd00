// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/height_layers.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

#include "codec/geometry/corrections_decoder.hpp"
#include "codec/geometry/height_steps.hpp"
#include "codec/geometry/stored_heights.hpp"
#include "codec/geometry/value_table_decoder.hpp"
#include "lattice/validity_decoder.hpp"
#include "wavelet/mip_level.hpp"

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

namespace {

/// The tracks taken apart.
struct Layers {
  std::span<const uint8_t> validity, table, corrections;
  Codewords coefficients;

  Layers(const Codewords& codewords, const GeometryLayers& layers) : coefficients(codewords) {
    assert(!coefficients.empty());
    std::span<const uint8_t>& first = coefficients.front();
    validity = firstOf(first, layers.validity_bytes);
    first = first.subspan(validity.size());
    table = firstOf(first, layers.table_bytes);
    first = first.subspan(table.size());
    if (layers.corrections == CorrectionKind::kNone) return;
    corrections = first.subspan(firstOf(first, layers.coefficient_bytes).size());
    first = first.first(first.size() - corrections.size());
  }
};

std::vector<uint8_t> validityOf(const Layers& taken, const GeometryHeader& header,
                                const GeometryLayers& layers, HeightsMemory* memory = nullptr) {
  if (layers.validity_bytes == 0) return {};
  const bool whole = memory != nullptr && taken.validity.size() == layers.validity_bytes;
  if (whole && !memory->valid.empty()) return memory->valid;
  std::vector<uint8_t> valid = decodeValidity(taken.validity, header.width, header.height);
  if (whole) memory->valid = valid;
  return valid;
}

}  // namespace

std::vector<uint8_t> decodeValidityLayer(const Codewords& codewords, const GeometryHeader& header,
                                         const GeometryLayers& layers, int level) {
  std::vector<uint8_t> valid = validityOf(Layers(codewords, layers), header, layers);
  if (level == 0 || valid.empty()) return valid;
  const MipLevel mip(header.width, header.height, level);
  valid = mip.maskOf(valid, header.width);
  mip.thin(std::span(valid));
  valid.resize(mip.samples());
  return valid;
}

namespace {

/// What the decoded steps are where they count the values of a table.
void applyTable(const Layers& taken, const GeometryHeader& header, const GeometryLayers& layers,
                DecodedHeights& decoded) {
  if (layers.table_bytes == 0) return;
  const ValueTable table = decodeValueTable(taken.table, layers.table_values);
  if (!table.empty()) applyTable(table, header, decoded);
}

/// Adds corrections of the samples to those that the table has made.
void addCorrections(const std::vector<int32_t>& more, std::vector<int32_t>& corrections) {
  if (corrections.empty()) {
    corrections = more;
    return;
  }
  for (size_t i = 0; i < more.size(); ++i) {
    corrections[i] = static_cast<int32_t>(static_cast<uint32_t>(corrections[i]) +
                                          static_cast<uint32_t>(more[i]));
  }
}

}  // namespace

DecodedHeights decodeLayers(const Codewords& codewords, const GeometryHeader& header,
                            const GeometryLayers& layers, int level, uint32_t threads,
                            HeightsMemory* memory) {
  const Layers taken(codewords, layers);
  if (header.stored()) {
    const std::vector<uint8_t> valid = validityOf(taken, header, layers, memory);
    return decodeStored(header, taken.coefficients.front(), valid, level);
  }
  DecodedHeights decoded;
  decoded.geometry =
      decodeGeometry(header, taken.coefficients, validityOf(taken, header, layers, memory), level,
                     threads, memory == nullptr ? nullptr : &memory->track);
  applyTable(taken, header, layers, decoded);
  if (taken.corrections.empty() || level > 0) return decoded;
  if (layers.corrections == CorrectionKind::kSteps) {
    correctSteps(decoded.geometry, header, layers, taken.corrections);
    return decoded;
  }
  const std::vector<uint8_t> hints = sampleHints(wholeSteps(decoded.geometry), header);
  addCorrections(decodeCorrections(taken.corrections,
                                   {header.width, header.height, decoded.geometry.valid, hints}),
                 decoded.corrections);
  return decoded;
}

DecodedHeights decodeLayersWindow(const Codewords& codewords, const GeometryHeader& header,
                                  const GeometryLayers& layers, const Window& window,
                                  uint32_t threads) {
  const Layers taken(codewords, layers);
  DecodedHeights decoded;
  if (taken.corrections.empty() && !header.stored()) {
    decoded.geometry = decodeGeometryWindow(header, taken.coefficients,
                                            validityOf(taken, header, layers), window, threads);
    applyTable(taken, header, layers, decoded);
    return decoded;
  }
  // Contexts of corrections come from the corrections and heights of the whole plane.
  const DecodedHeights whole = decodeLayers(codewords, header, layers, 0, threads);
  const auto cut = [&]<class T>(const std::vector<T>& values) {
    return values.empty() ? values : crop(std::span(values), header.width, window);
  };
  decoded.geometry.width = window.width;
  decoded.geometry.height = window.height;
  decoded.geometry.fraction_bits = whole.geometry.fraction_bits;
  decoded.geometry.heights = cut(whole.geometry.heights);
  decoded.geometry.valid = cut(whole.geometry.valid);
  decoded.corrections = cut(whole.corrections);
  return decoded;
}

}  // namespace tetrakis
