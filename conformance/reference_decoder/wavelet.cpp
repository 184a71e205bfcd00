// SPDX-License-Identifier: Apache-2.0
// Reference decoder: the inverse wavelet of a plane, with voids and held samples or
// without (docs/FORMAT.md,
// section 7).
#include "conformance/reference_decoder/wavelet.hpp"

#include <algorithm>
#include <optional>

namespace tetrakis::reference {
namespace {

/// FORMAT 7, "Held samples": s[0], s[1], …
using States = std::vector<int32_t>;

/// One signal, which of its samples are valid, and the states of those that are held.
struct Line {
  std::vector<int32_t> values;
  std::vector<bool> valid;
  std::vector<States> held;  ///< empty: the sample is not held
  bool ring = false;
};

/// What a step reads; nothing: a void.
using Read = std::optional<int32_t>;

States statesOf(const Filter& filter, bool exact, int32_t value) {
  States states = {value, value};
  for (size_t i = 0; i < filter.steps.size(); ++i) {
    int64_t sum = int64_t{1} << (filter.shift - 1);
    for (const int weight : filter.steps[i]) sum += 2 * int64_t{weight} * states[i + 1];
    if (!exact) sum = wrap(sum);
    states.push_back(wrap(states[i] + (sum >> filter.shift)));
  }
  return states;
}

/// "Mirrored about the first and the last sample (period 2n - 2)".
size_t mirrored(int64_t t, size_t size) {
  const auto n = static_cast<int64_t>(size), period = 2 * n - 2;
  t = (t % period + period) % period;
  return static_cast<size_t>(t < n ? t : period - t);
}

Read readAt(const Line& line, size_t place) {
  return line.valid[place] ? Read(line.values[place]) : std::nullopt;
}

/// FORMAT 7, "Rings": of any place.
Read readRing(const Line& line, int64_t place) {
  const auto n = static_cast<int64_t>(line.values.size()), places = n + n % 2;
  place = (place % places + places) % places;
  if (place < n) return readAt(line, static_cast<size_t>(place));
  const Read before = readAt(line, static_cast<size_t>(n - 2)), after = readAt(line, 1);
  if (!before || !after) return std::nullopt;
  return static_cast<int32_t>((int64_t{*before} + *after) >> 1);
}

Read readBeside(const Line& line, int64_t place) {
  return line.ring ? readRing(line, place) : readAt(line, mirrored(place, line.values.size()));
}

/// The sum of a pair; a void counts as the other one. Nothing: both are void.
std::optional<int64_t> pairSum(const Line& line, size_t t, int64_t distance) {
  Read before = readBeside(line, static_cast<int64_t>(t) - distance);
  Read after = readBeside(line, static_cast<int64_t>(t) + distance);
  if (!before && !after) return std::nullopt;
  if (!before) before = after;
  if (!after) after = before;
  return int64_t{*before} + *after;
}

/// The sums of all pairs of a step; pairs of two voids have that of another. Empty: all are.
std::vector<int64_t> pairSums(const Line& line, size_t t, size_t pairs) {
  std::vector<std::optional<int64_t>> sums;
  for (size_t k = 0; k < pairs; ++k)
    sums.push_back(pairSum(line, t, static_cast<int64_t>(2 * k + 1)));
  const auto nearest = std::find_if(sums.begin(), sums.end(), [](const auto& s) { return !!s; });
  if (nearest == sums.end()) return {};
  std::vector<int64_t> filled;
  int64_t last = **nearest;
  for (const std::optional<int64_t>& sum : sums) {
    last = sum.value_or(last);
    filled.push_back(last);
  }
  return filled;
}

/// FORMAT 7, "Inverse of one signal".
void synthesiseLine(const Filter& filter, bool exact, Line& line) {
  for (size_t t = 0; t < line.values.size(); ++t) {
    if (!line.held[t].empty()) line.values[t] = line.held[t][filter.steps.size() + 1 - t % 2];
  }
  for (size_t s = filter.steps.size(); s-- > 0;) {
    const std::vector<int>& weights = filter.steps[s];
    for (size_t t = s % 2 == 0 ? 1 : 0; t < line.values.size(); t += 2) {
      if (!line.held[t].empty()) line.values[t] = line.held[t][s];
      if (!line.valid[t] || !line.held[t].empty()) continue;
      const std::vector<int64_t> sums = pairSums(line, t, weights.size());
      if (sums.empty()) continue;
      int64_t sum = int64_t{1} << (filter.shift - 1);
      for (size_t k = 0; k < weights.size(); ++k) sum += weights[k] * sums[k];
      if (!exact) sum = wrap(sum);
      line.values[t] = wrap(line.values[t] - (sum >> filter.shift));
    }
  }
}

/// The samples of one signal, in a row or in a column.
struct Places {
  int x, y, stepX, stepY, count;

