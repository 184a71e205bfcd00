// SPDX-License-Identifier: Apache-2.0
// A drawn texture is better than the wavelet where its last byte is in reach, and worse before, if
// it has many colours. It also must take no more bytes than the wavelet needs for the last bit; or
// half of them, if the last bit is not asked for.
#include "texture_wavelet/texture_choice.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "texture_wavelet/cutout.hpp"
#include "texture_wavelet/drawn_encoder.hpp"
#include "texture_wavelet/overlay.hpp"

namespace tetrakis {

namespace {

/// Of so many bytes at most; what lies between two points of the account is not known to be better
/// than the first.
double distortionAt(const EncodedTexture& encoded, uint64_t bytes) {
  const std::vector<RatePoint>& points = encoded.tracks.front().points;
  const auto above = std::find_if(points.begin() + 1, points.end(),
                                  [&](const RatePoint& p) { return p.bytes > bytes; });
  return (above - 1)->distortion;
}

/// So few are not worth the time of another attempt.
constexpr uint64_t kFewBytes = 1024;

TrackOptions oneTrack(TrackOptions options) {
  options.region_log2 = 0;
  return options;
}

/// Whether the wavelet restores every sample within so many bytes.
bool restoresWithin(const Texels& texels, uint64_t bytes, uint32_t threads) {
  return encodeByWavelet(texels, Purpose::kLossless, {bytes, 0, threads}).tracks.front().complete;
}

uint64_t bytesOf(const EncodedTexture& encoded) {
  uint64_t bytes = 0;
  for (const EncodedTrack& track : encoded.tracks) bytes += track.codeword.size();
  return bytes;
}

/// With an overlay or without. Both are coded in one track to compare them: all of it for the last
/// bit, else what a budget has room for.
EncodedTexture encodePhotograph(const Texels& texels, Purpose purpose,
                                const TrackOptions& options) {
  const bool hides = purpose == Purpose::kLossy;
  const std::vector<uint8_t> photograph =
      photographOf(texels, hides ? cutoutOf(texels) : std::vector<uint8_t>());
  if (photograph.empty()) return encodeByWavelet(texels, purpose, options);
  EncodedTexture plain = encodeByWavelet(texels, purpose, oneTrack(options)),
                 overlaid = encodeByWavelet(texels, purpose, oneTrack(options), photograph);
  const uint64_t reach = std::min({options.room, bytesOf(plain), bytesOf(overlaid)});
  const double plain_error = distortionAt(plain, reach),
               overlaid_error = distortionAt(overlaid, reach);
  const bool pays = plain_error != overlaid_error ? overlaid_error < plain_error
                                                  : bytesOf(overlaid) < bytesOf(plain);
  if (options.region_log2 == 0) return pays ? std::move(overlaid) : std::move(plain);
  return encodeByWavelet(texels, purpose, options, pays ? photograph : std::vector<uint8_t>());
}

}  // namespace

EncodedTexture encodeTexture(const Texels& texels, Purpose purpose, const TrackOptions& options) {
  std::optional<EncodedTexture> drawn = encodeDrawn(texels);
  if (!drawn) return encodePhotograph(texels, purpose, options);
  const uint64_t bytes = bytesOf(*drawn);
  if (bytes <= std::min(kFewBytes, options.room)) return *drawn;
  if (bytes > options.room) {
    const EncodedTexture wavelet = encodeByWavelet(texels, purpose, oneTrack(options));
    if (distortionAt(*drawn, options.room) < distortionAt(wavelet, options.room)) return *drawn;
  } else if (!restoresWithin(texels, purpose == Purpose::kLossless ? bytes : 2 * bytes,
                             options.threads)) {
    return *drawn;
  }
  return encodePhotograph(texels, purpose, options);
}

}  // namespace tetrakis
