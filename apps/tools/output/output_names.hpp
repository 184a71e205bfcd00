// SPDX-License-Identifier: Apache-2.0
// checkDistinct() and checkInputsStay() refuse outputs of one command that would overwrite each
// other or an input.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tetrakis/result.hpp"

namespace tetrakis::tools {

/// Where writing to this name goes: symbolic links are followed, to targets that are missing too.
std::filesystem::path followLinks(std::filesystem::path path);

/// TKS_USAGE if two names mean the same file (links followed) or both mean standard output. Devices
/// and pipes take any number.
Status checkDistinct(const std::vector<std::string>& names);

/// TKS_USAGE if the output is one of the inputs (links followed; empty names are none). Devices and
/// pipes may be both.
Status checkInputsStay(const std::vector<std::string>& inputs, const std::string& output);

/// The files that writing this mesh makes: an .obj brings its .mtl and .png.
std::vector<std::string> meshFiles(const std::string& mesh);

}  // namespace tetrakis::tools
