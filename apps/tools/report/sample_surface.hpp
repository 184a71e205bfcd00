// SPDX-License-Identifier: Apache-2.0
// Surface holds samples of any type, heights of a file or a mesh as one grid of doubles, so that
// they can be compared.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "apps/tools/files/files.hpp"
#include "tetrakis/tetrakis.hpp"

namespace tetrakis::tools {

/// width * height values, row by row.
struct Surface {
  uint32_t width = 0, height = 0;
  std::vector<double> values;
};

/// `width` x `height` samples of any type as doubles, exactly.
Surface samplesOf(uint32_t width, uint32_t height, tks_sample sample,
                  std::span<const std::byte> data);

/// Heights in `unit`: sample * scale + offset; NaN where the sample is NaN or the file's nodata.
Surface heightsOf(const HeightFile& file);

/// The mesh's linear interpolant at every sample of the grid that it covers; barycentric weights
/// are exact integers. NaN where no triangle is: meshes cover the grid but for voids and their
/// coasts.
Surface rasterize(const Mesh& mesh, uint32_t width, uint32_t height);

}  // namespace tetrakis::tools
