// SPDX-License-Identifier: Apache-2.0
#include "encoder/mosaic/block_layout.hpp"

#include <cassert>
#include <utility>

#include "base/bit_plane.hpp"
#include "base/portable_math.hpp"

namespace tetrakis::inline mosaic {

namespace {

/// The mask of the block. Where the whole plane has voids no level is lifted jointly, so that a
/// block without any has a mask as well.
SharedBits maskOf(const MosaicPlan& plan, Extent extent, const PartMask& valid) {
  if (!plan.hasVoids()) return {};
  if (!valid.empty()) return sharedBits(valid, extent);
  BitPlane bits(extent);
  bits.invert();
  return shared(std::move(bits));
}

}  // namespace

BlockLayout::BlockLayout(const TaskInputs& inputs, const Window& window, const PartMask& valid)
    : whole_(specOf(inputs.plan.geometry().wavelet), inputs.grid.pyramid()),
      group_(inputs.grid.planeGroup(inputs.tile)),
      window_(window),
      unit_(portable::exp2(-2 * inputs.plan.geometry().wavelet.fraction_bits)),
      spec_(specOf(inputs.plan.geometry().wavelet).above(kRegionLevels * group_)),
      local_(spec_,
             Pyramid(maskOf(inputs.plan, window.extent(), valid), window.extent(), {},
                     inputs.grid.levels(inputs.tile)),
             {}, whole_.norms()) {}

BlockLayout::Track BlockLayout::trackOf(const Region& region) const {
  const std::vector<BandPart> parts = whole_.parts(region);
  Track track;
  for (const BandPart& part : parts) {
    track.here.push_back(inBlock(part));
    track.weights.push_back(whole_.energy(part.subband) * unit_);
  }
  track.plan = local_.marked(track.here, whole_.plan(parts));
  return track;
}

/// A part of a band of the whole plane as one of the same band of the block.
BandPart BlockLayout::inBlock(const BandPart& part) const {
  const Subband& subband = whole_.subbands()[part.subband];
  const int level = subband.level - kRegionLevels * group_;
  const int coarsest = local_.pyramid().levels();
  const bool is_low = subband.orientation == Orientation::kLL;
  const size_t index = is_low ? 0
                              : 1 + kBandsPerLevel * static_cast<size_t>(coarsest - level) +
                                    static_cast<size_t>(subband.orientation) - 1;
  const Subband& local = local_.subbands()[index];
  assert(local.orientation == subband.orientation);
  BandPart here = part;
  here.subband = index;
  here.column -= window_.x >> local.splits_x;
  here.row -= window_.y >> local.splits_y;
  return here;
}

}  // namespace tetrakis::inline mosaic
