// SPDX-License-Identifier: Apache-2.0
// The height fields that a bench measures.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "tetrakis/result.hpp"

namespace tetrakis::bench {

/// Files below the folder that hold heights, in order of name. filters: only those whose path holds
/// one of these texts; empty: all.
std::vector<std::filesystem::path> heightFilesBelow(const std::string& folder,
                                                    const std::vector<std::string>& filters);

/// Measures one file; item: its path below the folder, without the extension.
using MeasureFile = std::function<Status(const std::string& path, const std::string& item)>;

/// Has all files below the folders measured; false if one failed, which is told on stderr.
bool measureHeightFiles(const std::vector<std::string>& folders,
                        const std::vector<std::string>& filters, const MeasureFile& measure);

}  // namespace tetrakis::bench
