// SPDX-License-Identifier: Apache-2.0
// Reference decoder: corrections from facets (docs/FORMAT.md, section 8.1.12).
#include <algorithm>
#include <array>
#include <bit>
#include <cstdlib>

#include "conformance/reference_decoder/error_forecast.hpp"
#include "conformance/reference_decoder/mixed.hpp"
#include "conformance/reference_decoder/numbers.hpp"
#include "conformance/reference_decoder/range_decoder.hpp"
#include "conformance/reference_decoder/sample_corrections.hpp"
#include "conformance/reference_decoder/samples.hpp"
#include "conformance/reference_decoder/units.hpp"

namespace tetrakis::reference {

namespace {

constexpr int kWays = 13;

struct Nearest {
  uint32_t order = 0;
  int g = 0, d = 1;
};

/// Floats as multiples of a unit.
class Units {
 public:
  explicit Units(int u) : u_(u) {}

  int64_t of(uint32_t bits) const {
    const int field = static_cast<int>(bits >> 23 & 255), e = std::max(field, 1);
    const int64_t digits = (bits & 0x7FFFFF) + (field > 0 ? 0x800000 : 0);
    const int64_t size = e >= u_ ? digits << std::min(e - u_, 36) : digits >> std::min(u_ - e, 24);
    return bits >> 31 ? -size : size;
  }
  int64_t half(uint32_t bits) const {
    const int e = std::max(static_cast<int>(bits >> 23 & 255), 1);
    return e > u_ ? int64_t{1} << std::min(e - u_ - 1, 36) : 0;
  }
  Nearest nearest(int64_t p) const {
    Nearest found;
    if (p == 0) return found;
    const int64_t size = std::abs(p);
    const int k =
        std::max(static_cast<int>(std::bit_width(static_cast<uint64_t>(size))) - 24, 1 - u_);
    int64_t m = 0, t = 0;
    if (k > 0) {
      m = (size + (int64_t{1} << (k - 1))) >> k;
      t = size - (m << k);
      found.g = static_cast<int>(std::min<int64_t>(std::abs(t) * 16 >> k, 7));
    } else {
      m = size << -k;
    }
    const int64_t bits = std::min<int64_t>((int64_t{u_ + k - 1} << 23) + m, 0x7F7FFFFF);
    found.order = static_cast<uint32_t>(bits);
    if (p < 0) found.order = ~found.order;
    found.d = (t < 0) == (p < 0) ? 1 : -1;
    return found;
  }

 private:
  int u_;
};

bool agrees(int64_t a, int64_t b) {
  return std::abs(b - a) <= (std::abs(a) >> 22) + 1;
}

using Ways = std::array<int64_t, kWays>;

/// What is known of the samples before one.
class KnownFacets {
 public:
  explicit KnownFacets(const Plane& plane)
      : plane_(plane), z_(plane.values.size()), right_(plane.values.size()) {}

  void put(int x, int y, int64_t z, const Ways& ways) {
    z_[index(x, y)] = z;
    for (int i = 0; i < kWays; ++i) right_[index(x, y)][i] = agrees(z, ways[i]);
  }
  Ways waysTo(int x, int y, int64_t decoded) const {
    const auto at = [&](int i, int j, int64_t otherwise) {
      return has(x + i, y + j) ? z_[index(x + i, y + j)] : otherwise;
    };
    const int64_t w = at(-1, 0, at(0, -1, decoded)), n = at(0, -1, w);
    const int64_t nw = at(-1, -1, n), ne = at(1, -1, n), ww = at(-2, 0, w), nn = at(0, -2, n);
    const int64_t nww = at(-2, -1, nw), nee = at(2, -1, ne);
    const int64_t nnw = at(-1, -2, nw), nne = at(1, -2, ne);
    const int64_t nnww = at(-2, -2, nnw), nnee = at(2, -2, nne);
    const int64_t a = at(-4, -2, nnww), b = at(4, -2, nnee);
    return {w + n - nw,     2 * w - ww,   2 * n - nn,    n + ne - nne,  w + ne - n,
            w + nw - nww,   n + nw - nnw, 2 * nw - nnww, 2 * ne - nnee, w + nee - ne,
            n + nww - nnww, 2 * nww - a,  2 * nee - b};
  }
  int before(int way, int x, int y) const {
    constexpr int kPlaces[6][2] = {{-1, 0}, {0, -1}, {-1, -1}, {1, -1}, {-2, 0}, {0, -2}};
    int bits = 0;
    for (int k = 0; k < 6; ++k) {
      const int i = x + kPlaces[k][0], j = y + kPlaces[k][1];
      bits |= (has(i, j) && right_[index(i, j)][way]) << k;
    }
    return bits;
  }

 private:
  bool has(int x, int y) const {
    return x >= 0 && x < plane_.width && y >= 0 && plane_.isValid(x, y);
  }
  size_t index(int x, int y) const { return static_cast<size_t>(y) * plane_.width + x; }

