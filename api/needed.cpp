// SPDX-License-Identifier: Apache-2.0
#include "api/needed.hpp"

#include <algorithm>
#include <functional>
#include <optional>
#include <vector>

#include "api/index_pages.hpp"
#include "api/memory.hpp"
#include "bitstream/stream/geometry_header.hpp"
#include "bitstream/stream/scattered_packets.hpp"
#include "codec/geometry/heights_decoder.hpp"
#include "codec/geometry/region_masks.hpp"
#include "codec/lines/shown_lines.hpp"
#include "codec/wavelet/synthesis/view_synthesis.hpp"
#include "codec/wavelet/wavelet.hpp"

namespace tetrakis::inline api {

namespace {

/// For each track of coefficients, by its number, whether the view needs it.
std::vector<bool> neededTracks(const auto& header, const View& view) {
  const WaveletSpec spec = specOf(header.wavelet);
  const Pyramid pyramid = pyramidOf(spec, {}, header.extent());
  const ViewSynthesis synthesis(spec, pyramid, view);
  const std::vector<Region> regions =
      regionsOf(header.width, header.height, header.regions.side_log2, header.wavelet.patches());
  std::vector<bool> needed(regions.size());
  needed.front() = true;  // the component's opening and the coarsest levels
  for (size_t i = 1; i < regions.size(); ++i)
    needed[i] = !neededParts(synthesis, pyramid.subbands(), regions[i]).empty();
  return needed;
}

}  // namespace

std::vector<bool> neededTracks(const StreamHeader& header, Component component, const View& view) {
  if (view.isWhole())
    return std::vector<bool>(trackCounts(header)[static_cast<size_t>(component)].tracks, true);
  if (component == Component::kTexture)
    return neededTracks(*header.texture,
                        decodedView(*header.texture, codedView(*header.texture, view)));
  const GeometryHeader& geometry = *header.geometry;
  const View decoded = decodedView(geometry, header.layers, codedView(geometry, view));
  std::vector<bool> needed = neededTracks(geometry, decoded);
  if (header.layers.region_masks) addMaskTracks(geometry, needed);
  if (correctionTracks(geometry, header.layers) == 0) return needed;
  const Window all{0, 0, geometry.width, geometry.height};
  for (const Window& part : correctionParts(geometry))
    needed.push_back(view.level == 0 && part.meets(decoded.window.value_or(all)));
  return needed;
}

void giveRanges(std::span<const tks_range> ranges, tks_ranges& out) {
  if (ranges.empty()) return;
  out.ranges = new tks_range[ranges.size()];
  out.count = ranges.size();
  std::copy(ranges.begin(), ranges.end(), out.ranges);
}

}  // namespace tetrakis::inline api

void tks_free_ranges(tks_ranges* ranges) {
  if (ranges == nullptr) return;
  delete[] ranges->ranges;
  *ranges = {};
}

