// SPDX-License-Identifier: Apache-2.0
// A tks_decoder holds the bytes of a stream that the caller gave, their header, and the decoded
// heights and tracks that later calls go on from. The functions of this file serve all calls of
// decoders.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "api/guarded.hpp"
#include "base/view.hpp"
#include "bitstream/stream/borrowed_packets.hpp"
#include "bitstream/stream/header.hpp"
#include "bitstream/stream/packet.hpp"
#include "bitstream/stream/page_index.hpp"
#include "bitstream/stream/pieces.hpp"
#include "bitstream/stream/scattered_packets.hpp"
#include "bitstream/stream/sketch.hpp"
#include "codec/basemesh/base_mesh.hpp"
#include "codec/geometry/heights_decoder.hpp"
#include "codec/wavelet/pyramid.hpp"
#include "texture_wavelet/texture_decoder.hpp"

namespace tetrakis::inline api {

/// The packets of a stream, as far as they are there.
struct TakenPackets {
  Demultiplexed payload;
  BorrowedPackets borrowed;  ///< of the bytes given to tks_open(), what no call has needed yet
  uint64_t bytes = 0;        ///< that `payload` takes, at most
  bool has_gap = false;      ///< a byte is missing before others

  /// The codewords of a component, of which those of needed tracks are there: of the others the
  /// lengths are right.
  Codewords codewordsOf(Component component, const std::vector<bool>& needed) {
    return borrowed.codewordsOf(component, needed, payload);
  }
  /// How many bytes of a track are there.
  uint64_t bytesOf(Component component, uint32_t track) const;
};

/// Bytes of a stream of which a sketch is shown, since they end inside its header.
struct SketchedBytes {
  ShownStream shown;                            ///< the sketch among them
  std::span<const uint8_t> all;                 ///< the caller's, ...
  std::vector<uint8_t> own;                     ///< ... or, once there came more, these
  uint64_t header_bytes = 0, stream_bytes = 0;  ///< of the stream that the sketch is of
};

}  // namespace tetrakis::inline api

struct tks_decoder {
  std::span<const uint8_t> data;  ///< the stream up to its first missing byte: the caller's, ...
  tetrakis::Pieces pieces;        ///< ... or, once there came more, of these
  std::optional<tetrakis::SketchedBytes> sketched;  ///< `data` and all below are of the sketch
  tetrakis::ParsedHeader parsed;
  std::optional<tetrakis::BaseMesh> base_mesh;
  tks_index index = TKS_INDEX_NONE;
  std::optional<tetrakis::PageIndex> pages;  ///< of TKS_INDEX_PAGES
  tetrakis::TakenPackets packets;
  std::optional<tetrakis::ScatteredPackets> scattered;  ///< once bytes left a gap
  int heights_level = 0, texture_level = 0;
  uint32_t frame = 0;  ///< that is shown, of a stream of several
  /// Base and step that the stream states: those of `parsed` are the shown frame's.
  double base = 0, step = 1;
  std::optional<tetrakis::DecodedHeights> heights;  ///< of that level, decoded on first use
  bool remembers = false;  ///< what was decoded of tracks, so that more bytes cost what they tell
  tetrakis::HeightsMemory heights_memory;  ///< for views of all levels
  tetrakis::TextureMemory texture_memory;
  tetrakis::HeightsMemory heights_windows;  ///< what windows leave to those that come after them
  tetrakis::TextureMemory texture_windows;
  uint64_t most_of_windows = 0;  ///< bytes that tracks, or parts, of each may take
  uint32_t threads = 1;
  tks_limits limits{};        ///< that it was opened with
  uint64_t max_memory = 0;    ///< of the decoder and any call
  tetrakis::Status refused;   ///< once bytes were: it takes no more
  bool is_lost = false;       ///< memory ended while it took bytes: it decodes nothing any more
  tetrakis::Status last;      ///< of the last call, which owns its sentence, ...
  const char* sentence = "";  ///< ... unless memory was exhausted
};

