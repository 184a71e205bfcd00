// SPDX-License-Identifier: Apache-2.0
#include "codec/wavelet/priority_map.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <span>

#include "bitstream/coder/range_decoder.hpp"

namespace tetrakis::inline wavelet {

PriorityMap priorityMapOf(const PriorityHeader& header, Extent plane) {
  PriorityMap map{plane, header.tile_log2, {}};
  if (header.none()) return map;
  map.priorities.resize(size_t{map.columns()} * map.rows());
  const auto* bytes = reinterpret_cast<const uint8_t*>(header.code.data());
  DecisionDecoding io(std::span(bytes, header.code.size()));
  PriorityPass<DecisionDecoding<>>(io).run(map.columns(), map.priorities);
  return map;
}

std::array<double, kPriorities> worthOf(const PriorityMap& map) {
  std::array<double, kPriorities> worth;
  worth.fill(1);
  if (map.empty()) return worth;
  double sum = 0;
  for (const uint8_t priority : map.priorities) sum += std::ldexp(1, 2 * priority);
  const double mean = sum / static_cast<double>(map.priorities.size());
  for (size_t tier = 0; tier < kPriorities; ++tier)
    worth[tier] = std::ldexp(1, 2 * static_cast<int>(tier)) / mean;
  return worth;
}

CoefficientPriorities::CoefficientPriorities(const PriorityMap& map)
    : plane_(map.plane), tile_log2_(map.tile_log2), stride_(map.columns() + 1) {
  assert(map.priorities.size() == size_t{map.columns()} * map.rows());
  sums_.resize(size_t{stride_} * (map.rows() + 1));
  for (uint32_t y = 0; y < map.rows(); ++y) {
    uint64_t row = 0;
    for (uint32_t x = 0; x < map.columns(); ++x) {
      row += uint64_t{1} << (2 * map.priorities[size_t{y} * map.columns() + x]);
      const size_t at = size_t{y} * stride_ + x + 1;
      sums_[at + stride_] = sums_[at] + row;
    }
  }
}

/// Means are those of squared errors, which 4^priority stands for.
uint8_t CoefficientPriorities::at(uint32_t x, uint32_t y, int level) const {
  const size_t west = firstTile(x, level), east = endTile(x, plane_.width, level);
  const size_t north = firstTile(y, level), south = endTile(y, plane_.height, level);
  const uint64_t sum = sums_[south * stride_ + east] - sums_[south * stride_ + west] -
                       sums_[north * stride_ + east] + sums_[north * stride_ + west];
  const uint64_t mean = sum / ((east - west) * (south - north));
  return static_cast<uint8_t>((std::bit_width(2 * mean) - 1) / 2);
}

}  // namespace tetrakis::inline wavelet
