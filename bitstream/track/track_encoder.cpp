// SPDX-License-Identifier: Apache-2.0
#include "bitstream/track/track_encoder.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstdlib>
#include <limits>
#include <optional>
#include <utility>

#include "base/parallel.hpp"
#include "bitstream/coder/range_encoder.hpp"
#include "bitstream/track/pass_queue.hpp"
#include "bitstream/track/reconstruction.hpp"

namespace tetrakis::inline track {

namespace {

uint32_t magnitudeOf(int32_t value) {
  return static_cast<uint32_t>(std::abs(value));
}

double squared(double x) {
  return x * x;
}

/// The coefficients of a tier in a word, where all of them are in tier 0 unless there are tiers.
uint32_t membersOf(const BandPlan& plan, size_t tier, uint32_t row, uint32_t word) {
  if (plan.tiers == nullptr) return tier == 0 ? plan.shape.valid(word) : 0;
  return plan.tiers->members[tier * plan.shape.wordCells() + plan.shape.word(row, word)];
}

size_t tiersOf(const BandPlan& plan) {
  return plan.tiers == nullptr ? 1 : kPriorities;
}

/// Which bit-planes of a block, and of a band, hold a bit of some magnitude of a tier.
struct Occupancy {
  Occupancy(const BandPlan& plan, size_t tier, const std::vector<int32_t>& values)
      : blocks(size_t{(plan.shape.rows + Band::kBlockRows - 1) / Band::kBlockRows} *
                   plan.shape.words(),
               0) {
    const BandShape& shape = plan.shape;
    for (uint32_t row = 0; row < shape.rows; ++row) {
      uint32_t* to = blocks.data() + size_t{row / Band::kBlockRows} * shape.words();
      for (uint32_t word = 0; word < shape.words(); ++word) {
        const int32_t* from = values.data() + shape.cell(row, 32 * word);
        for (uint32_t todo = membersOf(plan, tier, row, word); todo != 0; todo &= todo - 1)
          to[word] |= magnitudeOf(from[std::countr_zero(todo)]);
      }
    }
    for (uint32_t block : blocks) band |= block;
  }
  std::vector<uint32_t> blocks;
  uint32_t band = 0;
};

/// The encoder's side of PlanePass: answers every decision from the true coefficients, codes the
/// answer, and keeps the account of the squared error.
class EncodingIo {
 public:
  using Plenty = EncodingIo&;
  static constexpr bool hasPlenty(size_t) { return false; }
  void select(const BandShape& shape, const BandSource& source, size_t tier,
              const Occupancy& occupancy) {
    words_ = shape.words();
    values_ = source.values.data();
    plain_ = source.weight;
    weight_ = source.weight * source.seen[tier];
    occupancy_ = &occupancy;
  }
  bool magnitudeBit(AdaptiveBit& model, size_t cell, int plane) {
    const bool bit = (magnitudeOf(values_[cell]) >> plane) & 1;
    encoder_.encode(model, bit);
    return bit;
  }
  bool refinedBit(AdaptiveBit& model, size_t cell, int plane) {
    return magnitudeBit(model, cell, plane);
  }
  bool signBit(AdaptiveBit& model, size_t cell, bool flip) {
    const bool negative = values_[cell] < 0;
    encoder_.encode(model, negative != flip);
    return negative;
  }
  bool blockBit(AdaptiveBit& model, uint32_t y, uint32_t x, int plane) {
    const bool bit = occupancy_->blocks[size_t{y} * words_ + x] >> plane != 0;
    encoder_.encode(model, bit);
    return bit;
  }
  bool groupBit(AdaptiveBit& model, size_t cell, int plane) {
    const bool bit = firstOfFour(cell, plane) < 4;
    encoder_.encode(model, bit);
    return bit;
  }
  bool placeBit(AdaptiveBit& model, size_t cell, uint32_t place_bit, int plane) {
    const bool bit = (firstOfFour(cell, plane) >> place_bit) & 1;
    encoder_.encode(model, bit);
    return bit;
  }
  bool bandBit(AdaptiveBit& model, int plane) {
    const bool bit = occupancy_->band >> plane != 0;
    encoder_.encode(model, bit);
    return bit;
  }
  bool stopped() const { return false; }
  void learned(size_t cell, uint32_t before, uint32_t after, int plane) {
    const double truth = magnitudeOf(values_[cell]);
    const double change = squared(truth - typicalMagnitude(after, plane)) -
                          squared(truth - typicalMagnitude(before, plane + 1));
    distortion_ += weight_ * change;
    squares_ += plain_ * change;
    if (distortion_ < best_) best_ = distortion_;
    dips_ |= distortion_ > kDip * best_ + least_;
  }
  void start(const RatePoint& nothing) {
    distortion_ = best_ = nothing.distortion;
    squares_ = nothing.squares();
    least_ = distortion_ * 1e-12;
  }
  /// The point reached now, with the dips since the last call. Only the end of a track is exact:
  /// the sums here are not.
  RatePoint point() {
    return {decidedBytes(), std::max(distortion_, least_), std::exchange(dips_, false),
            squares_ - distortion_};
  }
  uint64_t decidedBytes() const { return encoder_.decidedBytes(); }
  std::vector<uint8_t> finish() { return encoder_.finish(); }

 private:
  static constexpr double kDip =
      1.0015;  ///< 0.0065 dB: well inside the 0.03 dB that a prefix may fall

