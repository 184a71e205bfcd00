// SPDX-License-Identifier: Apache-2.0
// Files that appear whole or not at all, by GDAL's virtual files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace tetrakis::gdal {

/// A name for a file of this process alone, beside `name` where files can be renamed, else in
/// GDAL's folder of temporary files.
std::string temporaryNameFor(const std::string& name);

/// Whether it is there to be opened: /vsistdout/ has passed on what was written.
bool isFile(const std::string& name);

/// What was written; what is no file of its own, such as /dev/full, stays.
void discard(const std::string& name);

/// Where files can be renamed, nothing stands under the name before all bytes are written. False
/// after a reported error.
bool writeFile(const std::string& name, std::span<const uint8_t> bytes);

}  // namespace tetrakis::gdal
