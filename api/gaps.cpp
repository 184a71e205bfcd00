// SPDX-License-Identifier: Apache-2.0
#include "api/needed.hpp"

#include <algorithm>
#include <vector>

#include "api/index_pages.hpp"
#include "bitstream/stream/geometry_header.hpp"

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

/// Calls take(track, bytes) with what the index tells of each packet of a component that is known.
template <class Take>
void forEachPacket(const tks_decoder& decoder, Component component, const Take& take) {
  forEachKnownPacket(decoder,
                     [&](const PacketHead& head, uint64_t, uint64_t payload, uint64_t end) {
                       if (head.component == component) take(head.track, end - payload);
                     });
}

const auto& codewordsThere(const tks_decoder& decoder, Component component) {
  return decoder.packets.payload.codewords[static_cast<size_t>(component)];
}

/// How many bytes are missing of those tracks.
uint64_t missingOf(const tks_decoder& decoder, Component component,
                   const std::vector<bool>& tracks) {
  const auto counts = [&](uint32_t track) { return track < tracks.size() && tracks[track]; };
  uint64_t bytes = 0;
  forEachPacket(decoder, component, [&](uint32_t track, uint64_t size) {
    if (counts(track)) bytes += size;
  });
  for (const auto& [track, codeword] : codewordsThere(decoder, component))
    if (counts(track)) bytes -= std::min<uint64_t>(bytes, codeword.size());
  return bytes;
}

/// For each of the first tracks of the heights, whether some of its bytes are missing.
std::vector<bool> lackingTracks(const tks_decoder& decoder, size_t count) {
  std::vector<uint64_t> missing(count);
  forEachPacket(decoder, Component::kGeometry, [&](uint32_t track, uint64_t size) {
    if (track < count) missing[track] += size;
  });
  for (const auto& [track, codeword] : codewordsThere(decoder, Component::kGeometry))
    if (track < count) missing[track] -= std::min<uint64_t>(missing[track], codeword.size());
  std::vector<bool> lacking(count);
  for (size_t i = 0; i < count; ++i)
    lacking[i] = missing[i] > 0 || (decoder.pages && !decoder.pages->knowsTrack(i));
  return lacking;
}

/// How many bytes are missing of tracks that are not needed. Where a page of the index is not
/// known, all but those of the needed ones are counted, which are known; if these are not, nothing.
uint64_t missingBeside(const tks_decoder& decoder, Component component,
                       const std::vector<bool>& needed) {
  std::vector<bool> elsewhere = needed;
  elsewhere.flip();
  if (!decoder.pages) return missingOf(decoder, component, elsewhere);
  for (size_t i = 0; i < needed.size(); ++i)
    if (needed[i] && !decoder.pages->knowsTrack(i)) return 0;
  uint64_t there = missingOf(decoder, component, needed);
  for (const auto& [track, codeword] : codewordsThere(decoder, component))
    if (!decoder.pages->grid().isCorrection(track)) there += codeword.size();
  const uint64_t all = decoder.pages->coefficientBytes();
  return all - std::min(all, there);
}

template <class Header>
Header counted(const tks_decoder& decoder, const Header& header, Component component,
               const View& view) {
  Header result = header;
  uint64_t& rounded = result.wavelet.rounded_bytes;
  if (!decoder.packets.has_gap || rounded == 0) return result;
  const std::vector<bool> needed = neededCoefficients(decoder.parsed.header, component, view);
  rounded -= std::min(rounded, missingBeside(decoder, component, needed));
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

/// Which region a missing coefficient reaches is looked up for each region, in proportion to the
/// square of their number: in planes of very many regions all corrections wait for all coefficients
/// of the view.
Codewords heightTracksFor(tks_decoder& decoder, const View& view) {
  constexpr uint64_t kMostLookedUp = 1 << 17;  // about a tenth of a second
  const StreamHeader& header = decoder.parsed.header;
  const GeometryHeader& geometry = *header.geometry;
  Codewords tracks = decoder.packets.codewordsOf(Component::kGeometry,
                                                 neededTracks(header, Component::kGeometry, view));
  const uint64_t corrections = correctionTracks(geometry, header.layers);
  if (!decoder.packets.has_gap || corrections == 0) return tracks;
  const size_t coefficients = tracks.size() - corrections;
  const std::vector<bool> lacking = lackingTracks(decoder, coefficients);
  const auto lacksSome = [&](const View& part) {
    const std::vector<bool> needed = neededCoefficients(header, Component::kGeometry, part);
    for (size_t i = 0; i < needed.size(); ++i)
      if (needed[i] && lacking[i]) return true;
    return false;
  };
  if (!lacksSome(view)) return tracks;
  // Without fraction bits all heights change with the last coefficient, which makes them round.
  const bool all_wait =
      geometry.wavelet.fraction_bits == 0 || corrections * tracks.size() > kMostLookedUp;
  const auto parts = correctionParts(geometry);
  for (size_t i = 0; i < parts.size(); ++i) {
    std::span<const uint8_t>& codeword = tracks[coefficients + i];
    if (!codeword.empty() && (all_wait || lacksSome({0, parts[i]}))) codeword = {};
  }
  return tracks;
}

}  // namespace tetrakis::inline api
