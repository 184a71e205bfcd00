// SPDX-License-Identifier: Apache-2.0
// checkJpeg() tells whether a JPEG is complete. files.hpp has the writer.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "tetrakis/result.hpp"

namespace tetrakis::tools {

/// TKS_IO if the decoder would have to make pixels up: the file ends early or is damaged, which
/// OpenImageIO passes over. name: for the message.
Status checkJpeg(std::span<const std::byte> bytes, const std::string& name);

}  // namespace tetrakis::tools
