// SPDX-License-Identifier: Apache-2.0
// Reference decoder: corrections from relative steps (docs/FORMAT.md, section 8.1.11).
#include <algorithm>
#include <cstdint>
#include <optional>

#include "conformance/reference_decoder/numbers.hpp"
#include "conformance/reference_decoder/range_decoder.hpp"
#include "conformance/reference_decoder/sample_corrections.hpp"
#include "conformance/reference_decoder/samples.hpp"
#include "conformance/reference_decoder/units.hpp"

namespace tetrakis::reference {

namespace {

/// P of a sample, and which hint its rest has.
struct Prediction {
  int64_t p = 0;
  bool planar = false, beside = false;  ///< from three samples or more; from one at least

  int restHint(int64_t apart, int spacing) const {
    if (!planar) return beside ? 8 : 9;
    const int64_t places = near(apart < 0 ? -apart : apart, 4) >> std::clamp(spacing, 0, 62);
    return static_cast<int>(std::min<int64_t>(places, 7));
  }
};

/// K: what is known of the samples before one.
class KnownSamples {
 public:
  KnownSamples(const Plane& plane, int64_t g) : plane_(plane), g_(g), known_(plane.values.size()) {}

  /// d: the count of the decoded height.
  Prediction predict(int x, int y, int64_t d) const {
    const auto w = at(x - 1, y), n = at(x, y - 1), o = at(x - 1, y - 1);
    if (!w || !n || !o) return {w ? *w : n ? *n : d, false, w || n};
    const int64_t h = *w + *n - *o, z = ((h < 0 ? -h : h) >> 22) + 1;
    const auto e = at(x + 1, y - 1), a = at(x - 2, y), b = at(x, y - 2);
    int64_t sum = 0, count = 1;
    const auto add = [&](int64_t other) {
      const int64_t apart = other - h;
      const int64_t off = apart - floorDiv(apart + g_ / 2, g_) * g_;
      if (off > z || off < -z) return;
      sum += off;
      ++count;
    };
    if (a) add(2 * *w - *a);
    if (b) add(2 * *n - *b);
    if (e) add(*w + *e - *n);
    return {h + floorDiv(2 * sum + count, 2 * count), true, true};
  }

  void put(int x, int y, int64_t value) {
    if (value > -kFar && value < kFar) known_[plane_.index(x, y)] = value;
  }

 private:
  std::optional<int64_t> at(int x, int y) const {
    if (x < 0 || x >= plane_.width || y < 0) return std::nullopt;
    return known_[plane_.index(x, y)];
  }

  const Plane& plane_;
  int64_t g_;
  std::vector<std::optional<int64_t>> known_;
};

}  // namespace

void correctFromRelative(const GeometryHeader& header, const Layers& layers,
                         std::span<const uint8_t> codeword, const Plane& plane,
                         std::vector<uint32_t>& samples) try {
  constexpr int64_t kFarthest = 1 << 30;
  const Step step(layers.relativeStep);
  const int64_t g = step.g;
  RangeDecoder decoder(codeword);
  CorrectionDecoder multiples(decoder, plane), rests(decoder, plane);
  KnownSamples known(plane, g);
  for (int y = 0; y < plane.height; ++y) {
    for (int x = 0; x < plane.width; ++x) {
      if (!plane.isValid(x, y)) continue;
      uint32_t& sample = samples[plane.index(x, y)];
      const int64_t d = placeOf(header, plane.values[plane.index(x, y)], step.u);
      const Prediction prediction = known.predict(x, y, d);
      const int64_t t = d - prediction.p;
      const int64_t k = std::clamp(floorDiv(t + g / 2, g), -kFarthest, kFarthest);
      const int64_t off = k * g - t, apart = std::min(off < 0 ? -off : off, g / 2);
      const int hint = static_cast<int>(std::min<int64_t>(apart * 16 / g, 7));
      const uint32_t m = multiples.next(hint, x, y);
      const auto nearest = static_cast<uint32_t>(static_cast<int32_t>(k));
      const auto number = static_cast<int32_t>(off > 0 ? nearest - m : nearest + m);
      const int64_t multiple = prediction.p + number * g;
      const uint32_t c = sampleAt(header, multiple, step.u);
      const int64_t beyond = multiple - unitsOf(header, c, step.u);
      const int spacing = spacingOf(header, c) - step.u;
      const uint32_t r = rests.next(prediction.restHint(beyond, spacing), x, y);
      const uint32_t order = orderOf(header, c);
      sample = narrow(header, orderOf(header, beyond < 0 ? order - r : order + r));
      if (!isNumber(header, sample)) continue;
      const int64_t s = unitsOf(header, sample, step.u);
      if (s <= -kFar || s >= kFar) continue;
      const auto rest = static_cast<int32_t>(r);
      const bool rounded = rest >= -1 && rest <= 1 && multiple > -2 * kFar && multiple < 2 * kFar;
      const int64_t pull = rounded ? (s - multiple) * layers.relativeQuarters + 2 : 0;
      known.put(x, y, rounded ? multiple + (pull >> 2) : s);
    }
  }
} catch (Undecided) {
}

}  // namespace tetrakis::reference
