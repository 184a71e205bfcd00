// SPDX-License-Identifier: Apache-2.0
// TextureHeader is the part of the stream header that describes the texture (docs/FORMAT.md,
// section 2).
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/plane.hpp"
#include "bitstream/stream/coding_headers.hpp"
#include "bitstream/stream/line_repeats.hpp"
#include "bitstream/track/band.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::inline stream {

inline constexpr uint32_t kMaxTextureSide = 1u << 15;  ///< texels in a row or column of a grid

/// These stand in the place of a number of bit-planes: the texture is drawn
/// (codec/drawing/drawing_pass.hpp), or its samples are stored (bitstream/coder/byte_planes.hpp).
inline constexpr uint8_t kDrawnPlanes = 31;

/// What is added to the priority of a colour plane at its finest levels, in 1/16 of a binary order
/// of magnitude: how visible errors of a band are.
struct BandWeights {
  static constexpr uint64_t kMostLevels = 8;
  static constexpr int64_t kMaxPriority = 128;

  uint8_t levels = 0;  ///< 0: none, for no colour plane
  /// The list of a plane begins with HL and LH of level 1, HH of level 1, HL and LH of level 2.
  std::array<std::array<int64_t, 2 * kMostLevels>, 4> priority{};

  int64_t at(uint32_t plane, int level, Orientation orientation) const {
    if (orientation == Orientation::kLL || level > levels) return 0;
    return priority[plane]
                   [static_cast<size_t>(2 * (level - 1) + (orientation == Orientation::kHH))];
  }

  template <class V>
  void visit(V& v, uint32_t planes) {
    v.u8("weight_levels", levels, 1, kMostLevels);
    for (uint32_t c = 0; c < planes; ++c) {
      for (size_t i = 0; i < size_t{2} * levels && v.ok(); ++i)
        v.zigzag("band_priority", priority[c][i], kMaxPriority);
    }
  }
};

/// The values that channels have, where their type could hold more: the wavelet codes places in
/// these tables (texture_wavelet/tables/channel_tables.hpp).
struct ChannelTablesHeader {
  static constexpr uint32_t kMostValues = 1u << 16;

  bool present = false;
  std::array<uint32_t, 4> values{};  ///< how many a channel's table has; 0: it has none
  std::string code;

  template <class V>
  void visit(V& v, uint32_t planes) {
    for (uint32_t c = 0; c < planes; ++c) v.varint("table_values", values[c], 0, kMostValues);
    v.rest(code);
  }
};

/// Texture: centre, order and shears as in texture_wavelet/colour/colour.hpp. Drawn and stored ones
/// end with `planes`.
struct TextureHeader {
  uint32_t width = 0, height = 0;  ///< of the lines that are coded
  LineRepeats repeats;             ///< which of those that are shown they are
  uint8_t channels = 0;
  uint8_t sample = 0;  ///< TKS_U8 or TKS_U16
  uint8_t planes = 0;
  uint8_t colour_order = 0;
  /// Textures of 3 colour planes or more have the shears of samples, then those of coefficients.
  std::vector<std::array<int64_t, 6>> colour_shears{{}};
  std::array<int64_t, 3> further_shears{};  ///< of the last plane, a further colour
  std::array<uint16_t, 4> centre{};         ///< one per colour plane; of a table a place
  std::array<int64_t, 4> priority{};        ///< 16 log2 of each plane's weight, for the pass order
  WaveletHeader wavelet;
  ChannelTablesHeader tables;
  PriorityHeader priorities;
  RegionHeader regions;
  FramesHeader frames;
  BandWeights weights;
  /// Cut-out: alpha is 0 or the largest value, and no colour plane. A mask of so many bytes
  /// says which, ahead of the coefficients. 0: alpha, if there is one, is the last colour plane.
  uint64_t alpha_bytes = 0;
  uint8_t hidden = 0;        ///< of a cut-out: colours where alpha is 0 are not coded
  bool opaque = false;       ///< no channel is alpha: the last of 2 or 4 is a further colour
  uint16_t white_level = 0;  ///< of 16 bits: what shows as white (base/samples.hpp); 0: 65535
  /// Bytes of the overlay, drawn over what the coefficients make, which stop at its border.
  uint64_t overlay_bytes = 0;
  /// The reach of bridges over texels that are hidden or drawn over (codec/wavelet/morphology.hpp);
  /// 0: none.
  uint8_t bridge = 0;
  bool stored = false;      ///< sample by sample, without a transform
  std::string later_parts;  ///< of kinds that are not known and inform, as they were read

