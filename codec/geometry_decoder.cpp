// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry_decoder.hpp"

#include <utility>

#include "bitstream/track_decoder.hpp"
#include "wavelet/band_plan.hpp"
#include "wavelet/wavelet_header.hpp"

namespace tetrakis {

DecodedGeometry decodeGeometry(const GeometryHeader& header, std::span<const uint8_t> codeword) {
  const WaveletSpec spec = specOf(header.wavelet);
  const PlaneLayout layout(spec, header.width, header.height);
  const TrackState state = decodeTrack(layout.plan(0, 0, 0), header.planes, codeword);
  DecodedGeometry out;
  out.fraction_bits = outputFractionBits(header.wavelet, header.planes, state.complete);
  out.heights.assign(size_t{header.width} * header.height, 0);
  for (size_t i = 0; i < layout.size(); ++i) {
    scatter(state.bands[i], out.fraction_bits - header.wavelet.fraction_bits, layout.subbands()[i],
            out.heights, header.width);
  }
  inverseWavelet(spec, out.heights, header.width, header.height);
  return out;
}

std::vector<int32_t> wholeSteps(DecodedGeometry decoded) {
  const int bits = decoded.fraction_bits;
  if (bits > 0) {
    for (int32_t& h : decoded.heights) {
      h = static_cast<int32_t>((int64_t{h} + (int64_t{1} << (bits - 1))) >> bits);
    }
  }
  return std::move(decoded.heights);
}

}  // namespace tetrakis
