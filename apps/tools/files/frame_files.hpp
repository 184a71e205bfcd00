// SPDX-License-Identifier: Apache-2.0
// filesOf() turns a pattern like 'frames/*.tif' into the names of the frames of a sequence, in
// their order: quoted, a pattern reaches the program as it is, however many files there are.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tetrakis/result.hpp"

namespace tetrakis::tools {

/// Whether a path has a *, ? or [ and is no file itself.
bool isPattern(const std::string& path);

/// The files that a pattern names, sorted; of another path, that path. TKS_IO: there is none.
Result<std::vector<std::string>> filesOf(const std::string& pattern);

/// The files of each frame.
struct FrameNames {
  std::vector<std::string> heights, textures;  ///< empty: frames have none

  size_t count() const { return heights.empty() ? textures.size() : heights.size(); }
  /// "": there is none.
  std::string height(size_t frame) const { return heights.empty() ? "" : heights[frame]; }
  std::string texture(size_t frame) const { return textures.empty() ? "" : textures[frame]; }
};

/// Patterns, of which one may be "". TKS_USAGE: they name unlike numbers of files.
Result<FrameNames> frameNames(const std::string& heights, const std::string& textures);

}  // namespace tetrakis::tools
