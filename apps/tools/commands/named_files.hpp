// SPDX-License-Identifier: Apache-2.0
// namedFile() reads the words NAME=FILE of a command line, and takeWeights() the words NAME=WEIGHT:
// what components of a stream are called, and what their errors count.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "tetrakis/components.h"
#include "tetrakis/result.hpp"

namespace tetrakis::tools {

/// A file, and what the components that it holds are called.
struct NamedFile {
  std::string name, path;
  double weight = 0;  ///< 0: as others
};

/// A file whose own name has an equals sign is a file without another name.
NamedFile namedFile(const std::string& given);
std::vector<NamedFile> namedFiles(const std::vector<std::string>& given);

/// TKS_USAGE with a sentence where a word is no weight, or of a name that no file has.
Status takeWeights(const std::vector<std::string>& weights, std::vector<NamedFile>& files);

/// What tks_combine takes. `file` and the bytes outlive it.
tks_combined asCombined(const NamedFile& file, std::span<const uint8_t> stream);

/// A sentence of tks_combine, which counts streams, about these files instead.
Status aboutFile(const Status& status, const std::vector<NamedFile>& files);

}  // namespace tetrakis::tools
