// SPDX-License-Identifier: Apache-2.0
// Streams whose header begins with a sketch: a stream that is shown until the header is there.
#include <cstddef>

#include "conformance/cases/cases.hpp"
#include "conformance/cases/crafted_streams.hpp"

namespace tetrakis::conformance {
namespace {

Bytes heights(uint32_t side, size_t bytes, uint32_t seed) {
  return streamOf(heightsHeader(side, side, TKS_I16, 8), noise(bytes, seed));
}

/// Heights, with a header that begins with these bytes as its sketch.
Bytes sketched(uint32_t side, const Bytes& sketch, uint32_t seed) {
  StreamHeader header = heightsHeader(side, side, TKS_I16, 8);
  header.sketch.assign(sketch.begin(), sketch.end());
  return streamOf(header, noise(120, seed));
}

/// The stream with other bytes from a place of its body on, whose first byte is payload_bytes. All
/// such bodies are shorter than 128 bytes.
Bytes withInserted(const Bytes& stream, size_t place, const Bytes& part) {
  constexpr size_t kBody = 8, kChecksum = 4;  // where the body begins
  const size_t end = kBody + stream[kBody - 1];
  Bytes made(stream.begin(), stream.begin() + static_cast<ptrdiff_t>(end));
  made[kBody - 1] = static_cast<uint8_t>(made[kBody - 1] + part.size());
  made.insert(made.begin() + static_cast<ptrdiff_t>(kBody + place), part.begin(), part.end());
  const uint32_t crc = crc32(made);
  for (int i = 0; i < 4; ++i) made.push_back(static_cast<uint8_t>(crc >> (8 * i)));
  made.insert(made.end(), stream.begin() + static_cast<ptrdiff_t>(end + kChecksum), stream.end());
  return made;
}

/// Part 75 with these bytes, of which it says that they are so many.
Bytes part(const Bytes& bytes, size_t told) {
  Bytes made = varint(75);
  append(made, varint(told));
  append(made, bytes);
  return made;
}

VectorCase damagedCase() {
  Bytes stream = sketched(20, heights(9, 60, 262), 263);
  stream[*headerBytes(stream) - 1] ^= 1;
  return crafted("refused_sketch_crc", "a sketch in a header whose checksum is wrong", stream);
}

}  // namespace

std::vector<VectorCase> sketchCases() {
  const Bytes plain = heights(9, 60, 264), small = heights(5, 20, 265);
  const size_t behind_heights = plain[7];
  Bytes unsound = small;
  unsound[unsound.size() - 21] = 0xFE;  // the head of its packet: a component that is not there
  return {
      crafted("sketch_33x33", "a sketch of other samples", sketched(33, heights(9, 90, 266), 267)),
      crafted("sketch_twice_33x33", "a sketch that begins with a sketch, which nobody shows",
              sketched(33, sketched(17, heights(5, 30, 268), 269), 270)),
      crafted("sketch_unsound_20x20", "a sketch whose packet is corrupt",
              sketched(20, unsound, 271)),
      crafted("sketch_late_9x9", "a sketch behind other parts, which nobody shows",
              withInserted(plain, behind_heights, part(small, small.size()))),
      crafted("sketch_empty_9x9", "a sketch without a byte", withInserted(plain, 1, part({}, 0))),
      damagedCase(),
      crafted("refused_sketch_long", "a sketch that reaches past the end of the body",
              withInserted(plain, 1, part(small, 120)))};
}

}  // namespace tetrakis::conformance
