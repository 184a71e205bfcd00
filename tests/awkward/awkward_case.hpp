// SPDX-License-Identifier: Apache-2.0
// Terrains that are awkward to encode, each with a target: flat parts, lakes, voids, stripes, two
// values, an outlier, odd floats, sizes around the borders of regions. A seed says all of it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "conformance/samples/terrain_samples.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::test {

struct AwkwardCase {
  samples::Raster heights;
  std::optional<samples::Raster> texture;
  std::optional<double> nodata;          ///< declared
  tks_domain domain = TKS_DOMAIN_PLANE;  ///< of both
  tks_encode_options options = {};
  std::string description;  ///< type, size, kind and target, to find a failure again

  tks_heights input() const;
};

/// most_samples: of the heights. The same seed makes the same case on every machine.
AwkwardCase awkwardCase(uint64_t seed, uint32_t most_samples);

}  // namespace tetrakis::test
