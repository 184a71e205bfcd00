// SPDX-License-Identifier: Apache-2.0
// A track is the codeword of one Region of a plane. regionsOf() divides a plane into regions, a
// BandPlan describes each band of a track, and PassQueue gives the order of the passes over the
// bands, so that any prefix of the codeword is worth its bytes.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "base/view.hpp"
#include "bitstream/track/band.hpp"
#include "bitstream/track/pass_order.hpp"
#include "bitstream/track/plane_pass.hpp"

namespace tetrakis::inline track {

// A Region is the part of a plane's coefficients that one track holds (docs/FORMAT.md, section
// 5.1), so that a window of the plane can be decoded alone. The transform knows nothing of regions.
//
// Every coefficient belongs to a sample of the plane. The finest kRegionLevels levels are split
// into regions of side 2^s, the next kRegionLevels into regions of side 2^(s + kRegionLevels), and
// so on, each of about as many coefficients as a region of the finest levels. Where one region
// would be left it is the base, which holds all the coarser levels as well. Each patch of a forest
// is divided as a plane of its own, and all patches have one base.

inline constexpr int kRegionLevels = 3;
inline constexpr int kLeastRegionLog2 = 4;  ///< smallest side 2^s; above kRegionLevels
inline constexpr int kMostRegionLog2 = 20;

/// What one track holds: the coefficients of some levels whose samples lie in a rectangle.
struct Region {
  static constexpr int kAll = std::numeric_limits<int>::max();

  int first_level = 1, last_level = kAll;   ///< kAll: down to LL, which is the base's
  uint32_t x0 = 0, y0 = 0, x1 = 0, y1 = 0;  ///< samples; x1 and y1 lie behind the last

  bool isBase() const { return last_level == kAll; }
  bool holds(int level) const { return level >= first_level && level <= last_level; }
};

/// The regions of a group of levels. A remainder of less than half a side joins its neighbour.
struct RegionGroup {
  int side_log2 = 0;               ///< of the samples of a region
  uint32_t columns = 1, rows = 1;  ///< of regions
  uint64_t first = 0;              ///< number of the track of the first of them
  Extent plane = {};               ///< samples

  /// The samples of one region.
  Window samplesOf(uint32_t column, uint32_t row) const { return samplesOf({column, row, 1, 1}); }
  /// The samples of a rectangle of regions.
  Window samplesOf(const Window& regions) const;
  /// The rectangle of regions that a window of samples meets.
  Window meeting(const Window& samples) const;
  uint64_t numberOf(uint32_t column, uint32_t row) const {
    return first + uint64_t{row} * columns + column;
  }
};

/// The groups of a plane, from the finest levels on; none if the base holds everything.
std::vector<RegionGroup> regionGroups(Extent plane, int side_log2);

/// Whether regions may have masks of their own: there are groups, and each of their levels halves
/// both sides.
bool takesRegionMasks(Extent plane, int side_log2);

// Below, `patches` of a forest lie one below the other in the plane; a grid is one patch.

/// The tracks of a plane in the order of their numbers: the base, then the regions from the
/// coarsest levels to the finest, patch by patch and row by row. side_log2 0: the base alone, with
/// everything.
std::vector<Region> regionsOf(uint32_t width, uint32_t height, int side_log2, uint32_t patches = 1);

/// The regions of the finest levels in that order, each as a rectangle of the plane; none if the
/// base holds everything.
std::vector<Window> finestRegions(uint32_t width, uint32_t height, int side_log2,
                                  uint32_t patches = 1);

/// For each group of levels a region that no other of the group is larger than, in rows or columns.
std::vector<Region> largestRegions(uint32_t width, uint32_t height, int side_log2,
                                   uint32_t patches = 1);

/// How many regionsOf() are.
uint64_t regionCount(uint32_t width, uint32_t height, int side_log2, uint32_t patches = 1);

/// How many finestRegions() are.
uint64_t finestRegionCount(uint32_t width, uint32_t height, int side_log2, uint32_t patches = 1);

// A track is one codeword that holds bands of one component (heights, or texture): all of its
// bands, or the parts of them in one region.

/// One band of a track, as its owner (codec/, texture_wavelet/) describes it.
struct BandPlan {
  static constexpr int kNone = -1;
  static constexpr int kNoKey = -(1 << 24);  ///< below all keys

