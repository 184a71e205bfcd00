// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/relative/relative_encoder.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "base/portable_math.hpp"
#include "codec/geometry/steps/sample_order.hpp"

namespace tetrakis::inline relative {

namespace {

/// Runs of samples that are examined, and samples of each at most. More samples tell steps more
/// surely, and take time.
constexpr uint32_t kRuns = 128, kLongestRun = 512;
/// One jump in this number may have a larger rounding than counts as usual. A larger number makes
/// clusters wider, which hides fine steps.
constexpr size_t kLargeRoundingIn = 100;
/// Clusters that follow on one, whose distances to it count. More of them find steps of which few
/// neighbouring multiples occur, and take time.
constexpr size_t kNextClusters = 4;
/// The least distance of clusters, and how far a jump may lie off a multiple that the step is
/// fitted to, in roundings. A smaller distance takes noise for a step; jumps farther off spoil the
/// fit.
constexpr double kLeastRoundings = 4, kMostRoundings = 8;
/// Digits of decimal steps, and one jump in kMissIn that a shorter decimal may miss. More digits
/// and a smaller number find steps that are no decimals, or miss the step by a little.
constexpr int kDigits = 8;
constexpr size_t kMissIn = 1000;
/// A step explains jumps if one of kMeritPart is a multiple by merit, and if it misses one of
/// kMissedPart at most, and one for kSmoothPart samples on smooth ground. A larger first number and
/// smaller others accept more steps, whose corrections may take more bytes than steps of their own.
constexpr double kMeritPart = 3;
constexpr size_t kMissedPart = 10, kSmoothPart = 16;
/// The usual jump of smooth ground, in steps. With 8 or 1 the first 64 kB lose quality, and
/// triangulated terrain takes fewer bytes: 1.27 and 1.07 for 1.50 of the smallest GeoTIFF.
constexpr double kStepPart = 64;
/// Shares of the jumps whose clusters are examined, and parts of the most frequent distance's jumps
/// that a smaller distance needs. More trials find rarer steps, and take time.
constexpr std::array<double, 2> kClusterShares = {1. / 3, 2. / 3};
constexpr std::array<double, 2> kFrequentParts = {1. / 2, 1. / 16};
/// Samples and jumps below which no step is looked for. With fewer, chance makes steps.
constexpr size_t kFewest = 64;

/// By how much a sample misses what its neighbours predict, and what roundings of floats may leave.
struct Jump {
  double size, rounding;

  bool isMultipleOf(double step) const {
    return std::abs(size - std::round(size / step) * step) <= rounding;
  }
};

/// Those of the samples that were looked at.
struct Jumps {
  std::vector<Jump> beyond;  ///< the roundings; sorted by size
  size_t none = 0;           ///< samples that miss nothing

  size_t misses(double step) const {
    return static_cast<size_t>(std::count_if(
        beyond.begin(), beyond.end(), [&](const Jump& jump) { return !jump.isMultipleOf(step); }));
  }
};

/// Looks at runs of samples that are spread over the plane.
class JumpFinder {
 public:
  JumpFinder(const tks_heights& heights, Mask valid)
      : samples_(static_cast<const float*>(heights.data)),
        width_(heights.width),
        height_(heights.height),
        valid_(valid) {}

  Jumps find() {
    constexpr double kGolden = 0.6180339887498949;
    if (width_ < 2 || height_ < 2) return {};
    const uint32_t length = std::min(kLongestRun, width_ - 1);
    for (uint32_t run = 0; run < kRuns; ++run) {
      const double place = run * kGolden;
      const auto y = 1 + static_cast<uint32_t>((place - std::floor(place)) * (height_ - 1));
      const auto x = 1 + static_cast<uint32_t>(uint64_t{run} * (width_ - length) / kRuns);
      for (uint32_t i = 0; i < length; ++i) look(size_t{y} * width_ + x + i);
    }
    std::sort(jumps_.beyond.begin(), jumps_.beyond.end(),
              [](const Jump& a, const Jump& b) { return a.size < b.size; });
    return std::move(jumps_);
  }

