// SPDX-License-Identifier: Apache-2.0
// Terrains that are awkward to encode, each with a target: flat parts, lakes, voids, stripes, two
// values, an outlier, odd floats, sizes around the borders of regions; on planes, cylinders, cubes
// and patches that are glued anyhow. A seed says all of it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "conformance/samples/terrain_samples.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::test {

struct AwkwardCase {
  samples::Raster heights;
  std::optional<samples::Raster> texture;
  std::optional<double> nodata;          ///< declared
  tks_domain domain = TKS_DOMAIN_PLANE;  ///< of both
  std::vector<uint32_t> sides;           ///< of the patches of a forest, as those of tks_forest
  uint32_t depth = 0, texture_depth = 0;
  std::optional<tks_geographic_grid> grid;  ///< that lies round the Earth
  tks_encode_options options = {};
  std::string description;  ///< type, size, kind and target, to find a failure again

  tks_heights input() const;
  tks_image picture() const;  ///< there is a texture
};

/// most_samples: of the heights. The same seed makes the same case on every machine.
AwkwardCase awkwardCase(uint64_t seed, uint32_t most_samples);

}  // namespace tetrakis::test
