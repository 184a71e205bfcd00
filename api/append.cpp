// SPDX-License-Identifier: Apache-2.0
// tks_append() and its siblings give an open decoder more bytes of its stream, and others tell how
// finely the bytes that are there show heights and texture.
#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "api/decoder.hpp"
#include "api/group_chain.hpp"
#include "api/index_pages.hpp"
#include "base/shown_text.hpp"
#include "bitstream/track/track.hpp"

namespace tetrakis::inline api {

// Bytes may come in their order, or from anywhere.

void forget(tks_decoder& decoder) {
  decoder.remembers = false;
  decoder.heights_memory = {};
  decoder.texture_memory = {};
}

void forgetWindows(tks_decoder& decoder) {
  decoder.most_of_windows = 0;
  decoder.heights_windows = {};
  decoder.texture_windows = {};
}

namespace {

/// Takes the packets apart that are there now. Heights that were decoded stay if nothing changes
/// them: with a gap prefixes are not rounded.
Status retakePackets(tks_decoder& decoder, std::span<const ByteRange> ranges) {
  const uint64_t bytes = decoder.packets.payload.bytes[0];
  const bool has_gap = decoder.packets.has_gap;
  const Status status = takeMorePackets(decoder, ranges);
  if (decoder.packets.payload.bytes[0] != bytes || decoder.packets.has_gap != has_gap)
    decoder.heights.reset();
  return status;
}

/// The stream ends for the decoder where it was.
Status refuse(tks_decoder& decoder, const Status& status) {
  decoder.refused = Status(status);  // copied first: a copy may end memory
  return status;
}

Status tooManyBytes(const tks_decoder& decoder) {
  return {TKS_LIMIT, "The bytes of the stream take more memory than the limit (max_memory) of " +
                         describeBytes(decoder.max_memory) + "."};
}

/// Bytes from a place of the stream on.
struct Run {
  uint64_t place;
  std::span<const uint8_t> bytes;
};

/// Whether the decoder may take them, in their order.
Status check(const tks_decoder& decoder, std::span<const Run> runs) {
  const bool anywhere = hasIndex(decoder);
  uint64_t next = decoder.data.size();
  for (const auto& [place, bytes] : runs) {
    if (bytes.size() > std::numeric_limits<uint64_t>::max() - place)
      return {TKS_USAGE, "No stream has so many bytes."};
    if (bytes.empty()) continue;
    if (place > next && !anywhere) {
      return {TKS_USAGE, "The stream has no index, so that its bytes come in their order: byte " +
                             std::to_string(next) + " is the next."};
    }
    next = std::max(next, place + bytes.size());
  }
  return {};
}

/// From here on the decoder needs no byte of the caller's.
void keepBytes(tks_decoder& decoder) {
  if (!decoder.pieces.empty()) return;
  decoder.packets.borrowed.joinAll(decoder.packets.payload);
  decoder.pieces.put(0, decoder.data);
  decoder.data = decoder.pieces.from(0);
}

/// The time follows from the bytes of the runs, however many there are of the stream.
Status putShown(tks_decoder& decoder, std::span<const Run> runs) {
  if (const Status status = check(decoder, runs); !status.ok()) return status;
  uint64_t more = 0;
  for (const Run& run : runs) more += run.bytes.size();
  if (more == 0) return {};
  if (!decoder.refused.ok()) return decoder.refused;
  const uint64_t held = decoder.pieces.empty() ? decoder.data.size() : decoder.pieces.bytes();
  if (held + more > decoder.max_memory) return refuse(decoder, tooManyBytes(decoder));
  const size_t front = decoder.data.size();
  decoder.is_lost = true;  // if memory ends on the way
  keepBytes(decoder);
  std::vector<ByteRange> ranges;
  for (const auto& [place, bytes] : runs) ranges.push_back({place, place + bytes.size()});
  for (const auto& [place, bytes] : runs) {
    decoder.pieces.put(place, bytes);
    decoder.data = decoder.pieces.from(0);
  }
  const Status status = retakePackets(decoder, ranges);
  decoder.is_lost = false;
  if (!status.ok()) {
    decoder.data = decoder.data.first(front);
    return refuse(decoder, status);
  }
  decoder.remembers = true;
  return {};
}

/// The decoder goes on as one of the stream whose sketch it showed. If memory ends on the way it is
/// lost.
Status takeInPlace(tks_decoder& decoder) {
  const SketchedBytes& sketched = *decoder.sketched;
  const ComponentChoice choice = decoder.parsed.header.choice;
  Result<OwnedDecoder> opened = openBehind(sketched.all, &decoder.limits, {}, choice);
  if (opened.status().code() == TKS_USAGE)  // the stream has no component of that number and kind
    opened = openBehind(sketched.all, &decoder.limits, {});
  if (!opened.ok()) {
    decoder.is_lost = false;
    return refuse(decoder, opened.status());
  }
  tks_decoder& next = **opened;
  keepBytes(next);
  const StreamHeader& header = next.parsed.header;
  next.heights_level = std::min(decoder.heights_level, coarsestLevelOf(header.geometry));
  next.texture_level = std::min(decoder.texture_level, coarsestLevelOf(header.texture));
  next.threads = decoder.threads;
  next.remembers = true;
  decoder = std::move(next);
  return {};
}

/// Of a decoder that shows a sketch: bytes come in their order, and some of them are the sketch's.
Status putSketched(tks_decoder& decoder, std::span<const Run> runs) {
  if (!decoder.refused.ok()) return decoder.refused;
  SketchedBytes& sketched = *decoder.sketched;
  const uint64_t before = sketched.all.size();
  uint64_t end = before;
  for (const auto& [place, bytes] : runs) {
    if (place > end)
      return {TKS_USAGE,
              "The header of the stream is not there yet, so that its bytes come in "
              "their order: byte " +
                  std::to_string(end) + " is the next."};
    if (bytes.size() > std::numeric_limits<uint64_t>::max() - place)
      return {TKS_USAGE, "No stream has so many bytes."};
    end = std::max(end, place + bytes.size());
  }
  if (end == before) return {};
  if (end > decoder.max_memory) return refuse(decoder, tooManyBytes(decoder));
  decoder.is_lost = true;  // if memory ends on the way
  keepBytes(decoder);
  if (sketched.own.empty()) sketched.own.assign(sketched.all.begin(), sketched.all.end());
  for (const auto& [place, bytes] : runs) {
    const uint64_t known = std::min<uint64_t>(sketched.own.size() - place, bytes.size());
    sketched.own.insert(sketched.own.end(), bytes.begin() + static_cast<ptrdiff_t>(known),
                        bytes.end());
  }
  sketched.all = sketched.own;
  if (!(shownIn(sketched.all) == sketched.shown)) return takeInPlace(decoder);
  decoder.is_lost = false;
  const std::span<const uint8_t> shown = sketched.shown.of(sketched.all);
  const Run run{decoder.data.size(), shown.subspan(decoder.data.size())};
  return putShown(decoder, {&run, 1});
}

Status put(tks_decoder& decoder, std::span<const Run> runs) {
  return decoder.sketched ? putSketched(decoder, runs) : putShown(decoder, runs);
}

/// How many bytes of the stream, or of what it is a sketch of, are there.
uint64_t bytesThere(const tks_decoder& decoder) {
  return decoder.sketched ? decoder.sketched->all.size() : decoder.data.size();
}

}  // namespace

}  // namespace tetrakis::inline api

