// SPDX-License-Identifier: Apache-2.0
// PrefixErrors measures the error of the cameras' pictures for prefixes of streams that are not
// written yet, so that two selections can be compared at every size.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "encoder/inputs/encode_inputs.hpp"
#include "encoder/selection/selection.hpp"
#include "ratecontrol/pictures/picture_errors.hpp"

namespace tetrakis::inline views {

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

}  // namespace tetrakis::inline views
