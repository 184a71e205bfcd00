// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/serve/growing_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <algorithm>
#include <utility>

#include "apps/tools/files/file_bytes.hpp"

namespace tetrakis::tools {

Result<GrowingFile> GrowingFile::open(const std::string& path) {
  GrowingFile file(::open(path.c_str(), O_RDONLY | O_CLOEXEC), path);
  struct stat found = {};
  if (file.file_ < 0 || fstat(file.file_, &found) != 0 || !S_ISREG(found.st_mode))
    return Status(TKS_IO, "cannot read " + tools::quoted(path));
  return file;
}

GrowingFile::GrowingFile(GrowingFile&& other) noexcept
    : file_(std::exchange(other.file_, -1)), path_(std::move(other.path_)), given_(other.given_) {}

GrowingFile::~GrowingFile() {
  if (file_ >= 0) close(file_);
}

uint64_t GrowingFile::size() const {
  struct stat found = {};
  return fstat(file_, &found) == 0 ? static_cast<uint64_t>(found.st_size) : 0;
}

bool GrowingFile::read(uint64_t offset, std::span<uint8_t> to) const {
  while (!to.empty()) {
    const ssize_t got = pread(file_, to.data(), to.size(), static_cast<off_t>(offset));
    if (got <= 0) return false;
    offset += static_cast<uint64_t>(got);
    to = to.subspan(static_cast<size_t>(got));
  }
  return true;
}

Result<std::vector<uint8_t>> GrowingFile::more() {
  constexpr uint64_t kAtATime = 1 << 20;
  const uint64_t there = size();
  if (there < given_) return Status(TKS_IO, tools::quoted(path_) + " has become shorter");
  std::vector<uint8_t> bytes(static_cast<size_t>(std::min(there - given_, kAtATime)));
  if (!read(given_, bytes)) return Status(TKS_IO, "cannot read " + tools::quoted(path_));
  given_ += bytes.size();
  return bytes;
}

}  // namespace tetrakis::tools