  /// 4 if none of the four reaches 2^plane.
  uint32_t firstOfFour(size_t cell, int plane) const {
    uint32_t i = 0;
    while (i < 4 && magnitudeOf(values_[cell + i]) >> plane == 0) ++i;
    return i;
  }

  RangeEncoder encoder_;
  double distortion_ = 0, best_ = 0;
  double least_ = 0;    ///< what these sums, which are not exact, may be off
  double squares_ = 0;  ///< whatever viewers see of them
  bool dips_ = false;
  uint32_t words_ = 0;
  const int32_t* values_ = nullptr;
  double weight_ = 1, plain_ = 1;
  const Occupancy* occupancy_ = nullptr;
};

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

/// Bit-planes of its largest coefficient. Those that do not exist are 0.
int planesOf(const TrackSource& track) {
  uint32_t all = 0;
  for (const BandSource& band : track.bands)
    for (const int32_t value : band.values) all |= magnitudeOf(value);
  return std::bit_width(all);
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
  explicit TrackCoder(const TrackSource& source) : source_(source) {
    assert(source.plan.size() == source.bands.size());
    occupancy_.resize(source.plan.size());
    for (size_t i = 0; i < source.plan.size(); ++i) {
      for (size_t tier = 0; tier < tiersOf(source.plan[i]); ++tier)
        occupancy_[i].emplace_back(source.plan[i], tier, source.bands[i].values);
    }
  }

  int planes() const {
    uint32_t all = 0;
    for (const auto& band : occupancy_) {
      for (const Occupancy& tier : band) all |= tier.band;
    }
    return std::bit_width(all);
  }

  void start(int planes) {
    track_.planes = planes;
    state_.emplace(source_.plan, planes);
    passes_.emplace(source_.plan, planes);
    const RatePoint nothing = nothingOf(source_);
    io_.start(nothing);
    track_.points.push_back(nothing);
    nothing_to_say_ = nothing.squares() == 0;
  }

  int firstKey() const { return done() ? kNoKey : passes_->front().key; }
  /// A track of zeros is complete without a byte: WaveletHeader::rounded_bytes tells the decoder
  /// that none of its decisions is missing.
  bool done() const { return nothing_to_say_ || passes_->empty(); }
  uint64_t bytes() const { return io_.decidedBytes(); }
  double distortion() const { return track_.points.back().distortion; }

  /// Runs the passes of this key and above, until the codeword passes `limit` bytes or the
  /// distortion is enough. Every turn takes one of the 3 * planes passes of a band off the queue.
  void run(int least_key, uint64_t limit, double enough) {
    assert(state_ && passes_);
    while (!done() && firstKey() >= least_key && bytes() <= limit && distortion() > enough) {
      const Pass pass = passes_->front();
      io_.select(source_.plan[pass.band].shape, source_.bands[pass.band], pass.tier,
                 occupancy_[pass.band][pass.tier]);
      state_->run(source_.plan, pass, io_);
      passes_->pop(state_->bands[pass.band]);
      append(track_.points, io_.point());
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
  const TrackSource& source_;
  std::vector<std::vector<Occupancy>> occupancy_;  ///< of each band and tier
  std::optional<TrackState> state_;
  std::optional<PassQueue> passes_;
  bool nothing_to_say_ = false;
  EncodingIo io_;
  EncodedTrack track_;
};

/// All coders together, one bit-plane after the other. It ends: `key` falls below the key of every
/// pass, and a coder that is asked for all keys from there on is done.
void runTogether(std::vector<std::optional<TrackCoder>>& coders, const TrackOptions& options) {
  assert(!coders.empty());
  constexpr int kBitPlane = 16;
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

EncodedTrack encodeTrack(const std::vector<BandPlan>& plan, const std::vector<BandSource>& sources,
                         uint64_t limit) {
  return std::move(encodeTracks({{plan, sources}}, {limit}).front());
}

std::vector<EncodedTrack> encodeTracks(const std::vector<TrackSource>& sources,
                                       const TrackOptions& options) {
  assert(!sources.empty());
  const uint32_t threads = options.threads;
  std::vector<std::optional<TrackCoder>> coders(sources.size());
  parallelFor(threads, coders.size(), [&](size_t i) { coders[i].emplace(sources[i]); });
  int planes = 0;
  for (const auto& coder : coders) planes = std::max(planes, coder->planes());
  parallelFor(threads, coders.size(), [&](size_t i) { coders[i]->start(planes); });
  if (coders.size() == 1) {
    coders.front()->run(TrackCoder::kNoKey, options.limit, options.enough);
  } else {
    runTogether(coders, options);
  }
  std::vector<EncodedTrack> tracks;
  for (auto& coder : coders) tracks.push_back(coder->finish());
  return tracks;
}

std::vector<EncodedTrack> encodeWholeTracks(size_t count,
                                            const std::function<TrackSource(size_t)>& source_of,
                                            uint32_t threads) {
  assert(count > 0);
  std::vector<int> planes(count);
  parallelFor(threads, count, [&](size_t i) { planes[i] = planesOf(source_of(i)); });
  const int most = *std::max_element(planes.begin(), planes.end());
  std::vector<EncodedTrack> tracks(count);
  parallelFor(threads, count, [&](size_t i) {
    const TrackSource source = source_of(i);
    TrackCoder coder(source);
    coder.start(most);
    coder.run(TrackCoder::kNoKey, UINT64_MAX, TrackOptions::kNever);
    tracks[i] = coder.finish();
  });
  return tracks;
}

}  // namespace tetrakis::inline track
