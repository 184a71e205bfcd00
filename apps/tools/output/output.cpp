// SPDX-License-Identifier: Apache-2.0
// Output that appears whole or not at all: a staging folder on the same file system, then
// rename(2), which POSIX makes atomic.
#include "apps/tools/output/output.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <system_error>
#include <utility>
#include <vector>

#include "apps/tools/files/file_bytes.hpp"
#include "apps/tools/output/output_names.hpp"

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

}  // namespace

Output::Output(fs::path path, Kind kind, bool force, std::string name)
    : path_(std::move(path)), kind_(kind), force_(force), name_(std::move(name)) {}

Result<Output> Output::plan(const std::string& path, bool force, const std::string& extension) {
  const std::string unnamed = "output" + extension;
  if (path.empty()) return Status(TKS_USAGE, "an output needs a name");
  if (path == "-") return Output(path, Kind::kStdout, force, unnamed);
  std::error_code error;
  const fs::file_type type = fs::status(path, error).type();
  if (type == fs::file_type::none)
    return ioError("cannot write " + quoted(path) + ": " + error.message());
  if (type == fs::file_type::directory) return ioError(quoted(path) + " is a folder; name a file");
  if (type != fs::file_type::regular && type != fs::file_type::not_found)
    return Output(path, Kind::kDevice, force, unnamed);
  if (type == fs::file_type::regular && !force) return alreadyExists(path);
  const fs::path target = followLinks(path);
  const fs::path folder = folderOf(target);
  if (typeOf(folder) != fs::file_type::directory)
    return ioError("cannot write " + quoted(path) + ": there is no folder " +
                   quoted(folder.string()));
  if (access(folder.c_str(), W_OK | X_OK) != 0)
    return ioError("cannot write " + quoted(path) + ": " + std::strerror(errno));
  return Output(target, Kind::kFile, force, target.filename().string());
}

Status Output::stage(const std::function<Status(const std::string& path)>& write) {
  if (folder_.path().empty()) {
    std::error_code error;
    const fs::path parent = kind_ == Kind::kFile ? folderOf(path_) : fs::temp_directory_path(error);
    if (error) return ioError("there is no folder for temporary files: " + error.message());
    Result<Temporary> folder = Temporary::makeFolder(parent);
    if (!folder.ok()) return folder.status();
    folder_ = std::move(*folder);
  }
  const std::string staged = (folder_.path() / name_).string();
  const Status status = write(staged);
  if (status.ok()) return status;
  return Status(status.code(), replaceAll(status.message(), staged, path_.string()));
}

Status Output::stage(std::span<const std::byte> bytes) {
  return stage([bytes](const std::string& path) { return writeBytes(path, bytes); });
}

Status Output::commit() {
  return kind_ == Kind::kFile ? moveIntoPlace() : copyTo(folder_.path() / name_);
}

Status Output::commitAll(std::vector<Output*> outputs) {
  std::stable_partition(outputs.begin(), outputs.end(),
                        [](const Output* output) { return output->kind_ != Kind::kFile; });
  for (Output* const output : outputs)
    if (Status status = output->commit(); !status.ok()) return status;
  return Status();
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
  for (fs::directory_iterator entry(folder_.path(), error), end; !error && entry != end;
       entry.increment(error))
    staged.push_back(entry->path());
  if (error)
    return ioError("cannot read " + quoted(folder_.path().string()) + ": " + error.message());
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
  OutputFolder result(path);
  std::error_code error;
  std::vector<fs::path> missing;
  fs::path folder = fs::path(path).lexically_normal();
  if (!folder.has_filename()) folder = folder.parent_path();
  for (; !folder.empty() && typeOf(folder) == fs::file_type::not_found;
       folder = folder.parent_path())
    missing.push_back(folder);
  for (auto next = missing.rbegin(); next != missing.rend(); ++next) {
    Result<Temporary> made = Temporary::makeUnlessEmpty(*next);
    if (!made.ok()) return made.status();
    result.created_.insert(result.created_.begin(), std::move(*made));
  }
  fs::create_directories(path, error);  // tells what else stands there
  if (error) return ioError("cannot create " + quoted(path) + ": " + error.message());
  return result;
}

}  // namespace tetrakis::tools
