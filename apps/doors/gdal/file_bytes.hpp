// SPDX-License-Identifier: Apache-2.0
// The bytes of one of GDAL's virtual files that were read, at their places. Over a network each
// request takes as long as many bytes, so ranges that lie near each other are read in one piece.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <cpl_vsi.h>
#include "tetrakis/tetrakis.h"

namespace tetrakis::gdal {

struct FileCloser {
  void operator()(VSILFILE* file) const { VSIFCloseL(file); }
};
using File = std::unique_ptr<VSILFILE, FileCloser>;

class FileBytes {
 public:
  explicit FileBytes(File file) : file_(std::move(file)) {}

  VSILFILE* file() const { return file_.get(); }

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
  std::map<uint64_t, std::vector<uint8_t>> runs_;  ///< by place; no two touch
};

}  // namespace tetrakis::gdal
