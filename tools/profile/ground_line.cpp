// SPDX-License-Identifier: Apache-2.0
#include "tools/profile/ground_line.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

#include "tools/files/place/ground_spacing.hpp"
#include "tools/files/sample_types.hpp"

namespace tetrakis::tools {
namespace {

/// A line has no more samples than this: what is made of them fits in half a gigabyte.
constexpr double kMostLineSamples = 1 << 22;
constexpr uint64_t kBytesOfLineSample = 128;

/// Points that leave the ground by no more are on its border: coordinates that are typed, or come
/// through a geotransform, are off by their rounding.
constexpr double kOnBorder = 1e-6;

/// A place in columns and rows.
struct GridPoint {
  double column = 0, row = 0;
};

/// Between two points that differ, and the part of it that lies over the ground.
struct Leg {
  GridPoint from, to;
  LinePoint at_from, at_to;      ///< the same as they were given
  double start = 0, end = 0;     ///< distances
  double enters = 0, exits = 0;  ///< parts of the leg; exits < enters: it meets no ground
  bool meetsGround() const { return enters <= exits; }
  double samples() const { return std::hypot(to.column - from.column, to.row - from.row); }
  double distance(double part) const { return start + part * (end - start); }
};

std::optional<LinePoint> parsePoint(const std::string& word) {
  LinePoint point;
  const char *at = word.data(), *const end = at + word.size();
  const auto x = std::from_chars(at, end, point.x);
  if (x.ec != std::errc() || x.ptr == end || *x.ptr != ',') return std::nullopt;
  const auto y = std::from_chars(x.ptr + 1, end, point.y);
  if (y.ec != std::errc() || y.ptr != end) return std::nullopt;
  constexpr double kFarthest = 1e15;  // beyond, columns have no fractions
  if (!(std::abs(point.x) <= kFarthest && std::abs(point.y) <= kFarthest)) return std::nullopt;
  return point;
}

double onBorder(double value, double last) {
  if (value < 0 && value >= -kOnBorder) return 0;
  return value > last && value <= last + kOnBorder ? last : value;
}

/// Narrows the part of a leg to that between 0 and last (Liang and Barsky).
void clip(Leg& leg, double from, double to, double last) {
  const double step = to - from;
  if (step == 0) {
    if (from < 0 || from > last) leg.exits = -1;
    return;
  }
  const double at_first = -from / step, at_last = (last - from) / step;
  leg.enters = std::max(leg.enters, std::min(at_first, at_last));
  leg.exits = std::min(leg.exits, std::max(at_first, at_last));
}

GridPoint gridPoint(const GroundPath& path, const LinePoint& at, const tks_info& info) {
  const GeoTransform& t = path.place;
  const double x = at.x - t[0], y = at.y - t[3], area = t[1] * t[5] - t[2] * t[4];
  return {onBorder((x * t[5] - y * t[2]) / area, info.width - 1.0),
          onBorder((y * t[1] - x * t[4]) / area, info.height - 1.0)};
}

std::vector<Leg> legsOf(const GroundPath& path, const tks_info& info) {
  std::vector<Leg> legs;
  double distance = 0;
  for (size_t i = 1; i < path.points.size(); ++i) {
    Leg leg;
    leg.at_from = path.points[i - 1];
    leg.at_to = path.points[i];
    leg.from = gridPoint(path, leg.at_from, info);
    leg.to = gridPoint(path, leg.at_to, info);
    if (leg.samples() == 0) continue;
    leg.start = distance;
    distance += std::hypot((leg.to.column - leg.from.column) * path.spacing[0],
                           (leg.to.row - leg.from.row) * path.spacing[1]);
    leg.end = distance;
    leg.exits = 1;
    clip(leg, leg.from.column, leg.to.column, info.width - 1.0);
    clip(leg, leg.from.row, leg.to.row, info.height - 1.0);
    legs.push_back(leg);
  }
  return legs;
}

GridPoint pointOn(const Leg& leg, double part) {
  return {leg.from.column + part * (leg.to.column - leg.from.column),
          leg.from.row + part * (leg.to.row - leg.from.row)};
}

/// The samples that the legs need. Some leg meets the ground.
tks_window windowAround(const std::vector<Leg>& legs, const tks_info& info) {
  const double last_column = info.width - 1.0, last_row = info.height - 1.0;
  double left = last_column, top = last_row, right = 0, bottom = 0;
  for (const Leg& leg : legs) {
    if (!leg.meetsGround()) continue;
    for (const double part : {leg.enters, leg.exits}) {
      const GridPoint at = pointOn(leg, part);  // on the ground, but for the rounding of far points
      const double column = std::clamp(at.column, 0.0, last_column),
                   row = std::clamp(at.row, 0.0, last_row);
      left = std::min(left, std::floor(column));
      top = std::min(top, std::floor(row));
      right = std::max(right, std::ceil(column));
      bottom = std::max(bottom, std::ceil(row));
    }
  }
  const auto x = static_cast<uint32_t>(left), y = static_cast<uint32_t>(top);
  return {x, y, static_cast<uint32_t>(right) - x + 1, static_cast<uint32_t>(bottom) - y + 1};
}

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
      take(leg.distance(at), ground_.at(pointOn(leg, at)),
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

Result<std::vector<LinePoint>> parseLine(const std::string& text) {
  std::vector<LinePoint> points;
  std::istringstream words(text);
  bool differ = false;
  for (std::string word; words >> word;) {
    const std::optional<LinePoint> point = parsePoint(word);
    if (!point)
      return Status(TKS_USAGE, "--line takes points \"X,Y X,Y …\", and '" + word + "' is none");
    differ = differ ||
             (!points.empty() && (point->x != points.front().x || point->y != points.front().y));
    points.push_back(*point);
  }
  if (!differ) return Status(TKS_USAGE, "--line must have at least two points that differ");
  return points;
}

Result<GroundPath> pathOver(const tks_info& info, std::vector<LinePoint> points, bool geographic) {
  if (!info.has_heights)
    return Status(TKS_USAGE, "the stream has no heights, so there is no profile");
  GroundPath path;
  path.points = std::move(points);
  const std::array<double, 2> spacing = spacingOf(info);
  path.metres = spacing[0] > 0 && spacing[1] > 0;
  if (path.metres) path.spacing = spacing;
  if (!geographic) return path;
  if (!info.has_geotransform)
    return Status(TKS_USAGE, "the stream does not say where it lies, as --geo needs");
  std::copy_n(info.geotransform, path.place.size(), path.place.begin());
  GeoTransform& t = path.place;
  t[0] += (t[1] + t[2]) / 2;  // from the corner of the first sample to its middle
  t[3] += (t[4] + t[5]) / 2;
  if (!std::isnormal(t[1] * t[5] - t[2] * t[4]))
    return Status(TKS_USAGE, "the stream's geotransform cannot be inverted, as --geo needs");
  return path;
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
