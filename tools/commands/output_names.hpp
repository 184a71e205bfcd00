// SPDX-License-Identifier: Apache-2.0
// Whether the outputs of one command get in each other's way.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/status.hpp"

namespace tetrakis::tools {

/// Where writing to this name goes: symbolic links are followed, to targets that are missing too.
std::filesystem::path followLinks(std::filesystem::path path);

/// TKS_USAGE if two names mean the same file (links followed) or both mean standard output. Devices
/// and pipes take any number.
Status checkDistinct(const std::vector<std::string>& names);

/// The files that writing this mesh makes: an .obj brings its .mtl and .png.
std::vector<std::string> meshFiles(const std::string& mesh);

}  // namespace tetrakis::tools