namespace tetrakis::inline api {

/// Returns the heights of the decoder's level, which are decoded once. TKS_USAGE if the stream
/// holds none.
Result<const DecodedHeights*> decodedHeights(tks_decoder& decoder);

/// The heights in steps, with their corrections of steps and without those of samples.
Result<const DecodedGeometry*> decodedGeometry(tks_decoder& decoder);

/// How many frames the stream has.
uint32_t framesOf(const StreamHeader& header);

/// Whether nothing of the heights was sent, so that all samples are alike. Heights of frames with
/// scales may differ by roundings from level to level, and other frames go on from earlier ones.
inline bool heightsAreUnsent(const tks_decoder& decoder) {
  const FramesHeader& frames = decoder.parsed.header.geometry->frames;
  return decoder.packets.payload.nothingOf(Component::kGeometry) && frames.scales.empty() &&
         frames.reference == 0;
}
/// The same of texels.
inline bool texelsAreUnsent(const tks_decoder& decoder) {
  return decoder.packets.payload.nothingOf(Component::kTexture) &&
         decoder.parsed.header.texture->frames.reference == 0;
}

/// Gives the header of heights the base and the step of the frame that is shown.
void showScale(tks_decoder& decoder);

/// Decodes what a view shows of the heights, which the stream holds. Keeps what the decoder
/// remembers, and no heights.
DecodedHeights decodeHeights(tks_decoder& decoder, const View& view);

/// Takes the packets apart that are there. TKS_CORRUPT; TKS_LIMIT: they take too much memory.
Result<TakenPackets> takePackets(const tks_decoder& decoder);

/// Takes apart what these ranges of the stream have brought, in time for that. On an error nothing
/// changes.
Status takeMorePackets(tks_decoder& decoder, std::span<const ByteRange> ranges);

/// Forgets what was decoded of tracks, and remembers no more of it.
void forget(tks_decoder& decoder);
/// The same of windows alone.
void forgetWindows(tks_decoder& decoder);

/// TKS_CORRUPT or TKS_USAGE, with their sentences.
Status wrongIndex();
Status noHeights();
/// Of calls that make meshes of planes alone.
Status noMesh();

/// Of a decoder that is_lost.
Status lost();

/// The views that a call shows of the component that a part belongs to: the window, or, without
/// one, all of the level that is set for the component; two views, from left to right, of a window
/// that reaches across the seam of a cylinder. TKS_USAGE with a sentence unless the stream holds
/// the component and the window lies inside of the level.
Result<std::vector<View>> askedViews(const tks_decoder& decoder, tks_part part,
                                     const tks_window* window);

/// The view that is decoded for a view of askedViews(): itself, or all of its level, out of which
/// it is then cut. The windows of coarser levels are cut out of drawings, stored samples, forests,
/// frames and planes with repeated lines.
View decodedFor(const StreamHeader& header, tks_part part, const View& view);

/// Whether the stream is there to its end.
bool isComplete(const tks_decoder& decoder);

/// Of a stream with heights: whether their samples keep what it says of them, lossless or a largest
/// error. The surface is then these; between whole steps it would be off by up to half of one more.
bool keepsPromise(const tks_decoder& decoder);

/// Height in the unit = heights value * scale + offset.
struct SurfaceScale {
  double scale, offset;
};
SurfaceScale surfaceScale(const StreamHeader& header, const DecodedGeometry& geometry);

/// The coarsest level of the heights or the texture of a header; 0 where there are none.
inline int coarsestLevelOf(const auto& component) {
  if (!component) return 0;
  const SharedForest& forest = component->wavelet.forest;
  return coarsestLevel(forest != nullptr ? Extent{forest->side(), forest->side()}
                                         : component->shown());
}

/// All of a level of heights or a texture.
inline View levelOf(const auto& component, int level) {
  const SharedForest& forest = component.wavelet.forest;
  return {level, {}, 0, forest != nullptr ? forest->side() : 0};
}

/// Runs f and keeps its sentence in the decoder. When memory ends, so does what the decoder
/// remembers of tracks: it may be half of a step.
template <class F>
tks_status keeping(tks_decoder* decoder, F&& f) {
  if (decoder == nullptr) return TKS_USAGE;
  const auto work = [&] {
    decoder->last = decoder->is_lost ? lost() : f();
    decoder->sentence = decoder->last.message().c_str();
    return decoder->last.code();
  };
  const auto exhausted = [&](const char* sentence) {
    decoder->sentence = sentence;
    decoder->heights_memory = {};
    decoder->texture_memory = {};
    decoder->heights_windows = {};
    decoder->texture_windows = {};
  };
  return guarded(work, exhausted);
}

}  // namespace tetrakis::inline api
