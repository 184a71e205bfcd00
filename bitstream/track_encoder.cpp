// SPDX-License-Identifier: Apache-2.0
#include "bitstream/track_encoder.hpp"

#include <algorithm>
#include <bit>
#include <cstdlib>

#include "bitstream/range_encoder.hpp"

namespace tetrakis {

namespace {

uint32_t magnitudeOf(int32_t value) { return static_cast<uint32_t>(std::abs(value)); }

double squared(double x) { return x * x; }

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
    const double before = truth - Band::middle(magnitude_before, magnitude_before ? plane_before : 0);
    const double after = truth - Band::middle(band.magnitude[cell], band.plane[cell]);
    distortion += source_->weight * (squared(after) - squared(before));
  }
  uint64_t decidedBytes() const { return encoder_.decidedBytes(); }
  std::vector<uint8_t> finish() { return encoder_.finish(); }

  double distortion = 0;

 private:
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

}  // namespace

EncodedTrack encodeTrack(const std::vector<BandPlan>& plan, const std::vector<BandSource>& sources,
                         const HintFactory& factory) {
  EncodedTrack track;
  track.planes = planesOf(sources);
  TrackState state(plan);
  std::vector<std::unique_ptr<HintSource>> hints;
  for (uint32_t band = 0; band < plan.size(); ++band) hints.push_back(factory.hints(state, band));
  EncodingIo io;
  io.distortion = energyOf(sources);
  track.points.push_back({0, io.distortion});
  for (const Pass& pass : schedule(plan, track.planes)) {
    io.select(plan[pass.band].shape, sources[pass.band]);
    PlanePass<EncodingIo>(state.bands[pass.band], state.models[plan[pass.band].models],
                          *hints[pass.band], io)
        .run(pass.kind, pass.plane);
    if (io.distortion < track.points.back().distortion) {
      if (io.decidedBytes() <= track.points.back().bytes) track.points.pop_back();
      track.points.push_back({io.decidedBytes(), io.distortion});
    }
  }
  track.codeword = io.finish();
  while (track.points.size() > 1 && track.points.back().bytes >= track.codeword.size()) {
    track.points.pop_back();
  }
  track.points.push_back({track.codeword.size(), 0.0});
  return track;
}

}  // namespace tetrakis
