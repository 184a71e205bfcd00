// SPDX-License-Identifier: Apache-2.0
// Temporary is a file or folder that must not outlive the process, even if a signal ends the
// process.
#pragma once

#include <filesystem>

#include "tetrakis/result.hpp"

namespace tetrakis::tools {

/// Owns one such file or folder and removes it, with all that is in it. Move only.
class Temporary {
 public:
  /// Owns nothing; path() is empty.
  Temporary() = default;
  /// A new hidden folder in `parent`.
  static Result<Temporary> makeFolder(const std::filesystem::path& parent);
  /// A new empty file in the system's folder for temporary files.
  static Result<Temporary> makeFile();
  /// A new folder of this name, which is kept if there is something in it at the end.
  static Result<Temporary> makeUnlessEmpty(const std::filesystem::path& path);

  Temporary(Temporary&& other) noexcept;
  Temporary& operator=(Temporary&& other) noexcept;
  ~Temporary();
  const std::filesystem::path& path() const { return path_; }

 private:
  explicit Temporary(std::filesystem::path path) : path_(std::move(path)) {}
  std::filesystem::path path_;
};

/// Puts the folder `made` in the place of the folder `target`, which goes to `aside`; signals wait
/// till both are there. Where that fails, `target` is what it was.
Status replaceFolder(const std::filesystem::path& made, const std::filesystem::path& target,
                     const std::filesystem::path& aside);

/// For the start of main, before there are other threads: from here on SIGHUP, SIGINT and SIGTERM
/// (unless they are ignored) remove all that Temporaries own, then end the process as they do by
/// themselves. A pipe without a reader becomes an error of the write instead of a signal.
void cleanUpOnSignals();

}  // namespace tetrakis::tools
