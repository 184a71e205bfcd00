// SPDX-License-Identifier: Apache-2.0
// A drawn texture is better than the wavelet where its last byte is in reach, and worse before, if
// it has many colours. It also must take no more bytes than the wavelet needs for the last bit; or
// half of them, if the last bit is not asked for.
#include "texture_wavelet/texture_choice.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "texture_wavelet/drawn_encoder.hpp"

namespace tetrakis {

namespace {

double distortionAt(const EncodedTrack& track, uint64_t bytes) {
  const std::vector<RatePoint>& points = track.points;
  const auto above = std::find_if(points.begin(), points.end(),
                                  [&](const RatePoint& p) { return p.bytes > bytes; });
  if (above == points.begin() || above == points.end()) return points.back().distortion;
  const RatePoint &low = *(above - 1), &high = *above;
  const double part =
      static_cast<double>(bytes - low.bytes) / static_cast<double>(high.bytes - low.bytes);
  return std::lerp(low.distortion, high.distortion, part);
}

}  // namespace

EncodedTexture encodeTexture(const Texels& texels, Purpose purpose, uint64_t limit) {
  std::optional<EncodedTexture> drawn = encodeDrawn(texels);
  if (!drawn) return encodeByWavelet(texels, purpose, limit);
  const uint64_t bytes = drawn->track.codeword.size(), reach = limit / 2;
  if (bytes > reach) {
    EncodedTexture wavelet = encodeByWavelet(texels, purpose, limit);
    return distortionAt(drawn->track, reach) < distortionAt(wavelet.track, reach) ? *drawn
                                                                                  : wavelet;
  }
  const uint64_t room = purpose == Purpose::kLossless ? bytes : 2 * bytes;
  const bool better = !encodeByWavelet(texels, Purpose::kLossless, room).track.complete;
  return better ? *drawn : encodeByWavelet(texels, purpose, limit);
}

}  // namespace tetrakis
