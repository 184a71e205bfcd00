// SPDX-License-Identifier: Apache-2.0
// What a complete order of decimation costs, beside meshoptimizer in the same run.
#pragma once

#include <vector>

#include "bench/harness/results.hpp"
#include "bench/peers/raster.hpp"

namespace tetrakis::bench {

/// Prints and returns: seconds of the complete order, of the fitted order and of the hull, beside
/// meshopt_simplify to 20 000 triangles, at 1025 x 1025; then seconds and peak bytes a vertex of
/// the complete order from 129 to 4097 samples a side. The raster is cut or mirrored to those
/// sizes. Medians of processor time over `runs` alternating runs.
Result<std::vector<ResultRow>> timeDecimation(const Raster& raster, int runs);

}  // namespace tetrakis::bench
