// SPDX-License-Identifier: Apache-2.0
// What every prefix promises of its surface, whatever bytes are missing.
#pragma once

#include <string>

#include "tests/awkward/awkward_case.hpp"

namespace tetrakis::test {

/// Looks at what is there of a stream of this case: windows are parts of the whole, patches have
/// the samples, heights and texels that they share, meshes of forests and globes have no open edge
/// but at borders, and every vertex of a mesh of all samples lies on the surface. Empty, or the
/// first promise that is broken.
std::string brokenSurface(const AwkwardCase& c, tks_decoder* decoder);

}  // namespace tetrakis::test
