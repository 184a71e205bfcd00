// SPDX-License-Identifier: Apache-2.0
#include "bitstream/band_models.hpp"

#include <cstddef>

namespace tetrakis {

namespace {

// Initial P(bit = 0) in units of 1/256.
using Hints = std::array<uint8_t, BandModels::kHint>;
constexpr std::array<Hints, BandModels::kLocal> kSignificance = {{
    {240, 240, 232, 225, 218, 209, 170, 159},
    {224, 234, 219, 211, 202, 194, 163, 147},
    {208, 217, 203, 194, 188, 180, 158, 135},
    {198, 211, 196, 189, 184, 175, 154, 142},
    {187, 204, 185, 179, 173, 168, 147, 136},
    {170, 177, 169, 167, 163, 159, 145, 130},
    {160, 168, 158, 156, 153, 151, 141, 125},
    {147, 157, 148, 146, 145, 143, 141, 128},
    {142, 138, 142, 141, 139, 139, 134, 126},
    {135, 139, 135, 134, 133, 134, 131, 130},
    {130, 125, 132, 131, 130, 130, 127, 127},
}};
constexpr Hints kGroup = {246, 244, 220, 204, 196, 190, 111, 122};
constexpr std::array<uint8_t, 3> kGroupPlace = {128, 128, 128};
constexpr std::array<uint8_t, 9> kRefinement = {230, 220, 207, 187, 157, 134, 191, 147, 136};
constexpr std::array<uint8_t, 5> kSign = {128, 145, 72, 73, 90};
constexpr std::array<uint8_t, 5> kBlock = {236, 141, 49, 15, 6};
constexpr uint8_t kBand = 202;

template <size_t kCount>
void start(std::array<AdaptiveBit, kCount>& models, const std::array<uint8_t, kCount>& zero) {
  for (size_t i = 0; i < kCount; ++i) models[i] = AdaptiveBit(zero[i]);
}

}  // namespace

BandModels::BandModels() : band(kBand) {
  for (size_t local = 0; local < significance.size(); ++local)
    start(significance[local], kSignificance[local]);
  start(group, kGroup);
  start(group_place, kGroupPlace);
  start(refinement, kRefinement);
  start(sign, kSign);
  start(block, kBlock);
}

}  // namespace tetrakis