tks_status tks_append(tks_decoder* decoder, const uint8_t* data, size_t size) {
  if (data == nullptr && size != 0) return TKS_USAGE;
  return tetrakis::keeping(decoder, [&] {
    const tetrakis::Run run{tetrakis::bytesThere(*decoder), {data, size}};
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

namespace tetrakis::inline api {

// How finely the bytes that are there tell of heights and texture.

namespace {

/// An eighth of a bit for each.
constexpr uint64_t kSamplesOfByte = 64;

/// The finest level from `first` on at which so many samples of level 0 share the bytes.
int levelFedBy(uint64_t bytes, uint64_t samples, int first) {
  int level = first;
  while (samples >> (2 * level) > kSamplesOfByte * bytes) ++level;
  return level;
}

int fedLevel(const tks_decoder& decoder, Component component, const auto& of_stream) {
  if (isComplete(decoder)) return 0;
  const auto& header = *of_stream;
  int fed = coarsestLevelOf(of_stream);
  const auto regions =
      regionsOf(header.width, header.height, header.regions.side_log2, header.wavelet.patches());
  for (size_t i = 0; i < regions.size(); ++i) {
    const uint64_t bytes = decoder.packets.bytesOf(component, static_cast<uint32_t>(i));
    if (bytes == 0) continue;
    const Region& region = regions[i];
    const uint64_t samples = uint64_t{region.x1 - region.x0} * (region.y1 - region.y0);
    fed = std::min(fed, levelFedBy(bytes, samples, region.first_level - 1));
  }
  return fed;
}

Status giveFedLevel(const tks_decoder& decoder, tks_part part, uint32_t* level) {
  if (level == nullptr) return outputMissing();
  if (part != TKS_PART_HEIGHTS && part != TKS_PART_TEXTURE)
    return {TKS_USAGE, "Levels are fed of heights or of a texture."};
  if (const auto views = askedViews(decoder, part, nullptr); !views.ok()) return views.status();
  const StreamHeader& header = decoder.parsed.header;
  *level = static_cast<uint32_t>(part == TKS_PART_TEXTURE
                                     ? fedLevel(decoder, Component::kTexture, header.texture)
                                     : fedLevel(decoder, Component::kGeometry, header.geometry));
  return {};
}

}  // namespace

}  // namespace tetrakis::inline api

tks_status tks_fed_level(tks_decoder* decoder, tks_part part, uint32_t* level) {
  return tetrakis::keeping(decoder, [&] { return tetrakis::giveFedLevel(*decoder, part, level); });
}
