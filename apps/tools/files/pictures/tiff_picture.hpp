// SPDX-License-Identifier: Apache-2.0
// openTiff() reads TIFFs by libtiff alone, with the samples as they are stored. OpenImageIO 2.4
// converts some of them in place, into memory of another size than they have, and misreads the form
// of others.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "apps/tools/files/pictures/picture_formats.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::tools {

/// The file begins as a TIFF. Integers of few bits come in the smallest type that holds them,
/// floats of 16 and 24 bits as those of 32, places in a palette and inks as what they are; YCbCr
/// becomes RGB. TKS_USAGE for samples that neither heights nor textures have, or that are not read
/// exactly, or more than so many rows or columns. name: for messages.
Result<std::unique_ptr<PictureReader>> openTiff(const std::string& path, const std::string& name,
                                                uint64_t most_side);

}  // namespace tetrakis::tools
