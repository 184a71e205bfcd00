// SPDX-License-Identifier: Apache-2.0
// readWorldFile() and writeWorldFile() handle world files (Esri): six numbers beside a picture that
// say where it lies, without a reference system.
#pragma once

#include <optional>
#include <string>

#include "apps/tools/files/files.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::tools {

/// "a.pgw" for "a.png": the first and last letter of the extension, and w. "" for "-" and names
/// without an extension.
std::string worldFileOf(const std::string& picture);

/// Of the first that there is: a.pgw, a.pngw, a.wld, also in upper case; nothing if there is none.
/// TKS_IO if it does not hold six numbers that a stream takes.
Result<std::optional<GeoTransform>> readWorldFile(const std::string& picture);

/// With all digits.
Status writeWorldFile(const std::string& picture, const GeoTransform& transform);

}  // namespace tetrakis::tools
