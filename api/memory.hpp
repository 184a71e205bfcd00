// SPDX-License-Identifier: Apache-2.0
// checkMemory() takes a call of the C interface and refuses it if decoding would take more memory
// than the caller allows. HeightsBytes, textureBytes() and meshBytes() count the bytes from the
// header, before anything is allocated.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "api/decoder.hpp"
#include "base/shown_text.hpp"
#include "codec/mesh/topology/lattice.hpp"
#include "codec/wavelet/forest_lifting.hpp"
#include "codec/wavelet/region_decoder.hpp"
#include "codec/wavelet/synthesis/view_synthesis.hpp"
#include "codec/wavelet/wavelet.hpp"
#include "texture_wavelet/drawn/drawn_decoder.hpp"

namespace tetrakis::inline api {

// trackBytes(), stateBytes() and PlanesBytes compute how many bytes of memory the tracks and planes
// of a component, heights or texture, take while it is decoded.

inline constexpr uint64_t kOnceBytes = 256 << 10;         // models, plans, lists of levels
inline constexpr uint64_t kDrawnOnceBytes = 7 << 19;      // models of drawings and overlays
inline constexpr uint64_t kTrackBytes = 256;              // its region, views of its bytes, lists
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

/// The state of the tracks that are decoded at a time, or of all that a decoder keeps.
inline TrackNeeds trackNeeds(const tks_decoder& decoder, const auto& header, uint32_t planes,
                             bool masked, Component component) {
  const bool known = header.planes > 0 && header.planes < kDrawnPlanes &&
                     !decoder.packets.payload.nothingOf(component);
  const bool ordered = !header.priorities.none();
  const Forest* const forest = header.wavelet.forest.get();
  return {header.extent(),
          forest,
          header.regions.side_log2,
          planes,
          masked || forest != nullptr,
          ordered,
          known,
          decoder.threads,
          decoder.remembers};
}

/// The bytes that tracks take in a call for a view, beside those of the decoder's memory.
inline uint64_t stateBytes(const tks_decoder& decoder, const auto& header, const View& view,
                           TrackNeeds needs, Component component) {
  const bool texture = component == Component::kTexture;
  const TrackMemory& levels =
      texture ? decoder.texture_memory.tracks : decoder.heights_memory.tracks;
  const TrackMemory& windows =
      texture ? decoder.texture_windows.tracks : decoder.heights_windows.tracks;
  uint64_t state = needs.bytes();
  state -= std::min(state, levels.bytes());
  if (view.window && decoder.most_of_windows > 0) {
    needs.kept = true;
    const uint64_t tracks = regionCount(header.width, header.height, header.regions.side_log2,
                                        header.wavelet.patches());
    const uint64_t all = needs.bytes();
    const uint64_t room =
        decoder.most_of_windows - std::min(decoder.most_of_windows, windows.bytes());
    state = std::max(state, all / tracks * std::clamp<uint64_t>(decoder.threads, 1, tracks));
    state += std::min(all, room);
  }
  return state + (needs.ordered ? mapBytes(header) : 0);
}

/// The bytes that a decoder holds all the time for each track, and for the patches of a forest.
inline uint64_t trackBytes(const auto& header) {
  const SharedForest& forest = header.wavelet.forest;
  return kTrackBytes * regionCount(header.width, header.height, header.regions.side_log2,
                                   header.wavelet.patches()) +
         (forest != nullptr ? Pyramid::bytesOf(*forest) : 0);
}

/// The bytes that the planes of a view take until its samples are there.
struct PlanesBytes {
  uint64_t coefficients = 0;  ///< of one plane
  uint64_t work = 0;          ///< of the inverse transforms that run at a time

  PlanesBytes(const tks_decoder& decoder, const auto& header, const View& view, uint32_t planes,
              bool masked) {
    const SharedForest& forest = header.wavelet.forest;
    if (forest != nullptr && view.window) {
      const ForestBlocks blocks(specOf(header.wavelet), view);
      coefficients = kValueBytes * blocks.coefficients();
      work = blocks.workBytes();
      return;
    }
    if (forest != nullptr) {
      coefficients = kValueBytes * area(view.extentIn(header.extent()));
      work = ForestLifting::bytesOf(*forest, view.level);
      return;
    }
    const Pyramid pyramid(header.extent());
    const ViewSynthesis synthesis(specOf(header.wavelet), pyramid, view);
    const uint64_t at_a_time = view.window ? std::clamp<uint64_t>(decoder.threads, 1, planes) : 1;
    coefficients = kValueBytes * synthesis.coefficients();
    work = at_a_time * synthesis.workBytes(decoder.threads, masked);
  }
};

/// The bytes that the frames of a view take beside their coefficients: each plane as it is kept,
/// the marks beside them, those of the frame that is shown, and the work of the threads.
inline uint64_t framesBytes(const auto& header, const PlanesBytes& planes, uint64_t samples,
                            uint32_t colours = 1) {
  if (header.frames.none()) return 0;
  const uint64_t all = (header.frames.count + 1u) * colours;
  const uint64_t bytes = all * (samples * kValueBytes + planes.work) + 2 * samples;
  if (header.frames.reference == 0) return bytes;
  // The frames go on from whole planes: while the last group is decoded, its plane is there, and
  // the one of the group before, copied with means of its voids.
  constexpr uint64_t kMeans = 16;
  const uint64_t plane = uint64_t{header.width} * header.height;
  return bytes + header.frames.before.bytes + plane * (colours * 4 * kValueBytes + kMeans + 4);
}

/// The bytes of `samples` that are copied from coded lines, and of the maps of lines.
inline uint64_t copyBytes(const auto& header, uint64_t samples, uint64_t sample_bytes) {
  constexpr uint64_t kLine = 4 * sizeof(uint32_t);
  if (header.repeats.none()) return 0;
  const auto [width, height] = header.shown();
  return samples * sample_bytes + kLine * (uint64_t{width} + height);
}

// HeightsBytes computes from the header how many bytes of memory it takes to decode a view of the
// heights.

/// Bytes for a view of the heights of a decoder, which has some.
class HeightsBytes {
 public:
  HeightsBytes(const tks_decoder& decoder, const View& view);