namespace tetrakis::inline api {

namespace {

/// The views of a call for a part; meshes are made of everything.
Result<std::vector<View>> askedViewsOfPart(const tks_decoder& decoder, tks_part part,
                                           const tks_window* window) {
  if (part == TKS_PART_CODED_MESH || part == TKS_PART_BUDGET_MESH) {
    if (!decoder.parsed.header.geometry) return noHeights();
    return std::vector{View{}};
  }
  return askedViews(decoder, part, window);
}

/// The ranges of the packets of such tracks; of streams for windows each track has its own.
std::vector<tks_range> rangesOfTracks(const tks_decoder& decoder, Component component,
                                      const std::vector<bool>& needed) {
  const bool regions_apart = decoder.index == TKS_INDEX_WINDOWS;
  std::vector<tks_range> ranges;
  std::optional<uint32_t> last;
  forEachKnownPacket(decoder, [&](const PacketHead& head, uint64_t begin, uint64_t, uint64_t end) {
    if (head.component != component || head.track >= needed.size() || !needed[head.track]) return;
    const bool goes_on = !regions_apart || last == head.track;
    last = head.track;
    if (goes_on && !ranges.empty() && ranges.back().offset + ranges.back().size == begin) {
      ranges.back().size += end - begin;
    } else {
      ranges.push_back({begin, end - begin, 0});
    }
  });
  return ranges;
}

/// Where the front of a decoder ends once ranges, in order, are there too.
uint64_t frontWith(const tks_decoder& decoder, const std::vector<tks_range>& ranges) {
  uint64_t front = std::max<uint64_t>(decoder.parsed.bytes, decoder.data.size());
  for (const tks_range& range : ranges) {
    front += decoder.pieces.from(front).size();
    if (range.offset > front) return front;
    front = std::max(front, range.offset + range.size);
  }
  return front + decoder.pieces.from(front).size();
}

/// The ranges, and the last byte if no gap would tell that what is missing is not needed: a decoder
/// that has but the front of a stream decodes it as a prefix, whose samples are rounded otherwise.
/// Bytes that are there already may close the gaps between the ranges.
std::vector<tks_range> withGap(const tks_decoder& decoder, std::vector<tks_range> ranges) {
  if (ranges.empty()) return ranges;
  const uint64_t end = decoder.parsed.bytes + decoder.parsed.header.payload_bytes;
  const uint64_t front = frontWith(decoder, ranges),
                 behind = ranges.back().offset + ranges.back().size;
  if (front >= end || behind > front || decoder.pieces.hasAny({front, end})) return ranges;
  if (behind + 1 == end) {
    ++ranges.back().size;
  } else {
    ranges.push_back({end - 1, 1, 0});
  }
  return ranges;
}

Result<std::vector<tks_range>> neededRanges(tks_decoder& decoder, tks_part part,
                                            const tks_window* window) {
  if (part < TKS_PART_HEIGHTS || part > TKS_PART_BUDGET_MESH)
    return Status(TKS_USAGE, "There is no such part.");
  const Result<std::vector<View>> views = askedViewsOfPart(decoder, part, window);
  if (!views.ok()) return views.status();
  const StreamHeader& header = decoder.parsed.header;
  if (!hasIndex(decoder) && header.payload_bytes > 0)
    return Status(TKS_USAGE, "The stream has no index, which would tell where its packets lie.");
  const Component component = part == TKS_PART_TEXTURE ? Component::kTexture : Component::kGeometry;
  std::vector<bool> needed;
  for (const View& view : *views) {
    if (Status status = checkMemory(decoder, {part, view, 0}); !status.ok()) return status;
    const std::vector<bool> of_view =
        neededTracks(header, component, decodedFor(header, part, view));
    needed.resize(of_view.size());
    std::transform(needed.begin(), needed.end(), of_view.begin(), needed.begin(),
                   std::logical_or<bool>());
  }
  if (part == TKS_PART_VALIDITY && !header.layers.region_masks) needed.assign(1, true);
  const Result<std::vector<ByteRange>> records = lackingRecords(decoder, needed);
  if (!records.ok()) return records.status();
  if (records->empty()) return withGap(decoder, rangesOfTracks(decoder, component, needed));
  std::vector<tks_range> ranges;
  for (const ByteRange& record : *records)
    ranges.push_back({record.begin, record.end - record.begin, 0});
  return ranges;
}

}  // namespace

}  // namespace tetrakis::inline api

tks_status tks_needed_ranges(tks_decoder* decoder, tks_part part, const tks_window* window,
                             tks_ranges* out) {
  if (out == nullptr) return tetrakis::keeping(decoder, tetrakis::outputMissing);
  *out = {};
  return tetrakis::keeping(decoder, [&]() -> tetrakis::Status {
    const auto ranges = tetrakis::neededRanges(*decoder, part, window);
    if (!ranges.ok()) return ranges.status();
    tetrakis::giveRanges(*ranges, *out);
    return {};
  });
}
