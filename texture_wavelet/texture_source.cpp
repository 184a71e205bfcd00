// SPDX-License-Identifier: Apache-2.0
#include "texture_wavelet/texture_source.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/portable_math.hpp"

namespace tetrakis::inline texture {

PassedTexture passedOf(const EncodedTexture& encoded) {
  PassedTexture passed{.header = encoded.header, .bytes = bytesOf(encoded.tracks)};
  for (const EncodedTrack& track : encoded.tracks) passed.squares += track.points.back().distortion;
  return passed;
}

void passOver(PassedTextures* list, PassedTexture lost, const EncodedTexture& winner) {
  if (list == nullptr) return;
  const uint64_t bytes = lost.bytes + lost.header.tables.code.size();
  const bool longer = winner.tracks.front().complete && bytes >= bytesOf(winner);
  lost.reason = longer ? PassedFor::kLonger : PassedFor::kShowsWorse;
  list->push_back(std::move(lost));
}

void passOverExpected(PassedTextures* list, bool stored, uint64_t bytes) {
  if (list == nullptr) return;
  TextureHeader header;
  header.stored = stored;
  if (stored) header.planes = kDrawnPlanes;
  list->push_back({std::move(header), PassedFor::kExpectedLonger, bytes});
}

namespace {

/// Halvings of the bytes at which prefixes are compared. More of them count earlier prefixes.
constexpr int kHalvings = 4;
/// The share of the bytes that has to be saved for each dB that prefixes lose: without loss, and
/// for a PSNR. A larger share keeps prefixes, and takes bytes.
constexpr double kWholePerDb = 0.04, kAimedPerDb = 0.01;
/// Decibels of prefixes that one decibel at the end of a budget is worth. A larger number serves
/// whole streams, and costs prefixes quality.
constexpr double kEndPerPrefix = 2;

/// Bytes of the header that not every way to code an image has.
uint64_t tableBytes(const EncodedTexture& encoded) {
  return encoded.header.tables.code.size();
}

/// The distortion that at most so many bytes leave. What lies between two points of the account is
/// not known to be better than the first.
double distortionAt(const EncodedTexture& encoded, uint64_t bytes) {
  const std::vector<RatePoint>& points = encoded.tracks.front().points;
  bytes -= std::min(bytes, tableBytes(encoded));
  const auto above = std::find_if(points.begin() + 1, points.end(),
                                  [&](const RatePoint& p) { return p.bytes > bytes; });
  return (above - 1)->distortion;
}

/// By how many dB one error is worse than another.
double lossOf(double squares, double other) {
  return 10 * portable::log10((1 + squares) / (1 + other));
}

/// By how many dB prefixes of `a` are worse than those of `b`: the mean over a half of the bytes, a
/// quarter, and so on. What is drawn shows little until it is nearly whole, and an
/// overlay lies ahead of all else.
double prefixLoss(const EncodedTexture& a, const EncodedTexture& b, uint64_t bytes) {
  double loss = 0;
  for (int k = 1; k <= kHalvings; ++k)
    loss += lossOf(distortionAt(a, bytes >> k), distortionAt(b, bytes >> k)) / kHalvings;
  return loss;
}

/// Bytes from which on the error is no larger than that; all of them if it never is, and no number
/// of bytes if coding ended before.
uint64_t bytesFor(const EncodedTexture& encoded, double squares) {
  const EncodedTrack& track = encoded.tracks.front();
  const auto reached = std::find_if(track.points.begin(), track.points.end(),
                                    [&](const RatePoint& p) { return p.distortion <= squares; });
  if (reached != track.points.end()) return tableBytes(encoded) + reached->bytes;
  return track.complete ? bytesOf(encoded) : UINT64_MAX;
}

bool isWhole(const EncodedTexture& encoded, uint64_t room) {
  return encoded.tracks.front().complete && bytesOf(encoded) <= room;
}

}  // namespace

uint64_t bytesOf(const EncodedTexture& encoded) {
  return tableBytes(encoded) + bytesOf(encoded.tracks);
}

bool showsBetter(const EncodedTexture& a, const EncodedTexture& b, const TextureOptions& options,
                 uint64_t samples) {
  const bool aimed = options.mean_square > 0;
  if (aimed || (isWhole(a, options.room) && isWhole(b, options.room))) {
    const double squares = options.mean_square * static_cast<double>(samples);
    const uint64_t bytes_a = bytesFor(a, squares), bytes_b = bytesFor(b, squares);
    const double loss = prefixLoss(a, b, std::min(bytes_a, bytes_b));
    const double price = 1 - (aimed ? kAimedPerDb : kWholePerDb) * loss;
    return static_cast<double>(bytes_a) < static_cast<double>(bytes_b) * price;
  }
  const uint64_t reach = std::min({options.room, bytesOf(a), bytesOf(b)});
  const double loss = lossOf(distortionAt(a, reach), distortionAt(b, reach));
  return kEndPerPrefix * loss + prefixLoss(a, b, reach) < 0;
}

}  // namespace tetrakis::inline texture
