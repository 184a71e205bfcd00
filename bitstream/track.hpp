// SPDX-License-Identifier: Apache-2.0
// A track: the bands of one component (geometry, or texture) of one region, coded into one
// codeword. The order of its passes follows from the norms of the bands alone, so it costs no bits,
// and each pass improves the surface or image by about the same factor as its neighbours in the
// order.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "bitstream/band.hpp"
#include "bitstream/plane_pass.hpp"

namespace tetrakis {

/// One band of a track, as its owner (codec/, texture_wavelet/) describes it.
struct BandPlan {
  BandShape shape;
  int log_norm = 0;     ///< 16 * log2 of the L2 norm of the band's synthesis functions, rounded
  uint32_t models = 0;  ///< index of the BandModels that the band uses
};

/// Bit-planes a coefficient may have: magnitudes stay below 2^30.
inline constexpr int kMaxPlanes = 30;

struct Pass {
  uint16_t band;
  uint8_t plane;
  PassKind kind;
};

/// All passes of a track with `planes` bit-planes, in coding order.
std::vector<Pass> schedule(const std::vector<BandPlan>& plan, int planes);

/// Bands and contexts: the state that encoder and decoder build in step.
struct TrackState {
  explicit TrackState(const std::vector<BandPlan>& plan);
  std::vector<Band> bands;
  std::vector<BandModels> models;
  bool complete = false;  ///< every pass has been decoded: the coefficients are exact
};

/// Makes the hint source of each band; it may look at every band of the state.
class HintFactory {
 public:
  virtual ~HintFactory() = default;
  virtual std::unique_ptr<HintSource> hints(const TrackState& state, uint32_t band) const = 0;
};

}  // namespace tetrakis
