// SPDX-License-Identifier: Apache-2.0
// Shears of three planes, forwards and backwards (see colour.hpp).
#include "texture_wavelet/colour.hpp"

#include <cassert>

namespace tetrakis {
namespace {

/// What one shear does: the slot it changes and the two it reads.
struct Step {
  uint8_t slot, first, second;
};
constexpr std::array<Step, 4> kSteps = {{{2, 0, 1}, {0, 1, 2}, {1, 0, 2}, {2, 0, 1}}};

const std::array<uint8_t, 3>& slotsOf(const ColourTransform& transform) {
  return kShearOrders[transform.order % kShearOrders.size()];
}

struct Weights {
  uint32_t first, second;
};

Weights weightsOf(const ColourTransform& transform, size_t step) {
  return {static_cast<uint32_t>(int32_t{transform.shears[2 * step]}),
          static_cast<uint32_t>(int32_t{transform.shears[2 * step + 1]})};
}

uint32_t combine(Weights weights, int32_t first, int32_t second) {
  constexpr uint32_t kHalf = 1u << (kShearFractionBits - 1);
  const uint32_t sum = weights.first * static_cast<uint32_t>(first) +
                       weights.second * static_cast<uint32_t>(second) + kHalf;
  return static_cast<uint32_t>(static_cast<int32_t>(sum) >> kShearFractionBits);
}

template <bool kForward>
void shear(int32_t* __restrict target, const int32_t* __restrict first,
           const int32_t* __restrict second, Weights weights, size_t count) {
  for (size_t i = 0; i < count; ++i) {
    const auto value = static_cast<uint32_t>(target[i]);
    const uint32_t change = combine(weights, first[i], second[i]);
    target[i] = static_cast<int32_t>(kForward ? value + change : value - change);
  }
}

template <bool kForward>
void shearAll(const ColourTransform& transform, std::span<int32_t* const> planes, size_t count) {
  const auto& slots = slotsOf(transform);
  for (size_t i = 0; i < kSteps.size(); ++i) {
    const size_t index = kForward ? i : kSteps.size() - 1 - i;
    const Step& step = kSteps[index];
    shear<kForward>(planes[slots[step.slot]], planes[slots[step.first]], planes[slots[step.second]],
                    weightsOf(transform, index), count);
  }
}

/// The same steps without rounding, on one colour.
void shearExactly(const ColourTransform& transform, bool forward, std::array<double, 3>& colour) {
  const auto& slots = slotsOf(transform);
  for (size_t i = 0; i < kSteps.size(); ++i) {
    const size_t index = forward ? i : kSteps.size() - 1 - i;
    const Step& step = kSteps[index];
    const double change = (transform.shears[2 * index] * colour[slots[step.first]] +
                           transform.shears[2 * index + 1] * colour[slots[step.second]]) /
                          (1 << kShearFractionBits);
    colour[slots[step.slot]] += forward ? change : -change;
  }
}

}  // namespace

void forwardColour(const ColourTransform& transform, std::span<int32_t* const> planes,
                   size_t count) {
  assert(planes.size() >= 1 && planes.size() <= transform.centre.size());
  for (size_t p = 0; p < planes.size(); ++p) {
    const uint32_t centre = transform.centre[p];
    int32_t* plane = planes[p];
    for (size_t i = 0; i < count; ++i) {
      plane[i] = static_cast<int32_t>(static_cast<uint32_t>(plane[i]) - centre);
    }
  }
  if (planes.size() >= 3) shearAll<true>(transform, planes, count);
}

void inverseColour(const ColourTransform& transform, std::span<int32_t* const> planes, size_t count,
                   int fraction_bits) {
  assert(planes.size() >= 1 && planes.size() <= transform.centre.size());
  assert(fraction_bits >= 0 && fraction_bits <= 8);
  if (planes.size() >= 3) shearAll<false>(transform, planes, count);
  const uint32_t half = (1u << fraction_bits) >> 1;
  for (size_t p = 0; p < planes.size(); ++p) {
    const uint32_t centre = transform.centre[p];
    int32_t* plane = planes[p];
    for (size_t i = 0; i < count; ++i) {
      const auto scaled = static_cast<int32_t>(static_cast<uint32_t>(plane[i]) + half);
      plane[i] = static_cast<int32_t>(static_cast<uint32_t>(scaled >> fraction_bits) + centre);
    }
  }
}

Matrix3 colourMatrix(const ColourTransform& transform) {
  Matrix3 matrix{};
  for (size_t j = 0; j < 3; ++j) {
    std::array<double, 3> colour{};
    colour[j] = 1;
    shearExactly(transform, true, colour);
    for (size_t i = 0; i < 3; ++i) matrix[i][j] = colour[i];
  }
  return matrix;
}

std::array<double, 3> componentEnergies(const ColourTransform& transform) {
  std::array<double, 3> energies{};
  for (size_t i = 0; i < 3; ++i) {
    std::array<double, 3> colour{};
    colour[i] = 1;
    shearExactly(transform, false, colour);
    for (double channel : colour) energies[i] += channel * channel;
  }
  return energies;
}

}  // namespace tetrakis
