// SPDX-License-Identifier: Apache-2.0
// The pass codes drawn textures: maps, classes of land cover, plans, lettering. These have few
// colours and sharp edges. A wavelet spends most of its bytes on ringing there, and a palette has
// no use for magnitudes.
//
// Every texel is a vertex of the 4-8 lattice. Level by level, coarse to fine, it is asked whether a
// vertex has the first, second or third of the colours that its neighbours vote for (exact matches
// in the place of JBIG's contexts, ITU-T T.82). If not, its colour has appeared before and has an
// index, or it is new. Any prefix of the codeword gives the image at the resolution it pays for.
//
// Lossless bytes of JPEG XL at effort 7, and of this: contours of `tetrakis synth` 42.3 k, 35.0 k;
// of drawings that are not in the repository: a town of 12 colours 21.4 k, 11.2 k; the same
// smoothed and lettered, 3037 colours 102 k, 61 k; seven classes of land cover 7.1 k, 4.3 k.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>

#include "base/texels.hpp"
#include "lattice/levels.hpp"
#include "texture_wavelet/drawn/drawn_models.hpp"
#include "texture_wavelet/drawn/drawn_neighbours.hpp"

namespace tetrakis::inline drawn {

/// Runs over all vertices once. Io is the encoder's or the decoder's side of a decision; `ours` is
/// what the encoder knows of it and the decoder ignores:
///   ColourIndex target(size_t texel)           kNoColour for a colour that has not appeared
///   const DrawnColour& colour(size_t texel)
///   bool bit(AdaptiveBit&, bool ours)
///   bool evenBit(bool ours)
///   bool stopped()                             the last decision did not count
template <class Io>
class DrawnPass {
 public:
  /// format: width, height, channels, bits. indices: of every texel, kNoColour where not known.
  DrawnPass(const Texels& format, std::span<ColourIndex> indices, DrawnColours& colours, Io& io)
      : format_(format), indices_(indices), colours_(colours), io_(io) {}

  /// levels: of the grid, coarse to fine. Ends early at a decision that does not count.
  void run(std::span<const Level> levels) {
    for (const Level& level : levels) {
      const Neighbourhood neighbourhood(level, indices_, format_.width, format_.height);
      const ModelChain unanimous = models_.candidate(Candidates::unanimous(), 0, level.kind);
      for (uint32_t row = 0; row < level.rows; ++row) {
        const uint32_t y = level.y(row);
        uint32_t x = level.firstX(row);
        for (uint32_t i = 0; i < level.columns[row % 2]; ++i, x += level.pitch()) {
          const size_t texel = size_t{y} * format_.width + x;
          const ColourIndex target = io_.target(texel), common = neighbourhood.common(x, y);
          const bool asked = common != kNoColour;  // most vertices, and nothing else to do for them
          ColourIndex index = common;
          if (!asked || !ask(unanimous, target == common))
            index = decide(neighbourhood.around(x, y), level.kind, texel, target, asked);
          if (io_.stopped()) return;
          indices_[texel] = index;
        }
      }
    }
  }

 private:
  /// first: of the places to ask for.
  ColourIndex decide(const Candidates& around, LevelKind kind, size_t texel, ColourIndex target,
                     int first) {
    for (int place = first; place < std::min(around.count(), Candidates::kRanked); ++place) {
      const ColourIndex colour = around[place].colour;
      if (ask(models_.candidate(around, place, kind), target == colour)) return colour;
    }
    if (isNew(target)) return addColour(around, texel);
    return known(around, target);
  }

  /// The first colour is new without a decision, and where there is no room for more none is.
  bool isNew(ColourIndex target) {
    if (colours_.size() == 0) return true;
    return !colours_.full() && io_.bit(models_.fresh, target == kNoColour);
  }

  /// Digits of the index, the highest first.
  ColourIndex known(const Candidates& around, ColourIndex target) {
    uint32_t node = 1;
    for (int position = kColourIndexBits - 1; position >= 0 && !io_.stopped(); --position) {
      const bool bit = ask(models_.index(around, node), (target >> position) & 1);
      node = 2 * node + bit;
    }
    const auto last = static_cast<uint32_t>(colours_.size() - 1);
    return static_cast<ColourIndex>(std::min(node - (1u << kColourIndexBits), last));
  }

  bool ask(const ModelChain& chain, bool ours) {
    AdaptiveBit& asked = chain.asked();
    const bool bit = io_.bit(asked, ours);
    for (AdaptiveBit* model : chain.models) {
      if (model != &asked) model->update(bit);
    }
    return bit;
  }

  /// Each channel as the difference to the mean of the first two candidates, plus the difference
  /// that the channel before had.
  ColourIndex addColour(const Candidates& around, size_t texel) {
    const int half = 1 << (format_.bits - 1), most = 2 * half - 1;
    const DrawnColour& ours = io_.colour(texel);
    DrawnColour colour{};
    int carried = 0;
    for (uint32_t c = 0; c < format_.channels; ++c) {
      int mean = half;
      if (around.count() > 0) {
        const ColourCandidate &a = around[0], &b = around[std::min(around.count() - 1, 1)];
        mean = (colours_[a.colour][c] + colours_[b.colour][c]) / 2;
      }
      const int expected = std::clamp(mean + carried, 0, most);
      const int value = std::clamp(expected + residual(c, ours[c] - expected), 0, most);
      if (io_.stopped()) return kNoColour;
      colour[c] = static_cast<uint16_t>(value);
      carried = value - mean;
    }
    return colours_.add(colour);
  }

  int residual(uint32_t channel, int ours) {
    const auto our_magnitude = static_cast<uint32_t>(ours < 0 ? -ours : ours);
    const int our_class = static_cast<int>(std::bit_width(our_magnitude));
    constexpr int kMost = static_cast<int>(DrawnModels::kClasses);
    auto& models = models_.residual[channel];
    int bits = 0;
    while (bits < kMost && io_.bit(models[static_cast<size_t>(bits)], our_class > bits)) ++bits;
    if (bits == 0) return 0;
    uint32_t magnitude = 1;
    for (int position = bits - 2; position >= 0; --position)
      magnitude = 2 * magnitude + io_.evenBit((our_magnitude >> position) & 1);
    const auto value = static_cast<int>(magnitude);
    return io_.evenBit(ours < 0) ? -value : value;
  }

  const Texels& format_;
  std::span<ColourIndex> indices_;
  DrawnColours& colours_;
  Io& io_;
  DrawnModels models_;
};

}  // namespace tetrakis::inline drawn
