// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/heights_decoder.hpp"

#include <algorithm>
#include <cassert>
#include <optional>
#include <span>
#include <utility>

#include "bitstream/stream/correction_tracks.hpp"
#include "codec/geometry/corrected_heights.hpp"
#include "codec/geometry/drawn_heights/drawn_heights_decoder.hpp"
#include "codec/geometry/flat/flat_decoder.hpp"
#include "codec/geometry/shown_heights.hpp"
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

/// The tracks taken apart.
struct TakenLayers {
  std::span<const uint8_t> lifted, validity, table, flat;
  Codewords coefficients;  ///< of the first track those before what lies among them
  Codewords corrections;   ///< of each part of the plane
  std::vector<std::span<const uint8_t>> more;  ///< the others of it, in their order

  TakenLayers(const Codewords& codewords, const GeometryHeader& header,
              const GeometryLayers& layers)
      : coefficients(codewords) {
    const auto apart = static_cast<ptrdiff_t>(correctionTracks(header, layers));
    assert(codewords.size() > static_cast<size_t>(apart));
    corrections.assign(coefficients.end() - apart, coefficients.end());
    coefficients.erase(coefficients.end() - apart, coefficients.end());
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
    if (corrections.empty()) corrections.push_back(first);
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

  bool isCorrected() const {
    return std::any_of(corrections.begin(), corrections.end(),
                       [](const auto& codeword) { return !codeword.empty(); });
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

}  // namespace

uint64_t HeightsMemory::bytes() const {
  return valid.size() + lifted.size() + flat.numbers.size() * sizeof(uint16_t) +
         flat.heights.size() * sizeof(int32_t) + tracks.bytes();
}

std::vector<uint8_t> decodeValidityLayer(const GeometryHeader& header, const GeometryLayers& layers,
                                         const Codewords& codewords, const View& view) {
  const TakenLayers taken(codewords, header, layers);
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
  return decodeCoefficients(header, coefficients, {std::move(valid), flat.held(), bridged}, view,
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
  if (view.level > 0 || !taken.isCorrected()) return decoded;
  return corrected(std::move(decoded), header, layers, taken.corrections, view, context.threads);
}

/// Decodes a view of the coded lines; a window is cut out of what decodedView() says.
DecodedHeights decodeLines(const GeometryHeader& header, const GeometryLayers& layers,
                           const Codewords& codewords, const View& view,
                           const DecodeContext<HeightsMemory>& context) {
  const TakenLayers taken(codewords, header, layers);
  if (view.window && (header.direct() || taken.isCorrected())) {
    const View all = decodedView(header, layers, view);
    const DecodedHeights decoded = decodeTaken(header, layers, taken, all, {context.threads});
    const Window& window = *view.window;
    return windowOf(decoded, {window.x - all.firstColumn(), window.y - all.firstRow(), window.width,
                              window.height});
  }
  return decodeTaken(header, layers, taken, view, context);
}

}  // namespace

View decodedView(const GeometryHeader& header, const GeometryLayers& layers, const View& view) {
  if (header.direct()) return {};
  return correctedView(header, layers, view);
}

DecodedHeights decodeHeights(const GeometryHeader& header, const GeometryLayers& layers,
                             const Codewords& codewords, const View& view,
                             const DecodeContext<HeightsMemory>& context) {
  const ShownLines lines(header, view);
  return shownHeights(lines, decodeLines(header, layers, codewords, lines.coded(), context));
}

}  // namespace tetrakis::inline geometry
