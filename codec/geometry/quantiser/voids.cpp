// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/quantiser/voids.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <type_traits>

#include "base/samples.hpp"

namespace tetrakis::inline quantiser {

namespace {

Status notFinite(const tks_heights& heights, size_t i) {
  return {TKS_USAGE, "The height in column " + std::to_string(i % heights.width) + ", row " +
                         std::to_string(i / heights.width) +
                         " is infinite; declare it as nodata or fill it before encoding."};
}

}  // namespace

Result<std::vector<uint8_t>> findVoids(const tks_heights& heights) {
  const size_t count = size_t{heights.width} * heights.height;
  return withSampleType(heights.sample, [&](auto type) -> Result<std::vector<uint8_t>> {
    using T = decltype(type);
    const auto* samples = static_cast<const T*>(heights.data);
    const double nodata = std::is_floating_point_v<T>
                              ? static_cast<double>(static_cast<float>(heights.nodata))
                              : heights.nodata;
    std::vector<uint8_t> valid;  // takes no memory before the first void
    for (size_t i = 0; i < count; ++i) {
      const auto value = static_cast<double>(samples[i]);
      if (std::isnan(value) || (heights.has_nodata && value == nodata)) {
        if (valid.empty()) valid.assign(count, 1);
        valid[i] = 0;
      } else if (std::isinf(value)) {
        return notFinite(heights, i);
      }
    }
    return valid;
  });
}

SampleRange rangeOf(const tks_heights& heights, Mask valid) {
  return withSampleType(heights.sample, [&](auto type) {
    using T = decltype(type);
    const auto* samples = static_cast<const T*>(heights.data);
    SampleRange range;
    bool any = false;
    for (size_t i = 0; i < size_t{heights.width} * heights.height; ++i) {
      if (!valid[i]) continue;
      const auto value = static_cast<double>(samples[i]);
      range.low = any ? std::min(range.low, value) : value;
      range.high = any ? std::max(range.high, value) : value;
      any = true;
    }
    return range;
  });
}

}  // namespace tetrakis::inline quantiser
