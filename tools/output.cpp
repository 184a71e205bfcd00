// SPDX-License-Identifier: Apache-2.0
// Output that appears whole or not at all: a staging folder on the same file system, then
// rename(2), which POSIX makes atomic.
#include "tools/output.hpp"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <system_error>
#include <utility>
#include <vector>

#include "tools/file_bytes.hpp"

namespace tetrakis::tools {
namespace fs = std::filesystem;
namespace {

Status ioError(const std::string& what) {
  return Status(TKS_IO, what);
}

Status alreadyExists(const fs::path& path) {
  return ioError(quoted(path.string()) + " exists; -f overwrites it");
}

/// What stands at `path`, links followed; fs::file_type::none if that cannot be known.
fs::file_type typeOf(const fs::path& path) {
  std::error_code ignored;
  return fs::status(path, ignored).type();
}

fs::path folderOf(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

std::string replaceAll(std::string text, const std::string& from, const std::string& to) {
  for (size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

Result<fs::path> makeStagingFolder(const fs::path& parent) {
  std::string name = (parent / ".tetrakis-XXXXXX").string();
  if (!mkdtemp(name.data()))
    return ioError("cannot create a temporary folder in " + quoted(parent.string()) + ": " +
                   std::strerror(errno));
  return fs::path(name);
}

}  // namespace

Output::Output(fs::path path, Kind kind, bool force, std::string name)
    : path_(std::move(path)), kind_(kind), force_(force), name_(std::move(name)) {}

Output::Output(Output&& other) noexcept
    : path_(std::move(other.path_)),
      kind_(other.kind_),
      force_(other.force_),
      name_(std::move(other.name_)),
      folder_(std::exchange(other.folder_, {})) {}

Output& Output::operator=(Output&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(kind_, other.kind_);
  std::swap(force_, other.force_);
  std::swap(name_, other.name_);
  std::swap(folder_, other.folder_);
  return *this;
}

Output::~Output() {
  std::error_code ignored;
  if (!folder_.empty()) fs::remove_all(folder_, ignored);
}

Result<Output> Output::plan(const std::string& path, bool force, const std::string& extension) {
  const std::string unnamed = "output" + extension;
  if (path.empty()) return Status(TKS_USAGE, "an output needs a name");
  if (path == "-") return Output(path, Kind::kStdout, force, unnamed);
  fs::path target = path;
  const fs::file_type type = typeOf(target);
  if (type == fs::file_type::directory) return ioError(quoted(path) + " is a folder; name a file");
  if (type != fs::file_type::regular && type != fs::file_type::not_found)
    return Output(target, Kind::kDevice, force, unnamed);
  if (type == fs::file_type::regular) {
    if (!force) return alreadyExists(target);
    std::error_code ignored;
    const fs::path resolved = fs::canonical(target, ignored);
    if (!resolved.empty()) target = resolved;
  }
  const fs::path folder = folderOf(target);
  if (typeOf(folder) != fs::file_type::directory)
    return ioError("cannot write " + quoted(path) + ": there is no folder " +
                   quoted(folder.string()));
  if (access(folder.c_str(), W_OK | X_OK) != 0)
    return ioError("cannot write " + quoted(path) + ": " + std::strerror(errno));
  return Output(target, Kind::kFile, force, target.filename().string());
}

Status Output::stage(const std::function<Status(const std::string& path)>& write) {
  if (folder_.empty()) {
    std::error_code error;
    const fs::path parent = kind_ == Kind::kFile ? folderOf(path_) : fs::temp_directory_path(error);
    if (error) return ioError("there is no folder for temporary files: " + error.message());
    Result<fs::path> folder = makeStagingFolder(parent);
    if (!folder.ok()) return folder.status();
    folder_ = *folder;
  }
  const std::string staged = (folder_ / name_).string();
  const Status status = write(staged);
  if (status.ok()) return status;
  return Status(status.code(), replaceAll(status.message(), staged, path_.string()));
}

Status Output::stage(std::span<const std::byte> bytes) {
  return stage([bytes](const std::string& path) { return writeBytes(path, bytes); });
}

Status Output::commit() {
  return kind_ == Kind::kFile ? moveIntoPlace() : copyTo(folder_ / name_);
}

Status Output::copyTo(const fs::path& staged) {
  std::FILE* const out = kind_ == Kind::kStdout ? stdout : std::fopen(path_.c_str(), "wb");
  if (!out) return ioError("cannot write " + quoted(path_.string()) + ": " + std::strerror(errno));
  std::ifstream in(staged, std::ios::binary);
  std::vector<char> block(1 << 16);
  bool written = true;
  while (written &&
         (in.read(block.data(), static_cast<std::streamsize>(block.size())), in.gcount() > 0)) {
    const auto count = static_cast<size_t>(in.gcount());
    written = std::fwrite(block.data(), 1, count, out) == count;
  }
  const bool closed = (out == stdout ? std::fflush(out) : std::fclose(out)) == 0;
  if (written && closed) return Status();
  const std::string name = kind_ == Kind::kStdout ? "standard output" : quoted(path_.string());
  return ioError("cannot write " + name + ": " + std::strerror(errno));
}

Status Output::moveIntoPlace() {
  const fs::path target_folder = folderOf(path_);
  std::vector<fs::path> staged;
  std::error_code error;
  for (fs::directory_iterator entry(folder_, error), end; !error && entry != end;
       entry.increment(error))
    staged.push_back(entry->path());
  if (error) return ioError("cannot read " + quoted(folder_.string()) + ": " + error.message());
  for (const fs::path& file : staged) {
    const fs::path target = target_folder / file.filename();
    if (!force_ && typeOf(target) != fs::file_type::not_found) return alreadyExists(target);
  }
  for (const fs::path& file : staged) {
    const fs::path target = target_folder / file.filename();
    fs::rename(file, target, error);
    if (error) return ioError("cannot write " + quoted(target.string()) + ": " + error.message());
  }
  return Status();
}

Result<OutputFolder> OutputFolder::create(const std::string& path) {
  std::error_code error;
  const bool created = fs::create_directories(path, error);
  if (error) return ioError("cannot create " + quoted(path) + ": " + error.message());
  return OutputFolder(path, created);
}

OutputFolder::OutputFolder(OutputFolder&& other) noexcept
    : path_(std::move(other.path_)), created_(std::exchange(other.created_, false)) {}

OutputFolder::~OutputFolder() {
  std::error_code not_empty;
  if (created_) fs::remove(path_, not_empty);
}

}  // namespace tetrakis::tools
