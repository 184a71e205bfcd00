// SPDX-License-Identifier: Apache-2.0
// The files of a mosaic, in memory.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "encoder/mosaic/mosaic_plan.hpp"

namespace tetrakis::test {

struct MosaicMemory {
  std::map<std::string, std::vector<uint8_t>> files;

  MosaicFiles storage() {
    MosaicFiles out;
    out.read = [this](const std::string& name, uint64_t offset,
                      uint64_t bytes) -> Result<std::vector<uint8_t>> {
      const auto found = files.find(name);
      if (found == files.end()) return Status(TKS_IO, name + " is missing");
      const std::vector<uint8_t>& all = found->second;
      const uint64_t from = std::min<uint64_t>(offset, all.size());
      const uint64_t count = std::min<uint64_t>(bytes, all.size() - from);
      return std::vector<uint8_t>(all.begin() + static_cast<ptrdiff_t>(from),
                                  all.begin() + static_cast<ptrdiff_t>(from + count));
    };
    out.write = [this](const std::string& name, std::span<const uint8_t> bytes) -> Status {
      files[name].assign(bytes.begin(), bytes.end());
      return {};
    };
    return out;
  }
};

}  // namespace tetrakis::test
