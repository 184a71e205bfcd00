// SPDX-License-Identifier: Apache-2.0
#include "bitstream/track/band_models.hpp"

#include <cstddef>

namespace tetrakis::inline track {

namespace {

// Initial P(bit = 0) in units of 1/256.
using Hints = std::array<uint8_t, BandModels::kHint>;
constexpr std::array<Hints, BandModels::kLocal> kSignificance = {{
    {248, 241, 226, 206, 192, 204, 219, 229},
    {242, 233, 219, 198, 182, 186, 199, 217},
    {228, 215, 203, 184, 171, 169, 185, 204},
    {220, 210, 199, 182, 167, 167, 177, 183},
    {196, 189, 182, 170, 155, 154, 161, 178},
    {183, 180, 173, 165, 153, 152, 159, 168},
    {164, 164, 158, 153, 147, 144, 146, 156},
    {151, 152, 151, 144, 142, 139, 142, 148},
    {144, 143, 144, 139, 136, 137, 135, 141},
    {133, 135, 133, 135, 130, 132, 130, 136},
    {126, 128, 132, 130, 129, 130, 128, 126},
}};
constexpr std::array<Hints, BandModels::kReach> kGroup = {{
    {239, 241, 214, 183, 161, 162, 181, 190},
    {245, 246, 225, 202, 183, 206, 215, 217},
    {249, 250, 233, 212, 195, 210, 225, 217},
}};
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
  for (size_t reach = 0; reach < group.size(); ++reach) start(group[reach], kGroup[reach]);
  start(group_place, kGroupPlace);
  start(refinement, kRefinement);
  start(sign, kSign);
  start(block, kBlock);
}

}  // namespace tetrakis::inline track
