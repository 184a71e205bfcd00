// SPDX-License-Identifier: Apache-2.0
// Opens any bytes as a stream: header, limits, packets. Nothing is decoded yet. How many bytes that
// takes can be asked for first.
#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "api/decoder.hpp"
#include "api/group_chain.hpp"
#include "api/guarded.hpp"
#include "api/index_pages.hpp"
#include "api/memory.hpp"

namespace tetrakis::inline api {

namespace {

constexpr uint64_t kDefaultSamples = uint64_t{1} << 28;
constexpr uint64_t kDefaultMemory = uint64_t{8} << 30;

constexpr uint64_t kShareOfWindows = 32;  ///< of max_memory, for the tracks of each component

/// What can be addressed, whatever the limits: so many samples of at most 8 bytes, so that no
/// size_t wraps, and so many bytes of one object. Only programs of 32 bits meet these.
constexpr uint64_t kMostSamples = std::numeric_limits<size_t>::max() / 8;
constexpr uint64_t kMostMemory = std::numeric_limits<ptrdiff_t>::max();

Status exceeds(const char* what, uint64_t value, uint64_t limit) {
  return {TKS_LIMIT, "The stream holds " + std::to_string(value) + " " + what + "; the limit is " +
                         std::to_string(limit) + "."};
}

uint64_t limitOf(uint64_t given, uint64_t fallback, uint64_t most) {
  return std::min(given != 0 ? given : fallback, most);
}

Status checkSizes(const StreamHeader& header, const tks_limits& limits) {
  const uint64_t most_samples = limitOf(limits.max_samples, kDefaultSamples, kMostSamples);
  const uint64_t most_texels = limitOf(limits.max_texels, kDefaultSamples, kMostSamples);
  if (header.geometry) {
    const Extent shown = header.geometry->shown();
    const uint64_t samples = uint64_t{shown.width} * shown.height;
    if (samples > most_samples) return exceeds("height samples", samples, most_samples);
  }
  if (header.texture) {
    const Extent shown = header.texture->shown();
    const uint64_t texels = uint64_t{shown.width} * shown.height;
    if (texels > most_texels) return exceeds("texels", texels, most_texels);
  }
  return {};
}

/// Made for windows if all packets of a region follow one another. (The base, which all regions
/// need, may have some at the end as well.)
tks_index indexOf(const StreamHeader& header) {
  if (header.index.empty()) return TKS_INDEX_NONE;
  std::array<std::vector<uint32_t>, kComponents> pieces;  // the region of each
  for (const IndexEntry& entry : header.index) {
    const PacketHead& packet = entry.packet;
    if (packet.component == Component::kOther || packet.track == 0) continue;
    std::vector<uint32_t>& of = pieces[static_cast<size_t>(packet.component)];
    if (of.empty() || of.back() != packet.track) of.push_back(packet.track);
  }
  for (std::vector<uint32_t>& of : pieces) {
    std::sort(of.begin(), of.end());
    if (std::adjacent_find(of.begin(), of.end()) != of.end()) return TKS_INDEX_PACKETS;
  }
  return pieces[0].empty() && pieces[1].empty() ? TKS_INDEX_PACKETS : TKS_INDEX_WINDOWS;
}

/// Gives the components what their frames go on from.
Status takeReferences(const References& references, StreamHeader& header) {
  const auto take = [](auto& component, const ReferenceSource& before) {
    if (!component || component->frames.reference == 0) return true;
    component->frames.before = before;
    return !before.none();
  };
  if (take(header.geometry, references.heights) && take(header.texture, references.texture))
    return {};
  return {TKS_UNSUPPORTED,
          "The frames of the stream go on from those of another one: it is decoded as a part of "
          "its sequence."};
}

/// The stream that is shown of the caller's bytes.
Result<std::span<const uint8_t>> shownOf(std::span<const uint8_t> data, tks_decoder& decoder) {
  const ShownStream shown = shownIn(data);
  if (!shown.isSketch()) return data;
  const Result<uint64_t> header = headerBytes(data), stream = streamBytes(data);
  if (!stream.ok()) return stream.status();
  decoder.sketched = SketchedBytes{shown, data, {}, *header, *stream};
  return shown.of(data);
}

Status open(std::span<const uint8_t> bytes, const tks_limits* limits, const References& references,
            const ComponentChoice& choice, tks_decoder& decoder) {
  const Result<std::span<const uint8_t>> data = shownOf(bytes, decoder);
  if (!data.ok()) return data.status();
  decoder.data = *data;
  tks_limits& known = decoder.limits;
  known.size = sizeof known;
  if (limits != nullptr) {
    if (Status status = takeSized("the limits", *limits, sizeof limits->size, known); !status.ok())
      return status;
  }
  Result<ParsedHeader> parsed = readHeader(decoder.data, choice);
  if (!parsed.ok() && decoder.sketched && parsed.status().code() == TKS_TRUNCATED)
    return needMore(*leastBytes(bytes));
  if (!parsed.ok()) return parsed.status();
  decoder.parsed = std::move(*parsed);
  const StreamHeader& header = decoder.parsed.header;
  if (Status status = checkSizes(header, known); !status.ok()) return status;
  if (Status status = takeReferences(references, decoder.parsed.header); !status.ok())
    return status;
  if (header.geometry && !header.geometry->base_mesh.none())
    decoder.base_mesh = decodeBaseMesh(header.geometry->base_mesh, header.geometry->wavelet.forest);
  if (header.geometry) {
    decoder.base = header.geometry->base;
    decoder.step = header.geometry->step;
    showScale(decoder);
  }
  decoder.pages = PageIndex::of(decoder.parsed);
  decoder.index = decoder.pages ? TKS_INDEX_PAGES : indexOf(header);
  decoder.max_memory = limitOf(known.max_memory, kDefaultMemory, kMostMemory);
  decoder.most_of_windows = decoder.max_memory / kShareOfWindows;
  Result<TakenPackets> taken = takePackets(decoder);
  if (!taken.ok()) return taken.status();
  decoder.packets = *std::move(taken);
  return {};
}

/// Whether a byte of the stream is there behind one that is missing.
bool hasGap(const tks_decoder& decoder) {
  const uint64_t end = decoder.parsed.bytes + decoder.parsed.header.payload_bytes;
  return decoder.data.size() < end && decoder.pieces.hasAny({decoder.data.size(), end});
}

/// The bytes behind the header, up to the first that is missing.
std::span<const uint8_t> payloadOf(const tks_decoder& decoder) {
  const std::span<const uint8_t> behind = decoder.data.subspan(decoder.parsed.bytes);
  return behind.first(
      static_cast<size_t>(std::min<uint64_t>(behind.size(), decoder.parsed.header.payload_bytes)));
}

/// The bytes that it takes to take so much apart, if the decoder may take them.
Result<uint64_t> memoryFor(const tks_decoder& decoder, PayloadCount count) {
  if (!decoder.pieces.empty()) {
    count.bytes = decoder.pieces.bytes();
    count.packets = std::max(count.packets, knownPackets(decoder));
  }
  const bool scattered = decoder.scattered || hasGap(decoder);
  const uint64_t bytes = payloadBytes(count, trackCounts(decoder.parsed.header)) +
                         (scattered ? ScatteredPackets::bytesOf(knownPackets(decoder)) : 0) +
                         (decoder.pages ? decoder.pages->bytes() : 0);
  if (bytes + decoder.pieces.bytes() <= decoder.max_memory) return bytes;
  return Status(TKS_LIMIT, "Opening the stream takes " + describeBytes(bytes) +
                               " of memory; the limit (max_memory) is " +
                               describeBytes(decoder.max_memory) + ".");
}

}  // namespace

Result<TakenPackets> takePackets(const tks_decoder& decoder) {
  const size_t start = decoder.parsed.bytes;
  const std::span<const uint8_t> payload = payloadOf(decoder);
  const TrackCounts tracks = trackCounts(decoder.parsed.header);
  const Result<PayloadCount> count = countPackets(payload, start, tracks);
  if (!count.ok()) return count.status();
  const Result<uint64_t> bytes = memoryFor(decoder, *count);
  if (!bytes.ok()) return bytes.status();
  TakenPackets taken;
  taken.bytes = *bytes;
  taken.payload.counts = tracks;
  taken.payload.heads.reserve(count->packets);
  if (Status status = passHeads(payload, start, taken.payload); !status.ok()) return status;
  taken.borrowed = BorrowedPackets(payload, taken.payload);
  return taken;
}

uint64_t TakenPackets::bytesOf(Component component, uint32_t track) const {
  const auto& joined = payload.codewords[static_cast<size_t>(component)];
  const auto found = joined.find(track);
  return found != joined.end() ? found->second.size() : borrowed.bytesOf(component, track);
}

namespace {

/// Of a stream that has only grown at its end.
Status takeFollowing(tks_decoder& decoder) {
  const std::span<const uint8_t> payload = payloadOf(decoder);
  Demultiplexed& taken = decoder.packets.payload;
  Result<PayloadCount> count = countPackets(payload, decoder.parsed.bytes, taken.counts, taken.end);
  if (!count.ok()) return count.status();
  count->packets += taken.heads.size();
  const Result<uint64_t> bytes = memoryFor(decoder, *count);
  if (!bytes.ok()) return bytes.status();
  decoder.packets.bytes = *bytes;
  return demultiplexMore(payload, decoder.parsed.bytes, taken);
}

/// What the index says of the packets, compared with all that was there before the first gap.
Status makeScattered(tks_decoder& decoder) {
  const TakenPackets& before = decoder.packets;
  decoder.scattered.emplace(decoder.parsed, before.payload);
  const ByteRange front{decoder.parsed.bytes, decoder.parsed.bytes + before.payload.end.at + 1};
  Status status = decoder.scattered->check(decoder.pieces, front);
  if (!status.ok()) decoder.scattered.reset();
  return status;
}

/// fresh: pages of the index that were not known before.
Status takeScattered(tks_decoder& decoder, std::span<const ByteRange> ranges,
                     std::vector<uint32_t> fresh) {
  const Result<uint64_t> bytes = memoryFor(decoder, {});
  if (!bytes.ok()) return bytes.status();
  if (!decoder.scattered) {
    if (Status status = makeScattered(decoder); !status.ok()) return status;
    if (decoder.pages) fresh = decoder.pages->known();
  }
  std::vector<PagedPacket> listed;
  if (decoder.pages) listed = decoder.pages->inOrder(fresh);
  if (Status status = decoder.scattered->check(decoder.pieces, listed); !status.ok()) return status;
  for (const ByteRange& range : ranges) {
    if (Status status = decoder.scattered->check(decoder.pieces, range); !status.ok())
      return status;
  }
  TakenPackets& taken = decoder.packets;
  taken.bytes = *bytes;
  if (!listed.empty()) decoder.scattered->take(decoder.pieces, listed, taken.payload);
  for (const ByteRange& range : ranges)
    decoder.scattered->take(decoder.pieces, range, taken.payload);
  const Status passed = passHeads(payloadOf(decoder), decoder.parsed.bytes, taken.payload);
  if (passed.ok() && decoder.pages)
    decoder.scattered->takeFront(decoder.pieces, *decoder.pages, taken.payload);
  taken.has_gap = hasGap(decoder);
  const auto [heights, texture] = decoder.scattered->settle(taken.has_gap, taken.payload);
  if (heights) decoder.heights_memory = decoder.heights_windows = {};
  if (texture) decoder.texture_memory = decoder.texture_windows = {};
  return passed;
}

}  // namespace

Status takeMorePackets(tks_decoder& decoder, std::span<const ByteRange> ranges) {
  Result<std::vector<uint32_t>> fresh = takeRecords(decoder, ranges);
  if (!fresh.ok()) return fresh.status();
  if (decoder.scattered || hasGap(decoder)) return takeScattered(decoder, ranges, *fresh);
  return takeFollowing(decoder);
}

Result<OwnedDecoder> openBehind(std::span<const uint8_t> data, const tks_limits* limits,
                                const References& references, const ComponentChoice& choice) {
  OwnedDecoder decoder(new tks_decoder, tks_close);
  if (Status status = open(data, limits, references, choice, *decoder); !status.ok()) return status;
  return decoder;
}

}  // namespace tetrakis::inline api

