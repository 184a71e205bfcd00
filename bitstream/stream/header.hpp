// SPDX-License-Identifier: Apache-2.0
// The stream header (docs/FORMAT.md, section 2). A decoder can size everything from it before it
// allocates anything.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/plane.hpp"
#include "base/status.hpp"
#include "bitstream/stream/fields.hpp"
#include "bitstream/stream/georeference.hpp"
#include "bitstream/stream/line_repeats.hpp"
#include "bitstream/stream/packet.hpp"
#include "bitstream/track/band.hpp"
#include "bitstream/track/regions.hpp"

namespace tetrakis::inline stream {

inline constexpr std::array<uint8_t, 4> kMagic = {'T', 'K', 'S', 0x1a};
inline constexpr uint8_t kFormatVersion = 1;
inline constexpr uint8_t kMainProfile = 0;
inline constexpr uint32_t kMaxSide = 1u << 20;         ///< samples in a row or column of heights
inline constexpr uint32_t kMaxTextureSide = 1u << 15;  ///< texels in a row or column
inline constexpr int kMaxFractionBits = 8;
inline constexpr uint32_t kMaxHeaderBytes = 1u << 20;

/// Which wavelet: wavelet/wavelet.hpp.
struct WaveletHeader {
  std::array<uint8_t, 3> filters{};  ///< of level 1, of level 2, of all coarser ones
  uint8_t fraction_bits = 0;         ///< the transform works on samples * 2^fraction_bits
  uint8_t bits = 0;                  ///< of a sample with its fraction: how wide sums must be
  /// Without fraction bits: the low band is doubled after this level and the next; 0: never.
  uint8_t first_doubled = 0;
  /// Without fraction bits: the inverse rounds if the coefficients have so many bytes, of all
  /// tracks together.
  uint64_t rounded_bytes = 0;

  template <class V>
  void visit(V& v) {
    for (uint8_t& filter : filters) v.u8("filter", filter, 0, 4);
    v.u8("fraction_bits", fraction_bits, 0, kMaxFractionBits);
    v.u8("sample_bits", bits, 0, 32);
    if (fraction_bits > 0) return;
    v.u8("first_doubled", first_doubled, 0, kMostDoubled);
    v.varint("rounded_bytes", rounded_bytes, 0, UINT64_MAX >> 1);
  }
  static constexpr uint8_t kMostDoubled = 4;
};

/// Spatial regions of a component: bitstream/track/regions.hpp.
struct RegionHeader {
  uint8_t side_log2 = 0;  ///< of the regions of the finest levels; 0: one region

  bool isDefault() const { return *this == RegionHeader{}; }
  bool operator==(const RegionHeader&) const = default;

  template <class V>
  void visit(V& v) {
    v.u8("region_log2", side_log2, 0, kMostRegionLog2);
  }
};

/// Tiles of the samples of a component that come earlier than others: wavelet/priority_map.hpp.
struct PriorityHeader {
  uint8_t tile_log2 = 0;  ///< sides of the tiles; 0: none, all have the same priority
  std::string code;       ///< of the map, empty or not

  bool none() const { return tile_log2 == 0; }

  template <class V>
  void visit(V& v) {
    v.u8("tile_log2", tile_log2, kLeastTileLog2, kMostRegionLog2);
    v.text("priority_map", code);
  }
  static constexpr uint8_t kLeastTileLog2 = 4;
  static constexpr uint64_t kMostTiles = 65536;
};

/// The tiles of a side of a plane.
inline uint32_t tilesAlong(uint32_t side, int tile_log2) {
  return ((side - 1) >> tile_log2) + 1;
}

/// What corrections are added to.
enum class CorrectionKind : uint8_t {
  kNone = 0,
  kSteps = 1,   ///< heights in steps: heights += correction_step * correction
  kSamples = 2  ///< samples, in the order of their type: restores them bit for bit
};

/// Heights: integer q (after dropping fraction_bits) stands for the sample base + q * step.
struct GeometryHeader {
  uint32_t width = 0, height = 0;  ///< of the lines that are coded
  LineRepeats repeats;             ///< which of those that are shown they are
  uint8_t sample = 0;              ///< tks_sample of the input and of the decoded output
  uint8_t planes = 0;
  bool drawn = false;  ///< with kDirectPlanes alone
  uint8_t exact = 0;   ///< the steps restore every input sample
  double base = 0, step = 1;
  double max_error = -1;  ///< guaranteed for the complete stream, in the unit; < 0: not stated
  WaveletHeader wavelet;
  PriorityHeader priorities;
  RegionHeader regions;  ///< a part of the header of its own

