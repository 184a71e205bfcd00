// SPDX-License-Identifier: Apache-2.0
// A track: the bands of one component (geometry, or texture), coded into one codeword. The order of
// its passes follows from the norms of the bands alone, so it costs no bits, and each pass improves
// the surface or image by about the same factor as its neighbours in the order.
#pragma once

#include <cstdint>
#include <vector>

#include "bitstream/band.hpp"
#include "bitstream/plane_pass.hpp"

namespace tetrakis {

/// One band of a track, as its owner (codec/, texture_wavelet/) describes it.
struct BandPlan {
  static constexpr int kNone = -1;

  BandShape shape;
  Orientation orientation = Orientation::kLL;
  int log_norm = 0;       ///< 16 * log2 of the L2 norm of the band's synthesis functions, rounded
  uint32_t models = 0;    ///< index of the BandModels that the band uses
  int parent = kNone;     ///< the band of the same orientation one level coarser
  int component = kNone;  ///< the same band of another component
  /// Bit map (BandShape::word) of the coefficients that do not exist; empty: all do.
  std::vector<uint32_t> absent = {};
  bool needed = true;  ///< by a decoder

  /// There is no coefficient to code.
  bool vacant() const;
};

/// Bit-planes a coefficient may have: magnitudes stay below 2^30.
inline constexpr int kMaxPlanes = 30;

struct Pass {
  uint16_t band;
  uint8_t plane;
  PassKind kind;
  int key;  ///< what passes are ordered by: 16 log2 of norm * 2^plane, less a delay
};

/// All passes of a track with `planes` bit-planes, in coding order.
std::vector<Pass> schedule(const std::vector<BandPlan>& plan, int planes);

/// Bands and contexts: the state that encoder and decoder build in step.
struct TrackState {
  TrackState(const std::vector<BandPlan>& plan, int planes);

  /// Runs one pass of the plan that the state was made from.
  template <class Io>
  void run(const std::vector<BandPlan>& plan, const Pass& pass, Io& io) {
    const BandPlan& band = plan[pass.band];
    const auto at = [&](int i) { return i < 0 ? nullptr : &bands[static_cast<size_t>(i)]; };
    PlanePass<Io>(bands[pass.band], models[band.models], at(band.parent), at(band.component), io)
        .run(pass.kind, pass.plane);
  }

  std::vector<Band> bands;
  std::vector<BandModels> models;
  bool complete = false;  ///< every pass asked for has been decoded: those bands are exact
};

}  // namespace tetrakis
