// SPDX-License-Identifier: Apache-2.0
#include "bitstream/track/track_encoder.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <limits>
#include <optional>
#include <utility>

#include "base/parallel.hpp"
#include "base/watch.hpp"
#include "bitstream/track/encoding_io.hpp"
#include "bitstream/track/track.hpp"

namespace tetrakis::inline track {

namespace {

/// The sum of the squared coefficients of a tier.
double squaresOf(const BandPlan& plan, const BandSource& source, size_t tier) {
  double squares = 0;
  for (uint32_t row = 0; row < plan.shape.rows; ++row) {
    for (uint32_t word = 0; word < plan.shape.words(); ++word) {
      const int32_t* from = source.values.data() + plan.shape.cell(row, 32 * word);
      for (uint32_t todo = membersOf(plan, tier, row, word); todo != 0; todo &= todo - 1)
        squares += squared(from[std::countr_zero(todo)]);
    }
  }
  return squares;
}

/// The account before the first byte.
RatePoint nothingOf(const TrackSource& track) {
  double energy = 0, squares = 0;
  for (size_t i = 0; i < track.bands.size(); ++i) {
    const BandSource& source = track.bands[i];
    for (size_t tier = 0; tier < tiersOf(track.plan[i]); ++tier) {
      const double part = source.weight * squaresOf(track.plan[i], source, tier);
      energy += source.seen[tier] * part;
      squares += part;
    }
  }
  return {0, energy, false, squares - energy};
}

/// Which bit-planes the tiers of each band have bits in.
std::vector<std::vector<Occupancy>> occupancyOf(const TrackSource& track) {
  assert(track.plan.size() == track.bands.size());
  std::vector<std::vector<Occupancy>> occupancy(track.plan.size());
  for (size_t i = 0; i < track.plan.size(); ++i) {
    for (size_t tier = 0; tier < tiersOf(track.plan[i]); ++tier)
      occupancy[i].emplace_back(track.plan[i], tier, track.bands[i].values);
  }
  return occupancy;
}

/// Drops what is no improvement: a later point with no more bytes or no less distortion wins or
/// loses.
void append(std::vector<RatePoint>& points, RatePoint point) {
  assert(!points.empty() && point.bytes + 4 >= points.back().bytes);
  if (point.distortion >= points.back().distortion) {
    points.back().dips |= point.dips;
    return;
  }
  if (point.bytes <= points.back().bytes) {
    point.dips |= points.back().dips;
    points.pop_back();
  }
  points.push_back(point);
}

/// Codes a track pass by pass.
class TrackCoder {
 public:
  /// planes: the bit-planes of all tracks that are coded together.
  TrackCoder(const TrackSource& source, int planes)
      : TrackCoder(source, planes, nothingOf(source)) {}

  int firstKey() const { return done() ? kNoKey : passes_.front().key; }
  /// A track of zeros is complete without a byte: WaveletHeader::rounded_bytes tells the decoder
  /// that none of its decisions is missing.
  bool done() const { return nothing_to_say_ || passes_.empty(); }
  uint64_t bytes() const { return io_.decidedBytes(); }
  double distortion() const { return track_.points.back().distortion; }

  /// Runs the passes of this key and above, until the codeword passes `limit` bytes or the
  /// distortion is enough. Every turn takes one of the 3 * planes passes of a band off the queue.
  void run(int least_key, uint64_t limit, double enough) {
    while (!done() && firstKey() >= least_key && bytes() <= limit && distortion() > enough) {
      const Pass pass = passes_.front();
      io_.select(source_.plan[pass.band].shape, source_.bands[pass.band], pass.tier,
                 occupancy_[pass.band][pass.tier]);
      state_.run(source_.plan, pass, io_);
      passes_.pop(state_.bands[pass.band]);
      append(track_.points, io_.point());
      passPiece(most_passes_);
    }
  }

  EncodedTrack finish() {
    track_.complete = done();
    track_.codeword = io_.finish();
    RatePoint last = track_.points.back();
    last.bytes = track_.codeword.size();
    if (track_.complete) last.distortion = last.beyond = 0;
    while (track_.points.size() > 1 && track_.points.back().bytes >= last.bytes)
      track_.points.pop_back();
    if (last.bytes > 0) track_.points.push_back(last);
    assert(track_.points.front().bytes == 0 &&
           track_.points.back().bytes == track_.codeword.size());
    return std::move(track_);
  }

  static constexpr int kNoKey = std::numeric_limits<int>::min();

 private:
  TrackCoder(const TrackSource& source, int planes, const RatePoint& nothing)
      : source_(source),
        occupancy_(occupancyOf(source)),
        state_(source.plan, planes),
        passes_(source.plan, planes),
        nothing_to_say_(nothing.squares() == 0),
        io_(nothing),
        track_{{}, {nothing}, planes},
        most_passes_(mostPasses()) {}

