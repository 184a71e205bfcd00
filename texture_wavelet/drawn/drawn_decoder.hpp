// SPDX-License-Identifier: Apache-2.0
// decodeDrawn() and decodeOverlay() take any prefix of the codeword of a drawing and return its
// texels. DrawnColours, the list of its colours, is shared with the encoder, and fillDrawn() gives
// a colour to texels that have not arrived.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/samples.hpp"
#include "base/view.hpp"
#include "base/zeroed_array.hpp"
#include "bitstream/stream/texture_header.hpp"
#include "codec/drawing/drawing_models.hpp"
#include "codec/drawing/drawing_neighbours.hpp"
#include "codec/lattice/levels.hpp"

namespace tetrakis::inline drawn {

// DrawnColours is the list of colours of a drawn texture, and codes each new colour.

using DrawnColour = std::array<uint16_t, 4>;  ///< one value for each channel, the others 0

/// The first colour in the list of an overlay, grey, which is not shown.
inline constexpr DrawnIndex kSeeThrough = 0;

class DrawnColours {
 public:
  DrawnColours() = default;
  /// format: channels, bits.
  explicit DrawnColours(const Texels& format) : channels_(format.channels), bits_(format.bits) {}

  size_t size() const { return colours_.size(); }
  const DrawnColour& operator[](DrawnIndex i) const { return colours_[i]; }

  /// 0 for one colour, 1 for two.
  uint32_t difference(DrawnIndex a, DrawnIndex b) const { return a != b; }
  void add(const DrawnColour& colour) { colours_.push_back(colour); }

  /// Codes the colour of a texel that the list lacks. Each channel as the difference to the mean of
  /// the first two candidates, plus the difference that the channel before had.
  template <class Io>
  void code(const Candidates& around, size_t texel, Io& io) {
    const int half = 1 << (bits_ - 1), most = 2 * half - 1;
    const DrawnColour& ours = io.value(texel);
    DrawnColour colour{};
    int carried = 0;
    for (uint32_t c = 0; c < channels_; ++c) {
      int mean = half;
      if (around.count() > 0) {
        const VotedIndex &a = around[0], &b = around[std::min(around.count() - 1, 1)];
        mean = (colours_[a.index][c] + colours_[b.index][c]) / 2;
      }
      const int expected = std::clamp(mean + carried, 0, most);
      const int residual = codeResidual(residuals_[c], ours[c] - expected, io);
      const int value = std::clamp(expected + residual, 0, most);
      if (io.stopped()) return;
      colour[c] = static_cast<uint16_t>(value);
      carried = value - mean;
    }
    colours_.push_back(colour);
  }

 private:
  static constexpr size_t kClasses = 17;  ///< of a residual: bits of its magnitude

  uint32_t channels_ = 1;
  int bits_ = 8;
  std::vector<DrawnColour> colours_;
  std::array<ResidualModels<kClasses>, 4> residuals_;
};

// fillDrawn() gives every texel of a drawn texture a colour, whether the texel is decoded or not.

/// The middle of the range in every channel.
DrawnColour greyOf(const Texels& format);

/// Writes the samples of all texels; the format of texels and the size of its samples are set.
/// levels: those of the grid, coarse to fine. indices: width * height, row by row. A texel without
/// one is the mean of the coarser vertices next to it; a root, grey.
void fillDrawn(std::span<const Level> levels, std::span<const KeptIndex> indices,
               const DrawnColours& colours, Texels& texels);

/// The same of a window of an image; texels: its own, whose samples become those.
void fillDrawn(std::span<const Level> levels, std::span<const KeptIndex> indices,
               const DrawnColours& colours, Extent whole, const Window& window, Texels& texels);

// decodeDrawn() and decodeOverlay() decode any prefix of the codeword of a drawn texture, or of an
// overlay, to texels. They compute with integers only.

/// Decodes what a view shows. Of a level only its texels are decoded; for a window all are, but
/// only those that it needs get colours. codeword: any prefix of the track of a texture with
/// header.drawn(). Safe on any bytes.
Texels decodeDrawn(const TextureHeader& header, std::span<const uint8_t> codeword,
                   const View& view);

/// What lies over a photograph.
struct DrawnOverlay {
  ZeroedArray<KeptIndex> indices;  ///< of every texel
  uint32_t step = 1;               ///< those that are known lie at its multiples
  DrawnColours colours;

  /// Where nothing is known nothing is shown.
  bool covers(size_t texel) const {
    const DrawnIndex index = indices[texel];
    return index != kNoIndex && index != kSeeThrough;
  }
};

/// The format of a texture, without samples.
Texels formatOf(const TextureHeader& header);

/// The colours of an overlay before any is coded.
DrawnColours overlayColours(const Texels& format);

/// codeword: any prefix of that of a texture's overlay. Safe on any bytes.
DrawnOverlay decodeOverlay(const TextureHeader& header, std::span<const uint8_t> codeword);

}  // namespace tetrakis::inline drawn
