// SPDX-License-Identifier: Apache-2.0
// combinedHeader() makes the header of a stream of the components of several parts: those of the
// first part as they are, and of the others each with its name, its place and its promises, unless
// it is the first heights or the first texture of all.
#pragma once

#include <cstdint>
#include <vector>

#include "encoder/combination/combined_part.hpp"

namespace tetrakis::inline combination {

struct CombinedHeader {
  StreamHeader header;
  std::vector<std::vector<uint8_t>> numbers;  ///< of the components of each part in its list

  /// It says that samples are exact, or within an error.
  bool promisesSomething() const {
    const bool bound = header.geometry && header.geometry->max_error >= 0;
    return header.lossless > 0 || bound;
  }
};

/// promises: the parts' promises hold, since nothing of theirs is left out. TKS_USAGE: there are
/// too many components, or two of a kind with one name.
Result<CombinedHeader> combinedHeader(const std::vector<CombinedPart>& parts, bool promises);

}  // namespace tetrakis::inline combination
