// SPDX-License-Identifier: Apache-2.0
// AVIF by libavif's avifenc and libaom, tuned for PSNR: 8 bits, 4:4:4 (grey: 4:0:0), BT.601, full
// range, one thread. libaom's speeds run from 0, the slowest and best, to 10.
#pragma once

#include <string>
#include <vector>

#include "bench/peers/command_peer.hpp"

namespace tetrakis::bench {

class AvifPeer : public CommandPeer {
 public:
  explicit AvifPeer(int speed);
  std::string name() const override { return "avif_s" + std::to_string(speed_); }

 protected:
  std::vector<std::string> encoderOptions(const Raster& raster,
                                          const std::string& quality) const override;

 private:
  int speed_;
};

}  // namespace tetrakis::bench
