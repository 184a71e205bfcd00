// SPDX-License-Identifier: Apache-2.0
// The files that a bench measures, above all height fields.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "tetrakis/result.hpp"

namespace tetrakis::bench {

/// Files below the folders that `wanted` takes, in order of path. filters: only those whose path
/// holds one of these texts; empty: all.
std::vector<std::filesystem::path> filesBelow(
    const std::vector<std::string>& folders, const std::vector<std::string>& filters,
    const std::function<bool(const std::filesystem::path&)>& wanted);

/// Those that hold heights.
std::vector<std::filesystem::path> heightFilesBelow(const std::string& folder,
                                                    const std::vector<std::string>& filters);

/// Measures one file; item: its path below the folder, without the extension.
using MeasureFile = std::function<Status(const std::string& path, const std::string& item)>;

/// Has all files below the folders measured; false if one failed, which is told on stderr.
bool measureHeightFiles(const std::vector<std::string>& folders,
                        const std::vector<std::string>& filters, const MeasureFile& measure);

}  // namespace tetrakis::bench
