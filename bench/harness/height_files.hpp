// SPDX-License-Identifier: Apache-2.0
// The height fields that a bench measures.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tetrakis::bench {

/// Files below the folder that hold heights, in order of name. filters: only those whose path holds
/// one of these texts; empty: all.
std::vector<std::filesystem::path> heightFilesBelow(const std::string& folder,
                                                    const std::vector<std::string>& filters);

}  // namespace tetrakis::bench
