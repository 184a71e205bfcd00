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

#include "texture_wavelet/drawn_encoder.hpp"
#include "texture_wavelet/overlay.hpp"

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
  const std::vector<uint8_t> photograph = photographOf(texels);
  if (photograph.empty()) return encodeByWavelet(texels, purpose, options);
  const TrackOptions one_track{options.limit, 0, options.threads, options.visual};
  EncodedTexture plain = encodeByWavelet(texels, purpose, one_track),
                 overlaid = encodeByWavelet(texels, purpose, one_track, photograph);
  const uint64_t reach = std::min({options.limit / 2, bytesOf(plain), bytesOf(overlaid)});
  const double worse = distortionAt(plain.tracks.front(), reach),
               better = distortionAt(overlaid.tracks.front(), reach);
  const bool pays = worse != better ? better < worse : bytesOf(overlaid) < bytesOf(plain);
  if (options.region_log2 == 0) return pays ? std::move(overlaid) : std::move(plain);
  return encodeByWavelet(texels, purpose, options, pays ? photograph : std::vector<uint8_t>());
}

}  // namespace

EncodedTexture encodeTexture(const Texels& texels, Purpose purpose, const TrackOptions& options) {
  std::optional<EncodedTexture> drawn = encodeDrawn(texels);
  if (!drawn) return encodePhotograph(texels, purpose, options);
  const EncodedTrack& track = drawn->tracks.front();
  const uint64_t bytes = track.codeword.size(), reach = options.limit / 2;
  if (bytes > reach) {
    const TrackOptions one_track{options.limit, 0, options.threads, options.visual};
    const EncodedTexture wavelet = encodeByWavelet(texels, purpose, one_track);
    if (distortionAt(track, reach) < distortionAt(wavelet.tracks.front(), reach)) return *drawn;
  } else if (!restoresWithin(texels, purpose == Purpose::kLossless ? bytes : 2 * bytes,
                             options.threads)) {
    return *drawn;
  }
  return encodePhotograph(texels, purpose, options);
}

}  // namespace tetrakis
