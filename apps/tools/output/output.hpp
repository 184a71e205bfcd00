// SPDX-License-Identifier: Apache-2.0
// Output is a file that appears as a whole or not at all.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "apps/tools/files/temporary.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::tools {

/// One output of a command: a file, a device, or standard output ("-"). What is written is staged
/// in a temporary folder beside the file and renamed into place by commit(); without commit()
/// nothing is left behind. Standard output and devices (/dev/null, pipes) are staged in the
/// system's temporary folder and copied.
class Output {
 public:
  /// Refuses with TKS_IO a file that exists (unless `force`), a path that is a folder, and a folder
  /// that is missing or not writable. `extension` (".tif") tells the writer the format where the
  /// path does not: on standard output and devices.
  static Result<Output> plan(const std::string& path, bool force, const std::string& extension);

  /// Calls `write` with the path of a file to create; it may create others beside it (an .obj has
  /// its .mtl). Messages of `write` are passed on with the final name in place of the temporary
  /// one.
  Status stage(const std::function<Status(const std::string& path)>& write);

  /// The same for bytes in memory.
  Status stage(std::span<const std::byte> bytes);

  /// Of the main file; its extension is the format.
  const std::string& name() const { return name_; }

  /// Makes what was staged visible.
  Status commit();

  /// Makes all of them visible: first pipes, so that no file is there if one of them breaks.
  static Status commitAll(std::vector<Output*> outputs);

 private:
  enum class Kind { kFile, kDevice, kStdout };
  Output(std::filesystem::path path, Kind kind, bool force, std::string name);

  Status copyTo(const std::filesystem::path& staged);
  Status moveIntoPlace();

  std::filesystem::path path_;  ///< as given; a symbolic link is resolved
  Kind kind_;
  bool force_;
  std::string name_;  ///< name of the main file inside the staging folder
  Temporary folder_;  ///< staging folder, if there is one yet
};

/// A folder for outputs, created with its parents if they are missing, all removed again if they
/// stay empty.
class OutputFolder {
 public:
  static Result<OutputFolder> create(const std::string& path);

  std::string file(const std::string& name) const { return (path_ / name).string(); }

 private:
  explicit OutputFolder(std::filesystem::path path) : path_(std::move(path)) {}
  std::filesystem::path path_;
  std::vector<Temporary> created_;  ///< from the inside out
};

}  // namespace tetrakis::tools
