// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/flat_choice.hpp"

#include <cstdio>
#include <cstdlib>

#include "codec/geometry/flat_encoder.hpp"

namespace tetrakis::inline geometry {

FlatLayer chooseFlatAreas(const PlaneView<const int32_t>& heights, int, Purpose) {
  const char* e = std::getenv("TKS_FLAT");
  const int least = e ? std::atoi(e) : 0;
  if (least == 0) return {};
  FlatLayer layer{findFlatAreas(heights, static_cast<uint32_t>(least)), {}};
  if (layer.areas.empty()) return {};
  layer.codeword = encodeFlatAreas(layer.areas, heights.extent(), heights.valid);
  if (std::getenv("TKS_V")) fprintf(stderr, "areas %zu bytes %zu\n", layer.areas.levels.size(), layer.codeword.size());
  return layer;
}

}  // namespace tetrakis::inline geometry
