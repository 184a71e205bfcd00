// SPDX-License-Identifier: Apache-2.0
// More bytes of a stream that is open: in their order, or from anywhere.
#include <limits>
#include <map>
#include <string>

#include "api/decoder.hpp"
#include "api/message.hpp"
#include "base/describe_bytes.hpp"

namespace tetrakis::inline api {

void forget(tks_decoder& decoder) {
  decoder.remembers = false;
  decoder.heights_memory.clear();
  decoder.texture_memory.clear();
}

namespace {

/// Of each track of the heights. Tracks only grow, so that equal sizes are equal bytes.
std::map<uint32_t, size_t> heightsKnown(const tks_decoder& decoder) {
  std::map<uint32_t, size_t> known;
  for (const auto& [track, codeword] : decoder.payload.codewords[0]) known[track] = codeword.size();
  return known;
}

Status put(tks_decoder& decoder, uint64_t place, std::span<const uint8_t> bytes) {
  if (bytes.empty()) return {};
  if (bytes.size() > std::numeric_limits<uint64_t>::max() - place)
    return {TKS_USAGE, "No stream has so many bytes."};
  if (place > decoder.data.size() && decoder.parsed.header.index.empty()) {
    return {TKS_USAGE,
            "The stream has no front index, so that its bytes come in their order: byte " +
                std::to_string(decoder.data.size()) + " is the next."};
  }
  const uint64_t held = decoder.pieces.empty() ? decoder.data.size() : decoder.pieces.bytes();
  if (held + bytes.size() > decoder.max_memory) {
    return {TKS_LIMIT, "The bytes of the stream take more memory than the limit (max_memory) of " +
                           describeBytes(decoder.max_memory) + "."};
  }
  const bool gap_before = held > decoder.data.size();
  if (decoder.pieces.empty()) decoder.pieces.put(0, decoder.data);
  decoder.pieces.put(place, bytes);
  decoder.data = decoder.pieces.from(0);
  const std::map<uint32_t, size_t> before = heightsKnown(decoder);
  if (Status status = takePackets(decoder); !status.ok()) return status;
  const bool gap = decoder.pieces.bytes() > decoder.data.size();  // then prefixes are not rounded
  if (heightsKnown(decoder) != before || gap != gap_before) decoder.heights.reset();
  decoder.remembers = true;
  return {};
}

}  // namespace

}  // namespace tetrakis::inline api

tks_status tks_append(tks_decoder* decoder, const uint8_t* data, size_t size) {
  if (data == nullptr && size != 0) return TKS_USAGE;
  return tetrakis::keeping(decoder, [&] {
    return tetrakis::put(*decoder, decoder->data.size(), {data, size});
  });
}

tks_status tks_put(tks_decoder* decoder, uint64_t offset, const uint8_t* data, size_t size) {
  if (data == nullptr && size != 0) return TKS_USAGE;
  return tetrakis::keeping(decoder, [&] { return tetrakis::put(*decoder, offset, {data, size}); });
}

tks_status tks_header_bytes(const uint8_t* data, size_t size, uint64_t* bytes) {
  if (bytes == nullptr || (data == nullptr && size != 0)) return TKS_USAGE;
  *bytes = 0;
  const tetrakis::Status status = tetrakis::guarded([&]() -> tetrakis::Status {
    const auto needed = tetrakis::headerBytes({data, size});
    if (!needed.ok()) return needed.status();
    *bytes = *needed;
    if (*needed > size) return {TKS_TRUNCATED, "The header is cut short."};
    return {};
  });
  return status.code();
}
