// SPDX-License-Identifier: Apache-2.0
// withSampleType() calls a function with the C++ type that a tks_sample names, so that code is
// written once for all types.
#pragma once

#include <cstdint>

#include "tetrakis/tetrakis.h"

namespace tetrakis::inline base {

/// Calls f(T{}) with the type that `sample` names. Unknown values are refused before this point.
template <class F>
auto withSampleType(tks_sample sample, F&& f) {
  switch (sample) {
    case TKS_U8:
      return f(uint8_t{});
    case TKS_I8:
      return f(int8_t{});
    case TKS_U16:
      return f(uint16_t{});
    case TKS_I16:
      return f(int16_t{});
    case TKS_U32:
      return f(uint32_t{});
    case TKS_I32:
      return f(int32_t{});
    case TKS_F32:
      break;
  }
  return f(float{});
}

}  // namespace tetrakis::inline base