  template <class V>
  void visit(V& v) {
    Extent whole = shown();
    v.varint("geometry_width", whole.width, 1, kMaxSide);
    v.varint("geometry_height", whole.height, 1, kMaxSide);
    auto kind = static_cast<uint8_t>(sample + (repeats.none() ? 0 : kWithRepeats));
    v.u8("geometry_sample", kind, 0, kWithRepeats + TKS_F32);
    sample = kind % kWithRepeats;
    if (kind >= kWithRepeats) v.text("repeated_lines", repeats.code);
    if (v.ok()) setLines(whole, kind >= kWithRepeats);
    auto coding =
        static_cast<uint8_t>(planes + (drawn || !priorities.none() ? kWithPriorities : 0));
    v.u8("geometry_planes", coding, 0, kWithPriorities + kDirectPlanes);
    planes = coding % kWithPriorities;
    drawn = coding == kWithPriorities + kDirectPlanes;
    if (coding >= kWithPriorities && !drawn) priorities.visit(v);
    v.u8("exact", exact, 0, 1);
    v.f64("base", base);
    v.f64("step", step);
    v.f64("max_error", max_error);
    if (!direct()) wavelet.visit(v);
  }
  Extent extent() const { return {width, height}; }
  Extent shown() const { return repeats.none() ? extent() : repeats.shown; }
  /// Without a transform: drawn or stored.
  bool direct() const { return planes == kDirectPlanes; }
  bool stored() const { return direct() && !drawn; }

  /// In the place of a number of bit-planes: steps are drawn (codec/geometry/drawn_heights.hpp), or
  /// the samples are stored (bitstream/coder/byte_planes.hpp).
  static constexpr uint8_t kDirectPlanes = 31;
  static constexpr uint8_t kWithPriorities = 32;  ///< bit beside the number of bit-planes
  static constexpr uint8_t kWithRepeats = 8;      ///< bit beside the type of the samples

 private:
  void setLines(Extent whole, bool repeated) {
    if (repeated) repeats.shown = whole;
    const Extent coded = repeated ? lineMapsOf(repeats).coded() : whole;
    width = coded.width;
    height = coded.height;
  }
};

/// A point of the polyline that stands for a table of values while that is missing.
struct TableKnot {
  uint32_t place = 0;  ///< in the table
  int64_t rise = 0;    ///< of its value above base + step * (place - middle), in 1/16 steps

  bool operator==(const TableKnot&) const = default;
};

/// What a geometry track holds besides coefficients:
///
///   validity codeword | flat areas | coefficients | corrections
///
/// A table of values lies within the coefficients, or at one of their ends.
struct GeometryLayers {
  uint64_t validity_bytes = 0;  ///< 0: every sample is valid
  uint64_t table_bytes = 0;     ///< 0: steps are multiples; else they count the values of a table
  uint32_t table_values = 0;    ///< with a table only: how many it has
  uint64_t table_after = 0;     ///< likewise: bytes of coefficients before it
  std::vector<TableKnot> table_knots = {};  ///< likewise, by rising places
  uint64_t flat_bytes = 0;                  ///< 0: there are no flat areas
  uint32_t flat_areas = 0;                  ///< with flat areas only: how many there are
  uint8_t has_nodata = 0;  ///< voids have the sample value `nodata`; else NaN (f32 only)
  double nodata = 0;
  CorrectionKind corrections = CorrectionKind::kNone;
  uint64_t coefficient_bytes = 0;  ///< with corrections only: what follows is theirs
  uint32_t correction_step = 0;    ///< kSteps only: unit of the corrections, in steps

  bool isDefault() const { return *this == GeometryLayers{}; }
  bool operator==(const GeometryLayers&) const = default;

  template <class V>
  void visit(V& v) {
    v.varint("validity_bytes", validity_bytes, 0, UINT64_MAX >> 1);
    v.u8("has_nodata", has_nodata, 0, 1);
    if (has_nodata) v.f64("nodata", nodata);
    auto kinds = static_cast<uint8_t>(static_cast<uint8_t>(corrections) |
                                      (table_bytes > 0 ? kWithTable : 0) |
                                      (flat_bytes > 0 ? kWithFlatAreas : 0));
    v.u8("layer_kinds", kinds, 0, kWithFlatAreas + kWithTable + 2);
    corrections = static_cast<CorrectionKind>(kinds % kWithTable);
    if (kinds & kWithTable) {
      v.varint("table_bytes", table_bytes, 1, UINT64_MAX >> 1);
      v.varint("table_values", table_values, 2, kMostValues);
      v.varint("table_after", table_after, 0, UINT64_MAX >> 1);
      visitKnots(v);
    }
    if (kinds & kWithFlatAreas) {
      v.varint("flat_bytes", flat_bytes, 1, UINT64_MAX >> 1);
      v.varint("flat_areas", flat_areas, 1, kMostFlatAreas);
    }
    if (corrections == CorrectionKind::kNone) return;
    v.varint("coefficient_bytes", coefficient_bytes, table_after, UINT64_MAX >> 1);
    if (corrections == CorrectionKind::kSteps) {
      v.varint("correction_step", correction_step, 1, kMaxCorrectionStep);
    }
  }
  static constexpr uint64_t kMaxCorrectionStep = uint64_t{1} << 26;
  static constexpr uint8_t kWithTable = 4, kWithFlatAreas = 8;  ///< bits beside the corrections
  static constexpr uint64_t kMostFlatAreas = 65535;
  static constexpr uint64_t kMostFlatSamples = uint64_t{1} << 31;  ///< of a plane with flat areas
  static constexpr uint32_t kMostValues = 1u << 20;
  static constexpr uint8_t kMostKnots = 64;
  static constexpr int64_t kMostRise = int64_t{1} << 28;

