// SPDX-License-Identifier: Apache-2.0
// readBytes() and writeBytes() read and write whole files, and quoted() names a file in the
// sentence of a failure.
#pragma once

#include <bit>
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "apps/tools/files/temporary.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::tools {

/// "'path'", or "standard input" for "-".
std::string quoted(const std::string& path);

/// The format to use for `path`: `format` if given, else the extension; lower case, without a dot.
std::string formatOf(const std::string& path, const std::string& format);

/// All bytes of the file, or of standard input for "-".
Result<std::vector<std::byte>> readBytes(const std::string& path);

/// Replaces the content of the file.
Status writeBytes(const std::string& path, std::span<const std::byte> bytes);

/// Turns items between the byte order of a file and that of this machine, in place.
void reorderBytes(std::span<std::byte> items, size_t item_bytes, std::endian order);

/// A readable file with a name of its own, for libraries that open by name, and more than once: the
/// path itself, or for "-", pipes and devices a temporary copy that lives as long as this object.
class InputFile {
 public:
  static Result<InputFile> open(const std::string& path);
  const std::string& path() const { return path_; }

 private:
  InputFile(std::string path, Temporary copy) : path_(std::move(path)), copy_(std::move(copy)) {}
  std::string path_;
  Temporary copy_;
};

}  // namespace tetrakis::tools
