// SPDX-License-Identifier: Apache-2.0
// A drawn texture is better than the wavelet where its last byte is in reach, and worse before, if
// it has many colours. It also must take no more bytes than the wavelet needs for the last bit; or
// half of them, if the last bit is not asked for. Where it will be cut, both are compared there.
// What takes more bytes to code than to store is stored.
#include "texture_wavelet/texture_encoder.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstdlib>
#include <optional>
#include <utility>
#include <vector>

#include "texture_wavelet/drawn/drawn_encoder.hpp"
#include "texture_wavelet/mask/mask.hpp"
#include "texture_wavelet/texture_source.hpp"

namespace tetrakis::inline texture {

namespace {

/// A wavelet that takes this part more bytes than a drawing, or than tables, has lost to it. A
/// larger number ends trials earlier, and lets fewer wavelets win by their prefixes.
constexpr uint64_t kReachPart = 2;
/// No other attempt is made to save a part of this number of bytes. A larger number saves time.
constexpr uint64_t kFewBytes = 1024;
/// The part of the texels that a photograph under an overlay has at least: an overlay of nearly
/// everything is the drawing once more. A larger number takes the time of more trials.
constexpr size_t kPhotographPart = 4;
/// The part of the bits of one channel's residuals that no wavelet stays below; wavelets take about
/// twice as many. A larger number tries wavelets that are too long, which takes time.
constexpr double kResidualPart = 2;
/// A drawing of a lossy texture wins if the wavelet takes more than this many times its bytes. A
/// larger factor lets fewer drawings win, whose prefixes show less.
constexpr uint64_t kLossyReach = 2;
/// Halves of a table's bytes up to which a drawing is tried by its estimate, which is up to 2.5
/// times too high for few values. A larger number takes time, a smaller one misses dithers.
constexpr uint64_t kHalvesOfTables = 5;
/// The part of a photograph's bytes that a drawing has to save to be tried. A larger number tries
/// more drawings, which takes time.
constexpr uint64_t kSavedPart = 5;

/// A wavelet that takes more than so many bytes has lost to a drawing of `bytes`.
uint64_t withinReach(uint64_t bytes) {
  return bytes + bytes / kReachPart;
}

TextureOptions oneTrack(TextureOptions options) {
  options.region_log2 = 0;
  return options;
}

/// Codes the image by wavelet in one track, with tables of values where these pay.
EncodedTexture encodeOnce(const TextureSource& source, Purpose purpose,
                          const TextureOptions& options, Mask photograph) {
  assert(options.region_log2 == 0);
  const bool may_pay = purpose == Purpose::kLossless && options.tables;
  const FewValues few = may_pay ? fewValuesOf(source, photograph) : FewValues();
  if (few.none()) return encodeByWavelet(source, purpose, options, photograph);
  EncodedTexture better = encodeInTables(source, few, options, photograph);
  TextureOptions until = options;
  until.limit = std::min(options.limit, withinReach(bytesOf(better)));
  EncodedTexture other = encodeByWavelet(source, purpose, until, photograph);
  if (!showsBetter(better, other, until, source.texels.samples.size())) std::swap(better, other);
  passOver(options.passed, passedOf(other), better);
  return better;
}

/// What is made of a photograph in one track: as it is, and with an overlay.
struct Attempts {
  std::optional<EncodedTexture> plain, overlaid;
};

/// Codes what is not there yet. photograph: empty, there is no overlay.
Attempts attempt(const TextureSource& source, Purpose purpose, const TextureOptions& options,
                 const std::vector<uint8_t>& photograph, Attempts attempts) {
  const TextureOptions one_track = oneTrack(options);
  if (!attempts.plain) attempts.plain = encodeOnce(source, purpose, one_track, {});
  if (!attempts.overlaid && !photograph.empty())
    attempts.overlaid = encodeOnce(source, purpose, one_track, photograph);
  return attempts;
}

bool overlayPays(const TextureSource& source, Purpose purpose, const TextureOptions& options,
                 const Attempts& attempts) {
  const Mask seen = source.counted(purpose);
  return attempts.overlaid && showsBetter(*attempts.overlaid, *attempts.plain, options,
                                          countedSamples(source.texels, seen));
}

/// The attempt that shows the image better.
const EncodedTexture& betterOf(const TextureSource& source, Purpose purpose,
                               const TextureOptions& options, const Attempts& attempts) {
  return overlayPays(source, purpose, options, attempts) ? *attempts.overlaid : *attempts.plain;
}

/// A drawn texture beside what the wavelet makes of the image.
struct Comparison {
  bool drawn_wins;
  /// What encodePhotograph() would make itself.
  Attempts attempts;
};

/// An overlay of nearly everything is the drawing once more.
bool isMostlyPhotograph(const std::vector<uint8_t>& photograph) {
  const auto left = std::count(photograph.begin(), photograph.end(), 1);
  return kPhotographPart * static_cast<size_t>(left) >= photograph.size();
}

std::vector<uint8_t> photographOf(const TextureSource& source, Purpose purpose) {
  if (source.forest != nullptr) return {};
  return photographOf(source.texels, source.coloured(purpose == Purpose::kLossy));
}

/// What a drawn texture is compared with.
Attempts attemptsBesideDrawn(const TextureSource& source, Purpose purpose,
                             const TextureOptions& options) {
  std::vector<uint8_t> photograph = photographOf(source, purpose);
  if (!isMostlyPhotograph(photograph)) photograph.clear();
  return attempt(source, purpose, options, photograph, {});
}

/// Lists all attempts, over which a drawing has won.
void passOverAll(PassedTextures* list, const Attempts& attempts, const EncodedTexture& drawn) {
  for (const std::optional<EncodedTexture>* encoded : {&attempts.plain, &attempts.overlaid})
    if (*encoded) passOver(list, passedOf(**encoded), drawn);
}

/// Attempts that the limit of a comparison ended early are no use.
Attempts completeOnes(Attempts attempts) {
  for (std::optional<EncodedTexture>* encoded : {&attempts.plain, &attempts.overlaid})
    if (*encoded && !(*encoded)->tracks.front().complete) encoded->reset();
  return attempts;
}

/// Bytes that no wavelet stays below, whatever the image: a part of the bits of the residuals of
/// one channel, predicted along gradients. Wavelets take about twice as many, and the other
/// channels'.
uint64_t leastBytes(const Texels& texels) {
  double bits = 0;
  const size_t channels = texels.channels, row = channels * texels.width;
  for (uint32_t y = 1; y < texels.height; ++y) {
    const uint16_t* at = texels.samples.data() + y * row + (channels >= 3 ? 1 : 0);
    for (uint32_t x = 1; x < texels.width; ++x) {
      at += channels;
      const int predicted = at[-static_cast<ptrdiff_t>(channels)] +
                            at[-static_cast<ptrdiff_t>(row)] -
                            at[-static_cast<ptrdiff_t>(row + channels)];
      bits += std::bit_width(static_cast<uint32_t>(std::abs(*at - predicted)));
    }
  }
  return static_cast<uint64_t>(bits / kResidualPart / 8);
}

/// A drawn texture wins if it takes too few bytes for the wavelet to restore every sample within
/// about as many, or within a multiple if that is not asked for.
Comparison compareWhole(const EncodedTexture& drawn, const TextureSource& source, Purpose purpose,
                        const TextureOptions& options) {
  const uint64_t bytes = bytesOf(drawn);
  const bool lossless = purpose == Purpose::kLossless;
  const uint64_t limit = lossless ? withinReach(bytes) : kLossyReach * bytes;
  if (bytes <= kFewBytes) return {true, {}};
  if (const uint64_t least = leastBytes(source.texels); least > limit) {
    passOverExpected(options.passed, false, least);
    return {true, {}};
  }
  const TextureOptions until = {
      .limit = limit, .threads = options.threads, .tables = lossless, .passed = options.passed};
  Attempts attempts = attemptsBesideDrawn(source, Purpose::kLossless, until);
  const EncodedTexture& wavelet = betterOf(source, Purpose::kLossless, until, attempts);
  const bool drawn_wins =
      !wavelet.tracks.front().complete ||
      (lossless && showsBetter(drawn, wavelet, until, source.texels.samples.size()));
  if (drawn_wins) passOverAll(options.passed, attempts, drawn);
  if (drawn_wins || !lossless || options.visual) return {drawn_wins, {}};
  return {drawn_wins, completeOnes(std::move(attempts))};
}

/// The comparison for a drawn texture whose end will not be sent. Alpha of a cut-out would not be
/// exact.
Comparison compareCut(const EncodedTexture& drawn, const TextureSource& source, Purpose purpose,
                      const TextureOptions& options) {
  if (!source.cutout.empty()) return {false, {}};
  TextureOptions one_track = oneTrack(options);
  if (options.mean_square > 0) one_track.limit = withinReach(bytesOf(drawn));
  Attempts attempts = attemptsBesideDrawn(source, purpose, one_track);
  const EncodedTexture& wavelet = betterOf(source, purpose, one_track, attempts);
  const bool drawn_wins = showsBetter(drawn, wavelet, options, source.texels.samples.size());
  if (drawn_wins) passOverAll(options.passed, attempts, drawn);
  const bool may_end_early = one_track.limit < options.limit;
  return {drawn_wins, may_end_early ? completeOnes(std::move(attempts)) : std::move(attempts)};
}

/// The image without an overlay, as far as a comparison looks: where an overlay is tried it mostly
/// wins.
EncodedTexture encodeToCompare(const TextureSource& source, Purpose purpose,
                               const TextureOptions& options) {
  TextureOptions compared = oneTrack(options);
  compared.limit = std::min(options.limit, options.room);
  return encodeOnce(source, purpose, compared, {});
}

/// Codes the image by wavelet, with an overlay or without. Both are coded in one track to compare
/// them: all of it for the last bit, else what a budget has room for. attempts: those that were
/// made with the same purpose and options, in one track.
EncodedTexture encodePhotograph(const TextureSource& source, Purpose purpose,
                                const TextureOptions& options, Attempts attempts) {
  const std::vector<uint8_t> photograph = photographOf(source, purpose);
  const bool one_track = options.region_log2 == 0;
  const bool in_tables = purpose == Purpose::kLossless && !fewValuesOf(source, {}).none();
  if (photograph.empty() && !one_track && !in_tables)
    return encodeByWavelet(source, purpose, options, {},
                           attempts.plain ? &attempts.plain->header : nullptr);
  const bool ends_early = !photograph.empty() && !attempts.plain && options.room < options.limit &&
                          options.mean_square == 0;
  if (ends_early) attempts.plain = encodeToCompare(source, purpose, options);
  attempts = attempt(source, purpose, options, photograph, std::move(attempts));
  const bool pays = overlayPays(source, purpose, options, attempts);
  EncodedTexture& better = pays ? *attempts.overlaid : *attempts.plain;
  if (attempts.overlaid)
    passOver(options.passed, passedOf(pays ? *attempts.plain : *attempts.overlaid), better);
  if (one_track && (pays || !ends_early)) return std::move(better);
  const TextureHeader like = std::move(better.header);
  return encodeByWavelet(source, purpose, options, pays ? Mask(photograph) : Mask(), &like);
}

/// Drawn, or by wavelet: without priorities, because drawn textures have none, and what counts
/// differently cannot be compared.
Comparison compare(const EncodedTexture& drawn, const TextureSource& source, Purpose purpose,
                   TextureOptions options) {
  options.priorities = nullptr;
  const bool whole = bytesOf(drawn) <= options.room && options.mean_square == 0;
  return (whole ? compareWhole : compareCut)(drawn, source, purpose, options);
}

/// What does not look drawn has to save a part of the photograph's bytes, or to fit whole into the
/// budget, to be tried. Lossy tracks without an aim have bits behind the last one of the texels.
/// Estimates of what has few values are too high.
uint64_t mostToTry(const EncodedTexture& photograph, Purpose purpose,
                   const TextureOptions& options) {
  const uint64_t bytes = bytesOf(photograph);
  if (options.room < bytes) return options.room;
  if (photograph.header.tables.present) return kHalvesOfTables * bytes / 2;
  const bool aimed = purpose == Purpose::kLossless || options.mean_square > 0;
  return aimed && bytes > kFewBytes ? bytes - bytes / kSavedPart : 0;
}

EncodedTexture encodeModelled(const TextureSource& source, Purpose purpose,
                              TextureOptions options) {
  if (std::optional<EncodedTexture> drawn = encodeDrawn(source.texels)) {
    Comparison compared = compare(*drawn, source, purpose, options);
    if (compared.drawn_wins) return std::move(*drawn);
    PassedTexture lost = passedOf(*drawn);
    drawn.reset();
    options.priorities = nullptr;
    EncodedTexture photograph =
        encodePhotograph(source, purpose, options, std::move(compared.attempts));
    passOver(options.passed, std::move(lost), photograph);
    return photograph;
  }
  EncodedTexture photograph = encodePhotograph(source, purpose, options, {});
  const uint64_t most = mostToTry(photograph, purpose, options);
  std::optional<EncodedTexture> drawn = encodeDrawn(source.texels, most);
  if (!drawn) return photograph;
  const bool drawn_wins = compare(*drawn, source, purpose, options).drawn_wins;
  if (drawn_wins) std::swap(*drawn, photograph);
  passOver(options.passed, passedOf(*drawn), photograph);
  return photograph;
}

}  // namespace

EncodedTexture encodeTexture(const TextureSource& source, Purpose purpose, TextureOptions options) {
  if (purpose == Purpose::kLossless) options.mean_square = 0;
  EncodedTexture encoded = encodeModelled(source, purpose, options);
  const uint64_t stored = storedBytes(source.texels);
  const bool shorter = stored < bytesOf(encoded) && stored <= options.room;
  if (purpose != Purpose::kLossless) return encoded;
  if (!shorter) {
    passOverExpected(options.passed, true, stored);
    return encoded;
  }
  EncodedTexture samples = encodeStoredTexture(source.texels);
  passOver(options.passed, passedOf(encoded), samples);
  return samples;
}

EncodedTexture encodeReversibly(const TextureSource& source, TextureHeader lossy,
                                const TextureOptions& options) {
  assert(!lossy.direct());
  std::vector<uint8_t> photograph;
  if (lossy.overlay_bytes > 0)
    photograph = photographOf(source.texels, source.coloured(lossy.hidden));
  lossy.wavelet = withoutFraction(lossy.wavelet);
  return encodeByWavelet(source, Purpose::kLossless, options, photograph, &lossy);
}

}  // namespace tetrakis::inline texture
