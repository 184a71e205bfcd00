// SPDX-License-Identifier: Apache-2.0
// The functions here turn the channels of an image into the colour planes that the wavelet codes.
// Channels of few values become places in their tables, texels without coefficients take the values
// that cost least, and shears turn the colours. Encoder only.
#pragma once

#include <cstdint>
#include <vector>

#include "base/plane.hpp"
#include "bitstream/stream/texture_header.hpp"
#include "codec/wavelet/choice/filter_choice.hpp"
#include "texture_wavelet/colour/colour.hpp"
#include "texture_wavelet/tables/few_values.hpp"
#include "texture_wavelet/texture_bridges.hpp"
#include "texture_wavelet/texture_source.hpp"

namespace tetrakis::inline texture {

/// What is coded by wavelet, and how.
struct WaveletCoding {
  const TextureSource& source;
  Purpose purpose;
  const TextureOptions& options;
  Mask photograph;            ///< texels that are not drawn over
  const TextureHeader* like;  ///< colours, filters and bridges are taken over; null: chosen
  FewValues few;              ///< tables of the channels; none: there are no tables

  /// Colours that a cut-out hides are not coded.
  bool hides() const { return !source.cutout.empty() && purpose == Purpose::kLossy; }
};

/// The colour planes of an image, and what they were made with.
struct ColourPlanes {
  std::vector<std::vector<int32_t>> planes;
  ColourTransform colour;
  WaveletHeader wavelet;
  TextureBridges bridges;
};

/// coded: texels that are neither hidden nor drawn over. opening_bytes: what lies before the
/// coefficients, which leave as much less for them.
ColourPlanes colourPlanesOf(const WaveletCoding& coding, Mask coded, uint64_t opening_bytes);

}  // namespace tetrakis::inline texture
