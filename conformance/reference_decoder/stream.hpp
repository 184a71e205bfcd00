// SPDX-License-Identifier: Apache-2.0
// Reference decoder: header fields and the two codewords (docs/FORMAT.md, sections 2 and 3), and
// what sections 8 and 9 make of them.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "conformance/reference_decoder.hpp"
#include "conformance/reference_decoder/forest.hpp"

namespace tetrakis::reference {

enum SampleType { kU8, kI8, kU16, kI16, kU32, kI32, kF32 };

/// FORMAT 2, Domain.
struct Domain {
  int kind = 0, width = 0, height = 0;
  Forest forest = {};

  bool known() const { return kind <= 2; }
  bool ring() const { return kind == 1; }
};

/// FORMAT 2, table Wavelet.
struct WaveletHeader {
  std::array<int, 3> filters = {};
  int fractionBits = 0, sampleBits = 0, firstDoubled = 0;
  uint64_t roundedBytes = 0;
  Domain domain;
};

/// FORMAT 2, table Regions.
struct RegionHeader {
  int log2 = 0;
};

/// FORMAT 2, table Priorities.
struct PriorityHeader {
  int tileLog2 = 0;  ///< 0: none
  std::vector<uint8_t> code;
};

/// FORMAT 8.3: the coded line that each line shows; empty: all lines are coded.
struct LineMap {
  std::vector<int> columns, rows;

  LineMap() = default;
  LineMap(std::span<const uint8_t> code, int width, int height);
};

/// FORMAT 2, Triangle mesh.
struct TriangleMeshHeader {
  int triangles = 0, placeBits = 1, texcoordBits = 0, texcoordFraction = 0;
  double cell = 1;
  std::array<int64_t, 3> origin = {};
  std::array<int64_t, 2> texcoordOrigin = {};
  std::vector<uint8_t> codeword;
};

/// FORMAT 2, Base mesh.
struct BaseMeshHeader {
  int bits = 0;  ///< 0: none
  double cell = 1;
  std::array<double, 3> origin = {};
  std::vector<uint8_t> corners;
};

/// FORMAT 9.4.
struct FrameScale {
  int64_t offset = 0;
  int shift = 0;
};
/// The last frame of the group before, level 0: whole steps of each colour.
using ReferencePlanes = std::vector<std::vector<int32_t>>;
struct FramesHeader {
  int count = 0, filter = 0;       ///< count: 0: there are none
  std::vector<FrameScale> scales;  ///< of each frame; empty: all are 0
  uint64_t reference = 0;          ///< bytes of the stream of the group before
  ReferencePlanes before;          ///< what these show; empty: nothing is known of them

  int shown() const { return count > 0 ? count : 1; }
  bool suits() const { return reference == 0 || (count > 0 && scales.empty()); }

  FrameScale scale(int t) const { return scales.empty() ? FrameScale() : scales[size_t(t)]; }
};

struct GeometryHeader {
  int width = 0, height = 0, sample = 0, planes = 0;  ///< width and height: of the coded lines
  bool drawn = false;
  LineMap lines;
  double base = 0, step = 1;
  WaveletHeader wavelet;
  PriorityHeader priorities;
  RegionHeader regions;
  BaseMeshHeader baseMesh;
  FramesHeader frames;