 private:
  void look(size_t i) {
    double largest = 0;
    for (const size_t of : {i, i - 1, i - width_, i - width_ - 1}) {
      if (!valid_[of] || !std::isfinite(samples_[of])) return;
      largest = std::max(largest, std::abs(static_cast<double>(samples_[of])));
    }
    const auto at = [&](size_t of) { return static_cast<double>(samples_[of]); };
    const double size = std::abs(at(i) - (at(i - 1) + at(i - width_) - at(i - width_ - 1)));
    // Four samples, each half the distance to the next float off.
    const double rounding = std::ldexp(2.0, spacingExponent(static_cast<float>(largest)));
    if (size > rounding) {
      jumps_.beyond.push_back({size, rounding});
    } else {
      ++jumps_.none;
    }
  }

  const float* samples_;
  uint32_t width_, height_;
  Mask valid_;
  Jumps jumps_;
};

/// Jumps that differ by less than roundings.
struct Cluster {
  double sum = 0;
  size_t count = 0;

  double middle() const { return sum / static_cast<double>(std::max<size_t>(count, 1)); }
};

/// The clusters by rising sizes, the first of which misses nothing.
std::vector<Cluster> clustersOf(const Jumps& jumps, double rounding) {
  std::vector<Cluster> clusters = {{0, jumps.none}};
  double before = 0;
  for (const auto& [size, own] : jumps.beyond) {
    if (size - before > rounding) clusters.emplace_back();
    clusters.back().sum += size;
    ++clusters.back().count;
    before = size;
  }
  return clusters;
}

/// The first cluster and the largest others, which have such a share of the jumps: single jumps,
/// which lie anywhere, are not among them unless there are few others.
std::vector<Cluster> largest(std::vector<Cluster> clusters, double share) {
  std::vector<size_t> counts;
  size_t all = 0;
  for (const Cluster& cluster : clusters) counts.push_back(cluster.count);
  counts.front() = 0;
  for (const size_t count : counts) all += count;
  std::sort(counts.begin(), counts.end(), std::greater<>());
  const double enough = share * static_cast<double>(all);
  size_t held = 0, least = 0;
  for (size_t i = 0; static_cast<double>(held) < enough; ++i) held += least = counts[i];
  clusters.erase(std::remove_if(clusters.begin() + 1, clusters.end(),
                                [&](const Cluster& cluster) { return cluster.count < least; }),
                 clusters.end());
  return clusters;
}

/// Roundings of nearly all jumps.
double usualRounding(const Jumps& jumps) {
  std::vector<double> roundings;
  for (const Jump& jump : jumps.beyond) roundings.push_back(2 * jump.rounding);
  const auto most =
      roundings.begin() +
      static_cast<ptrdiff_t>(roundings.size() * (kLargeRoundingIn - 1) / kLargeRoundingIn);
  std::nth_element(roundings.begin(), most, roundings.end());
  return *most;
}

/// How far clusters lie apart, and how many jumps do.
struct Distance {
  double size;
  size_t count;
};

/// Distances of neighbouring clusters, by rising sizes.
std::vector<Distance> distancesOf(const std::vector<Cluster>& clusters, double least) {
  std::vector<Distance> distances;
  for (size_t i = 0; i < clusters.size(); ++i) {
    for (size_t next = i + 1; next < std::min(i + 1 + kNextClusters, clusters.size()); ++next) {
      const double size = clusters[next].middle() - clusters[i].middle();
      if (size >= least)
        distances.push_back({size, std::min(clusters[i].count, clusters[next].count)});
    }
  }
  std::sort(distances.begin(), distances.end(),
            [](const Distance& a, const Distance& b) { return a.size < b.size; });
  return distances;
}

/// Distances of clusters, each with how many jumps lie so far apart, up to roundings.
class FrequentDistances {
 public:
  /// share: of the jumps that are in clusters that are looked at.
  FrequentDistances(const Jumps& jumps, double share) : rounding_(usualRounding(jumps)) {
    distances_ =
        distancesOf(largest(clustersOf(jumps, rounding_), share), kLeastRoundings * rounding_);
    size_t count = 0, end = 0;
    for (const Distance& distance : distances_) {
      while (end < distances_.size() && distances_[end].size <= distance.size + rounding_)
        count += distances_[end++].count;
      counts_.push_back(count);
      ends_.push_back(end);
      count -= distance.count;
    }
  }

