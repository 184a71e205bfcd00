// SPDX-License-Identifier: Apache-2.0
// The bytes of one of GDAL's virtual files that were read, at their places. Over a network each
// request takes as long as many bytes, so ranges that lie near each other are read in one piece.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <cpl_vsi.h>
#include "tetrakis/tetrakis.h"

namespace tetrakis::gdal {

/// Null if it cannot be opened. The streams of a sequence share their file.
using File = std::shared_ptr<VSILFILE>;
inline File openFile(const std::string& name) {
  return {VSIFOpenL(name.c_str(), "rb"), [](VSILFILE* file) {
            if (file != nullptr) VSIFCloseL(file);
          }};
}
/// Nothing if it cannot be found.
std::optional<uint64_t> lengthOf(const File& file);

class FileBytes {
 public:
  /// Places count from `begin`.
  explicit FileBytes(File file, uint64_t begin = 0) : file_(std::move(file)), begin_(begin) {}

  /// What was read is read again where it is needed again.
  void forget() { runs_.clear(); }

  /// Reads what is missing of ranges in rising order, and what lies between. Returns a range that
  /// cannot be read, if there is one. Moves the bytes that are there.
  std::optional<tks_range> read(std::span<const tks_range> ranges);

  /// What was read from a place on without a gap. Valid until read().
  std::span<const uint8_t> at(uint64_t place) const;

  /// How many are read for these ranges if nothing is known.
  static uint64_t costOf(std::span<const tks_range> ranges);

 private:
  std::vector<tks_range> missingOf(std::span<const tks_range> ranges) const;
  void take(uint64_t place, std::vector<uint8_t>&& bytes);

  File file_;
  uint64_t begin_;
  std::map<uint64_t, std::vector<uint8_t>> runs_;  ///< by place; no two touch
};

}  // namespace tetrakis::gdal