  uint64_t openingBytes() const { return validity_bytes + flat_bytes; }

 private:
  /// Each as what it differs by from the one before it.
  template <class V>
  void visitKnots(V& v) {
    auto count = static_cast<uint8_t>(table_knots.size());
    v.u8("table_knots", count, 0, kMostKnots);
    table_knots.resize(count);
    TableKnot before;
    for (size_t i = 0; i < table_knots.size() && v.ok(); ++i) {
      TableKnot& knot = table_knots[i];
      uint32_t gap = knot.place - before.place;
      int64_t rise = knot.rise - before.rise;
      v.varint("knot_gap", gap, i > 0 ? 1 : 0, table_values - 1u - before.place);
      v.zigzag("knot_rise", rise, 2 * kMostRise);
      knot = {before.place + gap, before.rise + rise};
      before = knot;
    }
  }
};

/// In the place of a number of bit-planes: the texture is drawn
/// (codec/drawing/drawing_pass.hpp), or its samples are stored
/// (bitstream/coder/byte_planes.hpp).
inline constexpr uint8_t kDrawnPlanes = 31, kStoredTexture = 63;

/// What is added to the priority of a component at its finest levels, in 1/16 of a binary order of
/// magnitude: how visible errors of a band are. A part of the header of its own.
struct BandWeights {
  static constexpr uint64_t kMostLevels = 8;
  static constexpr int64_t kMaxPriority = 128;

  uint8_t levels = 0;  ///< 0: none, for no component
  /// Of a component: HL and LH of level 1, HH of level 1, HL and LH of level 2, ...
  std::array<std::array<int64_t, 2 * kMostLevels>, 4> priority{};

  int64_t at(uint32_t component, int level, Orientation orientation) const {
    if (orientation == Orientation::kLL || level > levels) return 0;
    return priority[component]
                   [static_cast<size_t>(2 * (level - 1) + (orientation == Orientation::kHH))];
  }

  template <class V>
  void visit(V& v, uint32_t components) {
    v.u8("weight_levels", levels, 1, kMostLevels);
    for (uint32_t c = 0; c < components; ++c) {
      for (size_t i = 0; i < size_t{2} * levels && v.ok(); ++i)
        v.zigzag("band_priority", priority[c][i], kMaxPriority);
    }
  }
};

/// Texture: centre, order and shears as in texture_wavelet/colour/colour.hpp. Drawn and stored ones
/// end with `planes`.
struct TextureHeader {
  uint32_t width = 0, height = 0;
  uint8_t channels = 0;
  uint8_t sample = 0;  ///< TKS_U8 or TKS_U16
  uint8_t planes = 0;
  uint8_t colour_order = 0;
  /// With 3 components or more: of samples, then those of coefficients.
  std::vector<std::array<int64_t, 6>> colour_shears{{}};
  std::array<uint16_t, 4> centre{};   ///< one per component
  std::array<int64_t, 4> priority{};  ///< 16 log2 of each component's weight, for the pass order
  WaveletHeader wavelet;
  PriorityHeader priorities;
  RegionHeader regions;  ///< a part of the header of its own
  BandWeights weights;
  /// Cut-out: alpha is 0 or the largest value, and no component. A mask of so many bytes says
  /// which, ahead of the coefficients. 0: alpha, if there is one, is the last component.
  uint64_t alpha_bytes = 0;
  uint8_t hidden = 0;  ///< of a cut-out: colours where alpha is 0 are not coded
  /// Bytes of the overlay, drawn over what the coefficients make, which stop at its border.
  uint64_t overlay_bytes = 0;
  bool stored = false;  ///< sample by sample, without a transform

  Extent extent() const { return {width, height}; }
  Extent shown() const { return extent(); }
  uint32_t components() const { return channels - (alpha_bytes > 0 ? 1u : 0u); }

