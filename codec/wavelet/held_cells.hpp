// SPDX-License-Identifier: Apache-2.0
// HeldCells says what joint lifting makes of held samples on a forest (held_lifting.hpp is about
// those of planes, which are lifted along rows and along columns). A step gives a held sample what
// it makes of a surface that has its value everywhere. Such a surface keeps one value at all
// corners of its cells, one at all sides and one at all centres (lifting/lifting.hpp).
#pragma once

#include <cstdint>
#include <vector>

#include "codec/wavelet/pyramid.hpp"
#include "codec/wavelet/wavelet.hpp"

namespace tetrakis::inline wavelet {

/// The samples of a surface of one value.
struct HeldCell {
  int32_t corner, side, centre;
};

/// What a level makes of all areas. A step reads a held sample as the one of such a surface, also
/// where it reads one that it is about to change.
struct HeldCellsOfLevel {
  std::vector<HeldCell> before, after;   ///< of the analysis; of each area
  std::vector<int32_t> raised, lowered;  ///< as of JointHeld

  bool none() const { return before.empty(); }
};

class HeldCells {
 public:
  /// Of the areas that the pyramid of a forest holds. The filters have two steps: of the rounds of
  /// a longer filter the first would read what the second has not changed yet, and at shores its
  /// errors would grow.
  HeldCells(const WaveletSpec& spec, const Pyramid& pyramid);

  /// level: from 1 on.
  HeldCellsOfLevel level(int level) const;

 private:
  WaveletSpec spec_;
  std::vector<std::vector<int32_t>> values_;  ///< [level]: of its low band
};

}  // namespace tetrakis::inline wavelet