  /// Three in each bit-plane of every tier.
  size_t mostPasses() const {
    size_t tiers = 0;
    for (const auto& band : occupancy_) tiers += band.size();
    return tiers * 3 * static_cast<size_t>(track_.planes);
  }

  const TrackSource& source_;
  std::vector<std::vector<Occupancy>> occupancy_;  ///< of each band and tier
  TrackState state_;
  PassQueue passes_;
  bool nothing_to_say_;
  EncodingIo io_;
  EncodedTrack track_;
  size_t most_passes_;  ///< counted once: forests have thousands of bands
};

/// The largest of so many numbers, which are found on several threads.
int mostOf(uint32_t threads, size_t count, const std::function<int(size_t)>& number) {
  std::vector<int> numbers(count);
  parallelFor(threads, count, [&](size_t i) { numbers[i] = number(i); });
  return *std::max_element(numbers.begin(), numbers.end());
}

/// The keys of the passes of a bit-plane.
constexpr int kBitPlane = 16;

/// One bit-plane after the other, as long as a byte of it takes off enough distortion. The first
/// ones, above all coefficients, take bytes and take off nothing.
void runWhileWorth(TrackCoder& coder, double least_slope) {
  while (!coder.done()) {
    const auto bytes = static_cast<double>(coder.bytes());
    const double distortion = coder.distortion();
    coder.run(coder.firstKey() - kBitPlane + 1, UINT64_MAX, TrackOptions::kNever);
    const double removed = distortion - coder.distortion();
    const double taken = static_cast<double>(coder.bytes()) - bytes;
    if (removed > 0 && removed < least_slope * taken) return;
  }
}

/// All coders together, one bit-plane after the other. It ends: `key` falls below the key of every
/// pass, and a coder that is asked for all keys from there on is done.
void runTogether(std::vector<std::optional<TrackCoder>>& coders, const TrackOptions& options) {
  assert(!coders.empty());
  int key = TrackCoder::kNoKey;
  for (const auto& coder : coders) key = std::max(key, coder->firstKey());
  const auto open = [&] {
    uint64_t bytes = 0;
    double distortion = 0;
    bool done = true;
    for (const auto& coder : coders) {
      bytes += coder->bytes();
      distortion += coder->distortion();
      done &= coder->done();
    }
    return !done && bytes <= options.limit && distortion > options.enough;
  };
  for (; open(); key -= kBitPlane) {
    const int least = options.toTheEnd() ? TrackCoder::kNoKey : key;
    parallelFor(options.threads, coders.size(),
                [&](size_t i) { coders[i]->run(least, UINT64_MAX, TrackOptions::kNever); });
  }
}

}  // namespace

int planesOf(const TrackSource& track) {
  uint32_t all = 0;
  for (const BandSource& band : track.bands)
    for (const int32_t value : band.values) all |= magnitudeOf(value);
  return std::bit_width(all);
}

uint64_t bytesOf(std::span<const EncodedTrack> tracks) {
  uint64_t bytes = 0;
  for (const EncodedTrack& track : tracks) bytes += track.codeword.size();
  return bytes;
}

uint64_t exactBytes(std::span<const EncodedTrack> tracks) {
  const bool complete =
      std::all_of(tracks.begin(), tracks.end(), [](const auto& t) { return t.complete; });
  return bytesOf(tracks) + (complete ? 0 : 1);
}

std::vector<EncodedTrack> encodeTracks(const std::vector<TrackSource>& sources,
                                       const TrackOptions& options) {
  assert(!sources.empty());
  const uint32_t threads = options.threads;
  const int planes =
      mostOf(threads, sources.size(), [&](size_t i) { return planesOf(sources[i]); });
  std::vector<std::optional<TrackCoder>> coders(sources.size());
  parallelFor(threads, coders.size(), [&](size_t i) { coders[i].emplace(sources[i], planes); });
  if (coders.size() == 1) {
    coders.front()->run(TrackCoder::kNoKey, options.limit, options.enough);
  } else {
    runTogether(coders, options);
  }
  std::vector<EncodedTrack> tracks;
  for (auto& coder : coders) tracks.push_back(coder->finish());
  return tracks;
}

EncodedTrack encodeTrack(const TrackSource& source, int planes, double least_slope) {
  assert(planesOf(source) <= planes);
  TrackCoder coder(source, planes);
  if (least_slope > 0) {
    runWhileWorth(coder, least_slope);
  } else {
    coder.run(TrackCoder::kNoKey, UINT64_MAX, TrackOptions::kNever);
  }
  return coder.finish();
}

std::vector<EncodedTrack> encodeWholeTracks(size_t count,
                                            const std::function<TrackSource(size_t)>& source_of,
                                            uint32_t threads) {
  assert(count > 0);
  const int planes = mostOf(threads, count, [&](size_t i) { return planesOf(source_of(i)); });
  std::vector<EncodedTrack> tracks(count);
  parallelFor(threads, count, [&](size_t i) { tracks[i] = encodeTrack(source_of(i), planes); });
  return tracks;
}

}  // namespace tetrakis::inline track
