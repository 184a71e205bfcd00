// SPDX-License-Identifier: Apache-2.0
// Files that appear whole or not at all, by GDAL's virtual files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include <cpl_vsi.h>

namespace tetrakis::gdal {

/// A name for a file of this process alone, beside `name` where files can be renamed, else in
/// GDAL's folder of temporary files.
std::string temporaryNameFor(const std::string& name);

/// Whether it is there to be opened: /vsistdout/ has passed on what was written.
bool isFile(const std::string& name);

/// What was written; what is no file of its own, such as /dev/full, stays.
void discard(const std::string& name);

/// Other file systems of GDAL show a file when it is closed, or pass on what is written.
bool canBeRenamed(const std::string& name);

/// A file that gets its name when it is whole. Only where files can be renamed.
class StagedFile {
 public:
  explicit StagedFile(std::string name);
  ~StagedFile();
  StagedFile(const StagedFile&) = delete;
  StagedFile& operator=(const StagedFile&) = delete;

  /// False after a reported error, as everything here.
  bool open();
  bool write(uint64_t offset, std::span<const uint8_t> bytes);
  bool finish();

 private:
  std::string name_, staged_;
  VSILFILE* file_ = nullptr;
};

/// Where files can be renamed, nothing stands under the name before all bytes are written. False
/// after a reported error.
bool writeFile(const std::string& name, std::span<const uint8_t> bytes);

}  // namespace tetrakis::gdal
