// SPDX-License-Identifier: Apache-2.0
// Reference decoder: the models of one class of bands and where they start (docs/FORMAT.md,
// section 5).
#pragma once

#include <cstddef>
#include <cstdint>

#include "conformance/reference_decoder/range_decoder.hpp"

namespace tetrakis::reference {

struct Models {
  Model significance[11][8], group[8], place[3], refinement[9], sign[5], block[5], band;

  Models() {
    constexpr uint8_t kSignificance[11][8] = {
        {240, 240, 232, 225, 218, 209, 170, 159}, {224, 234, 219, 211, 202, 194, 163, 147},
        {208, 217, 203, 194, 188, 180, 158, 135}, {198, 211, 196, 189, 184, 175, 154, 142},
        {187, 204, 185, 179, 173, 168, 147, 136}, {170, 177, 169, 167, 163, 159, 145, 130},
        {160, 168, 158, 156, 153, 151, 141, 125}, {147, 157, 148, 146, 145, 143, 141, 128},
        {142, 138, 142, 141, 139, 139, 134, 126}, {135, 139, 135, 134, 133, 134, 131, 130},
        {130, 125, 132, 131, 130, 130, 127, 127}};
    for (size_t i = 0; i < 11; ++i) start(significance[i], kSignificance[i]);
    start(group, {246, 244, 220, 204, 196, 190, 111, 122});
    start(place, {128, 128, 128});
    start(refinement, {230, 220, 207, 187, 157, 134, 191, 147, 136});
    start(sign, {128, 145, 72, 73, 90});
    start(block, {236, 141, 49, 15, 6});
    band = Model(202);
  }

 private:
  template <size_t kCount>
  static void start(Model (&models)[kCount], const uint8_t (&starts)[kCount]) {
    for (size_t i = 0; i < kCount; ++i) models[i] = Model(starts[i]);
  }
};

}  // namespace tetrakis::reference
