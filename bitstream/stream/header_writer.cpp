// SPDX-License-Identifier: Apache-2.0
#include <cassert>
#include <utility>

#include "bitstream/stream/fields.hpp"
#include "bitstream/stream/header_body.hpp"

namespace tetrakis::inline stream {

std::vector<uint8_t> writeHeader(const StreamHeader& header) {
  assert(header.geometry || header.texture || !header.triangle_mesh.none());
  StreamHeader copy = header;
  copy.level = levelFor(header);
  copy.components = listOf(header);
  FieldWriter body;
  visitBody(body, copy);
  FieldWriter out;
  out.bytes.assign(kMagic.begin(), kMagic.end());
  out.bytes.insert(out.bytes.end(), {copy.version, copy.profile, copy.level});
  out.put(body.bytes.size());
  out.bytes.insert(out.bytes.end(), body.bytes.begin(), body.bytes.end());
  const uint32_t crc = crc32(out.bytes);
  for (int i = 0; i < 4; ++i) out.bytes.push_back(static_cast<uint8_t>(crc >> (8 * i)));
  return std::move(out.bytes);
}

}  // namespace tetrakis::inline stream
