// SPDX-License-Identifier: Apache-2.0
// toolsOf() tells from the header of a stream which tools of the format the stream uses, and
// toolsStatedFor() tells which tools each vector is meant to test. If an encoder that chooses in
// another way leaves a vector without its tool, the maker of vectors and their test fail.
#pragma once

#include <set>
#include <string>

#include "bitstream/stream/header.hpp"

namespace tetrakis::conformance {

using Tools = std::set<std::string>;

/// Those of a stream; none of one that does not open.
Tools toolsOf(std::span<const uint8_t> stream);

/// Those that a vector states, by its name. Of a name that the table lacks: "not stated".
Tools toolsStatedFor(const std::string& name);

/// All tools that there are.
Tools allTools();

/// TKS_MISMATCH with a sentence where a vector's stream has other tools than it states.
Status checkTools(const std::string& name, std::span<const uint8_t> stream);

}  // namespace tetrakis::conformance
