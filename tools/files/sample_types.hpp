// SPDX-License-Identifier: Apache-2.0
// The samples of a height file under their own type.
#pragma once

#include <cstdint>
#include <span>
#include <type_traits>

#include "tools/files/files.hpp"

namespace tetrakis::tools {

/// Calls `visit` with a std::span of the samples, const if the heights are, and returns its result.
template <class Heights, class Visitor>
auto visitSamples(Heights& heights, Visitor&& visit) {
  const auto as = [&heights]<class T>(T) {
    using Item = std::conditional_t<std::is_const_v<Heights>, const T, T>;
    return std::span<Item>(reinterpret_cast<Item*>(heights.data.data()),
                           heights.data.size() / sizeof(T));
  };
  switch (heights.sample) {
    case TKS_U8:
      return visit(as(uint8_t{}));
    case TKS_I8:
      return visit(as(int8_t{}));
    case TKS_U16:
      return visit(as(uint16_t{}));
    case TKS_I16:
      return visit(as(int16_t{}));
    case TKS_U32:
      return visit(as(uint32_t{}));
    case TKS_I32:
      return visit(as(int32_t{}));
    case TKS_F32:
      break;
  }
  return visit(as(float{}));
}

}  // namespace tetrakis::tools
