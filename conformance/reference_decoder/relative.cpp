// SPDX-License-Identifier: Apache-2.0
#include "conformance/reference_decoder/relative.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "conformance/reference_decoder/corrections.hpp"
#include "conformance/reference_decoder/range_decoder.hpp"
#include "conformance/reference_decoder/samples.hpp"

namespace tetrakis::reference {

namespace {

/// FORMAT 8.1, "From relative steps": p of a sample, and which hint its rest has.
struct Prediction {
  double p = 0;
  bool planar = false, beside = false;  ///< from three samples or more; from one at least

  int restHint(double apart) const {
    if (planar) return static_cast<int>(std::min(std::abs(apart) * 16, 7.0));
    return beside ? 8 : 9;
  }
};

/// K: what is known of the samples before one.
class KnownSamples {
 public:
  KnownSamples(const Plane& plane, double g) : plane_(plane), g_(g), known_(plane.values.size()) {}

  /// d: the number that the decoded height is.
  Prediction predict(int x, int y, double d) const {
    const auto w = at(x - 1, y), n = at(x, y - 1), o = at(x - 1, y - 1);
    const Prediction one{w ? *w : n ? *n : d, false, w || n};
    if (!w || !n || !o) return one;
    const double h = (*w + *n) - *o, z = std::abs(h) * 0x1p-22;
    const auto e = at(x + 1, y - 1), a = at(x - 2, y), b = at(x, y - 2);
    double sum = 0;
    int count = 1;
    const auto add = [&](double other) {
      const double apart = other - h;
      const double off = apart - std::floor(apart / g_ + 0.5) * g_;
      if (!(std::abs(off) <= z)) return;
      sum += off;
      ++count;
    };
    if (a) add(2 * *w - *a);
    if (b) add(2 * *n - *b);
    if (e) add((*w + *e) - *n);
    const double mean = h + sum / count;
    return std::isfinite(mean) ? Prediction{mean, true, true} : one;
  }

  void put(int x, int y, double value) {
    if (std::isfinite(value)) known_[plane_.index(x, y)] = value;
  }

 private:
  std::optional<double> at(int x, int y) const {
    if (x < 0 || x >= plane_.width || y < 0) return std::nullopt;
    return known_[plane_.index(x, y)];
  }

  const Plane& plane_;
  double g_;
  std::vector<std::optional<double>> known_;
};

}  // namespace

void correctFromRelative(const GeometryHeader& header, const Layers& layers,
                         std::span<const uint8_t> codeword, const Plane& plane,
                         std::vector<uint32_t>& samples) {
  constexpr double kFarthest = 1 << 30;
  const double g = layers.relativeStep;
  RangeDecoder decoder(codeword);
  CorrectionDecoder multiples(decoder, plane), rests(decoder, plane);
  KnownSamples known(plane, g);
  for (int y = 0; y < plane.height; ++y) {
    for (int x = 0; x < plane.width; ++x) {
      if (!plane.isValid(x, y)) continue;
      uint32_t& sample = samples[plane.index(x, y)];
      const double d = numberOf(header, sample);
      const Prediction prediction = known.predict(x, y, d);
      const double p = prediction.p;
      const double t = std::clamp((d - p) / g, -kFarthest, kFarthest);
      const double k = std::floor(t + 0.5);
      const int hint = static_cast<int>(std::min(std::floor(std::abs(k - t) * 16), 7.0));
      const std::optional<uint32_t> m = multiples.next(hint, x, y);
      if (!m) return;
      const auto nearest = static_cast<uint32_t>(static_cast<int32_t>(k));
      const auto number = static_cast<int32_t>(k > t ? nearest - *m : nearest + *m);
      const double multiple = p + number * g;
      const uint32_t c = heightSampleOf(header, p, g, number);
      const double apart = std::ldexp(multiple - numberOf(header, c), -spacingOf(header, c));
      const std::optional<uint32_t> r = rests.next(prediction.restHint(apart), x, y);
      if (!r) return;
      const uint32_t order = orderOf(header, c);
      sample = narrow(header, orderOf(header, apart < 0 ? order - *r : order + *r));
      const double s = numberOf(header, sample);
      const auto rest = static_cast<int32_t>(*r);
      const bool rounded = rest >= -1 && rest <= 1;
      const double pulled = multiple + (s - multiple) * (layers.relativeQuarters / 4.0);
      known.put(x, y, rounded ? pulled : s);
    }
  }
}

}  // namespace tetrakis::reference
