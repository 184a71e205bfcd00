// SPDX-License-Identifier: Apache-2.0
// A GrowingFile is read by ranges, and from its begin on as it grows, while somebody else writes
// at its end.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "tetrakis/result.hpp"

namespace tetrakis::tools {

class GrowingFile {
 public:
  static Result<GrowingFile> open(const std::string& path);
  GrowingFile(GrowingFile&& other) noexcept;
  GrowingFile& operator=(GrowingFile&&) = delete;
  ~GrowingFile();

  uint64_t size() const;
  /// Fills `to` with bytes from an offset on. False: they are not there.
  bool read(uint64_t offset, std::span<uint8_t> to) const;

  /// The next bytes that more() has not given yet, a part of them at a time; none: there are none
  /// yet. TKS_IO: the file cannot be read, or has become shorter.
  Result<std::vector<uint8_t>> more();

 private:
  GrowingFile(int file, std::string path) : file_(file), path_(std::move(path)) {}

  int file_;
  std::string path_;
  uint64_t given_ = 0;
};

}  // namespace tetrakis::tools
