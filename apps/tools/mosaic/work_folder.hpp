// SPDX-License-Identifier: Apache-2.0
// WorkFolder is the folder that the tasks of a mosaic share: the plan, the names of its sources,
// and the parts. It knows which tasks have to run, as make does: those whose parts are missing, of
// another plan, or older than what they were made from.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "apps/tools/mosaic/height_source.hpp"
#include "tetrakis/mosaic.h"
#include "tetrakis/result.hpp"

namespace tetrakis::tools {

/// "g0-x3-y5".
std::string nameOf(const tks_tile& tile);

/// A task, and what it takes to say whether it has to run.
struct MosaicTask {
  tks_tile tile;
  std::vector<tks_tile> needs;
  bool restores;    ///< what decoders will have, from parts of others
  bool is_last;     ///< no task needs it
  bool leaves_low;  ///< a low band beside its part
};

class WorkFolder {
 public:
  /// Makes the folder, with the plan and what it is a plan of. TKS_IO: there is a mosaic already,
  /// unless `force`.
  static Status create(const std::string& path, const std::vector<uint8_t>& plan,
                       const std::vector<std::string>& sources, const std::optional<double>& nodata,
                       bool force);
  /// TKS_IO: it holds no mosaic.
  static Result<WorkFolder> open(const std::string& path);

  const std::string& path() const { return path_; }
  const std::vector<uint8_t>& plan() const { return plan_; }
  const std::vector<MosaicTask>& tasks() const { return tasks_; }
  const std::vector<std::string>& sources() const { return sources_; }
  const std::optional<double>& nodata() const { return nodata_; }

  /// Whether the parts of a task are there, whole, and newer than the files that it reads. source:
  /// null: only parts are compared.
  bool isDone(const MosaicTask& task, const HeightSource* source) const;

  /// What the C interface reads and writes parts with; valid while this lives.
  tks_mosaic_files files() const;
  std::filesystem::path file(const std::string& name) const {
    return std::filesystem::path(path_) / name;
  }

 private:
  std::string path_;
  std::vector<uint8_t> plan_;
  std::vector<std::string> sources_;
  std::optional<double> nodata_;
  std::vector<MosaicTask> tasks_;
};

/// Description and reader of a source, for the C interface; valid while both live.
struct MosaicSource {
  explicit MosaicSource(HeightSource& from);
  MosaicSource(const MosaicSource&) = delete;
  MosaicSource& operator=(const MosaicSource&) = delete;

  static int read(void* user, const tks_window* window, void* samples);

  HeightSource& source;
  tks_heights heights;
  tks_mosaic_source given;
  Status failure;  ///< of the last reading that failed
};

}  // namespace tetrakis::tools
