// SPDX-License-Identifier: Apache-2.0
// A drawn texture is better than the wavelet where its last byte is in reach, and worse before, if
// it has many colours. It also must take no more bytes than the wavelet needs for the last bit; or
// half of them, if the last bit is not asked for. Where it will be cut, both are compared there.
// What takes more bytes to code than to store is stored.
#include "texture_wavelet/texture_choice.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "texture_wavelet/drawn/drawn_encoder.hpp"
#include "texture_wavelet/mask/cutout.hpp"
#include "texture_wavelet/mask/overlay.hpp"
#include "texture_wavelet/stored_encoder.hpp"

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

uint64_t bytesOf(const EncodedTexture& encoded) {
  uint64_t bytes = 0;
  for (const EncodedTrack& track : encoded.tracks) bytes += track.codeword.size();
  return bytes;
}

/// Whether a drawn texture takes too few bytes for the wavelet to restore every sample within them,
/// or within twice as many if that is not asked for.
bool winsWhole(const EncodedTexture& drawn, const Texels& texels, Purpose purpose,
               uint32_t threads) {
  const uint64_t bytes = bytesOf(drawn);
  if (bytes <= kFewBytes) return true;
  const uint64_t limit = purpose == Purpose::kLossless ? bytes : 2 * bytes;
  return !encodeByWavelet(texels, Purpose::kLossless, {limit, 0, threads}).tracks.front().complete;
}

/// Bytes from which on the error is no larger than that; all of them if it never is.
uint64_t bytesFor(const EncodedTexture& encoded, double squares) {
  const EncodedTrack& track = encoded.tracks.front();
  const auto reached = std::find_if(track.points.begin(), track.points.end(),
                                    [&](const RatePoint& p) { return p.distortion <= squares; });
  return reached == track.points.end() ? track.codeword.size() : reached->bytes;
}

/// Whether a shows the image better than b where they will be cut: in fewer bytes if there is an
/// error aimed at, else by less error in as many bytes. samples: that count.
bool showsBetter(const EncodedTexture& a, const EncodedTexture& b, const TrackOptions& options,
                 uint64_t samples) {
  if (options.mean_square > 0) {
    const double squares = options.mean_square * static_cast<double>(samples);
    return bytesFor(a, squares) < bytesFor(b, squares);
  }
  const uint64_t reach = std::min({options.room, bytesOf(a), bytesOf(b)});
  const double error_a = distortionAt(a, reach), error_b = distortionAt(b, reach);
  return error_a != error_b ? error_a < error_b : bytesOf(a) < bytesOf(b);
}

/// The same of a drawn texture whose end will not be sent, and the wavelet. Alpha of a cut-out
/// would not be exact.
bool winsCut(const EncodedTexture& drawn, const Texels& texels, Purpose purpose,
             TrackOptions options) {
  if (!cutoutOf(texels).empty()) return false;
  options.region_log2 = 0;
  if (options.mean_square > 0) options.limit = bytesOf(drawn);
  const EncodedTexture wavelet = encodeByWavelet(texels, purpose, options);
  return showsBetter(drawn, wavelet, options, texels.samples.size());
}

/// With an overlay or without. Both are coded in one track to compare them: all of it for the last
/// bit, else what a budget has room for.
EncodedTexture encodePhotograph(const Texels& texels, Purpose purpose,
                                const TrackOptions& options) {
  const bool hides = purpose == Purpose::kLossy;
  const std::vector<uint8_t> seen = hides ? cutoutOf(texels) : std::vector<uint8_t>(),
                             photograph = photographOf(texels, seen);
  if (photograph.empty()) return encodeByWavelet(texels, purpose, options);
  EncodedTexture plain = encodeByWavelet(texels, purpose, oneTrack(options)),
                 overlaid = encodeByWavelet(texels, purpose, oneTrack(options), photograph);
  const bool pays = showsBetter(overlaid, plain, options, countedSamples(texels, seen));
  if (options.region_log2 == 0) return pays ? std::move(overlaid) : std::move(plain);
  return encodeByWavelet(texels, purpose, options, pays ? Mask(photograph) : Mask());
}

}  // namespace

namespace {

EncodedTexture encodeModelled(const Texels& texels, Purpose purpose, const TrackOptions& options) {
  const std::optional<EncodedTexture> drawn = encodeDrawn(texels);
  if (!drawn) return encodePhotograph(texels, purpose, options);
  const bool whole = bytesOf(*drawn) <= options.room && options.mean_square == 0;
  const bool wins = whole ? winsWhole(*drawn, texels, purpose, options.threads)
                          : winsCut(*drawn, texels, purpose, options);
  return wins ? *drawn : encodePhotograph(texels, purpose, options);
}

}  // namespace

EncodedTexture encodeTexture(const Texels& texels, Purpose purpose, TrackOptions options) {
  if (purpose == Purpose::kLossless) options.mean_square = 0;
  EncodedTexture encoded = encodeModelled(texels, purpose, options);
  const uint64_t stored = storedBytes(texels);
  const bool shorter = stored < bytesOf(encoded) && stored <= options.room;
  return purpose == Purpose::kLossless && shorter ? storeTexture(texels) : std::move(encoded);
}

}  // namespace tetrakis
