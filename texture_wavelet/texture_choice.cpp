// SPDX-License-Identifier: Apache-2.0
// A drawn texture is better than the wavelet where its last byte is in reach, and worse before, if
// it has many colours. It also must take no more bytes than the wavelet needs for the last bit; or
// half of them, if the last bit is not asked for. Where it will be cut, both are compared there.
// What takes more bytes to code than to store is stored.
#include "texture_wavelet/texture_choice.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "texture_wavelet/drawn/drawn_encoder.hpp"
#include "texture_wavelet/mask/cutout.hpp"
#include "texture_wavelet/mask/overlay.hpp"
#include "texture_wavelet/stored_texture_encoder.hpp"

namespace tetrakis::inline texture {

namespace {

/// The distortion that at most so many bytes leave. What lies between two points of the account is
/// not known to be better than the first.
double distortionAt(const EncodedTexture& encoded, uint64_t bytes) {
  const std::vector<RatePoint>& points = encoded.tracks.front().points;
  const auto above = std::find_if(points.begin() + 1, points.end(),
                                  [&](const RatePoint& p) { return p.bytes > bytes; });
  return (above - 1)->distortion;
}

/// So few bytes are not worth the time of another attempt.
constexpr uint64_t kFewBytes = 1024;

TextureOptions oneTrack(TextureOptions options) {
  options.region_log2 = 0;
  return options;
}

/// What a drawn texture and the wavelet make of an image, side by side.
struct Contest {
  bool drawn_wins;
  /// What encodePhotograph() would make of the image without an overlay, if that is one track.
  std::optional<EncodedTexture> plain;
};

/// A drawn texture wins if it takes too few bytes for the wavelet to restore every sample within
/// them, or within twice as many if that is not asked for.
Contest contestWhole(const EncodedTexture& drawn, const TextureSource& source, Purpose purpose,
                     const TextureOptions& options) {
  const uint64_t bytes = bytesOf(drawn.tracks);
  if (bytes <= kFewBytes) return {true, {}};
  const bool lossless = purpose == Purpose::kLossless;
  EncodedTexture wavelet = encodeByWavelet(source, Purpose::kLossless,
                                           {lossless ? bytes : 2 * bytes, 0, options.threads});
  if (!wavelet.tracks.front().complete) return {true, {}};
  if (!lossless || options.visual) return {false, {}};
  return {false, std::move(wavelet)};
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
bool showsBetter(const EncodedTexture& a, const EncodedTexture& b, const TextureOptions& options,
                 uint64_t samples) {
  if (options.mean_square > 0) {
    const double squares = options.mean_square * static_cast<double>(samples);
    return bytesFor(a, squares) < bytesFor(b, squares);
  }
  const uint64_t reach = std::min({options.room, bytesOf(a.tracks), bytesOf(b.tracks)});
  const double error_a = distortionAt(a, reach), error_b = distortionAt(b, reach);
  return error_a != error_b ? error_a < error_b : bytesOf(a.tracks) < bytesOf(b.tracks);
}

/// The contest for a drawn texture whose end will not be sent. Alpha of a cut-out would not be
/// exact.
Contest contestCut(const EncodedTexture& drawn, const TextureSource& source, Purpose purpose,
                   const TextureOptions& options) {
  if (!source.cutout.empty()) return {false, {}};
  TextureOptions one_track = oneTrack(options);
  if (options.mean_square > 0) one_track.limit = bytesOf(drawn.tracks);
  EncodedTexture wavelet = encodeByWavelet(source, purpose, one_track);
  if (showsBetter(drawn, wavelet, options, source.texels.samples.size())) return {true, {}};
  const bool limited = one_track.limit < options.limit && !wavelet.tracks.front().complete;
  if (limited) return {false, {}};
  return {false, std::move(wavelet)};
}

/// The image without an overlay, as far as a comparison looks: where an overlay is tried it mostly
/// wins.
EncodedTexture encodeToCompare(const TextureSource& source, Purpose purpose,
                               const TextureOptions& options) {
  TextureOptions compared = oneTrack(options);
  if (options.mean_square == 0) compared.limit = std::min(options.limit, options.room);
  return encodeByWavelet(source, purpose, compared);
}

/// Codes the image by wavelet, with an overlay or without. Both are coded in one track to compare
/// them: all of it for the last bit, else what a budget has room for. plain: the image without an
/// overlay, in one track, if that was coded already.
EncodedTexture encodePhotograph(const TextureSource& source, Purpose purpose,
                                const TextureOptions& options,
                                std::optional<EncodedTexture> plain) {
  const Mask seen = source.counted(purpose == Purpose::kLossy);
  const std::vector<uint8_t> photograph = photographOf(source.texels, seen);
  const bool one_track = options.region_log2 == 0;
  if (photograph.empty()) {
    if (plain && one_track) return std::move(*plain);
    return encodeByWavelet(source, purpose, options, {}, plain ? &plain->header : nullptr);
  }
  const bool ends_early = !plain && options.room < options.limit && options.mean_square == 0;
  if (!plain) plain = encodeToCompare(source, purpose, options);
  EncodedTexture overlaid = encodeByWavelet(source, purpose, oneTrack(options), photograph);
  const bool pays = showsBetter(overlaid, *plain, options, countedSamples(source.texels, seen));
  EncodedTexture& better = pays ? overlaid : *plain;
  if (one_track && (pays || !ends_early)) return std::move(better);
  const TextureHeader like = std::move(better.header);
  return encodeByWavelet(source, purpose, options, pays ? Mask(photograph) : Mask(), &like);
}

/// Drawn, or by wavelet: without priorities then, because drawn textures have none, and what counts
/// differently cannot be compared.
EncodedTexture encodeModelled(const TextureSource& source, Purpose purpose,
                              TextureOptions options) {
  std::optional<EncodedTexture> drawn = encodeDrawn(source.texels);
  if (!drawn) return encodePhotograph(source, purpose, options, {});
  options.priorities = nullptr;
  const bool whole = bytesOf(drawn->tracks) <= options.room && options.mean_square == 0;
  const auto contest = whole ? contestWhole : contestCut;
  Contest result = contest(*drawn, source, purpose, options);
  if (result.drawn_wins) return std::move(*drawn);
  drawn.reset();
  return encodePhotograph(source, purpose, options, std::move(result.plain));
}

}  // namespace

EncodedTexture encodeTexture(const TextureSource& source, Purpose purpose, TextureOptions options) {
  if (purpose == Purpose::kLossless) options.mean_square = 0;
  EncodedTexture encoded = encodeModelled(source, purpose, options);
  const uint64_t stored = storedBytes(source.texels);
  const bool shorter = stored < bytesOf(encoded.tracks) && stored <= options.room;
  return purpose == Purpose::kLossless && shorter ? storeTexture(source.texels)
                                                  : std::move(encoded);
}

EncodedTexture encodeReversibly(const TextureSource& source, TextureHeader lossy,
                                const TextureOptions& options) {
  assert(!lossy.direct());
  std::vector<uint8_t> photograph;
  if (lossy.overlay_bytes > 0)
    photograph = photographOf(source.texels, source.counted(lossy.hidden));
  lossy.wavelet = withoutFraction(lossy.wavelet);
  return encodeByWavelet(source, Purpose::kLossless, options, photograph, &lossy);
}

}  // namespace tetrakis::inline texture
