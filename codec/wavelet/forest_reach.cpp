// SPDX-License-Identifier: Apache-2.0
#include "codec/wavelet/forest_reach.hpp"

#include <algorithm>
#include <array>

#include "codec/wavelet/lifting/lifting.hpp"

namespace tetrakis::inline wavelet {

namespace {

/// A range of columns or of rows, both ends included.
struct Span {
  int64_t first, last;
  bool none() const { return first > last; }
};

/// The rectangles of all patches, which grow around the places that are added.
class Bounds {
 public:
  struct Bound {
    Span x = {INT64_MAX, INT64_MIN}, y = {INT64_MAX, INT64_MIN};
    bool none() const { return x.none(); }
  };

  explicit Bounds(const PatchWindows& windows) : bounds_(windows.size()) {
    for (size_t i = 0; i < windows.size(); ++i) {
      const Window& w = windows[i];
      if (w.width > 0)
        bounds_[i] = {{w.x, int64_t{w.x} + w.width - 1}, {w.y, int64_t{w.y} + w.height - 1}};
    }
  }

  size_t size() const { return bounds_.size(); }
  const Bound& operator[](size_t patch) const { return bounds_[patch]; }
  void add(const Forest::Place& place) {
    Bound& bound = bounds_[place.patch];
    bound.x = {std::min(bound.x.first, place.x), std::max(bound.x.last, place.x)};
    bound.y = {std::min(bound.y.first, place.y), std::max(bound.y.last, place.y)};
  }
  PatchWindows windows() const {
    PatchWindows windows(bounds_.size());
    for (size_t i = 0; i < windows.size(); ++i) {
      if (bounds_[i].none()) continue;
      const auto [x, y] = bounds_[i];
      const int64_t left = x.first & ~int64_t{1}, top = y.first & ~int64_t{1};
      windows[i] = {static_cast<uint32_t>(left), static_cast<uint32_t>(top),
                    static_cast<uint32_t>(x.last + 1 - left),
                    static_cast<uint32_t>(y.last + 1 - top)};
    }
    return windows;
  }

 private:
  std::vector<Bound> bounds_;
};

/// Adds what the samples at the sides of the rectangles get their values from.
void addOwners(const Forest& forest, int64_t n, Bounds& bounds) {
  const auto add = [&](uint32_t patch, int64_t x, int64_t y) {
    bounds.add(forest.owner(n, {patch, x, y}));
  };
  for (uint32_t patch = 0; patch < bounds.size(); ++patch) {
    const auto [x, y] = bounds[patch];
    if (x.none()) continue;
    const Span inner_x{std::max<int64_t>(x.first, 1), std::min(x.last, n - 1)};
    const Span inner_y{std::max<int64_t>(y.first, 1), std::min(y.last, n - 1)};
    for (const int64_t side : {int64_t{0}, n}) {
      const bool at_x = x.first <= side && side <= x.last, at_y = y.first <= side && side <= y.last;
      if (at_x && !inner_y.none())
        for (const int64_t end : {inner_y.first, inner_y.last}) add(patch, side, end);
      if (at_y && !inner_x.none())
        for (const int64_t end : {inner_x.first, inner_x.last}) add(patch, end, side);
      for (const int64_t other : {int64_t{0}, n})
        if (at_x && y.first <= other && other <= y.last) add(patch, side, other);
    }
  }
}

/// Where a line lies that leaves a patch at both ends.
enum class LinePart { kBefore, kInside, kBehind };
constexpr std::array<LinePart, 3> kLineParts = {LinePart::kBefore, LinePart::kInside,
                                                LinePart::kBehind};

/// The places in a part of a line that stand for all of it: those inside of a patch are seen beside
/// it in their order, but a line that crosses a small patch may turn back there.
std::vector<int64_t> placesOf(const Span& line, int64_t n, LinePart part) {
  if (part == LinePart::kInside) return {std::max<int64_t>(line.first, 0), std::min(line.last, n)};
  const Span range = part == LinePart::kBefore ? Span{line.first, std::min<int64_t>(line.last, -1)}
                                               : Span{std::max(line.first, n + 1), line.last};
  std::vector<int64_t> places;
  for (int64_t place = range.first; place <= range.last; ++place) places.push_back(place);
  return places;
}

/// Adds all that lies up to `reach` samples beside the rectangles.
void grow(const Forest& forest, int64_t n, int64_t reach, Bounds& bounds) {
  const Bounds before = bounds;
  for (uint32_t patch = 0; patch < before.size(); ++patch) {
    if (before[patch].none()) continue;
    const Span x{before[patch].x.first - reach, before[patch].x.last + reach};
    const Span y{before[patch].y.first - reach, before[patch].y.last + reach};
    for (const LinePart beside : kLineParts) {
      for (const LinePart above : kLineParts) {
        for (const int64_t column : placesOf(x, n, beside))
          for (const int64_t row : placesOf(y, n, above))
            bounds.add(forest.locate(n, {patch, column, row}));
      }
    }
  }
}

}  // namespace

uint32_t stepReach(FilterId id) {
  size_t pairs = 1;
  for (const LiftingStep& step : liftingFilter(id).steps) pairs = std::max(pairs, step.pairs);
  return static_cast<uint32_t>(2 * pairs - 1);
}

PatchWindows reachOf(const Forest& forest, int64_t n, FilterId id, const PatchWindows& wanted) {
  constexpr size_t kSteps = 3;  // of JointStep, but for the one that only moves samples
  Bounds bounds(wanted);
  addOwners(forest, n, bounds);
  for (size_t step = 0; step < kSteps * jointRounds(id); ++step) {
    grow(forest, n, stepReach(id), bounds);
    addOwners(forest, n, bounds);
  }
  return bounds.windows();
}

}  // namespace tetrakis::inline wavelet
