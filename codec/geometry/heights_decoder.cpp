// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/heights_decoder.hpp"

#include <cassert>
#include <optional>
#include <span>
#include <utility>

#include "base/forest.hpp"
#include "bitstream/coder/adaptive_bit.hpp"
#include "codec/geometry/drawn_heights/drawn_heights_decoder.hpp"
#include "codec/geometry/flat/flat_areas.hpp"
#include "codec/geometry/plane_corrections.hpp"
#include "codec/geometry/region_masks.hpp"
#include "codec/geometry/values/value_table.hpp"
#include "codec/lattice/validity.hpp"
#include "codec/wavelet/morphology.hpp"

namespace tetrakis::inline geometry {

namespace {

// shownHeights() turns heights of the coded lines into those of a view of all lines
// (codec/lines/shown_lines.hpp).

/// Turns heights of coded lines into those of the view. Where a coded sample is shown several
/// times, the vertex lies at its first place.
DecodedHeights shownHeights(const ShownLines& lines, DecodedHeights decoded) {
  if (lines.none()) return decoded;
  DecodedGeometry& geometry = decoded.geometry;
  geometry.heights = lines.shown(std::move(geometry.heights));
  geometry.valid = lines.shown(std::move(geometry.valid));
  geometry.significant = lines.shown(std::move(geometry.significant));
  decoded.corrections = lines.shown(std::move(decoded.corrections));
  const ShownLines::Lines &columns = lines.columns(), &rows = lines.rows();
  geometry.width = static_cast<uint32_t>(columns.size());
  geometry.height = static_cast<uint32_t>(rows.size());
  geometry.quiet_levels = 0;
  if (geometry.significant.empty()) return decoded;
  for (size_t y = 0, i = 0; y < rows.size(); ++y) {
    const bool repeated_row = y > 0 && rows[y] == rows[y - 1];
    for (size_t x = 0; x < columns.size(); ++x, ++i) {
      if (repeated_row || (x > 0 && columns[x] == columns[x - 1])) geometry.significant[i] = 0;
    }
  }
  return decoded;
}

/// Which samples of the whole plane are lifted, of heights whose mask comes late; null: all.
SharedBits lateLifted(const TakenLayers& taken) {
  if (taken.stated.lifted_bytes == 0) return nullptr;
  return shared(decodeValidity(taken.lifted, taken.header.extent()));
}

/// The validity mask of the whole plane, which is not that of regions. lifted: lateLifted(), if the
/// mask comes late.
SharedBits validityOf(const TakenLayers& taken, const SharedBits& lifted,
                      HeightsMemory* memory = nullptr) {
  const GeometryLayers& stated = taken.stated;
  if (stated.validity_bytes == 0) return nullptr;
  const bool whole = memory != nullptr && taken.validity.size() == stated.validity_bytes;
  if (whole && memory->valid != nullptr) return memory->valid;
  const Extent plane = taken.header.extent();
  SharedBits valid = shared(stated.late_mask ? decodeLateValidity(taken.validity, plane, lifted)
                                             : decodeValidity(taken.validity, plane));
  if (whole) memory->valid = valid;
  return valid;
}

/// The flat areas of the whole plane. known: which samples may be flat; of a forest those that are
/// owned.
FlatAreas flatAreasOf(const TakenLayers& taken, const SharedBits& known) {
  if (taken.stated.flat_bytes == 0 || taken.flat.empty()) return {};
  const Extent plane = taken.header.extent();
  const SharedForest& forest = taken.header.wavelet.forest;
  if (forest == nullptr) return decodeFlatAreas(taken.flat, plane, known, taken.stated.flat_areas);
  return decodeFlatAreas(taken.flat, plane, shared(ownedSamples(*forest)), taken.stated.flat_areas,
                         forest.get());
}

/// Turns decoded steps into heights: they are places in a table if there is one, else heights
/// already.
DecodedHeights heightsOf(DecodedGeometry steps, const TakenLayers& taken) {
  if (taken.stated.table_bytes == 0) return {std::move(steps), {}};
  const ValueTable table = decodeValueTable(taken.table, taken.stated.table_values);
  if (table.empty()) return {heightsOfStandIn(taken.stated, std::move(steps)), {}};
  return heightsOf(table, taken.header, std::move(steps));
}

/// The part of the coded lines that is decoded for a view.
struct DecodedView {
  View view;
  bool corrected = false;  ///< corrections reach it
};

/// Whether corrections of a plane in one track end before a row: each correction takes a decision,
/// and the bytes pay for a limited number.
bool correctionsEndBefore(uint32_t row, const TakenLayers& taken, const SharedBits& valid) {
  if (taken.corrections.size() > 1) return false;
  const uint64_t most = mostDecisions(taken.corrections.front().size());
  if (valid == nullptr) return size_t{row} * taken.header.width >= most;
  uint64_t before = 0;
  for (uint32_t y = 0; y < row && before < most; ++y)
    before += valid->countBefore(taken.header.width, y);
  return before >= most;
}

/// Voids have no corrections.
bool holdsValid(const SharedBits& valid, const Window& window) {
  if (valid == nullptr) return true;
  for (uint32_t y = window.y; y < window.y + window.height; ++y) {
    if (valid->countBefore(window.x + window.width, y) > valid->countBefore(window.x, y))
      return true;
  }
  return false;
}

DecodedView decodedViewOf(const TakenLayers& taken, const SharedBits& valid, const View& asked) {
  const bool corrected = asked.level == 0 && taken.isCorrected();
  if (taken.header.wavelet.forest != nullptr) return {asked, corrected};
  if (!asked.window) return {asked, corrected};
  const View all = correctedView(taken.header, taken.stated, asked);
  if (!corrected || !holdsValid(valid, *asked.window) ||
      correctionsEndBefore(asked.window->y, taken, valid))
    return {asked, false};
  return {all, true};
}

/// The steps that the first codewords hold: a drawing, or coefficients beside flat areas. view: the
/// view that is asked for; on return, the view that is decoded.
DecodedGeometry decodeSteps(const TakenLayers& taken, DecodedView& view,
                            const DecodeContext<HeightsMemory>& context) {
  const GeometryHeader& header = taken.header;
  const GeometryLayers& stated = taken.stated;
  if (!header.frames.none()) return decodeFrame(taken, view.view, context);
  // Later calls may go on from here once all layers are there that coefficients depend on.
  HeightsMemory* const kept = taken.isOpened() ? context.memory : nullptr;
  HeightsMemory of_this_call;
  HeightsMemory& memory = kept != nullptr ? *kept : of_this_call;
  SharedBits& lifted = memory.lifted;
  if (stated.late_mask && lifted == nullptr) lifted = lateLifted(taken);
  const JoinedCoefficients joined = joinCoefficients(taken);
  if (stated.region_masks) {
    view = decodedViewOf(taken, nullptr, view.view);
    return decodeCoefficients(header, joined.codewords,
                              {decodeRegionMasks(taken, view.view), {}, {}}, view.view,
                              {context.threads, kept != nullptr ? &memory.tracks : nullptr});
  }
  const SharedBits valid = validityOf(taken, lifted, context.memory);
  view = decodedViewOf(taken, valid, view.view);
  if (header.drawn) {
    const std::span<const uint8_t> codeword = joined.codewords.front();
    return kept != nullptr && kept->drawing
               ? kept->drawing(codeword.size())
               : decodeDrawnHeights(header, codeword, valid, view.view);
  }
  if (stated.bridge > 0 && lifted == nullptr) lifted = liftedSamples(valid, stated.bridge);
  std::optional<SharedBits> bridged;
  if (stated.late_mask || stated.bridge > 0) bridged = lifted;
  if (memory.flat.empty()) memory.flat = flatAreasOf(taken, stated.late_mask ? lifted : valid);
  return decodeCoefficients(header, joined.codewords, {valid, memory.flat.held(), bridged},
                            view.view,
                            {context.threads, kept != nullptr ? &memory.tracks : nullptr});
}

/// Decodes a view of the coded lines from all codewords. view: as of decodeSteps().
DecodedHeights decodeTaken(const TakenLayers& taken, DecodedView& view,
                           const DecodeContext<HeightsMemory>& context) {
  const GeometryHeader& header = taken.header;
  if (context.memory != nullptr && context.memory->corrected && taken.isCorrected())
    return context.memory->corrected(taken.corrections.front().size());
  if (header.stored()) {
    return decodeStoredHeights(header, joinCoefficients(taken).codewords.front(),
                               validityOf(taken, nullptr, context.memory), view.view);
  }
  DecodedGeometry steps = decodeSteps(taken, view, context);
  DecodedHeights decoded = heightsOf(std::move(steps), taken);
  if (!view.corrected) return decoded;
  const bool keeps = context.memory != nullptr && context.memory->parts.most_bytes > 0;
  return corrected(std::move(decoded), taken, view.view,
                   {context.threads, keeps ? &context.memory->parts : nullptr});
}

/// What of the coded lines is decoded for a view of them.
View decodedLines(const GeometryHeader& header, const GeometryLayers& layers, const View& view) {
  // The lattice of a drawing is that of the raster, whose levels are not those of patches.
  if (header.drawn && header.wavelet.forest != nullptr) return {};
  const bool corrected = view.level == 0 && layers.corrections != CorrectionKind::kNone;
  return viewOnForest(header, view, !header.stored() && layers.validity_bytes == 0 && !corrected);
}

/// Samples that several patches share become what they are in the patch that owns them.
void share(const GeometryHeader& header, DecodedHeights& decoded) {
  const SharedForest& forest = header.wavelet.forest;
  if (forest == nullptr) return;
  const auto shareAll = [&](auto& values) {
    if (!values.empty()) shareOwned(*forest, std::span(values), decoded.geometry.width - 1);
  };
  shareAll(decoded.geometry.heights);
  shareAll(decoded.geometry.valid);
  shareAll(decoded.geometry.significant);
  shareAll(decoded.corrections);
}

/// Decodes a view of the coded lines, which is taken out of what is decoded for it.
DecodedHeights decodeLines(const TakenLayers& taken, const View& view,
                           const DecodeContext<HeightsMemory>& context) {
  assert(view.level == 0 || taken.header.wavelet.forest == nullptr ||
         view.patch_rows == taken.header.wavelet.forest->side());
  DecodedView all{decodedLines(taken.header, taken.stated, view)};
  DecodedHeights decoded = decodeTaken(taken, all, context);
  if (!all.view.window) share(taken.header, decoded);
  const Extent plane = taken.header.extent();
  if (all.view.extentIn(plane) == view.extentIn(plane)) return decoded;
  View shown = view;
  if (shown.window) {
    shown.window->x -= all.view.firstColumn();
    shown.window->y -= all.view.firstRow();
  }
  return viewOf(decoded, shown);
}

}  // namespace

uint64_t HeightsMemory::bytes() const {
  const auto bytesOf = [](const SharedBits& marks) {
    return marks != nullptr ? BitPlane::bytesOf(marks->extent()) : 0;
  };
  uint64_t of_frames = frames.bytes();
  for (const SharedBits& mask : frame_masks) of_frames += bytesOf(mask);
  return of_frames + bytesOf(valid) + bytesOf(lifted) + flat.numbers.size() * sizeof(uint16_t) +
         flat.heights.size() * sizeof(int32_t) + tracks.bytes() + parts.bytes();
}

std::vector<uint8_t> decodeValidityLayer(const GeometryHeader& header, const GeometryLayers& layers,
                                         const Codewords& codewords, const View& view) {
  const TakenLayers taken = takeApart(codewords, header, layers);
  const ShownLines lines(header, view);
  if (layers.region_masks)
    return lines.shown(decodeRegionMasks(taken, lines.coded()).shown(lines.coded()));
  const SharedBits valid = header.frames.none()
                               ? validityOf(taken, layers.late_mask ? lateLifted(taken) : nullptr)
                               : frameMasksOf(taken)[view.frame];
  return lines.shown(shownMarks(valid, lines.coded()));
}

View decodedView(const GeometryHeader& header, const GeometryLayers& layers, const View& view) {
  if (header.direct()) return {};
  return correctedView(header, layers, decodedLines(header, layers, view));
}

DecodedHeights decodeHeights(const GeometryHeader& header, const GeometryLayers& layers,
                             const Codewords& codewords, const View& view,
                             const DecodeContext<HeightsMemory>& context) {
  const ShownLines lines(header, view);
  const TakenLayers taken = takeApart(codewords, header, layers);
  return shownHeights(lines, decodeLines(taken, lines.coded(), context));
}

DecodedHeights decodeUncorrected(const GeometryHeader& header, const GeometryLayers& layers,
                                 const Codewords& codewords) {
  const TakenLayers taken = takeApart(codewords, header, layers);
  assert(!taken.isCorrected());
  DecodedView all;
  return decodeTaken(taken, all, {});
}

}  // namespace tetrakis::inline geometry
