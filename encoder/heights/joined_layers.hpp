// SPDX-License-Identifier: Apache-2.0
// joinLayers() joins the layers of heights into the codeword of their first track, which
// codec/geometry/taken_layers.hpp takes apart again. In front lie the mask of the valid samples and
// the flat areas; a table of values and a late mask lie among the coefficients, where their bytes
// take off as much error as the coefficients beside them; corrections follow.
#pragma once

#include <memory>
#include <vector>

#include "codec/geometry/coding_choice/flat_choice.hpp"
#include "encoder/heights/coded_heights.hpp"

namespace tetrakis::inline heights {

/// The layers around coefficients, and how these are coded.
struct HeightLayers {
  GeometryLayers stated;    ///< what the header says of them
  MaskRoom mask_room = {};  ///< of a late mask
  WaveletHeader wavelet;
  PriorityHeader priorities;
  FlatLayer flat = {};
};

/// The layers that the heights come with, which outlive the result, and flat areas.
HeightLayers layersAround(const QuantisedHeights& heights, FlatChoice choice,
                          const PriorityMap* priorities);

/// The header of heights whose coefficients, in so many bit-planes, have these layers around them.
GeometryHeader headerOf(const QuantisedHeights& heights, const HeightLayers& layers, int planes);

/// Joins the layers around coefficients, or around what stands in their place. A table of values
/// lies where its bytes take off as much error as those of the coefficients; the corrections are
/// those that the heights come with. region_log2: what the coefficients were coded with.
CodedHeights joinLayers(std::shared_ptr<const QuantisedHeights> quantised,
                        const HeightLayers& layers, std::vector<EncodedTrack> coefficients,
                        int region_log2);

}  // namespace tetrakis::inline heights
