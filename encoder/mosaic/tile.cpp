// SPDX-License-Identifier: Apache-2.0
#include "encoder/mosaic/tile.hpp"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "base/parallel.hpp"
#include "bitstream/track/track_decoder.hpp"
#include "codec/wavelet/band_plan.hpp"
#include "codec/wavelet/wavelet.hpp"
#include "encoder/mosaic/block.hpp"
#include "encoder/mosaic/block_layout.hpp"
#include "encoder/mosaic/restored_plane.hpp"
#include "encoder/mosaic/track_mask.hpp"
#include "ratecontrol/curves/component_curve.hpp"

namespace tetrakis::inline mosaic {

namespace {

/// A lifted block, whose values it takes.
class LiftedBlock {
 public:
  LiftedBlock(const TaskInputs& inputs, Block& block)
      : layout_(inputs, block.window, block.valid), values_(std::move(block.values)) {
    forwardWavelet(layout_.spec(), layout_.local().pyramid(), values_, inputs.threads);
  }

  /// The bands and samples that the track of a region of the tile is made of, as of the whole
  /// plane.
  TrackSource sourceOf(const Region& region) const {
    BlockLayout::Track track = layout_.trackOf(region);
    TrackSource source{std::move(track.plan), {}};
    for (size_t i = 0; i < track.here.size(); ++i) {
      source.bands.push_back({layout_.local().gather(values_, track.here[i]), track.weights[i]});
      clearAbsent(source.plan[i], source.bands[i].values);
    }
    return source;
  }

  /// The value of all samples of the low band; nothing if they differ, or anything else is not 0.
  std::optional<int32_t> constantLow() const {
    const Pyramid& pyramid = layout_.local().pyramid();
    const Subband& ll = pyramid.subbands().front();
    const int32_t low = values_[pyramid.indexOf(ll, 0)];
    std::vector<int32_t> others = values_;
    for (uint32_t y = 0; y < ll.height; ++y) {
      for (uint32_t x = 0; x < ll.width; ++x) {
        int32_t& value = others[pyramid.indexOf(ll, y) + x];
        if (value != low) return std::nullopt;
        value = 0;
      }
    }
    if (std::any_of(others.begin(), others.end(), [](int32_t value) { return value != 0; }))
      return std::nullopt;
    return low;
  }

  /// The low band of the tile, without the halo. low: MosaicGrid::low().
  LowPart lowPart(const Window& low, bool has_voids) const {
    const Pyramid& pyramid = layout_.local().pyramid();
    const Subband& ll = pyramid.subbands().front();
    const Window& block = layout_.window();
    const uint32_t x0 = low.x - (block.x >> ll.splits_x), y0 = low.y - (block.y >> ll.splits_y);
    LowPart part{low.extent(), {}, {}};
    for (uint32_t y = 0; y < low.height; ++y) {
      const size_t row = pyramid.indexOf(ll, y0 + y) + x0;
      part.values.insert(part.values.end(), values_.begin() + static_cast<ptrdiff_t>(row),
                         values_.begin() + static_cast<ptrdiff_t>(row + low.width));
      for (uint32_t x = 0; has_voids && x < low.width; ++x)
        part.marks.push_back(pyramid.exists(ll.sampleColumn(x0 + x), ll.planeRow(y0 + y)));
    }
    return part;
  }

