// SPDX-License-Identifier: Apache-2.0
// JPEG XL (ISO/IEC 18181) by libjxl's cjxl at its default effort, 7, one thread. Lossy files are
// tuned to its model of seeing, not to PSNR.
#pragma once

#include <string>
#include <vector>

#include "bench/peers/command_peer.hpp"

namespace tetrakis::bench {

enum class JxlModes { kLossless, kLosslessAndLossy };

class JxlPeer : public CommandPeer {
 public:
  explicit JxlPeer(JxlModes modes);
  std::string name() const override { return "jxl_e7"; }

 protected:
  std::vector<std::string> encoderOptions(const Raster& raster,
                                          const std::string& quality) const override;
};

}  // namespace tetrakis::bench
