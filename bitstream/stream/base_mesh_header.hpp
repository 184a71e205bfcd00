// SPDX-License-Identifier: Apache-2.0
// BaseMeshHeader is the part of a header that says what the heights of a surface lie over:
// codec/basemesh/base_mesh.hpp.
#pragma once

#include <array>
#include <cstdint>
#include <string>

namespace tetrakis::inline stream {

struct BaseMeshHeader {
  static constexpr uint8_t kMostBits = 20;
  /// The finest patches over a base mesh: 257 x 257 samples.
  static constexpr int kMostDepth = 8;

  uint8_t bits = 0;                ///< of a coordinate of a corner; 0: there is no base mesh
  double cell = 1;                 ///< side of a cell of the grid of corners
  std::array<double, 3> origin{};  ///< of that grid
  std::string code;                ///< codeword of the corners

  bool none() const { return bits == 0; }

  template <class V>
  void visit(V& v) {
    v.u8("position_bits", bits, 1, kMostBits);
    v.f64("cell", cell);
    v.require("cell", cell > 0);
    for (double& value : origin) v.f64("origin", value);
    v.rest(code);
  }
};

}  // namespace tetrakis::inline stream