  Extent extent() const { return {width, height}; }
  Extent shown() const { return repeats.none() ? extent() : repeats.shown; }
  /// What pictures show as white.
  uint32_t white() const { return white_level > 0 ? white_level : (1u << sampleBits()) - 1; }
  int sampleBits() const { return sample == TKS_U8 ? 8 : 16; }
  uint32_t colourPlanes() const { return channels - (alpha_bytes > 0 ? 1u : 0u); }
  bool hasAlpha() const { return channels % 2 == 0 && !opaque; }
  /// Whether a colour plane is alpha.
  bool isAlpha(uint32_t plane) const { return hasAlpha() && plane + 1 == channels; }

  /// domain: the lines that are shown.
  template <class V>
  void visit(V& v, Extent domain) {
    v.u8("channels", channels, 1, 4);
    v.u8("sample", sample, 0, TKS_U16);
    v.require("sample", sample != TKS_I8);
    Coding coding = this->coding();
    v.u8("coding", coding, 0, static_cast<uint64_t>(Coding::kWavelet));
    if (coding != Coding::kWavelet) planes = kDrawnPlanes;
    stored = coding == Coding::kStored;
    if (coding == Coding::kWavelet) wavelet.visit(v, planes);
    const Extent coded = visitLines(v, PartKind::kRepeatedLines, domain, repeats);
    width = coded.width;
    height = coded.height;
    v.part(PartKind::kPriorities, !priorities.none(), [&](auto& part) { priorities.visit(part); });
    v.part(PartKind::kBridges, bridge > 0, [&](auto& part) { part.u8("bridge", bridge, 1, 255); });
    v.part(PartKind::kFrames, !frames.none(), [&](auto& part) { frames.visit(part); });
    v.part(PartKind::kReference, frames.reference > 0,
           [&](auto& part) { frames.visitReference(part); });
    v.part(PartKind::kCutOut, alpha_bytes > 0, [&](auto& part) {
      part.varint("alpha_bytes", alpha_bytes, 1, UINT64_MAX >> 1);
      part.u8("hidden", hidden, 0, 1);
    });
    v.part(PartKind::kOverlay, overlay_bytes > 0,
           [&](auto& part) { part.varint("overlay_bytes", overlay_bytes, 1, UINT64_MAX >> 1); });
    const bool coloured =
        v.part(PartKind::kColours, !direct(), [&](auto& part) { visitColours(part); });
    v.require("colours", coloured == (coding == Coding::kWavelet));
    visitOthers(v);
    v.endParts(later_parts);
  }
  bool drawn() const { return direct() && !stored; }
  /// The texture was coded without a transform: drawn or stored.
  bool direct() const { return planes == kDrawnPlanes; }
  Coding coding() const {
    return !direct() ? Coding::kWavelet : stored ? Coding::kStored : Coding::kDrawn;
  }

  static constexpr uint64_t kMostWhite = 0xfffe;
  static constexpr int64_t kMaxPriority = 128;
  static constexpr uint8_t kOrders = 6;      ///< of channels
  static constexpr uint8_t kMostShears = 8;  ///< sets of shears

 private:
  template <class V>
  void visitColours(V& v) {
    for (size_t c = 0; c < colourPlanes() && v.ok(); ++c) {
      v.varint("centre", centre[c], 0, 0xffff);
      v.zigzag("priority", priority[c], kMaxPriority);
    }
    if (colourPlanes() < 3) return;
    v.u8("colour_order", colour_order, 0, kOrders - 1);
    auto sets = static_cast<uint8_t>(colour_shears.size());
    v.u8("shear_sets", sets, 1, kMostShears);
    if (!v.ok()) return;
    colour_shears.resize(sets);
    for (auto& shears : colour_shears) {
      for (int64_t& shear : shears) v.zigzag("colour_shear", shear, INT16_MAX);
    }
  }

  template <class V>
  void visitOthers(V& v) {
    opaque = v.part(PartKind::kFurtherColour, opaque && channels % 2 == 0, [&](auto& part) {
      for (size_t c = 0; !direct() && c + 1 < channels; ++c)
        part.zigzag("further_shear", further_shears[c], INT16_MAX);
    });
    tables.present = v.part(PartKind::kChannelTables, tables.present,
                            [&](auto& part) { tables.visit(part, colourPlanes()); });
    v.part(PartKind::kWhiteLevel, white_level > 0,
           [&](auto& part) { part.varint("white_level", white_level, 1, kMostWhite); });
    v.part(PartKind::kBandWeights, weights.levels > 0,
           [&](auto& part) { weights.visit(part, colourPlanes()); });
  }
};

}  // namespace tetrakis::inline stream
