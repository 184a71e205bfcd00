// SPDX-License-Identifier: Apache-2.0
#include "encoder/mosaic/restored_plane.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include "base/parallel.hpp"
#include "bitstream/track/track_decoder.hpp"
#include "codec/geometry/heights_decoder.hpp"
#include "codec/wavelet/synthesis/view_synthesis.hpp"
#include "encoder/mosaic/block_layout.hpp"
#include "encoder/mosaic/part.hpp"

namespace tetrakis::inline mosaic {

namespace {

/// The coefficients of a region in the block.
struct RegionCodeword {
  Region region;
  std::vector<uint8_t> bytes;
};

/// Whether all of a region, which lies in the plane of a group, is in a window of whole regions.
bool isIn(const Window& window, const LowBand& plane, const Region& region) {
  const uint32_t x = region.x0 >> plane.splits_x, y = region.y0 >> plane.splits_y;
  return Window{x, y, 1, 1}.meets(window);
}

/// The codewords of the block, which other tasks have left.
Result<std::vector<RegionCodeword>> readCodewords(const TaskInputs& inputs, const Window& block) {
  const MosaicGrid& grid = inputs.grid;
  const LowBand& plane = grid.pyramid().low(kRegionLevels * grid.planeGroup(inputs.tile));
  std::vector<RegionCodeword> codewords;
  for (const Tile& coder : grid.coders(inputs.tile)) {
    const Result<PartTable> table = readTable(inputs.files, hashOf(inputs.plan), coder);
    if (!table.ok()) return table.status();
    const std::vector<uint32_t> numbers = grid.tracks(coder);
    for (size_t i = 0; i < std::min(numbers.size(), table->tracks.size()); ++i) {
      const Region& region = grid.regions()[numbers[i]];
      if (!isIn(block, plane, region)) continue;
      const PartTable::Track& track = table->tracks[i];
      Result<std::vector<uint8_t>> bytes = readCodeword(inputs.files, coder, track);
      if (!bytes.ok()) return bytes.status();
      bytes->erase(bytes->begin(), bytes->begin() + static_cast<ptrdiff_t>(track.opening));
      codewords.push_back({region, *std::move(bytes)});
    }
  }
  return codewords;
}

/// The low band of the block as the group before has restored it. Not of the base.
Result<LowPart> restoredLow(const TaskInputs& inputs, const Window& window) {
  LowPart low{window.extent(), std::vector<int32_t>(window.extent().samples()),
              PartMask(window.extent().samples())};
  for (const Tile& other : inputs.grid.lowNeeds(inputs.tile)) {
    const Result<LowPart> part = readLowOf(inputs, other);
    if (!part.ok()) return part.status();
    if (part->marks.empty())
      return Status(TKS_IO, "The part " + lowName(other) + " of the mosaic has no marks.");
    const Window from = inputs.grid.low(other);
    copyShared<int32_t>(from, part->values, window, low.values);
    copyShared<uint8_t>(from, part->marks, window, low.marks);
  }
  return low;
}

/// Puts as much of the low band as the synthesis needs.
void putLow(const LowPart& low, const Subband& ll, ViewSynthesis& synthesis) {
  const Window needed = synthesis.needed(ll);
  for (uint32_t row = 0; row < needed.height; ++row) {
    const auto from = low.values.begin() +
                      static_cast<ptrdiff_t>(size_t{needed.y + row} * low.extent.width + needed.x);
    std::copy_n(from, needed.width, synthesis.row(ll, row).begin());
  }
}

/// Marks the vertices of a window that are marked in the low band.
void addMarks(const LowPart& low, const Subband& ll, const Window& window,
              std::vector<uint8_t>& marks) {
  for (uint32_t row = 0; row < low.extent.height; ++row) {
    for (uint32_t column = 0; column < low.extent.width; ++column) {
      const uint32_t x = ll.sampleColumn(column) - window.x, y = ll.planeRow(row) - window.y;
      if (low.marks[size_t{row} * low.extent.width + column] == 0) continue;
      if (x < window.width && y < window.height) marks[size_t{y} * window.width + x] = 1;
    }
  }
}

/// The coefficients of the block, decoded.
void decodeAll(const TaskInputs& inputs, const BlockLayout& layout,
               const std::vector<RegionCodeword>& codewords, ViewSynthesis& synthesis,
               ShownSignificance& significance) {
  parallelFor(inputs.threads, codewords.size(), [&](size_t i) {
    if (codewords[i].bytes.empty()) return;
    BlockLayout::Track track = layout.trackOf(codewords[i].region);
    bool any = false;
    for (size_t k = 0; k < track.here.size(); ++k) {
      track.plan[k].needed = synthesis.needs(track.here[k]);
      any |= track.plan[k].needed;
    }
    if (!any) return;
    const TrackState state =
        decodeTrack(std::move(track.plan), inputs.plan.geometry().planes, codewords[i].bytes);
    for (size_t k = 0; k < track.here.size(); ++k) synthesis.put(state.bands[k], 0, track.here[k]);
    significance.take(i, state.bands, track.here);
  });
}

/// The mask of the block; empty: all samples exist.
Result<PartMask> maskOf(const TaskInputs& inputs, const Window& block) {
  if (!inputs.plan.hasVoids()) return PartMask();
  Result<Block> original = readBlock(inputs, block);
  if (!original.ok()) return original.status();
  return std::move(original->valid);
}

/// The low band above the block; nothing above the base.
Result<LowPart> lowAbove(const TaskInputs& inputs, const Window& block) {
  const int group = inputs.grid.planeGroup(inputs.tile);
  if (group == inputs.grid.groups()) return LowPart{{0, 0}, {}, {}};
  return restoredLow(inputs, inputs.grid.coarser(group, block));
}

}  // namespace

Result<DecodedGeometry> restorePlane(const TaskInputs& inputs) {
  const Window block = inputs.grid.block(inputs.tile), samples = inputs.grid.samples(inputs.tile);
  const Window inner{samples.x - block.x, samples.y - block.y, samples.width, samples.height};
  const Result<PartMask> valid = maskOf(inputs, block);
  if (!valid.ok()) return valid.status();
  const Result<std::vector<RegionCodeword>> codewords = readCodewords(inputs, block);
  if (!codewords.ok()) return codewords.status();
  const Result<LowPart> low = lowAbove(inputs, block);
  if (!low.ok()) return low.status();
  const BlockLayout layout(inputs, block, *valid);
  const Pyramid& pyramid = layout.local().pyramid();
  const Subband& ll = pyramid.subbands().front();
  const View view{0, inner};
  ViewSynthesis synthesis(layout.spec(), pyramid, view);
  synthesis.allocate();
  if (!low->values.empty()) putLow(*low, ll, synthesis);
  ShownSignificance significance(pyramid, view, codewords->size());
  decodeAll(inputs, layout, *codewords, synthesis, significance);
  DecodedGeometry out;
  out.width = samples.width;
  out.height = samples.height;
  out.fraction_bits = inputs.plan.geometry().wavelet.fraction_bits;
  out.heights = synthesis.run(inputs.threads);
  significance.giveTo(out);
  addMarks(*low, ll, inner, out.significant);
  out.valid = slice(std::span<const uint8_t>(*valid), block.extent(), view);
  clearUnmarked(std::span(out.heights), out.valid);
  clearUnmarked(std::span(out.significant), out.valid);
  return out;
}

}  // namespace tetrakis::inline mosaic
