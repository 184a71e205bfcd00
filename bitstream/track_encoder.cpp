// SPDX-License-Identifier: Apache-2.0
#include "bitstream/track_encoder.hpp"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <utility>

#include "bitstream/range_encoder.hpp"

namespace tetrakis {

namespace {

uint32_t magnitudeOf(int32_t value) {
  return static_cast<uint32_t>(std::abs(value));
}

double squared(double x) {
  return x * x;
}

/// The encoder's side of PlanePass: answers every decision from the true coefficients, codes the
/// answer, and keeps the account of the squared error.
class EncodingIo {
 public:
  void select(const BandShape& shape, const BandSource& source) {
    shape_ = &shape;
    source_ = &source;
  }
  bool magnitudeBit(AdaptiveBit& model, size_t cell, int plane) {
    const bool bit = (magnitudeOf(source_->values[cell]) >> plane) & 1;
    encoder_.encode(model, bit);
    return bit;
  }
  bool signBit(AdaptiveBit& model, size_t cell, bool flip) {
    const bool negative = source_->values[cell] < 0;
    encoder_.encode(model, negative != flip);
    return negative;
  }
  bool blockBit(AdaptiveBit& model, const CellRange& range, int plane) {
    const bool bit = reaches(range, plane);
    encoder_.encode(model, bit);
    return bit;
  }
  bool stopped() const { return false; }
  void learned(const Band& band, size_t cell, uint32_t magnitude_before, int plane_before) {
    const double truth = magnitudeOf(source_->values[cell]);
    const double before =
        truth - Band::middle(magnitude_before, magnitude_before ? plane_before : 0);
    const double after = truth - Band::middle(band.magnitude[cell], band.plane[cell]);
    distortion_ += source_->weight * (squared(after) - squared(before));
    if (distortion_ < best_) best_ = distortion_;
    dips_ |= distortion_ > kDip * best_;
  }
  void start(double energy) {
    distortion_ = best_ = energy;
    least_ = energy * 1e-12;
  }
  /// The point reached now, with the dips since the last call. Only the end of a track is exact:
  /// the sums here are not.
  RatePoint point() {
    return {decidedBytes(), std::max(distortion_, least_), std::exchange(dips_, false)};
  }
  uint64_t decidedBytes() const { return encoder_.decidedBytes(); }
  std::vector<uint8_t> finish() { return encoder_.finish(); }

 private:
  static constexpr double kDip =
      1.0015;  ///< 0.0065 dB: well inside the 0.03 dB that a prefix may fall

  bool reaches(const CellRange& range, int plane) const {
    for (uint32_t row = range.row; row < range.row_end; ++row) {
      const uint32_t end = std::min(range.column_end, shape_->columns[row % 2]);
      for (uint32_t column = range.column; column < end; ++column) {
        if (magnitudeOf(source_->values[shape_->cell(row, column)]) >> plane) return true;
      }
    }
    return false;
  }

  RangeEncoder encoder_;
  double distortion_ = 0, best_ = 0, least_ = 0;
  bool dips_ = false;
  const BandShape* shape_ = nullptr;
  const BandSource* source_ = nullptr;
};

int planesOf(const std::vector<BandSource>& sources) {
  uint32_t all = 0;
  for (const BandSource& source : sources) {
    for (int32_t value : source.values) all |= magnitudeOf(value);
  }
  return std::bit_width(all);
}

double energyOf(const std::vector<BandSource>& sources) {
  double energy = 0;
  for (const BandSource& source : sources) {
    double band = 0;
    for (int32_t value : source.values) band += squared(value);
    energy += source.weight * band;
  }
  return energy;
}

/// Drops what is no improvement: a later point with no more bytes or no less distortion wins or
/// loses.
void append(std::vector<RatePoint>& points, RatePoint point) {
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

}  // namespace

EncodedTrack encodeTrack(const std::vector<BandPlan>& plan, const std::vector<BandSource>& sources,
                         const HintFactory& factory, uint64_t limit) {
  EncodedTrack track;
  track.planes = planesOf(sources);
  TrackState state(plan);
  std::vector<std::unique_ptr<HintSource>> hints;
  for (uint32_t band = 0; band < plan.size(); ++band) hints.push_back(factory.hints(state, band));
  EncodingIo io;
  io.start(energyOf(sources));
  track.points.push_back({0, energyOf(sources)});
  for (const Pass& pass : schedule(plan, track.planes)) {
    io.select(plan[pass.band].shape, sources[pass.band]);
    PlanePass<EncodingIo>(state.bands[pass.band], state.models[plan[pass.band].models],
                          *hints[pass.band], io)
        .run(pass.kind, pass.plane);
    append(track.points, io.point());
    if (io.decidedBytes() > limit) {
      track.complete = false;
      break;
    }
  }
  track.codeword = io.finish();
  RatePoint last = track.points.back();
  last.bytes = track.codeword.size();
  if (track.complete) last.distortion = 0;
  while (track.points.size() > 1 && track.points.back().bytes >= last.bytes)
    track.points.pop_back();
  if (last.bytes > 0) track.points.push_back(last);
  return track;
}

}  // namespace tetrakis