 private:
  BlockLayout layout_;
  std::vector<int32_t> values_;
};

/// Whether a decoder gets the coefficients of a codeword back.
bool decodes(const TrackSource& source, const EncodedTrack& track) {
  const TrackState state = decodeTrack(source.plan, track.planes, track.codeword);
  for (size_t i = 0; i < source.bands.size(); ++i) {
    const Band& band = state.bands[i];
    const auto decoded = [&](size_t cell) {  // a band of zeros holds nothing
      return !band.hasCells() ? 0 : static_cast<int32_t>(band.magnitude[cell]) * band.sign[cell];
    };
    const BandShape& shape = source.plan[i].shape;
    for (uint32_t row = 0; row < shape.rows; ++row) {
      const size_t first = shape.cell(row, 0);
      for (size_t cell = first; cell < first + shape.columns; ++cell)
        if (decoded(cell) != source.bands[i].values[cell]) return false;
    }
  }
  return true;
}

/// Ends a track where a byte takes off less than `slope`, in squared steps.
void cutAt(double slope, EncodedTrack& track) {
  const uint64_t end = bytesWorth(track.points, slope);
  std::erase_if(track.points, [&](const RatePoint& point) { return point.bytes > end; });
  track.codeword.resize(end);
}

/// The points that packets may end at: all others would only make the part longer.
std::vector<RatePoint> thinned(const std::vector<RatePoint>& points) {
  const std::vector<RatePoint> hull = lowerHull(points, 0);
  std::vector<RatePoint> ends = {hull.front()};
  for (size_t i = 1; i < hull.size(); ++i)
    for (const RatePoint& end : packetEnds(points, hull[i - 1], hull[i])) ends.push_back(end);
  return ends;
}

/// A track without a coefficient that is not 0, which takes no byte: decoders take coefficients
/// that no byte tells for 0.
EncodedTrack emptyTrack(int planes) {
  return {{}, {{}}, planes};
}

/// Codes the tracks of a tile. TKS_MISMATCH: one does not decode to what was coded.
Result<std::vector<EncodedTrack>> codeTracks(const TaskInputs& inputs, const LiftedBlock& lifted) {
  const MosaicPlan& plan = inputs.plan;
  const std::vector<uint32_t> numbers = inputs.grid.tracks(inputs.tile);
  std::vector<EncodedTrack> tracks(numbers.size());
  std::atomic<bool> sound = true;
  parallelFor(inputs.threads, numbers.size(), [&](size_t i) {
    const TrackSource source = lifted.sourceOf(inputs.grid.regions()[numbers[i]]);
    const int planes = plan.geometry().planes;
    EncodedTrack& track = tracks[i];
    if (planesOf(source) > planes) {
      sound = false;
      return;
    }
    if (planesOf(source) == 0 && !inputs.grid.isBase(inputs.tile)) {
      track = emptyTrack(planes);
      return;
    }
    track = encodeTrack(source, planes, plan.cut_slope);
    if (plan.cut_slope > 0) cutAt(plan.cut_slope, track);
    track.points = thinned(track.points);
    // Corrections prove what comes before them.
    if (!plan.corrects() && !decodes(source, track)) sound = false;
  });
  if (sound) return tracks;
  return Status(TKS_MISMATCH, "A tile of the mosaic does not come back: a fault of the encoder.");
}

/// How many samples of a window of the plane exist.
uint64_t validIn(const Block& block, const Window& samples) {
  if (block.valid.empty()) return samples.extent().samples();
  const Window inner{samples.x - block.window.x, samples.y - block.window.y, samples.width,
                     samples.height};
  const std::vector<uint8_t> valid =
      slice(std::span<const uint8_t>(block.valid), block.window.extent(), {0, inner});
  return static_cast<uint64_t>(std::count(valid.begin(), valid.end(), 1));
}

/// Puts masks in front of the coefficients of all tracks of a tile.
void openTracks(const TaskInputs& inputs, const Block& block, Part& part) {
  const std::vector<uint32_t> numbers = inputs.grid.tracks(inputs.tile);
  part.openings.resize(numbers.size());
  parallelFor(inputs.threads, numbers.size(), [&](size_t i) {
    part.openings[i] =
        openWithMask(inputs, block, inputs.grid.regions()[numbers[i]], part.tracks[i]);
  });
}

/// Whether nothing exists of a block, as over the sea or abroad.
bool isVoid(const Block& block) {
  return !block.valid.empty() &&
         std::find(block.valid.begin(), block.valid.end(), 1) == block.valid.end();
}

/// The tile of a block of which nothing exists: what coding it would make, without doing so.
CodedTile voidTile(const TaskInputs& inputs) {
  const MosaicGrid& grid = inputs.grid;
  CodedTile coded;
  const size_t tracks = grid.tracks(inputs.tile).size();
  coded.part.tracks.assign(tracks, emptyTrack(inputs.plan.geometry().planes));
  coded.part.openings.resize(tracks);
  if (!grid.leavesLow(inputs.tile)) return coded;
  const Extent low = grid.low(inputs.tile).extent();
  coded.low = {low, std::vector<int32_t>(low.samples()), PartMask(low.samples())};
  return coded;
}

/// The value of all samples of a block, as on a calm sea; nothing if they differ, or some are void.
std::optional<int32_t> constantOf(const Block& block) {
  const auto is_valid = [](uint8_t mark) { return mark != 0; };
  const auto is_first = [&](int32_t value) { return value == block.values.front(); };
  if (!std::all_of(block.valid.begin(), block.valid.end(), is_valid)) return std::nullopt;
  if (!std::all_of(block.values.begin(), block.values.end(), is_first)) return std::nullopt;
  return block.values.front();
}

/// The value that lifting makes of a plane of one value: itself or a multiple of it, as a small
/// plane tells, whatever lies around it.
std::optional<int32_t> constantLow(const TaskInputs& inputs, int32_t value) {
  const uint32_t side = uint32_t{8} << inputs.grid.levels(inputs.tile);
  const Window window{0, 0, side, side};
  Block plane{window, std::vector<int32_t>(window.extent().samples(), value), {}};
  return LiftedBlock(inputs, plane).constantLow();
}

/// The tile of a block whose samples have one value: what coding it would make, without doing so.
CodedTile constantTile(const TaskInputs& inputs, const Block& block, int32_t low_value) {
  CodedTile coded = voidTile(inputs);
  if (inputs.tile.group == 0)
    coded.part.valid_samples = validIn(block, inputs.grid.samples(inputs.tile));
  std::fill(coded.low.values.begin(), coded.low.values.end(), low_value);
  if (inputs.plan.hasVoids()) {
    std::fill(coded.low.marks.begin(), coded.low.marks.end(), 1);
    openTracks(inputs, block, coded.part);
  } else {
    coded.low.marks.clear();
    coded.part.openings.clear();
  }
  return coded;
}

Result<CodedTile> codeCoefficients(const TaskInputs& inputs) {
  const MosaicGrid& grid = inputs.grid;
  const bool has_voids = inputs.plan.hasVoids();
  Result<Block> block = readBlock(inputs, grid.block(inputs.tile));
  if (!block.ok()) return block.status();
  if (!grid.isBase(inputs.tile) && isVoid(*block)) return voidTile(inputs);
  if (const auto value = constantOf(*block); value && !grid.isBase(inputs.tile)) {
    if (const auto low = constantLow(inputs, *value)) return constantTile(inputs, *block, *low);
  }
  CodedTile coded;
  if (inputs.tile.group == 0) coded.part.valid_samples = validIn(*block, grid.samples(inputs.tile));
  const LiftedBlock lifted(inputs, *block);
  if (grid.leavesLow(inputs.tile)) coded.low = lifted.lowPart(grid.low(inputs.tile), has_voids);
  Result<std::vector<EncodedTrack>> tracks = codeTracks(inputs, lifted);
  if (!tracks.ok()) return tracks.status();
  coded.part.tracks = *std::move(tracks);
  if (has_voids) openTracks(inputs, *block, coded.part);
  return coded;
}

Result<CodedTile> restoreTile(const TaskInputs& inputs) {
  Result<DecodedGeometry> plane = restorePlane(inputs);
  if (!plane.ok()) return plane.status();
  CodedTile coded;
  if (inputs.grid.leavesLow(inputs.tile)) {
    coded.low = {plane->extent(), std::move(plane->heights), std::move(plane->significant)};
    return coded;
  }
  Result<std::vector<EncodedTrack>> tracks = codeCorrections(inputs, *std::move(plane));
  if (!tracks.ok()) return tracks.status();
  coded.part.tracks = *std::move(tracks);
  return coded;
}

}  // namespace

Result<CodedTile> codeTile(const MosaicPlan& plan, const Tile& tile, const ReadSamples& read,
                           const MosaicFiles& files, uint32_t threads) {
  const MosaicGrid grid = plan.grid();
  assert(grid.has(tile));
  const TaskInputs inputs{plan, grid, tile, read, files, threads};
  return grid.isRestoring(tile) ? restoreTile(inputs) : codeCoefficients(inputs);
}

Status runTask(const MosaicPlan& plan, const Tile& tile, const ReadSamples& read,
               const MosaicFiles& files, uint32_t threads) {
  const Result<CodedTile> coded = codeTile(plan, tile, read, files, threads);
  if (!coded.ok()) return coded.status();
  const uint32_t hash = hashOf(plan);
  if (plan.grid().leavesLow(tile)) {
    const Status low = files.write(lowName(tile), writeLow(hash, tile, coded->low));
    if (!low.ok()) return low;
  }
  return files.write(partName(tile), writePart(hash, tile, coded->part));
}

}  // namespace tetrakis::inline mosaic
