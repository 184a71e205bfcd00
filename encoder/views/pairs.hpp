// SPDX-License-Identifier: Apache-2.0
// pairErrorsOf() measures, in the cameras' pictures, the errors of pairs of a prefix of the heights
// with a prefix of the texture. PrefixErrors does the same for prefixes of a whole selection;
// mapsPay() judges maps of priorities by it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "encoder/inputs/encode_inputs.hpp"
#include "encoder/selection/write_stream.hpp"
#include "encoder/views/decoded_nodes.hpp"
#include "ratecontrol/allocation/allocation.hpp"
#include "ratecontrol/pictures/picture_errors.hpp"

namespace tetrakis::inline views {

// PrefixErrors measures the error of the cameras' pictures for prefixes of streams that are not
// written yet, so that two selections can be compared at every size.

/// Holds the pictures of the inputs themselves, which take longer than those of some prefixes: all
/// streams that are compared share them.
class PrefixErrors {
 public:
  /// inputs: of both components; they outlive this. any: a selection of them.
  PrefixErrors(const EncodeInputs& inputs, const Selection& any);

  /// Squared errors of the picture after each of `lengths` bytes of the packets, their heads
  /// counted. lengths: rising. Empty: nobody can look at the terrain.
  std::vector<double> of(const Selection& selection, std::span<const uint64_t> lengths) const;

 private:
  const EncodeInputs& inputs_;
  std::optional<PictureErrors> pictures_;
};

// mapsPay() decides whether maps of priorities are worth the bytes that they take in the header: it
// compares pictures of prefixes of a stream with maps and of one without.

/// Bytes of the header that hold the maps of both components.
uint64_t bytesOfMaps(const Selection& selection);

/// Whether the cameras see fewer errors in prefixes of a stream with maps of priorities than in
/// those of a stream without maps, in the mean of half of the budget and all of it.
bool mapsPay(const EncodeInputs& inputs, const Selection& with, const Selection& without);

// pairErrorsOf() measures the cost of errors of either component in the cameras' pictures: an
// engine, modelled or rendered, looks at pairs of prefixes of both (thesis 6.3.1). The errors of
// heights and texture do not add, so neither component can be measured alone.

/// Decodes some prefixes of either component and looks at their pairs. inputs: of both.
PairErrors pairErrorsOf(const EncodeInputs& inputs, const Rated<CodedHeights>& heights,
                        const Rated<CodedTexture>& texture);

// objectErrors() (object_pairs.cpp) is the modelled engine for surfaces over a base mesh: it draws
// pairs of a prefix of the heights with a prefix of the texture for cameras all around, or for
// the cameras that the options tell.

/// Errors of the pictures of all pairs, in the order that PairErrors takes; none if nobody can look
/// at the surface. inputs: of both components on a forest.
std::vector<double> objectErrors(const EncodeInputs& inputs, DecodedNodes& decoded,
                                 const Nodes& nodes);

}  // namespace tetrakis::inline views
