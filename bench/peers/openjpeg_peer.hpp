// SPDX-License-Identifier: Apache-2.0
// OpenJPEG (JPEG 2000 Part 1, ISO/IEC 15444-1): a bare codestream, one tile, one layer, 64 x 64
// code-blocks, an empty comment; 9/7 wavelet and ICT, or 5/3 and RCT when lossless. In memory, one
// thread.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/peers/peer.hpp"

namespace tetrakis::bench {

struct OpenJpegSettings {
  uint64_t bytes = 0;   ///< size aimed at (never exceeded by more than the headers); 0: lossless
  int resolutions = 6;  ///< wavelet levels + 1; held to what the raster's size allows
};

Result<std::vector<uint8_t>> encodeOpenJpeg(const Raster& raster, const OpenJpegSettings& settings);

/// The samples as Raster::samples has them, of a codestream that encodeOpenJpeg made.
Result<std::vector<uint16_t>> decodeOpenJpeg(const std::vector<uint8_t>& codestream);

/// One file for each target, for each number of resolutions.
class OpenJpegPeer : public Peer {
 public:
  /// stretch: code rasters of few bits also multiplied up to 16 bits, because OpenJPEG quantises
  /// no finer than one step and decodes to integers only.
  OpenJpegPeer(std::vector<int> resolutions, bool stretch)
      : resolutions_(std::move(resolutions)), stretch_(stretch) {}
  std::string name() const override { return "openjpeg97"; }
  Result<PeerCurves> curves(const Raster& raster,
                            const std::vector<uint64_t>& targets) const override;

 private:
  std::vector<int> resolutions_;
  bool stretch_;
};

}  // namespace tetrakis::bench
