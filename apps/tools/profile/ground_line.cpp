// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/profile/ground_line.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "apps/tools/files/sample_types.hpp"
#include "apps/tools/profile/path_legs.hpp"

namespace tetrakis::tools {
namespace {

/// A line has no more samples than this: what is made of them fits in half a gigabyte.
constexpr double kMostLineSamples = 1 << 22;
constexpr uint64_t kBytesOfLineSample = 128;

/// Heights of a window; NaN for voids.
class Ground {
 public:
  Ground(const HeightFile& heights, const tks_window& window)
      : heights_(heights), window_(window) {}

  /// NaN where a sample that it depends on is void.
  double at(const GridPoint& point) const {
    const auto [column, right] = weigh(point.column - window_.x, window_.width);
    const auto [row, below] = weigh(point.row - window_.y, window_.height);
    const double upper = between(column, row, right);
    return below > 0 ? upper + below * (between(column, row + 1, right) - upper) : upper;
  }

 private:
  /// The sample before, and the weight of that behind it.
  static std::pair<uint32_t, double> weigh(double at, uint32_t count) {
    const double inside = std::clamp(at, 0.0, count - 1.0);
    const auto before = static_cast<uint32_t>(inside);
    return {before, inside - before};
  }

  double between(uint32_t column, uint32_t row, double right) const {
    const double left = sample(column, row);
    return right > 0 ? left + right * (sample(column + 1, row) - left) : left;
  }

  double sample(uint32_t column, uint32_t row) const {
    const size_t i = size_t{row} * window_.width + column;
    const double value =
        visitSamples(heights_, [i](auto samples) { return static_cast<double>(samples[i]); });
    if (heights_.nodata && value == *heights_.nodata)
      return std::numeric_limits<double>::quiet_NaN();
    return value * heights_.scale + heights_.offset;
  }

  const HeightFile& heights_;
  const tks_window window_;
};

/// Walks along the legs; pieces end where there is no height.
class LineSampler {
 public:
  explicit LineSampler(const Ground& ground) : ground_(ground) {}

  GroundLine walk(const std::vector<Leg>& legs) && {
    bool arrived = false;  // at the end of the leg before, with a sample
    for (const Leg& leg : legs) {
      if (!leg.meetsGround()) {
        leave(leg.start, leg.end);
        arrived = false;
        continue;
      }
      if (leg.enters > 0) leave(leg.start, leg.distance(leg.enters));
      sampleAlong(leg, arrived && leg.enters <= 0);
      arrived = leg.exits >= 1;
      if (!arrived) leave(leg.distance(leg.exits), leg.end);
    }
    line_.length = legs.back().end;
    endPiece();
    return std::move(line_);
  }

 private:
  void sampleAlong(const Leg& leg, bool has_first) {
    const double part = leg.exits - leg.enters;
    const auto steps = static_cast<uint32_t>(std::ceil(leg.samples() * part));
    for (uint32_t i = has_first ? 1 : 0; i <= steps; ++i) {
      const double at = steps == 0 || i == 0 ? leg.enters
                        : i == steps         ? leg.exits
                                             : leg.enters + part * i / steps;
      take(leg.distance(at), ground_.at(leg.pointAt(at)),
           {leg.at_from.x + at * (leg.at_to.x - leg.at_from.x),
            leg.at_from.y + at * (leg.at_to.y - leg.at_from.y)});
    }
  }

  void take(double distance, double height, const LinePoint& at) {
    if (std::isnan(height)) {
      addGap({piece_.empty() ? distance : piece_.back().distance, distance, false});
      endPiece();
      return;
    }
    if (piece_.empty() && in_gap_ && !line_.gaps.back().outside) line_.gaps.back().to = distance;
    in_gap_ = false;
    piece_.push_back({distance, height, at});
  }

  void leave(double from, double to) {
    addGap({from, to, true});
    endPiece();
  }

  /// Or makes the last one longer.
  void addGap(const GroundGap& gap) {
    if (in_gap_ && line_.gaps.back().outside == gap.outside) {
      line_.gaps.back().to = gap.to;
    } else {
      line_.gaps.push_back(gap);
    }
    in_gap_ = true;
  }

  void endPiece() {
    if (!piece_.empty()) line_.pieces.push_back(std::exchange(piece_, {}));
  }

  const Ground& ground_;
  GroundLine line_;
  std::vector<GroundSample> piece_;
  bool in_gap_ = false;  ///< since the last sample that has a height
};

}  // namespace

size_t GroundLine::samples() const {
  size_t count = 0;
  for (const std::vector<GroundSample>& piece : pieces) count += piece.size();
  return count;
}

Result<GroundLine> groundUnder(const GroundPath& path, Decoder& decoder) {
  const tks_info& info = decoder.info();
  const std::vector<Leg> legs = legsOf(path, info);
  double samples = 0;
  for (const Leg& leg : legs)
    if (leg.meetsGround()) samples += leg.samples() * (leg.exits - leg.enters) + 2;
  if (samples == 0) return Status(TKS_USAGE, "the line meets no ground");
  if (samples > kMostLineSamples)
    return Status(TKS_LIMIT, "the line has more than 4194304 samples: draw it shorter");
  const tks_window window = windowAround(legs, info);
  const Result<HeightFile> heights =
      decodeHeights(decoder, window, static_cast<uint64_t>(samples) * kBytesOfLineSample);
  if (!heights.ok()) return heights.status();
  const Ground ground(*heights, window);
  GroundLine line = LineSampler(ground).walk(legs);
  line.metres = path.metres;
  if (line.pieces.empty()) return Status(TKS_USAGE, "the line meets no ground but voids");
  return line;
}

}  // namespace tetrakis::tools
