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

/// The layers around coefficients, and the options for coding the coefficients.
struct HeightLayers {
  GeometryLayers stated;    ///< as the header states them
  MaskRoom mask_room = {};  ///< of a late mask
  WaveletHeader wavelet;
  PriorityHeader priorities;
  FlatLayer flat = {};
};

/// The layers that the heights have, with flat areas. The heights outlive the result.
HeightLayers layersAround(const QuantisedHeights& heights, FlatChoice choice,
                          const PriorityMap* priorities);

/// The header of heights whose coefficients have `planes` bit-planes and these layers around them.
GeometryHeader headerOf(const QuantisedHeights& heights, const HeightLayers& layers, int planes);

/// Joins the layers around coefficients, or around a drawing or stored samples. A table of values
/// lies where its bytes take off as much error as those of the coefficients; corrections are those
/// of the heights. region_log2: that with which the coefficients were coded.
CodedHeights joinLayers(std::shared_ptr<const QuantisedHeights> quantised,
                        const HeightLayers& layers, std::vector<EncodedTrack> coefficients,
                        int region_log2);

}  // namespace tetrakis::inline heights
