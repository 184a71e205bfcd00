// SPDX-License-Identifier: Apache-2.0
// AVIF through avifenc and avifdec; see avif_peer.hpp.
#include "bench/peers/avif_peer.hpp"

namespace tetrakis::bench {

// Quantisers of libaom (63: coarsest), about a factor of sqrt(2) in bytes apart.
AvifPeer::AvifPeer(int speed)
    : CommandPeer(
          {"avifenc", "avifdec", {"-j", "1"}, ".avif", "libavif-bin"},
          {{"63", "59", "55", "51", "47", "43", "39", "35", "30", "25", "19", "12", "5"}, ""}),
      speed_(speed) {}

std::vector<std::string> AvifPeer::encoderOptions(const Raster& raster,
                                                  const std::string& quality) const {
  return {"-c",    "aom",
          "-j",    "1",
          "-s",    std::to_string(speed_),
          "-d",    "8",
          "-y",    raster.channels == 3 ? "444" : "400",
          "-a",    "tune=psnr",
          "--min", quality,
          "--max", quality};
}

}  // namespace tetrakis::bench
