// SPDX-License-Identifier: Apache-2.0
// visitSamples() calls a function with the samples of a height file in their own type.
#pragma once

#include <span>
#include <type_traits>

#include "apps/tools/files/files.hpp"
#include "base/samples.hpp"

namespace tetrakis::tools {

/// Calls `visit` with a std::span of the samples, const if the heights are, and returns its result.
template <class Heights, class Visitor>
auto visitSamples(Heights& heights, Visitor&& visit) {
  return withSampleType(heights.sample, [&]<class T>(T) {
    using Item = std::conditional_t<std::is_const_v<Heights>, const T, T>;
    return visit(std::span<Item>(reinterpret_cast<Item*>(heights.data.data()),
                                 heights.data.size() / sizeof(T)));
  });
}

}  // namespace tetrakis::tools
