// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/height_layers.hpp"

#include <algorithm>
#include <cassert>
#include <optional>
#include <span>
#include <utility>

#include "codec/geometry/corrections/corrections_decoder.hpp"
#include "codec/geometry/corrections/exact_corrections_decoder.hpp"
#include "codec/geometry/drawn_heights/drawn_heights_decoder.hpp"
#include "codec/geometry/flat/flat_decoder.hpp"
#include "codec/geometry/relative/relative_decoder.hpp"
#include "codec/geometry/shown_heights.hpp"
#include "codec/geometry/steps/height_samples.hpp"
#include "codec/geometry/stored_heights_decoder.hpp"
#include "codec/geometry/values/value_stand_in.hpp"
#include "codec/geometry/values/value_table_decoder.hpp"
#include "lattice/validity_decoder.hpp"
#include "wavelet/bridges.hpp"

namespace tetrakis::inline geometry {

namespace {

std::span<const uint8_t> firstOf(std::span<const uint8_t> bytes, uint64_t count) {
  return bytes.first(static_cast<size_t>(std::min<uint64_t>(count, bytes.size())));
}

/// The heights with corrections in units of so many steps.
DecodedGeometry correctedSteps(DecodedGeometry geometry, uint32_t correction_step,
                               std::span<const uint8_t> codeword) {
  const std::vector<uint8_t> hints = activityHints(geometry);
  const uint32_t unit = correction_step << geometry.fraction_bits;
  const auto add = [&](size_t first, std::span<const int32_t> row) {
    for (size_t x = 0; x < row.size(); ++x) {
      int32_t& height = geometry.heights[first + x];
      height = static_cast<int32_t>(static_cast<uint32_t>(height) +
                                    static_cast<uint32_t>(row[x]) * unit);
    }
  };
  decodeCorrections(codeword, {hints, geometry.extent(), geometry.valid}, add);
  return geometry;
}

/// The heights with corrections to whole steps: what a fraction is beside its sample is an error of
/// the cut, which surfaces and meshes need not show.
DecodedGeometry exactSteps(DecodedGeometry geometry, std::span<const uint8_t> codeword) {
  const auto put = [&](size_t first, std::span<const int32_t> row) {
    for (size_t x = 0; x < row.size(); ++x) {
      const uint32_t whole = static_cast<uint32_t>(row[x]) << geometry.fraction_bits;
      geometry.heights[first + x] = static_cast<int32_t>(whole);
    }
  };
  decodeExactSteps(codeword, {geometry.heights, geometry.extent(), geometry.valid},
                   geometry.fraction_bits, put);
  return geometry;
}

/// The tracks taken apart.
struct TakenLayers {
  std::span<const uint8_t> lifted, validity, table, flat, corrections;
  Codewords coefficients;  ///< of the first track those before what lies among them
  std::vector<std::span<const uint8_t>> more;  ///< the others of it, in their order

  TakenLayers(const Codewords& codewords, const GeometryLayers& layers) : coefficients(codewords) {
    assert(!coefficients.empty());
    std::span<const uint8_t>& first = coefficients.front();
    const auto take = [&](uint64_t count) {
      const std::span<const uint8_t> taken = firstOf(first, count);
      first = first.subspan(taken.size());
      return taken;
    };
    if (layers.late_mask) {
      lifted = take(layers.lifted_bytes);
    } else {
      validity = take(layers.validity_bytes);
    }
    flat = take(layers.flat_bytes);
    struct Among {
      uint64_t after, bytes;
      std::span<const uint8_t>* layer;
    };
    std::vector<Among> among;
    if (layers.late_mask)
      among.push_back({layers.validity_after, layers.validity_bytes, &validity});
    if (layers.table_bytes > 0) among.push_back({layers.table_after, layers.table_bytes, &table});
    if (among.size() > 1 && among[1].after < among[0].after) std::swap(among[0], among[1]);
    uint64_t before = 0;
    for (const auto& [after, bytes, layer] : among) {
      more.push_back(take(after - before));
      *layer = take(bytes);
      before = after;
    }
    const bool corrected = layers.corrections != CorrectionKind::kNone;
    more.push_back(take((corrected ? layers.coefficient_bytes : UINT64_MAX) - before));
    corrections = first;
    first = more.front();
    more.erase(more.begin());
    std::erase_if(more, [](std::span<const uint8_t> part) { return part.empty(); });
  }

  /// The coefficients of the first track as one codeword, if something parts them; else nothing.
  std::vector<uint8_t> joined() const {
    if (more.empty()) return {};
    size_t bytes = coefficients.front().size();
    for (const std::span<const uint8_t> part : more) bytes += part.size();
    std::vector<uint8_t> whole;
    whole.reserve(bytes);
    whole.assign(coefficients.front().begin(), coefficients.front().end());
    for (const std::span<const uint8_t> part : more)
      whole.insert(whole.end(), part.begin(), part.end());
    return whole;
  }

