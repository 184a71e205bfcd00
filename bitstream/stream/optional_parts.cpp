// SPDX-License-Identifier: Apache-2.0
#include "bitstream/stream/optional_parts.hpp"

#include <algorithm>

namespace tetrakis::inline stream {

void writeOptionalParts(const std::vector<OptionalPart>& parts, FieldWriter& out) {
  for (const OptionalPart& part : parts) {
    out.put(static_cast<uint64_t>(part.kind));
    std::string bytes = part.bytes;
    out.text("part", bytes);
  }
}

std::vector<OptionalPart> readOptionalParts(std::span<const uint8_t> rest) {
  std::vector<OptionalPart> parts;
  FieldReader reader(rest);
  while (reader.position() < rest.size() && parts.size() < kMostOptionalParts) {
    OptionalPart part{OptionalKind{reader.take()}, {}};
    reader.text("part", part.bytes);
    if (!reader.ok()) break;
    parts.push_back(std::move(part));
  }
  return parts;
}

const std::string* findPart(const std::vector<OptionalPart>& parts, OptionalKind kind) {
  const auto found = std::find_if(parts.begin(), parts.end(),
                                  [kind](const OptionalPart& part) { return part.kind == kind; });
  return found == parts.end() ? nullptr : &found->bytes;
}

}  // namespace tetrakis::inline stream
