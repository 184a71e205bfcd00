// SPDX-License-Identifier: Apache-2.0
// JPEG XL through cjxl and djxl; see jxl_peer.hpp.
#include "bench/peers/jxl_peer.hpp"

namespace tetrakis::bench {
namespace {

// Butteraugli distances, 25 being the coarsest that cjxl takes; 0 is lossless.
std::vector<std::string> distances(JxlModes modes) {
  if (modes == JxlModes::kLossless) return {};
  return {"25", "16", "11", "8", "5.6", "4", "2.8", "2", "1.4", "1", "0.7", "0.5", "0.35", "0.2"};
}

}  // namespace

JxlPeer::JxlPeer(JxlModes modes)
    : CommandPeer({"cjxl", "djxl", {"--num_threads=0"}, ".jxl", "libjxl-tools"},
                  {distances(modes), "0"}) {}

std::vector<std::string> JxlPeer::encoderOptions(const Raster& /*raster*/,
                                                 const std::string& quality) const {
  return {"--num_threads=0", "-e", "7", "-d", quality};
}

}  // namespace tetrakis::bench