  /// All is there that comes before the coefficients.
  bool opened(const GeometryLayers& layers) const {
    const bool masked = layers.late_mask ? lifted.size() == layers.lifted_bytes
                                         : validity.size() == layers.validity_bytes;
    return masked && flat.size() == layers.flat_bytes;
  }
};

/// Which samples of the whole plane are lifted, of heights whose mask comes late; empty: all.
std::vector<uint8_t> lateLifted(const TakenLayers& taken, const GeometryHeader& header,
                                const GeometryLayers& layers) {
  if (layers.lifted_bytes == 0) return {};
  return decodeValidity(taken.lifted, header.extent());
}

/// The validity mask of the whole plane. lifted: lateLifted(), if the mask comes late.
std::vector<uint8_t> validityOf(const TakenLayers& taken, const GeometryHeader& header,
                                const GeometryLayers& layers, Mask lifted,
                                HeightsMemory* memory = nullptr) {
  if (layers.validity_bytes == 0) return {};
  const bool whole = memory != nullptr && taken.validity.size() == layers.validity_bytes;
  if (whole && !memory->valid.empty()) return memory->valid;
  std::vector<uint8_t> valid = layers.late_mask
                                   ? decodeLateValidity(taken.validity, header.extent(), lifted)
                                   : decodeValidity(taken.validity, header.extent());
  if (whole) memory->valid = valid;
  return valid;
}

/// The flat areas of the whole plane. known: which samples may be flat.
FlatAreas flatAreasOf(const TakenLayers& taken, const GeometryHeader& header,
                      const GeometryLayers& layers, Mask known) {
  if (layers.flat_bytes == 0 || taken.flat.empty()) return {};
  return decodeFlatAreas(taken.flat, header.extent(), known, layers.flat_areas);
}

/// The heights that decoded steps are: places in a table, if there is one, else themselves.
DecodedHeights heightsOf(DecodedGeometry steps, const TakenLayers& taken,
                         const GeometryHeader& header, const GeometryLayers& layers) {
  if (layers.table_bytes == 0) return {std::move(steps), {}};
  const ValueTable table = decodeValueTable(taken.table, layers.table_values);
  if (table.empty()) return {heightsOfStandIn(layers, std::move(steps)), {}};
  return heightsOf(table, header, std::move(steps));
}

/// The heights with the corrections of samples that are decoded beside those that the table has
/// made, if there is one.
DecodedHeights correctedSamples(DecodedHeights decoded, const GeometryHeader& header,
                                std::span<const uint8_t> codeword) {
  const DecodedGeometry& geometry = decoded.geometry;
  const std::vector<uint8_t> hints = sampleHints(geometry.heights, geometry.fraction_bits, header);
  std::vector<int32_t>& corrections = decoded.corrections;
  corrections.resize(geometry.heights.size());
  const auto add = [&](size_t first, std::span<const int32_t> row) {
    for (size_t x = 0; x < row.size(); ++x) {
      int32_t& sum = corrections[first + x];
      sum = static_cast<int32_t>(static_cast<uint32_t>(sum) + static_cast<uint32_t>(row[x]));
    }
  };
  decodeCorrections(codeword, {hints, geometry.extent(), geometry.valid}, add);
  return decoded;
}

/// The window of heights that were decoded from the first row on, without the marks of their
/// vertices.
DecodedHeights cutWindow(const DecodedHeights& decoded, const View& view) {
  const DecodedGeometry& geometry = decoded.geometry;
  const auto cut_out = [&]<class T>(const std::vector<T>& values) {
    return cut(std::span<const T>(values), geometry.extent(), view);
  };
  const Extent extent = view.extentIn(geometry.extent());
  DecodedHeights part;
  part.geometry.width = extent.width;
  part.geometry.height = extent.height;
  part.geometry.fraction_bits = geometry.fraction_bits;
  part.geometry.heights = cut_out(geometry.heights);
  part.geometry.valid = cut_out(geometry.valid);
  part.corrections = cut_out(decoded.corrections);
  return part;
}

}  // namespace

uint64_t HeightsMemory::bytes() const {
  return valid.size() + lifted.size() + flat.numbers.size() * sizeof(uint16_t) +
         flat.heights.size() * sizeof(int32_t) + tracks.bytes();
}

std::vector<uint8_t> activityHints(const DecodedGeometry& geometry) {
  const std::vector<uint8_t>& marks = geometry.significant;
  const auto [width, height] = geometry.extent();
  assert(marks.size() == geometry.extent().samples());
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

std::vector<uint8_t> decodeValidityLayer(const GeometryHeader& header, const GeometryLayers& layers,
                                         const Codewords& codewords, const View& view) {
  const TakenLayers taken(codewords, layers);
  std::vector<uint8_t> lifted;
  if (layers.late_mask) lifted = lateLifted(taken, header, layers);
  const std::vector<uint8_t> valid = validityOf(taken, header, layers, lifted);
  const ShownLines lines(header, view);
  return lines.shown(cut(std::span<const uint8_t>(valid), header.extent(), lines.coded()));
}

namespace {

/// The steps that the first codewords hold: a drawing, or coefficients beside flat areas.
DecodedGeometry decodeSteps(const GeometryHeader& header, const GeometryLayers& layers,
                            const TakenLayers& taken, const View& view,
                            const DecodeContext<HeightsMemory>& context) {
  HeightsMemory* const memory = context.memory;
  const bool growing = memory != nullptr && taken.opened(layers);
  std::vector<uint8_t> lifted_in_this_call;
  std::vector<uint8_t>& lifted = growing ? memory->lifted : lifted_in_this_call;
  if (layers.late_mask && lifted.empty()) lifted = lateLifted(taken, header, layers);
  std::vector<uint8_t> valid = validityOf(taken, header, layers, lifted, memory);
  const std::vector<uint8_t> joined = taken.joined();
  Codewords coefficients = taken.coefficients;
  if (!joined.empty()) coefficients.front() = joined;
  if (header.drawn) return decodeDrawnHeights(header, coefficients.front(), valid, view.level);
  if (layers.bridge > 0 && lifted.empty())
    lifted = liftedSamples(valid, header.extent(), layers.bridge);
  std::optional<Mask> bridged;
  if (layers.late_mask || layers.bridge > 0) bridged = lifted;
  FlatAreas of_this_call;
  FlatAreas& flat = growing ? memory->flat : of_this_call;
  if (flat.empty())
    flat = flatAreasOf(taken, header, layers, layers.late_mask ? *bridged : Mask(valid));
  return decodeGeometry(header, coefficients, {std::move(valid), flat.held(), bridged}, view,
                        {context.threads, growing ? &memory->tracks : nullptr});
}

/// Decodes a view of the coded lines, with everything that the codewords hold for it.
DecodedHeights decodeTaken(const GeometryHeader& header, const GeometryLayers& layers,
                           const TakenLayers& taken, const View& view,
                           const DecodeContext<HeightsMemory>& context) {
  if (header.stored()) {
    const std::vector<uint8_t> valid = validityOf(taken, header, layers, {}, context.memory);
    return decodeStoredHeights(header, taken.coefficients.front(), valid, view.level);
  }
  DecodedHeights decoded =
      heightsOf(decodeSteps(header, layers, taken, view, context), taken, header, layers);
  if (taken.corrections.empty() || view.level > 0) return decoded;
  if (layers.corrections == CorrectionKind::kSteps) {
    decoded.geometry.quiet_levels = 0;
    decoded.geometry =
        layers.correction_step > 1
            ? correctedSteps(std::move(decoded.geometry), layers.correction_step, taken.corrections)
            : exactSteps(std::move(decoded.geometry), taken.corrections);
    return decoded;
  }
  if (layers.corrections == CorrectionKind::kRelative)
    return restoreRelative(std::move(decoded), header, layers.relative, taken.corrections);
  return correctedSamples(std::move(decoded), header, taken.corrections);
}

/// Decodes a view of the coded lines; a window is cut out of what decodedView() says.
DecodedHeights decodeLines(const GeometryHeader& header, const GeometryLayers& layers,
                           const Codewords& codewords, const View& view,
                           const DecodeContext<HeightsMemory>& context) {
  const TakenLayers taken(codewords, layers);
  if (view.window && (header.direct() || !taken.corrections.empty())) {
    const View all = decodedView(header, layers, view);
    return cutWindow(decodeTaken(header, layers, taken, all, {context.threads}), view);
  }
  return decodeTaken(header, layers, taken, view, context);
}

}  // namespace

View decodedView(const GeometryHeader& header, const GeometryLayers& layers, const View& view) {
  if (header.direct()) return {};
  if (!view.window || layers.corrections == CorrectionKind::kNone) return view;
  const uint32_t rows = view.window->y + view.window->height;
  if (layers.corrections == CorrectionKind::kSteps || rows == header.height) return {};
  return {0, Window{0, 0, header.width, rows}};
}

DecodedHeights decodeHeights(const GeometryHeader& header, const GeometryLayers& layers,
                             const Codewords& codewords, const View& view,
                             const DecodeContext<HeightsMemory>& context) {
  const ShownLines lines(header, view);
  return shownHeights(lines, decodeLines(header, layers, codewords, lines.coded(), context));
}

}  // namespace tetrakis::inline geometry
