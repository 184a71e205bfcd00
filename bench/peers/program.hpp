// SPDX-License-Identifier: Apache-2.0
// Programs of other codecs, and a folder for what they read and write.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tetrakis/result.hpp"

namespace tetrakis::bench {

/// A folder of its own, which is gone with its files at the end.
class TemporaryFolder {
 public:
  TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder();

  bool made() const { return !path_.empty(); }
  std::string file(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

/// Runs a program, found on the PATH, to its end; what it prints goes to the file `log`. words: its
/// name and arguments. TKS_UNSUPPORTED if it does not start, TKS_MISMATCH if it fails.
Status runProgram(std::vector<std::string> words, const std::string& log);

}  // namespace tetrakis::bench