tks_status tks_header_bytes(const uint8_t* data, size_t size, uint64_t* bytes) {
  if (bytes == nullptr || (data == nullptr && size != 0)) return TKS_USAGE;
  *bytes = 0;
  return tetrakis::answering([&]() -> tetrakis::Status {
    const auto needed = tetrakis::leastBytes({data, size});
    if (!needed.ok()) return needed.status();
    *bytes = *needed;
    if (*needed > size) return {TKS_TRUNCATED, "The header is cut short."};
    return {};
  });
}

tks_status tks_open(const uint8_t* data, size_t size, const tks_limits* limits, tks_decoder** out,
                    char* message, size_t message_size) {
  if (out != nullptr) *out = nullptr;
  return tetrakis::reporting(message, message_size, [&]() -> tetrakis::Status {
    if (out == nullptr) return tetrakis::outputMissing();
    if (data == nullptr && size != 0) return {TKS_USAGE, "The bytes of the stream are missing."};
    tetrakis::Result<tetrakis::OwnedDecoder> opened =
        tetrakis::openBehind({data, size}, limits, {});
    if (!opened.ok()) return opened.status();
    *out = opened->release();
    return {};
  });
}

void tks_close(tks_decoder* decoder) {
  delete decoder;
}

const char* tks_message(const tks_decoder* decoder) {
  return decoder ? decoder->sentence : "";
}

tks_status tks_set_threads(tks_decoder* decoder, uint32_t threads) {
  if (decoder == nullptr) return TKS_USAGE;
  decoder->threads = threads;
  return TKS_OK;
}
