// SPDX-License-Identifier: Apache-2.0
// DrawingEncoding is the encoder's side of drawing_pass.hpp: it answers each decision of the pass
// from the samples, writes it to a codeword, and accounts for the error of every prefix.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "base/plane.hpp"
#include "bitstream/coder/range_encoder.hpp"
#include "bitstream/track/track_encoder.hpp"
#include "codec/drawing/drawing_neighbours.hpp"

namespace tetrakis::inline drawing {

/// Samples with a number for each of their values, in any order.
template <class Value>
struct Numbered {
  std::vector<DrawnIndex> numbers;  ///< of each sample
  std::vector<Value> values;
};

/// The decisions of a drawing as a codeword.
class DrawingDecisions {
 public:
  bool bit(AdaptiveBit& model, bool ours) {
    encoder_.encode(model, ours);
    return ours;
  }
  bool bitOf(uint32_t zero, bool ours) {
    encoder_.encodeOf(zero, ours);
    return ours;
  }
  bool evenBit(bool ours) {
    encoder_.encodeEven(ours);
    return ours;
  }
  bool stopped() const { return false; }
  uint64_t decidedBytes() const { return encoder_.decidedBytes(); }

  std::vector<uint8_t> finish() {
    std::vector<uint8_t> codeword = encoder_.finish();
    if (codeword.empty()) codeword.push_back(0);  // a track has at least one packet
    return codeword;
  }

 private:
  RangeEncoder encoder_;
};

/// Values have an index from the moment on when they are first coded.
template <class Value>
class DrawingEncoding : public DrawingDecisions {
 public:
  /// Squared error of what a decoder shows that knows the indices so far.
  using Measure = std::function<double()>;

  /// listed: how many of the values, the first ones, are in the list from the start. measure:
  /// empty: what prefixes show does not matter.
  DrawingEncoding(const Numbered<Value>& samples, size_t listed, Measure measure)
      : samples_(samples),
        measure_(std::move(measure)),
        listed_(listed),
        index_(samples.values.size(), kNoIndex) {
    for (size_t i = 0; i < listed; ++i) index_[i] = static_cast<DrawnIndex>(i);
    if (measure_) note(0);
  }

  /// Gives a value that has not appeared yet its index.
  DrawnIndex target(size_t sample) {
    if (measure_ && decidedBytes() >= next_) note(decidedBytes());
    DrawnIndex& index = index_[samples_.numbers[sample]];
    const DrawnIndex known = index;
    if (known == kNoIndex) index = static_cast<DrawnIndex>(listed_++);
    return known;
  }
  const Value& value(size_t sample) const { return samples_.values[samples_.numbers[sample]]; }

  EncodedTrack finishTrack(int planes) {
    EncodedTrack track;
    track.codeword = finish();
    track.points = std::move(points_);
    const uint64_t bytes = track.codeword.size();
    std::erase_if(track.points,
                  [&](const RatePoint& p) { return p.bytes >= bytes && p.bytes > 0; });
    track.points.push_back({bytes, 0, bytes <= kDippingBytes});
    track.planes = planes;
    return track;
  }

 private:
  /// The error is measured each time that the codeword has grown by kGrowth; of drawings of more
  /// than kLargeDrawing samples by kLargeGrowth, because each time takes a good part of that of
  /// coding them. Smaller factors give the account more points, and take time.
  static constexpr double kGrowth = 1.4, kLargeGrowth = 2.0;
  static constexpr size_t kLargeDrawing = size_t{1} << 18;
  /// Bytes at which the error is measured first. Fewer of them take the time of points that are too
  /// close to be packets.
  static constexpr uint64_t kLeastStep = 32;
  /// Within this number of bytes a vertex stands for enough samples to make the prefix worse where
  /// it is wrong. A larger number makes more bytes wait until their packet is complete.
  static constexpr uint64_t kDippingBytes = 512;

  double growth() const { return samples_.numbers.size() > kLargeDrawing ? kLargeGrowth : kGrowth; }

  void note(uint64_t bytes) {
    const double squares = measure_();
    next_ = std::max(kLeastStep, static_cast<uint64_t>(growth() * static_cast<double>(bytes)));
    if (squares == 0) next_ = UINT64_MAX;  // nothing is left to be found
    const bool better = points_.empty() || (squares > 0 && squares < points_.back().distortion);
    if (better) points_.push_back({bytes, squares, bytes > 0 && bytes <= kDippingBytes});
  }

  const Numbered<Value>& samples_;
  Measure measure_;
  size_t listed_;
  std::vector<DrawnIndex> index_;  ///< of each number
  uint64_t next_ = 0;              ///< bytes at which the error is measured again
  std::vector<RatePoint> points_;
};

// estimateDrawing() foretells from the samples of a plane how many bytes a drawing of them takes,
// in a small part of the time of coding it.

/// What a sample says that is like neither the one before nor the one above: by how much it differs
/// from the one before, or which value it has.
enum class Alone { kDifference, kValue };

/// About how many bytes the samples take as a drawing; the first column and row cost nothing.
/// Value: int32_t, or uint16_t.
template <class Value>
double estimateDrawing(const PlaneView<const Value>& samples, Alone alone);

}  // namespace tetrakis::inline drawing