  const Plane& plane_;
  std::vector<int64_t> z_;
  std::vector<std::array<bool, kWays>> right_;
};

struct Sample {
  uint32_t bits = 0;
  int64_t z = 0;
};

/// What decoded heights say of a sample.
struct About {
  int32_t u = 0;
  int64_t level = 0;
  uint32_t bits = 0;
};

class FacetDecoder {
 public:
  FacetDecoder(const GeometryHeader& header, const Units& units, RangeDecoder& decoder)
      : header_(header), units_(units), decoder_(decoder), beyond_(decoder) {
    for (auto& weights : right_) weights.fill(kFirstWeight);
    for (auto& weights : rest_) weights.fill(kFirstWeight);
  }

  Sample next(const Ways& ways, const std::array<int, kWays>& before, const About& about) {
    std::array<bool, kWays> left;
    left.fill(true);
    for (int j = 0; std::count(left.begin(), left.end(), true) > 0; ++j) {
      int first = -1;
      for (int i = 0; i < kWays; ++i) {
        const auto ones = [&](int way) {
          return std::popcount(static_cast<unsigned>(before[way]));
        };
        if (left[i] && (first < 0 || ones(i) > ones(first))) first = i;
      }
      int64_t sum = 0;
      int count = 0;
      for (int k = 0; k < kWays; ++k) {
        if (!left[k] || !agrees(ways[first], ways[k])) continue;
        left[k] = false;
        sum += ways[k] - ways[first];
        ++count;
      }
      const int64_t p = ways[first] + sum / count;
      const bool last = std::count(left.begin(), left.end(), true) == 0;
      const Nearest nearest = units_.nearest(p);
      const int64_t s = stepsOf(header_, orderOf(header_, nearest.order));
      const int a = std::min(j, 5), b = std::min(count, 8) - 1;
      const int64_t distance =
          std::clamp<int64_t>(levelOf(std::abs(s - about.u)) - about.level + 9, 0, 15);
      Model* const models[2] = {
          &right_way_[(a * 64 + before[first]) * kWays + first],
          &right_far_[((a * 8 + b) * 16 + static_cast<int>(distance)) * 2 + last]};
      if (decodeMixed(decoder_, models, right_[a]) == 0) continue;
      const int rest = restOf(b, nearest.g, first, before[first]);
      const uint32_t order = nearest.order + static_cast<uint32_t>(nearest.d * rest);
      const uint32_t bits = orderOf(header_, order);
      const int64_t there = units_.of(bits), half = units_.half(bits);
      return {bits, std::clamp(p + (there - p) / 4, there - half, there + half)};
    }
    return beyond(about);
  }

 private:
  int restOf(int b, int g, int way, int before) {
    const auto ask = [&](int t) {
      Model* const models[2] = {&rest_place_[(b * 8 + g) * 4 + t],
                                &rest_way_[(way * 64 + before) * 4 + t]};
      return decodeMixed(decoder_, models, rest_[t]);
    };
    if (ask(0) == 0) return 0;
    const int negative = ask(1), size = 1 + ask(2 + negative);
    return negative ? -size : size;
  }

  Sample beyond(const About& about) {
    const int64_t open =
        about.level + 2 * (Digits(header_.step).log2() - spacingOf(header_, about.bits));
    const int o = static_cast<int>(std::clamp<int64_t>(open, 0, 63));
    const uint32_t c = beyond_.next(Nearby(), o, 0);
    const uint32_t bits = orderOf(header_, orderOf(header_, about.bits) + c);
    return {bits, units_.of(bits)};
  }

  const GeometryHeader& header_;
  const Units& units_;
  RangeDecoder& decoder_;
  ModelTable right_way_ = ModelTable(6 * 64 * kWays), right_far_ = ModelTable(6 * 8 * 16 * 2);
  ModelTable rest_place_ = ModelTable(8 * 8 * 4), rest_way_ = ModelTable(kWays * 64 * 4);
  NumberDecoder beyond_;
  std::array<std::array<int64_t, 2>, 6> right_;
  std::array<std::array<int64_t, 2>, 4> rest_;
};

}  // namespace

void correctFromFacets(const GeometryHeader& header, const Layers& layers,
                       std::span<const uint8_t> codeword, const Plane& plane,
                       std::vector<uint32_t>& samples) try {
  const Units units(layers.facetUnit);
  RangeDecoder decoder(codeword);
  FacetDecoder facets(header, units, decoder);
  KnownFacets known(plane);
  ErrorForecast forecast(plane);
  for (int y = 0; y < plane.height; ++y) {
    for (int x = 0; x < plane.width; ++x) {
      if (!plane.isValid(x, y)) continue;
      const size_t i = static_cast<size_t>(y) * plane.width + x;
      const int32_t q = plane.values[i];
      const int64_t p = forecast.look(x, y);
      About about;
      about.u = static_cast<int32_t>(q + p);
      about.level = levelOf(forecast.missedNearby(x, y));
      about.bits = sampleNear(header, about.u);
      const Ways ways = known.waysTo(x, y, units.of(about.bits));
      std::array<int, kWays> before;
      for (int way = 0; way < kWays; ++way) before[way] = known.before(way, x, y);
      const Sample sample = facets.next(ways, before, about);
      samples[i] = sample.bits;
      known.put(x, y, sample.z, ways);
      forecast.learn(x, y, stepsOf(header, sample.bits) - q);
    }
  }
} catch (Undecided) {
}

}  // namespace tetrakis::reference
