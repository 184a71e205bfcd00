// SPDX-License-Identifier: Apache-2.0
// Reference decoder: exact corrections (docs/FORMAT.md, section 8.1.10).
#include <algorithm>
#include <cstdlib>

#include "conformance/reference_decoder/error_forecast.hpp"
#include "conformance/reference_decoder/layers.hpp"
#include "conformance/reference_decoder/numbers.hpp"
#include "conformance/reference_decoder/range_decoder.hpp"
#include "conformance/reference_decoder/samples.hpp"

namespace tetrakis::reference {

void makeExact(std::span<const uint8_t> codeword, Plane& plane, int f) try {
  RangeDecoder decoder(codeword);
  NumberDecoder numbers(decoder);
  KnownNumbers known(plane);
  ErrorForecast forecast(plane);
  for (int y = 0; y < plane.height; ++y) {
    for (int x = 0; x < plane.width; ++x) {
      if (!plane.isValid(x, y)) continue;
      int32_t& v = plane.values[static_cast<size_t>(y) * plane.width + x];
      const auto u = static_cast<int32_t>(v + forecast.look(x, y));
      const int32_t r = stepOf(u, f);
      const int64_t b = u - (int64_t{r} << f);
      const int g = static_cast<int>(std::min<int64_t>((std::abs(b) * 16) >> f, 7));
      const int d = b < 0 ? -1 : 1;
      const int l = levelOf(forecast.missedNearby(x, y));
      const uint32_t c = numbers.next(Nearby(known, x, y, r, d), l, g);
      const uint32_t q = d < 0 ? static_cast<uint32_t>(r) - c : static_cast<uint32_t>(r) + c;
      const auto whole = static_cast<int32_t>(q << f);
      known.put(x, y, static_cast<int32_t>(q));
      forecast.learn(x, y, int64_t{whole} - v);
      v = whole;
    }
  }
} catch (Undecided) {
}

}  // namespace tetrakis::reference
