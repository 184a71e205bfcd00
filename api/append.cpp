// SPDX-License-Identifier: Apache-2.0
// More bytes of a stream that is open: in their order, or from anywhere.
#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "api/decoder.hpp"
#include "base/describe_bytes.hpp"

namespace tetrakis::inline api {

void forget(tks_decoder& decoder) {
  decoder.remembers = false;
  decoder.heights_memory.clear();
  decoder.texture_memory.clear();
}

namespace {

using Tracks = std::map<uint32_t, std::vector<uint8_t>>;

/// Whether each track begins with the bytes that it had. An index that names other tracks than the
/// packets do gives tracks bytes that are not theirs, until the packets' own heads are there.
bool haveGrown(const Tracks& before, const Tracks& now) {
  return std::all_of(before.begin(), before.end(), [&](const auto& track) {
    const auto& [number, had] = track;
    const auto has = now.find(number);
    return has != now.end() && had.size() <= has->second.size() &&
           std::equal(had.begin(), had.end(), has->second.begin());
  });
}

/// What was decoded stays only where it is still what the tracks say. With a gap prefixes are not
/// rounded.
void replacePackets(tks_decoder& decoder, TakenPackets taken) {
  const auto& before = decoder.packets.payload.codewords;
  const auto& now = taken.payload.codewords;
  if (before[0] != now[0] || taken.has_gap != decoder.packets.has_gap) decoder.heights.reset();
  if (!haveGrown(before[0], now[0])) decoder.heights_memory.clear();
  if (!haveGrown(before[1], now[1])) decoder.texture_memory.clear();
  decoder.packets = std::move(taken);
}

/// All bytes of the heights' tracks.
uint64_t bytesOfHeights(const tks_decoder& decoder) {
  uint64_t bytes = 0;
  for (const auto& [number, codeword] : decoder.packets.payload.codewords[0])
    bytes += codeword.size();
  return bytes;
}

/// Takes the packets apart that are there now. What was decoded of tracks that go on stays.
Status retakePackets(tks_decoder& decoder) {
  if (onlyGrew(decoder)) {
    const uint64_t before = bytesOfHeights(decoder);
    const Status status = takeMorePackets(decoder);
    if (bytesOfHeights(decoder) != before) decoder.heights.reset();
    return status;
  }
  Result<TakenPackets> taken = takePackets(decoder);
  if (taken.ok()) replacePackets(decoder, *std::move(taken));
  return taken.status();
}

/// The stream ends for the decoder where it was.
Status refuse(tks_decoder& decoder, const Status& status) {
  decoder.refused = Status(status);  // copied first: a copy may end memory
  return status;
}

/// Bytes from a place of the stream on.
struct Run {
  uint64_t place;
  std::span<const uint8_t> bytes;
};

/// Whether the decoder may take them, in their order.
Status check(const tks_decoder& decoder, std::span<const Run> runs) {
  const bool anywhere = !decoder.parsed.header.index.empty();
  uint64_t next = decoder.data.size();
  for (const auto& [place, bytes] : runs) {
    if (bytes.size() > std::numeric_limits<uint64_t>::max() - place)
      return {TKS_USAGE, "No stream has so many bytes."};
    if (bytes.empty()) continue;
    if (place > next && !anywhere) {
      return {TKS_USAGE,
              "The stream has no front index, so that its bytes come in their order: byte " +
                  std::to_string(next) + " is the next."};
    }
    next = std::max(next, place + bytes.size());
  }
  return {};
}

/// Packets are looked at once, however many runs there are; behind the bytes that were there only
/// those that are new.
Status put(tks_decoder& decoder, std::span<const Run> runs) {
  if (const Status status = check(decoder, runs); !status.ok()) return status;
  uint64_t more = 0;
  for (const Run& run : runs) more += run.bytes.size();
  if (more == 0) return {};
  if (!decoder.refused.ok()) return decoder.refused;
  const uint64_t held = decoder.pieces.empty() ? decoder.data.size() : decoder.pieces.bytes();
  if (held + more > decoder.max_memory) {
    const std::string limit = describeBytes(decoder.max_memory);
    return refuse(decoder, {TKS_LIMIT,
                            "The bytes of the stream take more memory than the limit "
                            "(max_memory) of " +
                                limit + "."});
  }
  const size_t front = decoder.data.size();
  decoder.is_lost = true;  // if memory ends on the way
  if (decoder.pieces.empty()) decoder.pieces.put(0, decoder.data);
  for (const auto& [place, bytes] : runs) decoder.pieces.put(place, bytes);
  decoder.data = decoder.pieces.from(0);
  const Status status = retakePackets(decoder);
  decoder.is_lost = false;
  if (!status.ok()) {
    decoder.data = decoder.data.first(front);
    return refuse(decoder, status);
  }
  decoder.remembers = true;
  return {};
}

}  // namespace

}  // namespace tetrakis::inline api

tks_status tks_append(tks_decoder* decoder, const uint8_t* data, size_t size) {
  if (data == nullptr && size != 0) return TKS_USAGE;
  return tetrakis::keeping(decoder, [&] {
    const tetrakis::Run run{decoder->data.size(), {data, size}};
    return tetrakis::put(*decoder, {&run, 1});
  });
}

tks_status tks_put(tks_decoder* decoder, uint64_t offset, const uint8_t* data, size_t size) {
  const tks_range range{offset, size, 0};
  return tks_put_ranges(decoder, &range, &data, 1);
}

tks_status tks_put_ranges(tks_decoder* decoder, const tks_range* ranges, const uint8_t* const* data,
                          size_t count) {
  if (count != 0 && (ranges == nullptr || data == nullptr)) return TKS_USAGE;
  return tetrakis::keeping(decoder, [&]() -> tetrakis::Status {
    std::vector<tetrakis::Run> runs;
    runs.reserve(count);
    for (size_t i = 0; i < count; ++i) {
      if (data[i] == nullptr && ranges[i].size != 0) return {TKS_USAGE, "A range has no bytes."};
      if (ranges[i].size > std::numeric_limits<size_t>::max())
        return {TKS_USAGE, "No stream has so many bytes."};
      runs.push_back({ranges[i].offset, {data[i], static_cast<size_t>(ranges[i].size)}});
    }
    return tetrakis::put(*decoder, runs);
  });
}
