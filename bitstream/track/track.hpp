// SPDX-License-Identifier: Apache-2.0
// A track is one codeword that holds bands of one component (heights, or texture): all of its
// bands, or the parts of them in one region.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "bitstream/track/band.hpp"
#include "bitstream/track/plane_pass.hpp"

namespace tetrakis::inline track {

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

/// A pass over a tier of a band.
struct Pass {
  uint16_t band;
  uint8_t tier;
  uint8_t plane;
  PassKind kind;
  /// 16 log2 of norm * 2^plane, less a delay, but at least BandPlan::key_floor; 16 more for each
  /// priority of the tier.
  int key = 0;
};

/// Bit-planes a coefficient may have: magnitudes stay below 2^30.
inline constexpr int kMaxPlanes = 30;

/// Bands and contexts: the state that encoder and decoder build in step.
struct TrackState {
  TrackState(const std::vector<BandPlan>& plan, int planes);

  /// Runs one pass of a band of the plan that the state was made from.
  template <class Io>
  void run(const std::vector<BandPlan>& plan, const Pass& pass, Io& io) {
    const BandPlan& band = plan[pass.band];
    const auto at = [&](int i) { return i < 0 ? nullptr : &bands[static_cast<size_t>(i)]; };
    const HintBands hints{
        at(band.parent), at(band.companion), {at(band.siblings[0]), at(band.siblings[1])}};
    PlanePass<Io>(bands[pass.band], pass.tier, models[band.models], hints, io)
        .run(pass.kind, pass.plane);
  }

  std::vector<Band> bands;
  std::vector<BandModels> models;
  bool complete = false;  ///< every pass asked for has been decoded: those bands are exact
};

}  // namespace tetrakis::inline track
