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
    if (x < 0 || y < 0) return std::nullopt;
    return known[static_cast<size_t>(y) * plane.width + x];
  };
  for (int y = 0; y < plane.height; ++y) {
    for (int x = 0; x < plane.width; ++x) {
      if (!plane.isValid(x, y)) continue;
      const size_t i = static_cast<size_t>(y) * plane.width + x;
      const double d = numberOf(header, samples[i]);
      const auto w = knownAt(x - 1, y), n = knownAt(x, y - 1), o = knownAt(x - 1, y - 1);
      double p = w ? *w : n ? *n : d;
      int rest_hint = w || n ? 1 : 2;
      if (w && n && o && std::isfinite((*w + *n) - *o)) {
        p = (*w + *n) - *o;
        rest_hint = 0;
      }
      const double t = std::clamp((d - p) / g, -kFarthest, kFarthest);
      const double k = std::floor(t + 0.5);
      const int hint = static_cast<int>(std::min(std::floor(std::abs(k - t) * 16), 7.0));
      const std::optional<uint32_t> m = multiples.next(hint, x, y);
      if (!m) return;
      const std::optional<uint32_t> r = rests.next(rest_hint, x, y);
      if (!r) return;
      const auto nearest = static_cast<uint32_t>(static_cast<int32_t>(k));
      const auto number = static_cast<int32_t>(k > t ? nearest - *m : nearest + *m);
      const uint32_t c = heightSampleOf(header, p, g, number);
      samples[i] = narrow(header, orderOf(header, orderOf(header, c) + *r));
      const double s = numberOf(header, samples[i]), multiple = p + number * g;
      const auto rest = static_cast<int32_t>(*r);
      const bool rounded = rest >= -1 && rest <= 1;
      const double pulled = multiple + (s - multiple) * (layers.relativeQuarters / 4.0);
      const double now = rounded ? pulled : s;
      if (std::isfinite(now)) known[i] = now;
    }
  }
}

}  // namespace tetrakis::reference
