// SPDX-License-Identifier: Apache-2.0
#include "api/gaps.hpp"

#include <algorithm>
#include <vector>

#include "api/needed_tracks.hpp"
#include "bitstream/stream/correction_tracks.hpp"
#include "bitstream/stream/indexed_packets.hpp"

namespace tetrakis::inline api {

namespace {

/// For each track of coefficients, whether the view needs it.
std::vector<bool> neededCoefficients(const StreamHeader& header, Component component,
                                     const View& view) {
  std::vector<bool> needed = neededTracks(header, component, view);
  if (component == Component::kGeometry)
    needed.resize(needed.size() - correctionTracks(*header.geometry, header.layers));
  return needed;
}

/// How many bytes are missing of those tracks.
uint64_t missingOf(const tks_decoder& decoder, Component component,
                   const std::vector<bool>& tracks) {
  const StreamHeader& header = decoder.parsed.header;
  const auto counts = [&](uint32_t track) { return track < tracks.size() && tracks[track]; };
  uint64_t bytes = 0;
  const uint64_t end = decoder.parsed.bytes + header.payload_bytes;
  for (const IndexedPacket& packet : IndexedPackets(header, decoder.parsed.bytes)) {
    const PacketHead& head = packet.entry.packet;
    if (head.component() == component && counts(head.track))
      bytes += std::min(packet.end, end) - std::min(packet.payload, end);
  }
  for (const auto& [track, codeword] :
       decoder.packets.payload.codewords[static_cast<size_t>(component)])
    if (counts(track)) bytes -= std::min<uint64_t>(bytes, codeword.size());
  return bytes;
}

template <class Header>
Header counted(const tks_decoder& decoder, const Header& header, Component component,
               const View& view) {
  Header result = header;
  uint64_t& rounded = result.wavelet.rounded_bytes;
  if (!decoder.packets.has_gap || rounded == 0) return result;
  std::vector<bool> elsewhere = neededCoefficients(decoder.parsed.header, component, view);
  elsewhere.flip();
  rounded -= std::min(rounded, missingOf(decoder, component, elsewhere));
  return result;
}

}  // namespace

GeometryHeader headerFor(const tks_decoder& decoder, const GeometryHeader& header,
                         const View& view) {
  return counted(decoder, header, Component::kGeometry, view);
}

TextureHeader headerFor(const tks_decoder& decoder, const TextureHeader& header, const View& view) {
  return counted(decoder, header, Component::kTexture, view);
}

Codewords heightTracksFor(const tks_decoder& decoder, const View& view) {
  const StreamHeader& header = decoder.parsed.header;
  const GeometryHeader& geometry = *header.geometry;
  Codewords tracks = decoder.packets.payload.codewordsOf(Component::kGeometry);
  if (!decoder.packets.has_gap || correctionTracks(geometry, header.layers) == 0) return tracks;
  const auto lacksSome = [&](const View& part) {
    return missingOf(decoder, Component::kGeometry,
                     neededCoefficients(header, Component::kGeometry, part)) > 0;
  };
  if (!lacksSome(view)) return tracks;
  // Without fraction bits all heights change with the last coefficient, which makes them round.
  const bool change = geometry.wavelet.fraction_bits == 0;
  const auto parts = correctionParts(geometry.extent(), geometry.regions.side_log2);
  const size_t coefficients = tracks.size() - parts.size();
  for (size_t i = 0; i < parts.size(); ++i) {
    std::span<const uint8_t>& codeword = tracks[coefficients + i];
    if (!codeword.empty() && (change || lacksSome({0, parts[i]}))) codeword = {};
  }
  return tracks;
}

}  // namespace tetrakis::inline api