  int shownWidth() const { return lines.columns.empty() ? width : int(lines.columns.size()); }
  int shownHeight() const { return lines.rows.empty() ? height : int(lines.rows.size()); }
};

/// FORMAT 2, table Layers.
struct TableKnot {
  int64_t place = 0, rise = 0;
};

struct Layers {
  uint64_t validityBytes = 0, coefficientBytes = 0;
  bool regionMasks = false;
  bool hasNodata = false;
  double nodata = 0;
  int corrections = 0;  ///< 0 none, 1 of steps, 2 of samples, 3 from relative steps, 4 facets
  uint32_t correctionStep = 0;
  double relativeStep = 0;
  int relativeQuarters = 0;
  int facetUnit = 0;
  uint64_t tableBytes = 0;  ///< 0: no table of values
  uint64_t flatBytes = 0;
  uint32_t flatAreas = 0;
  int bridge = 0;  ///< 0: none
  bool lateMask = false;
  uint64_t liftedBytes = 0, validityAfter = 0;
  uint32_t tableValues = 0;
  uint64_t tableAfter = 0;
  std::vector<TableKnot> tableKnots;
};

struct TextureHeader {
  int width = 0, height = 0, channels = 0, colourPlanes = 0, sample = 0, planes = 0;
  LineMap lines;  ///< width and height are of the coded ones
  bool stored = false;
  int shownWidth() const { return lines.columns.empty() ? width : int(lines.columns.size()); }
  int shownHeight() const { return lines.rows.empty() ? height : int(lines.rows.size()); }
  uint64_t alphaBytes = 0;    ///< 0: no cut-out
  uint64_t overlayBytes = 0;  ///< 0: no overlay
  bool hidden = false;
  bool opaque = false;  ///< the last of two or four channels is no alpha
  int bridge = 0;       ///< 0: none
  int white = 0;        ///< the value that pictures show as white
  WaveletHeader wavelet;
  PriorityHeader priorities;
  RegionHeader regions;
  FramesHeader frames;
  std::array<int, 4> centre = {}, priority = {};
  /// [colour plane][level - 1][1 for HH], as many levels as the header tells.
  std::array<std::vector<std::array<int, 2>>, 4> bandPriority;
  int colourOrder = 0;
  std::vector<std::array<int, 6>> shears;     ///< of samples, of level 2, 3, ...
  std::array<int, 3> furtherShears = {};      ///< of the last channel of an opaque texture
  std::vector<std::vector<uint32_t>> tables;  ///< of each channel; empty: it has none
};

/// The codewords of a component's tracks.
using Codewords = std::vector<std::vector<uint8_t>>;

/// FORMAT 2, what every component begins with.
struct Component {
  int kind = 0;
  int role = -1;  ///< 0 heights, 1 texture, -1: passed over
  bool named = false;
  Domain domain;
};

/// What a prefix of a stream holds.
struct Stream {
  Outcome outcome = Outcome::kDone;
  std::optional<GeometryHeader> geometry;
  Layers layers;
  std::optional<TextureHeader> texture;
  std::vector<Component> components;
  std::optional<TriangleMeshHeader> triangles;
  bool suits = true;  ///< what the parts of the header say fits together
  Choice choice;
  std::array<Codewords, 2> codewords;  ///< by role
};

/// Header and packets of a prefix.
Stream readStream(std::span<const uint8_t> prefix, uint64_t maxSamples, const Choice& choice = {});
/// The samples of a stream. kUnsupported: nobody gave what its frames go on from.
Decoded decode(const Stream& stream, Levels levels);

/// "Arithmetic on samples and coefficients wraps modulo 2^32" (FORMAT, notation).
constexpr int32_t wrap(int64_t value) {
  return static_cast<int32_t>(static_cast<uint32_t>(value));
}

/// Samples of the header's type, little endian (FORMAT 8); of frames (9.4) one behind the other.
std::vector<uint8_t> decodeHeights(const GeometryHeader& header, const Layers& layers,
                                   const Codewords& codewords, int level);

/// The same with repeated lines (FORMAT 8.3).
std::vector<uint8_t> decodeShownHeights(const GeometryHeader& header, const Layers& layers,
                                        const Codewords& codewords, int level);

/// Samples of the header's type, channels interleaved, little endian (FORMAT 9).
std::vector<uint8_t> decodeTexture(const TextureHeader& header, const Codewords& codewords,
                                   int level);

/// The same with repeated lines (FORMAT 8.3).
std::vector<uint8_t> decodeShownTexture(const TextureHeader& header, const Codewords& codewords,
                                        int level);

/// The same for kDrawnPlanes (FORMAT 9.1).
std::vector<uint8_t> decodeDrawn(const TextureHeader& header, std::span<const uint8_t> codeword,
                                 int level);

/// FORMAT 8.4: v of all samples, with f = 4.
std::vector<int32_t> decodeDrawnHeights(const GeometryHeader& header,
                                        std::span<const uint8_t> codeword,
                                        const std::vector<uint8_t>& valid);

/// FORMAT 9.2: at every texel nothing if it is seen through, or its colour.
std::vector<std::optional<std::array<int, 4>>> decodeOverlay(const TextureHeader& header,
                                                             std::span<const uint8_t> codeword);

inline constexpr int kDrawnPlanes = 31, kStoredPlanes = 31;

}  // namespace tetrakis::reference
