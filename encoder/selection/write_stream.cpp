// SPDX-License-Identifier: Apache-2.0
#include "encoder/selection/write_stream.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <string>

#include "bitstream/stream/header.hpp"
#include "encoder/heights/coded_heights.hpp"
#include "encoder/textures/coded_texture.hpp"
#include "ratecontrol/needs/needs.hpp"

namespace tetrakis::inline selection {

namespace {

std::string textOf(const char* text) {
  return text != nullptr ? text : "";
}

template <class T>
Placement placementOf(const T& raster) {
  Placement placement;
  placement.has_transform = raster.has_geotransform != 0;
  if (placement.has_transform)
    std::copy_n(raster.geotransform, placement.transform.size(), placement.transform.begin());
  placement.registration = static_cast<uint8_t>(raster.registration);
  placement.geo_keys = textOf(raster.geo_keys);
  return placement;
}

/// Either may be null. A texture in the reference system of the heights has none of its own.
Georeference georeferenceOf(const tks_heights* heights, const tks_image* image) {
  Georeference out;
  if (heights != nullptr) {
    out.heights = placementOf(*heights);
    out.description = textOf(heights->description);
    out.nan_nodata = heights->has_nodata && std::isnan(heights->nodata);
  }
  if (image == nullptr) return out;
  out.texture = placementOf(*image);
  out.texture_crs = textOf(image->crs);
  const bool shared = heights != nullptr && out.texture.has_transform &&
                      out.texture_crs == textOf(heights->crs) &&
                      out.texture.geo_keys == out.heights.geo_keys;
  if (shared) {
    out.texture_crs.clear();
    out.texture.geo_keys.clear();
  }
  return out;
}

/// Notes the components of a stream that holds the first `payload_bytes` bytes of the packets.
void noteTaken(const EncodeInputs& inputs, const Selection& taken, uint64_t payload_bytes) {
  const auto sent = payloadWithin(taken.packets, payload_bytes);
  if (taken.heights) note(inputs, *taken.heights, Verdict::kTaken, sent[0]);
  if (taken.texture) note(inputs, *taken.texture, Verdict::kTaken, sent[1]);
}

}  // namespace

void noteOthers(const EncodeInputs& inputs, const Selection& better, const Selection& lost) {
  if (lost.heights && lost.heights != better.heights)
    note(inputs, *lost.heights, Verdict::kWorseInBudget);
  if (lost.texture && lost.texture != better.texture)
    note(inputs, *lost.texture, Verdict::kWorseInBudget);
}

namespace {

/// Whether the tracks leave no error before their first byte, so that nothing has to be sent.
bool nothingLeft(const std::vector<EncodedTrack>& tracks) {
  return std::all_of(tracks.begin(), tracks.end(), [](const EncodedTrack& track) {
    return track.points.front().distortion == 0;
  });
}

Metadata metadataOf(const tks_heights& heights) {
  const auto text = [](const char* s) { return std::string(s ? s : ""); };
  return {heights.scale,     heights.offset,     heights.spacing_x,
          heights.spacing_y, text(heights.unit), text(heights.vertical_datum),
          text(heights.crs)};
}

}  // namespace

void describePlace(const tks_heights* heights, const tks_image* image, StreamHeader& header) {
  header.georeference = georeferenceOf(heights, image);
  header.height_positions = positionsOf(heights);
  header.texture_positions = positionsOf(image);
  if (heights == nullptr) return;
  header.metadata = metadataOf(*heights);
  header.grid = {heights->grid_width, heights->grid_height};
}

std::vector<IndexEntry> indexOf(const std::vector<Packet>& packets, const TrackCounts& counts) {
  double steepest = 0;
  for (const Packet& packet : packets) steepest = std::max(steepest, packet.slope);
  std::vector<IndexEntry> index;
  for (const Packet& packet : packets)
    index.push_back({headOf(packet, counts), slopeByte(packet.slope, steepest)});
  return index;
}

namespace {

StreamHeader makeHeader(const EncodeInputs& inputs, const Selection& selection,
                        uint64_t payload_bytes, bool lossless) {
  const tks_encode_options& options = inputs.options;
  StreamHeader header;
  header.payload_bytes = payload_bytes;
  header.lossless = lossless;
  if (lossless || options.max_error > 0) header.payload_crc = 0;  // until there is a payload
  header.triangles = options.triangles;
  if (selection.heights) {
    header.geometry = selection.heights->header;
    header.geometry->max_error = options.max_error > 0 ? options.max_error : lossless ? 0 : -1;
    header.layers = selection.heights->layers;
    if (inputs.lines != nullptr) header.geometry->repeats = inputs.lines->repeats;
    if (inputs.allHeights()->base_mesh.position_bits > 0)
      header.geometry->base_mesh = encodeBaseMesh(baseMeshOf(*inputs.allHeights()));
  }
  if (selection.texture) {
    header.texture = selection.texture->header;
    if (inputs.texel_lines != nullptr) header.texture->repeats = inputs.texel_lines->repeats;
  }
  describePlace(inputs.heights != nullptr ? inputs.allHeights() : nullptr, inputs.allTexels(),
                header);
  if (options.index != 0) header.index = indexOf(selection.packets, trackCounts(header));
  return header;
}

/// The last packet of either component states that nothing is left, or there was nothing to send.
bool restoresEverything(const Selection& selection) {
  const auto& [heights, texture, packets] = selection;
  std::array<bool, kComponents> exact = {!heights || nothingLeft(heights->tracks),
                                         !texture || nothingLeft(texture->tracks)};
  for (const Packet& packet : packets)
    exact[static_cast<size_t>(packet.component)] = packet.quality == 0;
  const bool restored = !heights || heights->restoresSamples();
  const bool all_counts = !texture || texture->seen().all();
  return exact[0] && exact[1] && restored && all_counts;
}

}  // namespace

uint64_t headerBytesOf(const EncodeInputs& inputs, const Selection& selection) {
  const uint64_t payload = bytesOfPackets(selection.packets);
  return writeHeader(makeHeader(inputs, selection, payload, false)).size();
}

bool isLossless(const EncodeInputs& inputs, const Selection& selection) {
  if (!restoresEverything(selection)) return false;
  if (!inputs.budgeted()) return true;
  const uint64_t payload = bytesOfPackets(selection.packets);
  const size_t header_bytes = writeHeader(makeHeader(inputs, selection, payload, true)).size();
  return header_bytes + payload <= inputs.options.bytes;
}

Result<std::vector<uint8_t>> writeStream(const EncodeInputs& inputs, const Selection& selection) {
  assert(selection.heights || selection.texture);
  const uint64_t budget = inputs.options.bytes;
  const bool lossless = isLossless(inputs, selection);
  uint64_t room = UINT64_MAX >> 1;
  if (inputs.budgeted() && !lossless) {
    const size_t header_bytes = writeHeader(makeHeader(inputs, selection, budget, false)).size();
    if (budget < header_bytes) {
      return Status(TKS_USAGE, "A budget of " + std::to_string(budget) +
                                   " bytes is too small: the header of this stream takes " +
                                   std::to_string(header_bytes) + ". Give at least that many.");
    }
    room = budget - header_bytes;
  }
  const uint64_t all_bytes = bytesOfPackets(selection.packets);
  const uint64_t payload_bytes = std::min(room, all_bytes);
  assert(!lossless || payload_bytes == all_bytes);
  std::array<Codewords, kComponents> codewords;
  if (selection.heights) codewords[0] = codewordsOf(selection.heights->tracks);
  if (selection.texture) codewords[1] = codewordsOf(selection.texture->tracks);
  StreamHeader header = makeHeader(inputs, selection, payload_bytes, lossless);
  const std::vector<uint8_t> payload =
      multiplex(selection.packets, trackCounts(header), codewords, payload_bytes);
  assert(payload.size() == payload_bytes);
  if (header.payload_crc) header.payload_crc = crc32(payload);
  std::vector<uint8_t> stream = writeHeader(header);
  if (stream.size() > kMaxHeaderBytes) {
    return Status(TKS_USAGE, "The front index of " + std::to_string(selection.packets.size()) +
                                 " packets is too long: it makes a header of " +
                                 std::to_string(stream.size()) + " bytes, and " +
                                 std::to_string(kMaxHeaderBytes) +
                                 " are the most. Take larger regions, or no index.");
  }
  stream.insert(stream.end(), payload.begin(), payload.end());
  assert(!inputs.budgeted() || stream.size() <= budget);
  noteTaken(inputs, selection, payload_bytes);
  return stream;
}

}  // namespace tetrakis::inline selection
