// SPDX-License-Identifier: Apache-2.0
// CameraPictures writes what cameras see as PNGs into a folder, in the order of the cameras:
// picture-1.png and so on, and the pictures of the original as original-1.png and so on.
#pragma once

#include <string>
#include <vector>

#include "apps/tools/output/output.hpp"
#include "apps/tools/render/render.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::tools {

class CameraPictures {
 public:
  /// Plans the files of so many cameras; the folder is made if it is missing.
  static Result<CameraPictures> plan(const std::string& folder, size_t cameras, bool force);

  /// Writes all of them or none.
  Status write(const std::vector<Picture>& pictures, const std::vector<Picture>& originals);

 private:
  explicit CameraPictures(OutputFolder folder) : folder_(std::move(folder)) {}

  OutputFolder folder_;
  std::vector<Output> pictures_, originals_;
};

}  // namespace tetrakis::tools
