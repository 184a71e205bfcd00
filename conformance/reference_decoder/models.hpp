// SPDX-License-Identifier: Apache-2.0
// Reference decoder: the models of one class of bands and where they start (docs/FORMAT.md,
// section 5).
#pragma once

#include <cstddef>
#include <cstdint>

#include "conformance/reference_decoder/range_decoder.hpp"

namespace tetrakis::reference {

struct Models {
  Model significance[11][8], group[3][8], place[3], refinement[9], sign[5], block[5], band;

  Models() {
    constexpr uint8_t kSignificance[11][8] = {
        {248, 241, 226, 206, 192, 204, 219, 229}, {242, 233, 219, 198, 182, 186, 199, 217},
        {228, 215, 203, 184, 171, 169, 185, 204}, {220, 210, 199, 182, 167, 167, 177, 183},
        {196, 189, 182, 170, 155, 154, 161, 178}, {183, 180, 173, 165, 153, 152, 159, 168},
        {164, 164, 158, 153, 147, 144, 146, 156}, {151, 152, 151, 144, 142, 139, 142, 148},
        {144, 143, 144, 139, 136, 137, 135, 141}, {133, 135, 133, 135, 130, 132, 130, 136},
        {126, 128, 132, 130, 129, 130, 128, 126}};
    for (size_t i = 0; i < 11; ++i) start(significance[i], kSignificance[i]);
    start(group[0], {239, 241, 214, 183, 161, 162, 181, 190});
    start(group[1], {245, 246, 225, 202, 183, 206, 215, 217});
    start(group[2], {249, 250, 233, 212, 195, 210, 225, 217});
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