  bool row() const { return stepX > 0; }
};

bool isExact(const WaveletHeader& header, int level, const Plane& plane) {
  return !plane.valid.empty() || level > 3 || header.sampleBits > filterOf(header, level).widest;
}

void synthesisePlaces(const WaveletHeader& header, int level, const Places& places,
                      const std::vector<int32_t>& held, Plane& plane) {
  const Filter& filter = filterOf(header, level);
  const bool exact = isExact(header, level, plane);
  Line line;
  line.ring = header.domain.ring() && places.row();
  for (int i = 0; i < places.count; ++i) {
    const int x = places.x + i * places.stepX, y = places.y + i * places.stepY;
    line.values.push_back(plane.at(x, y));
    line.valid.push_back(plane.isValid(x, y));
    const uint32_t area = plane.areaOf(x, y);
    line.held.push_back(area > 0 ? statesOf(filter, exact, held[area - 1]) : States{});
  }
  synthesiseLine(filter, exact, line);
  for (int i = 0; i < places.count; ++i)
    plane.at(places.x + i * places.stepX, places.y + i * places.stepY) = line.values[size_t(i)];
}

/// Multiples of a step below a size.
int multiples(int size, int step) {
  return (size - 1) / step + 1;
}

/// FORMAT 7, "Held samples": the values of areas before the analysis of a level, and what its rows
/// make of them.
struct HeldValues {
  std::vector<int32_t> before, low, high;
};

HeldValues heldValues(const WaveletHeader& header, const std::vector<Subband>& subbands, int level,
                      const Plane& plane) {
  HeldValues held;
  for (int32_t value : plane.flat.heights) {
    int32_t high = 0;
    for (int l = 1; l <= level; ++l) {
      const auto hh = std::find_if(subbands.begin(), subbands.end(), [l](const Subband& subband) {
        return subband.orientation == kHH && subband.level == l;
      });
      const Filter& filter = filterOf(header, l);
      const bool exact = isExact(header, l, plane);
      if (l == level) held.before.push_back(value);
      if (hh->splitsX == l) {
        const States states = statesOf(filter, exact, value);
        value = states.back();
        high = states[states.size() - 2];
      }
      if (l == level) {
        held.low.push_back(value);
        held.high.push_back(high);
      }
      if (hh->splitsY == l) value = statesOf(filter, exact, value).back();
      if (doublesLow(header, l)) value = wrap(2 * int64_t{value});
    }
  }
  return held;
}

/// FORMAT 7, "Inverse transform", one level. hh: the subband that is high in both directions.
void synthesiseLevel(const WaveletHeader& header, const Subband& hh, const HeldValues& held,
                     Plane& plane) {
  const int lowX = 1 << hh.splitsX, lowY = 1 << hh.splitsY;
  // A side that was split at this level was split at every finer one.
  const bool splitX = hh.splitsX == hh.level, splitY = hh.splitsY == hh.level;
  const int stepX = splitX ? lowX / 2 : lowX, stepY = splitY ? lowY / 2 : lowY;
  if (splitX && splitY && liftsJointly(header, hh.level, plane))
    return synthesiseJointly(header, {hh.level, stepX, stepY}, plane);
  if (doublesLow(header, hh.level)) {
    for (int y = 0; y < plane.height; y += lowY) {
      for (int x = 0; x < plane.width; x += lowX)
        plane.at(x, y) = wrap(int64_t{plane.at(x, y)} + 1) >> 1;
    }
  }
  for (int x = 0; x < plane.width && splitY; x += stepX) {
    const bool high = splitX && x / stepX % 2 == 1;
    synthesisePlaces(header, hh.level, {x, 0, 0, stepY, multiples(plane.height, stepY)},
                     high ? held.high : held.low, plane);
  }
  for (int y = 0; y < plane.height && splitX; y += stepY) {
    synthesisePlaces(header, hh.level, {0, y, stepX, 0, multiples(plane.width, stepX)}, held.before,
                     plane);
  }
}

size_t filterNumber(const WaveletHeader& header, int level) {
  return header.filters.at(static_cast<size_t>(std::min(level, 3) - 1));
}

}  // namespace

const Filter& filterOf(const WaveletHeader& header, int level) {
  static const Filter kFilters[] = {
      {8, 20, {{-128}, {64}}},
      {8, 20, {{-147, 28, -9}, {78, -20, 6}}},
      {13, 15, {{0}, {1435, -176}, {-3653, 706, -186}, {2218, -254, 116}}},
      {8, 20, {{-157, 41, -17, 8, -3}, {77, -24, 12, -6, 2}}},
      {8, 20, {{-150, 25, -3}, {75, -13, 2}}},
      {12, 15, {{-7895, 81}, {-258, 64}, {4447, 105}, {2189, -297}}},
  };
  return kFilters[filterNumber(header, level)];
}

bool doublesLow(const WaveletHeader& header, int level) {
  const int first = header.firstDoubled;
  return header.fractionBits == 0 && first > 0 && (level >= first && level <= first + 2);
}

int fractionOf(const WaveletHeader& header, int planes, uint64_t bytes, int level) {
  if (header.fractionBits > 0) return header.fractionBits;
  if (level == 0 && bytes >= header.roundedBytes) return 0;
  return std::clamp(19 - planes, 0, 4);
}

void synthesise(const WaveletHeader& header, int target, Plane& plane) {
  const Forest& forest = header.domain.forest;
  const std::vector<Subband> subbands = subbandsOf(plane.width, plane.height / forest.patches());
  for (const Subband& subband : subbands) {
    const int level = subband.level;
    if (subband.orientation != kHH || level <= target) continue;
    const int step = 1 << (level - 1);
    if (forest.isGrid()) {
      synthesiseLevel(header, subband, heldValues(header, subbands, level, plane), plane);
    } else {
      synthesiseJointly(header, {level, step, step}, plane);
    }
  }
  forest.share(plane.values);
}

Plane levelOf(const WaveletHeader& header, int level, const Plane& plane) {
  const Forest& forest = header.domain.forest;
  const std::vector<Subband> subbands = subbandsOf(plane.width, plane.height / forest.patches());
  int64_t weight = int64_t{1} << 30;
  for (int l = 1; l <= level; ++l) {
    const auto hh = std::find_if(subbands.begin(), subbands.end(), [l](const Subband& subband) {
      return subband.orientation == kHH && subband.level == l;
    });
    const int splits = (hh->splitsX == l) + (hh->splitsY == l);
    const size_t filter = filterNumber(header, l);
    if (filter != 2 && filter != 5) continue;
    const int64_t factor = filter == 2 ? 821297201 : 847671299;
    for (int i = 0; i < splits; ++i) weight = (weight * factor + (1 << 29)) >> 30;
  }
  int d = 0;
  for (int l = 1; l <= level; ++l) d += doublesLow(header, l);
  Plane image{multiples(plane.width, 1 << level), 0, {}};
  for (int y = 0; y < plane.height; ++y) {
    image.height += forest.shows(level, 0, y);
    for (int x = 0; x < plane.width; ++x) {
      if (!forest.shows(level, x, y)) continue;
      const int64_t v = plane.values.at(plane.index(x, y));
      image.values.push_back(wrap((v * weight + (int64_t{1} << (29 + d))) >> (30 + d)));
      if (!plane.valid.empty()) image.valid.push_back(plane.isValid(x, y));
    }
  }
  return image;
}

}  // namespace tetrakis::reference
