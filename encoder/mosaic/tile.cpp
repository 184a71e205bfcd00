// SPDX-License-Identifier: Apache-2.0
#include "encoder/mosaic/tile.hpp"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <utility>

#include "base/bit_plane.hpp"
#include "base/parallel.hpp"
#include "base/portable_math.hpp"
#include "bitstream/track/track_decoder.hpp"
#include "codec/wavelet/band_plan.hpp"
#include "codec/wavelet/wavelet.hpp"
#include "encoder/mosaic/block.hpp"
#include "ratecontrol/curves/component_curve.hpp"

namespace tetrakis::inline mosaic {

namespace {

/// A lifted block, with the places of its coefficients in the bands of the whole plane.
class LiftedBlock {
 public:
  LiftedBlock(const MosaicPlan& plan, const MosaicGrid& grid, const Tile& tile, Block block,
              uint32_t threads)
      : whole_(specOf(plan.geometry().wavelet), grid.pyramid()),
        tile_(tile),
        window_(block.window),
        unit_(portable::exp2(-2 * plan.geometry().wavelet.fraction_bits)),
        layout_(localLayout(plan, grid, block)),
        values_(std::move(block.values)) {
    forwardWavelet(localSpec(plan), layout_.pyramid(), values_, threads);
  }

  /// What the track of a region of the tile is made of, as of the whole plane.
  TrackSource sourceOf(const Region& region) const {
    const std::vector<BandPart> parts = whole_.parts(region);
    std::vector<BandPart> here;
    for (const BandPart& part : parts) here.push_back(inBlock(part));
    TrackSource source{layout_.marked(here, whole_.plan(parts)), {}};
    for (size_t i = 0; i < parts.size(); ++i) {
      source.bands.push_back(
          {layout_.gather(values_, here[i]), whole_.energy(parts[i].subband) * unit_});
      clearAbsent(source.plan[i], source.bands[i].values);
    }
    return source;
  }

  /// The low band of the tile, without the halo. low: MosaicGrid::low().
  LowPart lowPart(const Window& low, bool has_voids) const {
    const Subband& ll = layout_.subbands().front();
    const uint32_t x0 = low.x - (window_.x >> ll.splits_x), y0 = low.y - (window_.y >> ll.splits_y);
    LowPart part{low.extent(), {}, {}};
    for (uint32_t y = 0; y < low.height; ++y) {
      const size_t row = layout_.pyramid().indexOf(ll, y0 + y) + x0;
      part.values.insert(part.values.end(), values_.begin() + static_cast<ptrdiff_t>(row),
                         values_.begin() + static_cast<ptrdiff_t>(row + low.width));
      for (uint32_t x = 0; has_voids && x < low.width; ++x)
        part.valid.push_back(
            layout_.pyramid().exists(ll.sampleColumn(x0 + x), ll.planeRow(y0 + y)));
    }
    return part;
  }

 private:
  WaveletSpec localSpec(const MosaicPlan& plan) const {
    return specOf(plan.geometry().wavelet).above(kRegionLevels * tile_.group);
  }

  /// The block as a plane of its own. Where the whole plane has voids no level is lifted jointly,
  /// so that a block without any has a mask as well.
  PlaneLayout localLayout(const MosaicPlan& plan, const MosaicGrid& grid,
                          const Block& block) const {
    const Extent extent = window_.extent();
    SharedBits valid;
    if (plan.hasVoids()) {
      BitPlane bits(extent);
      bits.invert();
      valid = block.valid.empty() ? shared(std::move(bits)) : sharedBits(block.valid, extent);
    }
    return {localSpec(plan), Pyramid(valid, extent, {}, grid.levels(tile_)), {}, whole_.norms()};
  }

  /// A part of a band of the whole plane as one of the same band of the block, which begins at even
  /// places of all of its levels.
  BandPart inBlock(const BandPart& part) const {
    const Subband& subband = whole_.subbands()[part.subband];
    const int level = subband.level - kRegionLevels * tile_.group;
    const int coarsest = layout_.pyramid().levels();
    const bool is_low = subband.orientation == Orientation::kLL;
    const size_t index = is_low ? 0
                                : 1 + kBandsPerLevel * static_cast<size_t>(coarsest - level) +
                                      static_cast<size_t>(subband.orientation) - 1;
    const Subband& local = layout_.subbands()[index];
    assert(local.orientation == subband.orientation);
    BandPart here = part;
    here.subband = index;
    here.column -= window_.x >> local.splits_x;
    here.row -= window_.y >> local.splits_y;
    return here;
  }

  PlaneLayout whole_;
  Tile tile_;
  Window window_;
  double unit_;  ///< squared steps in a squared unit of coefficients
  PlaneLayout layout_;
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

/// The points that packets may end at: all others would only make the part longer.
std::vector<RatePoint> thinned(const std::vector<RatePoint>& points) {
  const std::vector<RatePoint> hull = lowerHull(points, 0);
  std::vector<RatePoint> ends = {hull.front()};
  for (size_t i = 1; i < hull.size(); ++i)
    for (const RatePoint& end : packetEnds(points, hull[i - 1], hull[i])) ends.push_back(end);
  return ends;
}

}  // namespace

Result<CodedTile> codeTile(const MosaicPlan& plan, const Tile& tile, const ReadSamples& read,
                           const MosaicFiles& files, uint32_t threads) {
  const MosaicGrid grid = plan.grid();
  assert(grid.has(tile));
  Result<Block> block = readBlock(plan, grid, tile, read, files);
  if (!block.ok()) return block.status();
  CodedTile coded;
  if (tile.group == 0 && plan.hasVoids() && !block->valid.empty()) {
    const Window inner = grid.samples(tile), &outer = block->window;
    coded.part.valid =
        slice(std::span<const uint8_t>(block->valid), outer.extent(),
              {0, Window{inner.x - outer.x, inner.y - outer.y, inner.width, inner.height}});
  }
  const LiftedBlock lifted(plan, grid, tile, *std::move(block), threads);
  if (!grid.isBase(tile)) coded.low = lifted.lowPart(grid.low(tile), plan.hasVoids());
  const std::vector<uint32_t> tracks = grid.tracks(tile);
  coded.part.tracks.resize(tracks.size());
  std::atomic<bool> sound = true;
  parallelFor(threads, tracks.size(), [&](size_t i) {
    const TrackSource source = lifted.sourceOf(grid.regions()[tracks[i]]);
    const int planes = plan.geometry().planes;
    EncodedTrack& track = coded.part.tracks[i];
    if (planesOf(source) > planes) {
      sound = false;
      return;
    }
    track = encodeTrack(source, planes);
    track.points = thinned(track.points);
    if (!decodes(source, track)) sound = false;
  });
  if (sound) return coded;
  return Status(TKS_MISMATCH, "A tile of the mosaic does not come back: a fault of the encoder.");
}

Status runTask(const MosaicPlan& plan, const Tile& tile, const ReadSamples& read,
               const MosaicFiles& files, uint32_t threads) {
  const Result<CodedTile> coded = codeTile(plan, tile, read, files, threads);
  if (!coded.ok()) return coded.status();
  const uint32_t hash = hashOf(plan);
  if (!plan.grid().isBase(tile)) {
    const Status low = files.write(lowName(tile), writeLow(hash, tile, coded->low));
    if (!low.ok()) return low;
  }
  return files.write(partName(tile), writePart(hash, tile, coded->part));
}

}  // namespace tetrakis::inline mosaic
