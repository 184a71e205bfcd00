// SPDX-License-Identifier: Apache-2.0
#include "conformance/reference_decoder/relative.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "conformance/reference_decoder/corrections.hpp"
#include "conformance/reference_decoder/range_decoder.hpp"
#include "conformance/reference_decoder/samples.hpp"

namespace tetrakis::reference {

void correctFromRelative(const GeometryHeader& header, const Layers& layers,
                         std::span<const uint8_t> codeword, const Plane& plane,
                         std::vector<uint32_t>& samples) {
  constexpr double kFarthest = 1 << 30;
  const double g = layers.relativeStep;
  RangeDecoder decoder(codeword);
  CorrectionDecoder multiples(decoder, plane), rests(decoder, plane);
  std::vector<std::optional<double>> known(samples.size());  // K
  const auto knownAt = [&](int x, int y) -> std::optional<double> {
    if (x < 0 || x >= plane.width || y < 0) return std::nullopt;
    return known[static_cast<size_t>(y) * plane.width + x];
  };
  for (int y = 0; y < plane.height; ++y) {
    for (int x = 0; x < plane.width; ++x) {
      if (!plane.isValid(x, y)) continue;
      const size_t i = static_cast<size_t>(y) * plane.width + x;
      const double d = numberOf(header, samples[i]);
      const auto w = knownAt(x - 1, y), n = knownAt(x, y - 1), o = knownAt(x - 1, y - 1);
      double p = w ? *w : n ? *n : d;
      bool planar = false;
      if (w && n && o) {
        const double h = (*w + *n) - *o, z = std::abs(h) * 0x1p-22;
        const auto e = knownAt(x + 1, y - 1), a = knownAt(x - 2, y), b = knownAt(x, y - 2);
        double sum = 0;
        int count = 1;
        const auto add = [&](double other) {
          const double apart = other - h;
          const double off = apart - std::floor(apart / g + 0.5) * g;
          if (!(std::abs(off) <= z)) return;
          sum += off;
          ++count;
        };
        if (a) add(2 * *w - *a);
        if (b) add(2 * *n - *b);
        if (e) add((*w + *e) - *n);
        if (const double mean = h + sum / count; std::isfinite(mean)) {
          p = mean;
          planar = true;
        }
      }
      const double t = std::clamp((d - p) / g, -kFarthest, kFarthest);
      const double k = std::floor(t + 0.5);
      const int hint = static_cast<int>(std::min(std::floor(std::abs(k - t) * 16), 7.0));
      const std::optional<uint32_t> m = multiples.next(hint, x, y);
      if (!m) return;
      const auto nearest = static_cast<uint32_t>(static_cast<int32_t>(k));
      const auto number = static_cast<int32_t>(k > t ? nearest - *m : nearest + *m);
      const double multiple = p + number * g;
      const uint32_t c = heightSampleOf(header, p, g, number);
      const double beside = std::ldexp(multiple - numberOf(header, c), -spacingOf(header, c));
      const int rest_hint = planar   ? static_cast<int>(std::min(std::abs(beside) * 16, 7.0))
                            : w || n ? 8
                                     : 9;
      const std::optional<uint32_t> r = rests.next(rest_hint, x, y);
      if (!r) return;
      const uint32_t order = orderOf(header, c);
      samples[i] = narrow(header, orderOf(header, beside < 0 ? order - *r : order + *r));
      const double s = numberOf(header, samples[i]);
      const auto rest = static_cast<int32_t>(*r);
      const bool rounded = rest >= -1 && rest <= 1;
      const double pulled = multiple + (s - multiple) * (layers.relativeQuarters / 4.0);
      const double now = rounded ? pulled : s;
      if (std::isfinite(now)) known[i] = now;
    }
  }
}

}  // namespace tetrakis::reference
