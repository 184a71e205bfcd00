// SPDX-License-Identifier: Apache-2.0
// Whole files as bytes, and standard input as a file.
#include "apps/tools/files/file_bytes.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <utility>

namespace tetrakis::tools {
namespace {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

Status failure(const char* verb, const std::string& path, int error) {
  return {TKS_IO, std::string("cannot ") + verb + " " + quoted(path) + ": " + std::strerror(error)};
}

/// size: of the file, if it is known.
Result<std::vector<std::byte>> readAll(std::FILE* file, const std::string& path, uint64_t size) {
  std::vector<std::byte> bytes;
  bytes.reserve(size);
  std::array<std::byte, 1 << 16> block;
  while (const size_t count = std::fread(block.data(), 1, block.size(), file)) {
    bytes.insert(bytes.end(), block.begin(), block.begin() + count);
  }
  if (std::ferror(file)) return failure("read", path, errno);
  return bytes;
}

}  // namespace

std::string quoted(const std::string& path) {
  return path == "-" ? "standard input" : "'" + path + "'";
}

std::string formatOf(const std::string& path, const std::string& format) {
  std::string name = format.empty() ? std::filesystem::path(path).extension().string() : format;
  if (name.starts_with('.')) name.erase(0, 1);
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return name;
}

Result<std::vector<std::byte>> readBytes(const std::string& path) {
  if (path == "-") return readAll(stdin, path, 0);
  const File file(std::fopen(path.c_str(), "rb"));
  if (!file) return failure("read", path, errno);
  std::error_code unknown;
  const bool regular = std::filesystem::is_regular_file(path, unknown);
  return readAll(file.get(), path, regular ? std::filesystem::file_size(path) : 0);
}

Status writeBytes(const std::string& path, std::span<const std::byte> bytes) {
  File file(std::fopen(path.c_str(), "wb"));
  if (!file) return failure("write", path, errno);
  const bool written = std::fwrite(bytes.data(), 1, bytes.size(), file.get()) == bytes.size();
  const int write_error = errno;
  // Closing flushes: a full disk may only be noticed here.
  if (std::fclose(file.release()) != 0 && written) return failure("write", path, errno);
  return written ? Status() : failure("write", path, write_error);
}

void reorderBytes(std::span<std::byte> items, size_t item_bytes, std::endian order) {
  if (order == std::endian::native) return;
  for (; items.size() >= item_bytes; items = items.subspan(item_bytes)) {
    std::reverse(items.begin(), items.begin() + item_bytes);
  }
}

Result<InputFile> InputFile::open(const std::string& path) {
  std::error_code none;
  if (std::filesystem::is_regular_file(path, none) || std::filesystem::is_directory(path, none)) {
    const File file(std::fopen(path.c_str(), "rb"));
    char first = 0;
    // Reading one byte also tells a directory from a file.
    if (!file || (std::fread(&first, 1, 1, file.get()) == 0 && std::ferror(file.get()))) {
      return failure("read", path, errno);
    }
    return InputFile(path, {});
  }
  const auto bytes = readBytes(path);
  if (!bytes.ok()) return bytes.status();
  auto copy = Temporary::makeFile();
  if (!copy.ok()) return copy.status();
  const Status written = writeBytes(copy->path(), *bytes);
  if (!written.ok()) return written;
  const std::string name = copy->path();
  return InputFile(name, std::move(*copy));
}

}  // namespace tetrakis::tools