  BandShape shape;
  Orientation orientation = Orientation::kLL;
  int log_norm = 0;        ///< 16 * log2 of the L2 norm of the band's synthesis functions, rounded
  int key_floor = kNoKey;  ///< no pass of the band has a lower key
  uint32_t models = 0;     ///< index of the BandModels that the band uses
  int parent = kNone;      ///< the band of the same orientation one level coarser
  int companion = kNone;   ///< the same band of the colour plane before
  std::array<int, 2> siblings = {kNone, kNone};  ///< the other details of the level
  /// Bit map (BandShape::word) of the coefficients that do not exist; empty: all do.
  std::vector<uint32_t> absent = {};
  /// The tiers of those that do; null: all are in tier 0.
  std::shared_ptr<const BandTiers> tiers = nullptr;
  bool needed = true;  ///< by a decoder

  /// The coefficients of a tier.
  uint32_t members(size_t tier) const;
};

/// Bands and contexts: the state that encoder and decoder build in step.
struct TrackState {
  TrackState(const std::vector<BandPlan>& plan, int planes);

  /// Runs one pass of a band of the plan that the state was made from.
  template <class Io>
  void run(const std::vector<BandPlan>& plan, const Pass& pass, Io& io, PassPlace from = {}) {
    const BandPlan& band = plan[pass.band];
    const auto at = [&](int i) { return i < 0 ? nullptr : &bands[static_cast<size_t>(i)]; };
    const HintBands hints{
        at(band.parent), at(band.companion), {at(band.siblings[0]), at(band.siblings[1])}};
    PlanePass<Io>(bands[pass.band], pass.tier, models[band.models], hints, io)
        .run(pass.kind, pass.plane, from);
  }

  std::vector<Band> bands;
  std::vector<BandModels> models;
  bool complete = false;  ///< every pass asked for has been decoded: those bands are exact
};

// PassQueue gives the order of a track's passes: the next pass is always the pending one of the
// greatest key, key = log2(norm of the band) + bit-plane + priority of the tier - delay. The delay
// depends on the kind of pass and on the number of coefficients that are known to be significant.
// Both sides know all of this, so the order costs no bits, and each pass improves the surface or
// image by about the same factor as its neighbours.

class PassQueue {
 public:
  PassQueue(const std::vector<BandPlan>& plan, int planes);

  bool empty() const { return order_.empty(); }
  uint64_t bytes() const { return progress_.size() * sizeof(Progress) + order_.bytes(); }
  /// The next pass.
  Pass front() const { return order_.front(); }
  /// Takes the next pass off the queue, once it has been coded. band: what is known by then of its
  /// band.
  void pop(const Band& band);
  /// Bands that are needed (BandPlan::needed) have passes left.
  bool needed() const { return needed_ > 0; }
  /// A band is needed that was not before.
  void need(size_t band);

 private:
  struct Progress {
    int log_norm = 0, key_floor = 0;  ///< those of the band, raised by the tier's priority
    bool needed = false;
    uint32_t coefficients = 0;  ///< that exist
    uint8_t open = 0;           ///< passes of the plane that are not coded yet
  };

  Progress& progressOf(const Pass& pass) { return progress_[tiers_ * pass.band + pass.tier]; }
  void push(Pass pass, uint32_t significant);
  /// Pushes what follows once no pass of a tier is left.
  void pushNext(const Pass& done, const Band& band);

  size_t tiers_;                    ///< of every band
  std::vector<Progress> progress_;  ///< of each tier of each band
  PassOrder order_;                 ///< of the passes that may come next, one or two of a tier
  size_t needed_ = 0;               ///< tiers of needed bands with passes left
};

}  // namespace tetrakis::inline track