  /// The smallest one that many jumps lie apart: as many as most of them do, or this part of them.
  /// 0: there is none.
  double smallest(double part) const {
    if (counts_.empty()) return 0;
    const size_t most = *std::max_element(counts_.begin(), counts_.end());
    const auto many = std::find_if(counts_.begin(), counts_.end(), [&](size_t some) {
      return static_cast<double>(some) >= part * static_cast<double>(most);
    });
    const auto window = counts_.begin() +
                        static_cast<ptrdiff_t>(ends_[static_cast<size_t>(many - counts_.begin())]);
    const auto best = static_cast<size_t>(std::max_element(many, window) - counts_.begin());
    double sum = 0;
    for (size_t i = best; i < ends_[best]; ++i)
      sum += distances_[i].size * static_cast<double>(distances_[i].count);
    return sum / static_cast<double>(counts_[best]);
  }

 private:
  double rounding_;
  std::vector<Distance> distances_;
  std::vector<size_t> counts_, ends_;
};

/// The step whose multiples the jumps are, by least squares over ever larger ones: the smaller ones
/// tell which multiples these are.
double fitted(const Jumps& jumps, double step) {
  const double largest = jumps.beyond.back().size;
  for (double reach = 2 * step; reach < 2 * largest; reach *= 2) {
    double products = 0, squares = 0;
    for (const auto& [size, rounding] : jumps.beyond) {
      if (size > reach) break;
      const double multiple = std::round(size / step);
      if (std::abs(size - multiple * step) > kMostRoundings * rounding) continue;
      products += size * multiple;
      squares += multiple * multiple;
    }
    if (squares > 0) step = products / squares;
  }
  return step;
}

/// The decimal number of the fewest digits that explains nearly as many jumps: steps are 0.2 or
/// 0.3048.
double shortestDecimal(const Jumps& jumps, double step) {
  const size_t most = jumps.misses(step) + jumps.beyond.size() / kMissIn;
  for (int digits = 1; digits <= kDigits; ++digits) {
    const double unit = portable::pow(10, std::floor(portable::log10(step)) - digits + 1);
    const double count = std::round(step / unit);
    const double decimal = unit < 1 ? count / std::round(1 / unit) : count * unit;
    if (decimal > 0 && jumps.misses(decimal) <= most) return decimal;
  }
  return step;
}

/// A part of the jumps at least shall be multiples, beside those that are by chance, and nearly
/// all of those on rough ground: of the samples on smooth ground, which lie on multiples of any
/// step, some may be followed by a jump. On flat ground out of LERC most jumps lie between
/// squares.
bool explains(const Jumps& jumps, double step) {
  double chance = 0;
  for (const Jump& jump : jumps.beyond) chance += std::min(1.0, 2 * jump.rounding / step);
  const size_t missed = jumps.misses(step), all = jumps.beyond.size();
  const auto by_merit = static_cast<double>(all - missed) - chance;
  return kMeritPart * by_merit >= static_cast<double>(all) &&
         missed <= all / kMissedPart + jumps.none / kSmoothPart;
}

/// Any step does on ground that is smooth between its jumps, as triangles are. One much smaller
/// than these keeps the coefficients of some bits a sample, which is what prefixes show.
double stepOfSmoothGround(const Jumps& jumps) {
  const bool smooth = jumps.none > jumps.beyond.size();
  return smooth ? jumps.beyond[jumps.beyond.size() / 2].size / kStepPart : 0;
}

/// The step that explains the jumps; 0: there is none. Clusters that lie a step apart also lie two
/// or three steps from the next ones, so that half as many are mostly enough. But whole feet of
/// whole metres lie three and four steps apart, and seldom one.
double frequentStep(const Jumps& jumps) {
  for (const double share : kClusterShares) {
    const FrequentDistances distances(jumps, share);
    for (const double part : kFrequentParts) {
      const double distance = distances.smallest(part);
      if (distance <= 0) break;
      const double step = shortestDecimal(jumps, fitted(jumps, distance));
      if (explains(jumps, step)) return step;
    }
  }
  return 0;
}

}  // namespace

double findRelativeStep(const tks_heights& heights, Mask valid) {
  const uint64_t samples = uint64_t{heights.width} * heights.height;
  if (heights.sample != TKS_F32 || samples < kFewest) return 0;
  const Jumps jumps = JumpFinder(heights, valid).find();
  if (jumps.beyond.size() < kFewest) return 0;
  if (const double step = frequentStep(jumps); step > 0) return step;
  return stepOfSmoothGround(jumps);
}

}  // namespace tetrakis::inline relative
