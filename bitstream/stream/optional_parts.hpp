// SPDX-License-Identifier: Apache-2.0
// Optional parts of the header (docs/FORMAT.md, section 2): they stand behind all others, and
// whoever does not know the kind of one skips it. Decoding does not depend on them.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "bitstream/stream/fields.hpp"

namespace tetrakis::inline stream {

enum class OptionalKind : uint64_t { kHeightPositions = 1, kTexturePositions = 2 };

struct OptionalPart {
  OptionalKind kind{};  ///< of later versions: any value
  std::string bytes;
};

inline constexpr size_t kMostOptionalParts = 16;

void writeOptionalParts(const std::vector<OptionalPart>& parts, FieldWriter& out);

/// Those in the rest of a body, up to the first that the body does not hold whole.
std::vector<OptionalPart> readOptionalParts(std::span<const uint8_t> rest);

/// The first of that kind, or null.
const std::string* findPart(const std::vector<OptionalPart>& parts, OptionalKind kind);

}  // namespace tetrakis::inline stream
