// SPDX-License-Identifier: Apache-2.0
// The functions here compute how many bytes of memory the planes and tracks of a component, heights
// or texture, take while it is decoded.
#pragma once

#include <algorithm>
#include <cstdint>

#include "api/decoder.hpp"
#include "codec/wavelet/region_decoder.hpp"
#include "codec/wavelet/synthesis/view_synthesis.hpp"
#include "codec/wavelet/wavelet_header.hpp"
#include "texture_wavelet/drawn/drawn_colours.hpp"

namespace tetrakis::inline api {

inline constexpr uint64_t kOnceBytes = 256 << 10;         // models, plans, lists of levels
inline constexpr uint64_t kDrawnOnceBytes = 7 << 19;      // models of drawings and overlays
inline constexpr uint64_t kTrackBytes = 64;               // its region, and views of its bytes
inline constexpr uint64_t kValueBytes = sizeof(int32_t);  // of a plane

/// How many samples a rectangle has.
inline uint64_t area(const auto& extent) {
  return uint64_t{extent.width} * extent.height;
}

/// A map of priorities and its sums.
inline uint64_t mapBytes(const auto& header) {
  const int log2 = header.priorities.tile_log2;
  const uint64_t columns = tilesAlong(header.width, log2), rows = tilesAlong(header.height, log2);
  return columns * rows + (columns + 1) * (rows + 1) * sizeof(uint64_t);
}

/// The state of the tracks that are decoded at a time, beside what is remembered of them.
inline uint64_t stateBytes(const tks_decoder& decoder, const auto& header, uint32_t planes,
                           bool masked, Component component) {
  const bool known = header.planes > 0 && header.planes < kDrawnPlanes &&
                     !decoder.packets.payload.nothingOf(component);
  const bool ordered = !header.priorities.none();
  const TrackNeeds needs{header.extent(), header.regions.side_log2, planes, masked, ordered, known,
                         decoder.threads, decoder.remembers};
  const TrackMemory& memory = component == Component::kTexture ? decoder.texture_memory.tracks
                                                               : decoder.heights_memory.tracks;
  const uint64_t state = needs.bytes();
  return state - std::min(state, memory.bytes()) + (ordered ? mapBytes(header) : 0);
}

/// What there is for each track all the time.
inline uint64_t trackBytes(const auto& header) {
  return kTrackBytes * regionCount(header.width, header.height, header.regions.side_log2);
}

/// What the planes of a view take until its samples are there.
struct PlanesBytes {
  uint64_t coefficients = 0;  ///< of one plane
  uint64_t work = 0;          ///< of the inverse transforms that run at a time

  PlanesBytes(const tks_decoder& decoder, const auto& header, const View& view, uint32_t planes,
              bool masked) {
    const Pyramid pyramid(header.extent());
    const ViewSynthesis synthesis(specOf(header.wavelet), pyramid, view);
    const uint64_t at_a_time = view.window ? std::clamp<uint64_t>(decoder.threads, 1, planes) : 1;
    coefficients = kValueBytes * synthesis.coefficients();
    work = at_a_time * synthesis.workBytes(decoder.threads, masked);
  }
};

/// So many samples that are copied from coded lines, and the maps of lines.
inline uint64_t copyBytes(const auto& header, uint64_t samples, uint64_t sample_bytes) {
  constexpr uint64_t kLine = 4 * sizeof(uint32_t);
  if (header.repeats.none()) return 0;
  const auto [width, height] = header.shown();
  return samples * sample_bytes + kLine * (uint64_t{width} + height);
}

}  // namespace tetrakis::inline api
