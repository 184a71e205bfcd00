// SPDX-License-Identifier: Apache-2.0
// How a height field becomes bands: one band per level of the 4-8 lattice, and the hints that a
// level takes from the level before it. Shared by encoder and decoder.
#pragma once

#include <cstdint>
#include <vector>

#include "bitstream/track.hpp"
#include "codec/levels.hpp"

namespace tetrakis {

class GeometryPlan : public HintFactory {
 public:
  GeometryPlan(uint32_t width, uint32_t height);

  const std::vector<Level>& levels() const { return levels_; }
  const std::vector<BandPlan>& bands() const { return bands_; }
  std::unique_ptr<HintSource> hints(const TrackState& state, uint32_t band) const override;

 private:
  std::vector<Level> levels_;
  std::vector<BandPlan> bands_;
};

}  // namespace tetrakis
