// SPDX-License-Identifier: Apache-2.0
// WaveletHeader, RegionHeader, PriorityHeader and FramesHeader are the parts of a header that
// heights and textures share: the wavelet, spatial regions, priorities over the ground, and frames;
// Coding says how a component is coded (docs/FORMAT.md, section 2).
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/forest.hpp"
#include "bitstream/track/track.hpp"

namespace tetrakis::inline stream {

inline constexpr int kMaxFractionBits = 8;
inline constexpr int kMostPlanes = 30;  ///< bit-planes

/// How a component is coded.
enum class Coding : uint8_t { kStored = 0, kDrawn = 1, kWavelet = 2 };

/// Kinds of the parts of a component. Those of heights and of textures have numbers of their own
/// where they are not the same.
struct PartKind {
  static constexpr uint64_t kRepeatedLines = 1, kPriorities = 2, kValidity = 3, kBridges = 4,
                            kLateMask = 5, kNodata = 6, kValueTable = 7, kFlatAreas = 8,
                            kCorrections = 9, kBaseMesh = 10, kFrames = 11, kReference = 12,
                            kCutOut = 16, kOverlay = 17, kColours = 18, kFurtherColour = 19,
                            kChannelTables = 20, kWhiteLevel = 21, kBandWeights = 22, kBound = 64;
};

/// Which wavelet: codec/wavelet/wavelet.hpp.
struct WaveletHeader {
  std::array<uint8_t, 3> filters{};  ///< of level 1, of level 2, of all coarser ones
  uint8_t fraction_bits = 0;         ///< the transform works on samples * 2^fraction_bits
  uint8_t bits = 0;                  ///< of a sample with its fraction: how wide sums must be
  /// Where there are no fraction bits, the low band is doubled after this level and the next two;
  /// 0: never.
  uint8_t first_doubled = 0;
  /// Where there are no fraction bits, the inverse rounds from the moment on when all tracks
  /// together have so many bytes of coefficients.
  uint64_t rounded_bytes = 0;
  bool ring = false;         ///< what the domain says: the last column lies beside the first one
  SharedForest forest = {};  ///< likewise: the raster is that of a forest

  /// Into how many patches the plane falls, each of which has regions of its own.
  uint32_t patches() const { return forest != nullptr ? forest->patches() : 1; }

  /// planes: bit-planes of the coefficients.
  template <class V>
  void visit(V& v, uint8_t& planes) {
    v.u8("planes", planes, 0, kMostPlanes);
    for (uint8_t& filter : filters) v.u8("filter", filter, 0, 5);
    v.u8("fraction_bits", fraction_bits, 0, kMaxFractionBits);
    v.u8("sample_bits", bits, 0, 32);
    if (fraction_bits > 0) return;
    v.u8("first_doubled", first_doubled, 0, kMostDoubled);
    v.varint("rounded_bytes", rounded_bytes, 0, UINT64_MAX >> 1);
  }
  static constexpr uint8_t kMostDoubled = 4;
};

/// Spatial regions of a component: bitstream/track/track.hpp.
struct RegionHeader {
  uint8_t side_log2 = 0;  ///< of the regions of the finest levels; 0: one region
};

/// Tiles of the samples of a component that come earlier than others:
/// codec/wavelet/priority_map.hpp.
struct PriorityHeader {
  uint8_t tile_log2 = 0;  ///< sides of the tiles; 0: none, all have the same priority
  std::string code;       ///< of the map, empty or not

  bool none() const { return tile_log2 == 0; }

  template <class V>
  void visit(V& v) {
    v.u8("tile_log2", tile_log2, kLeastTileLog2, kMostRegionLog2);
    v.rest(code);
  }
  static constexpr uint8_t kLeastTileLog2 = 4;
  static constexpr uint64_t kMostTiles = 65536;
};

/// Filters over time: codec/frames/frame_lifting.hpp.
enum class TimeFilter : uint8_t { kNone = 0, kHaar = 1, kFiveThree = 2 };

/// Of heights: what the steps of a frame are in those of the component: q of the frame stands for
/// offset + q * 2^shift of these.
struct FrameScale {
  static constexpr int64_t kMostOffset = int64_t{1} << 26;
  static constexpr uint8_t kMostShift = 24;

  int64_t offset = 0;
  uint8_t shift = 0;

  bool operator==(const FrameScale&) const = default;
};

/// The last frame of the group before in a sequence, which the frames of a group go on from: whole
/// planes of level 0.
struct FrameReference {
  std::vector<std::vector<int32_t>> planes;  ///< of each colour, or of heights, in whole steps
  std::vector<uint8_t> significant = {};     ///< of heights: as of DecodedGeometry
  uint32_t quiet_levels = 0;                 ///< likewise
};
/// Decodes it when it is asked for.
struct ReferenceSource {
  std::function<std::shared_ptr<const FrameReference>()> decode = {};
  uint64_t bytes = 0;  ///< of memory that this takes at most, beside the frame itself

  bool none() const { return !decode; }
};

/// Frames of a component, which follow one another in time. Each has the planes of the component.
struct FramesHeader {
  uint8_t count = 0;  ///< 0: the component has no frames
  TimeFilter filter = TimeFilter::kNone;
  std::vector<FrameScale> scales = {};  ///< of each frame; empty: all have the component's steps
  /// The frames go on from the last frame of the group before in a sequence, as so many bytes of
  /// its stream show it (codec/frames/frame_reference.hpp); 0: they stand by themselves.
  uint64_t reference = 0;
  ReferenceSource before = {};  ///< what these bytes show; none: it is not there

  bool none() const { return count == 0; }
  /// How many frames the component shows.
  uint32_t shown() const { return count > 0 ? count : 1; }
  FrameScale scale(size_t frame) const { return scales.empty() ? FrameScale() : scales[frame]; }

  template <class V>
  void visit(V& v) {
    v.u8("frames", count, 1, kMost);
    v.u8("time_filter", filter, 0, static_cast<uint64_t>(TimeFilter::kFiveThree));
  }
  template <class V>
  void visitReference(V& v) {
    v.varint("reference", reference, 1, kMostReference);
  }
  template <class V>
  void visitScales(V& v) {
    v.unless(std::vector<FrameScale>(), scales, [&] {
      if constexpr (V::kReads) scales.resize(v.ok() ? count : 0);
      for (FrameScale& scale : scales) {
        v.zigzag("frame_offset", scale.offset, FrameScale::kMostOffset);
        v.u8("frame_shift", scale.shift, 0, FrameScale::kMostShift);
      }
    });
  }
  static constexpr uint8_t kMost = 32;
  static constexpr uint64_t kMostReference = UINT64_MAX >> 2;
};

/// The tiles of a side of a plane.
inline uint32_t tilesAlong(uint32_t side, int tile_log2) {
  return ((side - 1) >> tile_log2) + 1;
}

}  // namespace tetrakis::inline stream
