// SPDX-License-Identifier: Apache-2.0
// fillDrawn() gives every texel of a drawn texture a colour, whether the texel is decoded or not.
#pragma once

#include <span>

#include "base/texels.hpp"
#include "base/view.hpp"
#include "codec/lattice/levels.hpp"
#include "texture_wavelet/drawn/drawn_colours.hpp"

namespace tetrakis::inline drawn {

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

}  // namespace tetrakis::inline drawn