  /// The bytes that are left when a level is decoded: heights, marks, masks, corrections.
  uint64_t kept() const;
  /// The bytes that decoding takes.
  uint64_t decoding() const;
  /// The bytes that decoding the mask alone takes.
  uint64_t validity() const;

 private:
  /// The same heights, of which another view of the coded lines is decoded.
  HeightsBytes(const HeightsBytes& of, const View& lines);

  uint64_t decodingLines() const;
  uint64_t decodingTaken() const;
  uint64_t drawing() const;
  uint64_t wholeMasks() const;
  uint64_t openingMaskBytes() const;
  uint64_t copyBytes() const;
  uint64_t rows() const;
  uint64_t parts() const;
  uint64_t tableBytes() const;
  uint64_t joinedBytes() const;
  uint64_t flatBytes() const;
  uint64_t flatOpeningBytes() const;
  uint64_t low() const;

  const tks_decoder& decoder_;
  const GeometryHeader& header_;
  const GeometryLayers& layers_;
  View view_;
  uint64_t shown_;   ///< samples of the view, of coded lines
  uint64_t copied_;  ///< of the view; 0: no lines are copied
  bool voids_;
  bool flat_;
  bool table_;
  bool corrected_;  ///< corrections, or all samples directly, are decoded
};

// checkBytes() and checkMemory() bound the bytes that a call of a decoder allocates, from the
// header and before the call allocates anything, and hold them against the limit.
//
// Bounds follow what the rooms below keep at the same time: planes of 32-bit values, masks, the
// state of one track a thread (codec/wavelet/region_decoder.hpp), a window's blocks. The
// bytes of meshes are measured (tests/api/decode_memory_test.cpp).

/// The part and the view that a call is asked for.
struct MemoryRequest {
  tks_part part = TKS_PART_HEIGHTS;
  View view;                   ///< of askedViews(); meshes ignore it
  uint32_t max_triangles = 0;  ///< of TKS_PART_BUDGET_MESH
};

/// Bytes that a call allocates at its peak, at most; meshes include what they hand over. The stream
/// holds what is asked for.
uint64_t callBytes(const tks_decoder& decoder, const MemoryRequest& request);

/// The bytes of a budget mesh of decoded heights with voids. callBytes() knows no more triangles
/// than the budget; triangles in voids come beside it, and are judged when they are known.
uint64_t voidMeshBytes(const Lattice& lattice, uint64_t triangles);

/// The bytes that tks_decode_screen_mesh allocates at its peak, at most. triangles: with those in
/// voids. texels: of the texture.
uint64_t screenMeshBytes(const tks_decoder& decoder, const Lattice& lattice, uint64_t triangles,
                         uint64_t texels);

/// Bytes that a decoder of a payload allocates for what it keeps of that.
uint64_t payloadBytes(const PayloadCount& count, const TrackCounts& tracks);

/// TKS_LIMIT with a sentence if the decoder and so many bytes for the request take more than the
/// limit.
Status checkBytes(const tks_decoder& decoder, const MemoryRequest& request, uint64_t bytes);
/// Likewise of work that a sentence can begin with: "A mesh of 7 triangles".
Status checkWork(const tks_decoder& decoder, const std::string& work, uint64_t bytes);

/// TKS_LIMIT with a sentence if the decoder, the call and `beside` bytes of the caller's together
/// take more than the limit. Heights that the decoder keeps and the call does not need give way.
Status checkMemory(tks_decoder& decoder, const MemoryRequest& request, uint64_t beside = 0);

// meshBytes() tells how many bytes a mesh takes to decode. Its figures are measured
// (tests/api/decode_memory_test.cpp).

/// Bytes of a request for a coded mesh or a budget mesh.
uint64_t meshBytes(const tks_decoder& decoder, const MemoryRequest& request);

// textureStrips() cuts a view of a texture into strips of some rows where each strip can go on from
// the decoded tracks of the strip before. The planes of coefficients of a strip fit in caches, and
// a large image takes no plane of its size beside its texels.

/// The strips of a view of the texture, from above; the view itself where it is decoded at once.
std::vector<View> textureStrips(const tks_decoder& decoder, const View& view);

// textureBytes() computes from the header how many bytes of memory it takes to decode a view of the
// texture.

/// Bytes for a view of the texture of a decoder, which has one.
uint64_t textureBytes(const tks_decoder& decoder, const View& view);

}  // namespace tetrakis::inline api
