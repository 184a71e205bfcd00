// SPDX-License-Identifier: Apache-2.0
// Shears of three planes, forwards and backwards (see colour.hpp).
#include "texture_wavelet/colour/colour.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <type_traits>

namespace tetrakis::inline colour {

namespace {

/// What one shear does: the plane it changes and the two it reads.
struct Step {
  uint8_t plane, first, second;
};
constexpr std::array<Step, 3> kSteps = {{{1, 2, 0}, {2, 1, 0}, {0, 1, 2}}};

const std::array<uint8_t, 3>& orderOf(const ColourTransform& transform) {
  return kChannelOrders[transform.order % kChannelOrders.size()];
}

/// Sum: int32_t (wraps) or int64_t.
template <class Sum, bool kForward>
void shear(int32_t* __restrict target, const int32_t* __restrict first,
           const int32_t* __restrict second, std::array<int16_t, 2> weights, size_t count) {
  using Unsigned = std::make_unsigned_t<Sum>;
  constexpr Unsigned kHalf = 1u << (kShearFractionBits - 1);
  const auto weight0 = static_cast<Unsigned>(Sum{weights[0]});
  const auto weight1 = static_cast<Unsigned>(Sum{weights[1]});
  for (size_t i = 0; i < count; ++i) {
    const Unsigned sum = weight0 * static_cast<Unsigned>(Sum{first[i]}) +
                         weight1 * static_cast<Unsigned>(Sum{second[i]}) + kHalf;
    const auto change = static_cast<uint32_t>(static_cast<Sum>(sum) >> kShearFractionBits);
    const auto value = static_cast<uint32_t>(target[i]);
    target[i] = static_cast<int32_t>(kForward ? value + change : value - change);
  }
}

template <class Sum, bool kForward>
void shearAll(const Shears& shears, std::span<int32_t* const> planes, size_t count) {
  for (size_t i = 0; i < kSteps.size(); ++i) {
    const size_t index = kForward ? i : kSteps.size() - 1 - i;
    const Step& step = kSteps[index];
    shear<Sum, kForward>(planes[step.plane], planes[step.first], planes[step.second],
                         {shears[2 * index], shears[2 * index + 1]}, count);
  }
}

/// The last plane follows those before it, which are 1 or 3.
template <bool kForward>
void shearFurther(const ColourTransform& transform, std::span<int32_t* const> planes,
                  size_t count) {
  const auto& shears = transform.further_shears;
  if (planes.size() % 2 != 0 || shears == std::array<int16_t, 3>{}) return;
  constexpr uint32_t kHalf = 1u << (kShearFractionBits - 1);
  int32_t* const last = planes.back();
  for (size_t i = 0; i < count; ++i) {
    uint32_t sum = kHalf;
    for (size_t c = 0; c + 1 < planes.size(); ++c)
      sum += static_cast<uint32_t>(shears[c]) * static_cast<uint32_t>(planes[c][i]);
    const auto change = static_cast<uint32_t>(static_cast<int32_t>(sum) >> kShearFractionBits);
    const auto value = static_cast<uint32_t>(last[i]);
    last[i] = static_cast<int32_t>(kForward ? value + change : value - change);
  }
}

/// The shears of the coefficients of a level; null: there are none.
const Shears* shearsAt(const ColourTransform& transform, int level) {
  if (level < 2 || transform.level_shears.empty()) return nullptr;
  const size_t last = transform.level_shears.size() - 1;
  return &transform.level_shears[std::min(static_cast<size_t>(level - 2), last)];
}

/// Shears one colour whose channels are in order, without rounding.
void shearExactly(const Shears& shears, bool forward, std::array<double, 3>& colour) {
  for (size_t i = 0; i < kSteps.size(); ++i) {
    const size_t index = forward ? i : kSteps.size() - 1 - i;
    const Step& step = kSteps[index];
    const double change =
        (shears[2 * index] * colour[step.first] + shears[2 * index + 1] * colour[step.second]) /
        (1 << kShearFractionBits);
    colour[step.plane] += forward ? change : -change;
  }
}

void swapPlanes(int32_t* a, int32_t* b, size_t count) {
  if (a != b) std::swap_ranges(a, a + count, b);
}

/// Two exchanges put the channels in order; channel 0 may have moved before the second.
uint8_t secondPartner(const std::array<uint8_t, 3>& order) {
  return order[1] == 0 ? order[0] : order[1];
}

void addCentre(int32_t* plane, size_t count, uint32_t centre) {
  for (size_t i = 0; i < count; ++i) {
    plane[i] = static_cast<int32_t>(static_cast<uint32_t>(plane[i]) + centre);
  }
}

void addFraction(int32_t* plane, size_t count, int fraction_bits) {
  for (size_t i = 0; i < count; ++i) {
    plane[i] <<= fraction_bits;
  }
}

void dropFraction(int32_t* plane, size_t count, int fraction_bits) {
  const uint32_t half = (1u << fraction_bits) >> 1;
  for (size_t i = 0; i < count; ++i) {
    plane[i] = static_cast<int32_t>(static_cast<uint32_t>(plane[i]) + half) >> fraction_bits;
  }
}

}  // namespace

void forwardColour(const ColourTransform& transform, std::span<int32_t* const> planes, size_t count,
                   int fraction_bits) {
  assert(planes.size() >= 1 && planes.size() <= transform.centre.size());
  for (size_t p = 0; p < planes.size(); ++p) {
    addCentre(planes[p], count, -uint32_t{transform.centre[p]});
    if (fraction_bits > 0) addFraction(planes[p], count, fraction_bits);
  }
  if (planes.size() >= 3) {
    const auto& order = orderOf(transform);
    swapPlanes(planes[0], planes[order[0]], count);
    swapPlanes(planes[1], planes[secondPartner(order)], count);
    shearAll<int32_t, true>(transform.shears, planes, count);
  }
  shearFurther<true>(transform, planes, count);
}

void inverseShears(const ColourTransform& transform, std::span<int32_t* const> planes,
                   size_t count) {
  assert(planes.size() >= 1 && planes.size() <= transform.centre.size());
  shearFurther<false>(transform, planes, count);
  if (planes.size() < 3) return;
  const auto& order = orderOf(transform);
  shearAll<int32_t, false>(transform.shears, planes, count);
  swapPlanes(planes[1], planes[secondPartner(order)], count);
  swapPlanes(planes[0], planes[order[0]], count);
}

void restoreSamples(std::span<int32_t> channel, uint16_t centre, int fraction_bits) {
  assert(fraction_bits >= 0 && fraction_bits <= 8);
  if (fraction_bits > 0) dropFraction(channel.data(), channel.size(), fraction_bits);
  addCentre(channel.data(), channel.size(), centre);
}

void forwardLevelColour(const ColourTransform& transform, int level,
                        std::span<int32_t* const> planes, size_t count) {
  if (const Shears* shears = shearsAt(transform, level))
    shearAll<int64_t, true>(*shears, planes, count);
}

void inverseLevelColour(const ColourTransform& transform, int level,
                        std::span<int32_t* const> planes, size_t count) {
  if (const Shears* shears = shearsAt(transform, level))
    shearAll<int64_t, false>(*shears, planes, count);
}

Matrix3 colourMatrix(const ColourTransform& transform, int level) {
  Matrix3 matrix{};
  const auto& order = orderOf(transform);
  for (size_t j = 0; j < 3; ++j) {
    std::array<double, 3> colour{};
    colour[j] = 1;
    shearExactly(transform.shears, true, colour);
    if (const Shears* shears = shearsAt(transform, level)) shearExactly(*shears, true, colour);
    for (size_t i = 0; i < 3; ++i) matrix[i][order[j]] = colour[i];
  }
  return matrix;
}

std::array<double, 3> planeEnergies(const ColourTransform& transform, int level,
                                    const std::array<double, 3>& weights) {
  std::array<double, 3> energies{};
  const auto& order = orderOf(transform);
  for (size_t i = 0; i < 3; ++i) {
    std::array<double, 3> colour{};
    colour[i] = 1;
    if (const Shears* shears = shearsAt(transform, level)) shearExactly(*shears, false, colour);
    shearExactly(transform.shears, false, colour);
    for (size_t j = 0; j < 3; ++j) energies[i] += weights[order[j]] * colour[j] * colour[j];
  }
  return energies;
}

std::array<double, 3> furtherEnergies(const ColourTransform& transform, size_t planes, int level) {
  std::array<double, 3> energies{};
  for (size_t i = 0; i + 1 < planes; ++i) {
    std::array<double, 3> colour{};
    colour[i] = 1;
    const Shears* const shears = planes > 3 ? shearsAt(transform, level) : nullptr;
    if (shears != nullptr) shearExactly(*shears, false, colour);
    double change = 0;
    for (size_t j = 0; j + 1 < planes; ++j) change += transform.further_shears[j] * colour[j];
    energies[i] = std::pow(change / (1 << kShearFractionBits), 2);
  }
  return energies;
}

void forwardColourLevels(const ColourTransform& transform, const Pyramid& pyramid,
                         std::span<int32_t* const> planes) {
  if (planes.size() < 3) return;
  for (const Subband& subband : pyramid.subbands()) {
    for (uint32_t row = 0; row < subband.height; ++row) {
      const size_t first = pyramid.indexOf(subband, row);
      const std::array<int32_t*, 3> rows = {planes[0] + first, planes[1] + first,
                                            planes[2] + first};
      forwardLevelColour(transform, subband.level, rows, subband.width);
    }
  }
}

void inverseColourLevels(const ColourTransform& transform, const Pyramid& pyramid,
                         std::span<ViewSynthesis> planes) {
  if (planes.size() < 3) return;
  for (const Subband& subband : pyramid.subbands()) {
    const uint32_t count = planes.front().needed(subband).height;
    for (uint32_t row = 0; row < count; ++row) {
      const std::span<int32_t> first = planes[0].row(subband, row);
      const std::array<int32_t*, 3> rows = {first.data(), planes[1].row(subband, row).data(),
                                            planes[2].row(subband, row).data()};
      assert(planes[1].row(subband, row).size() == first.size());
      inverseLevelColour(transform, subband.level, rows, first.size());
    }
  }
}

}  // namespace tetrakis::inline colour
