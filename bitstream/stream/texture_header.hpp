// SPDX-License-Identifier: Apache-2.0
// What the stream header says of the texture (docs/FORMAT.md, section 2).
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

inline constexpr uint32_t kMaxTextureSide = 1u << 15;  ///< texels in a row or column

/// These stand in the place of a number of bit-planes: the texture is drawn
/// (codec/drawing/drawing_pass.hpp), or its samples are stored
/// (bitstream/coder/byte_planes.hpp).
inline constexpr uint8_t kDrawnPlanes = 31, kStoredTexture = 63;

/// What is added to the priority of a colour plane at its finest levels, in 1/16 of a binary order
/// of magnitude: how visible errors of a band are. A part of the header of its own.
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
    v.text("value_tables", code);
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
  RegionHeader regions;  ///< a part of the header of its own
  BandWeights weights;
  /// Cut-out: alpha is 0 or the largest value, and no colour plane. A mask of so many bytes
  /// says which, ahead of the coefficients. 0: alpha, if there is one, is the last colour plane.
  uint64_t alpha_bytes = 0;
  uint8_t hidden = 0;        ///< of a cut-out: colours where alpha is 0 are not coded
  bool opaque = false;       ///< no channel is alpha: the last of 2 or 4 is a further colour
  uint16_t white_level = 0;  ///< of 16 bits: what shows as white (base/white_level.hpp); 0: 65535
  /// Bytes of the overlay, drawn over what the coefficients make, which stop at its border.
  uint64_t overlay_bytes = 0;
  /// The reach of bridges over texels that are hidden or drawn over (wavelet/bridges.hpp); 0: none.
  uint8_t bridge = 0;
  bool stored = false;  ///< sample by sample, without a transform

  Extent extent() const { return {width, height}; }
  Extent shown() const { return repeats.none() ? extent() : repeats.shown; }
  /// What pictures show as white.
  uint32_t white() const { return white_level > 0 ? white_level : (1u << sampleBits()) - 1; }
  int sampleBits() const { return sample == TKS_U8 ? 8 : 16; }
  uint32_t colourPlanes() const { return channels - (alpha_bytes > 0 ? 1u : 0u); }
  bool hasAlpha() const { return channels % 2 == 0 && !opaque; }
  /// Whether a colour plane is alpha.
  bool isAlpha(uint32_t plane) const { return hasAlpha() && plane + 1 == channels; }

  template <class V>
  void visit(V& v) {
    LineFields lines(repeats, extent());
    v.varint("texture_width", lines.whole.width, 1, kMaxTextureSide);
    v.varint("texture_height", lines.whole.height, 1, kMaxTextureSide);
    const Alpha alpha = visitChannels(v);
    auto type = static_cast<uint8_t>(
        sample + (tables.present ? kWithTables : 0) + (lines.repeated() ? kWithRepeats : 0) +
        (bridge > 0 ? kWithBridges : 0) + (white_level > 0 ? kWithWhite : 0));
    v.u8("texture_sample", type, 0,
         kWithWhite + kWithBridges + kWithRepeats + kWithTables + TKS_U16);
    sample = type % kWithTables;
    tables.present = (type & kWithTables) != 0;
    const bool bridges = (type & kWithBridges) != 0;
    if (bridges && bridge == 0) bridge = 1;  // until it is read, which direct textures do not
    const Extent coded = lines.visitMap(v, (type & kWithRepeats) != 0);
    width = coded.width;
    height = coded.height;
    if (type & kWithWhite) v.varint("white_level", white_level, 1, kMostWhite);
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
    if (alpha == kCutOut) {
      v.varint("alpha_bytes", alpha_bytes, 1, UINT64_MAX >> 1);
      v.u8("hidden", hidden, 0, 1);
    }
    if (coding >= overlaid) v.varint("overlay_bytes", overlay_bytes, 1, UINT64_MAX >> 1);
    if (bridges) v.u8("bridge", bridge, 1, 255);
    for (size_t c = 0; c < colourPlanes() && v.ok(); ++c) {
      v.varint("centre", centre[c], 0, 0xffff);
      v.zigzag("priority", priority[c], kMaxPriority);
    }
    if (colourPlanes() >= 3) visitShears(v);
    for (size_t c = 0; alpha == kOpaque && c + 1 < colourPlanes() && v.ok(); ++c)
      v.zigzag("further_shear", further_shears[c], INT16_MAX);
    if (tables.present) tables.visit(v, colourPlanes());
  }
  bool drawn() const { return direct() && !stored; }
  /// The texture was coded without a transform: drawn or stored.
  bool direct() const { return planes == kDrawnPlanes; }

  static constexpr uint8_t kWithTables = 4;    ///< bit beside the type of the samples
  static constexpr uint8_t kWithRepeats = 8;   ///< another one
  static constexpr uint8_t kWithBridges = 16;  ///< a third one
  static constexpr uint8_t kWithWhite = 32;    ///< a fourth one
  static constexpr uint64_t kMostWhite = 0xfffe;
  static constexpr uint8_t kWithPriorities = 64;  ///< bit beside the number of bit-planes
  static constexpr int64_t kMaxPriority = 128;
  static constexpr uint8_t kOrders = 6;      ///< of channels
  static constexpr uint8_t kMostShears = 8;  ///< sets of shears

 private:
  enum Alpha : uint8_t { kPlain = 0, kCutOut = 4, kOpaque = 6 };  ///< before half of the channels

  template <class V>
  Alpha visitChannels(V& v) {
    const Alpha alpha = alpha_bytes > 0 ? kCutOut : opaque && channels % 2 == 0 ? kOpaque : kPlain;
    auto kind = static_cast<uint8_t>(alpha == kPlain ? channels : alpha + channels / 2);
    v.u8("channels", kind, 1, kOpaque + 2);
    const Alpha read = kind <= kCutOut ? kPlain : kind <= kOpaque ? kCutOut : kOpaque;
    channels = static_cast<uint8_t>(read == kPlain ? kind : 2 * (kind - read));
    opaque = read == kOpaque;
    return read;
  }

  template <class V>
  void visitShears(V& v) {
    auto colour = static_cast<uint8_t>(colour_order + kOrders * (colour_shears.size() - 1));
    v.u8("colour", colour, 0, kOrders * kMostShears - 1);
    colour_order = colour % kOrders;
    colour_shears.resize(colour / kOrders + size_t{1});
    for (auto& shears : colour_shears) {
      for (int64_t& shear : shears) v.zigzag("colour_shear", shear, INT16_MAX);
    }
  }
};

}  // namespace tetrakis::inline stream