  template <class V>
  void visit(V& v) {
    v.varint("texture_width", width, 1, kMaxTextureSide);
    v.varint("texture_height", height, 1, kMaxTextureSide);
    uint8_t kind = static_cast<uint8_t>(alpha_bytes == 0 ? channels : 4 + channels / 2);
    v.u8("channels", kind, 1, 6);
    channels = static_cast<uint8_t>(kind <= 4 ? kind : 2 * (kind - 4));
    v.u8("texture_sample", sample, 0, TKS_U16);
    const uint8_t overlaid = kDrawnPlanes + 1;
    auto coding = static_cast<uint8_t>(
        (stored ? kStoredTexture : planes + (overlay_bytes > 0 ? overlaid : 0)) +
        (priorities.none() ? 0 : kWithPriorities));
    v.u8("texture_planes", coding, 0, kWithPriorities + kStoredTexture - 1);
    const bool ordered = coding >= kWithPriorities;
    coding %= kWithPriorities;
    planes = coding % overlaid;
    stored = coding == kStoredTexture;
    if (ordered) priorities.visit(v);
    if (direct()) return;
    wavelet.visit(v);
    if (kind > 4) {
      v.varint("alpha_bytes", alpha_bytes, 1, UINT64_MAX >> 1);
      v.u8("hidden", hidden, 0, 1);
    }
    if (coding >= overlaid) v.varint("overlay_bytes", overlay_bytes, 1, UINT64_MAX >> 1);
    for (size_t c = 0; c < components() && v.ok(); ++c) {
      v.varint("centre", centre[c], 0, 0xffff);
      v.zigzag("priority", priority[c], kMaxPriority);
    }
    if (components() < 3) return;
    auto colour = static_cast<uint8_t>(colour_order + kOrders * (colour_shears.size() - 1));
    v.u8("colour", colour, 0, kOrders * kMostShears - 1);
    colour_order = colour % kOrders;
    colour_shears.resize(colour / kOrders + size_t{1});
    for (auto& shears : colour_shears) {
      for (int64_t& shear : shears) v.zigzag("colour_shear", shear, INT16_MAX);
    }
  }
  bool drawn() const { return direct() && !stored; }
  /// Without a transform: drawn or stored.
  bool direct() const { return planes == kDrawnPlanes; }

  static constexpr uint8_t kWithPriorities = 64;  ///< bit beside the number of bit-planes
  static constexpr int64_t kMaxPriority = 128;
  static constexpr uint8_t kOrders = 6;      ///< of channels
  static constexpr uint8_t kMostShears = 8;  ///< sets of shears
};

/// What the heights mean on the ground.
struct Metadata {
  double scale = 1, offset = 0;  ///< height in the unit = sample * scale + offset
  double spacing_x = 0, spacing_y = 0;
  std::string unit, vertical_datum, crs;

  bool isDefault() const;

  template <class V>
  void visit(V& v) {
    v.f64("scale", scale);
    v.f64("offset", offset);
    v.f64("spacing_x", spacing_x);
    v.f64("spacing_y", spacing_y);
    v.text("unit", unit);
    v.text("vertical_datum", vertical_datum);
    v.text("crs", crs);
  }
};

struct StreamHeader {
  uint8_t version = kFormatVersion;
  uint8_t profile = kMainProfile;
  uint8_t level = 0;
  uint64_t payload_bytes = 0;  ///< what the encoder wrote behind the header
  uint8_t lossless = 0;        ///< the complete stream restores every sample
  uint32_t triangles = 0;      ///< budget the stream was made for; 0: none
  std::optional<GeometryHeader> geometry;
  GeometryLayers layers;
  std::optional<TextureHeader> texture;
  Metadata metadata;
  Georeference georeference;
  std::vector<IndexEntry> index;  ///< of all packets, ahead of time
};

/// Tracks of each component; see demultiplex().
TrackCounts trackCounts(const StreamHeader& header);

/// Smallest n such that neither component has more than 4^(n + 8) samples.
uint8_t levelFor(const StreamHeader& header);

/// Magic, version, profile, level, size of the body, body, CRC-32 of everything before it. A long
/// index may make more than kMaxHeaderBytes, which no decoder reads; encoders refuse it.
std::vector<uint8_t> writeHeader(const StreamHeader& header);

struct ParsedHeader {
  StreamHeader header;
  size_t bytes = 0;  ///< header bytes: the payload starts here
};

/// How many bytes the header takes. If `bytes` ends before that is known: a smaller number, but
/// greater than bytes.size(). TKS_CORRUPT, TKS_UNSUPPORTED.
Result<uint64_t> headerBytes(std::span<const uint8_t> bytes);

/// TKS_TRUNCATED with the number of bytes needed if `bytes` ends early; TKS_CORRUPT,
/// TKS_UNSUPPORTED.
Result<ParsedHeader> readHeader(std::span<const uint8_t> bytes);

}  // namespace tetrakis::inline stream
