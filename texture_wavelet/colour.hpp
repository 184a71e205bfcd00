// SPDX-License-Identifier: Apache-2.0
// Reversible component transform: any 3 x 3 matrix of determinant 1 as four integer shears
// (P. Hao, Q. Shi, "Matrix factorizations for reversible integer mapping", IEEE TSP 49(10), 2001).
//
// The planes are taken in the order kShearOrders[order] as slots 0, 1, 2. Each shear adds to one
// slot a rounded combination of the two others, which any rounding leaves exactly invertible:
//
//   step   slot        += round((shears[2 step] * from + shears[2 step + 1] * from) / 1024)
//     0      2            slots 0, 1
//     1      0            slots 1, 2
//     2      1            slots 0, 2
//     3      2            slots 0, 1
//
// Everything happens in place: the first component is in plane 0, the others in planes 1 and 2.
// Four shears have eight numbers, as many as a matrix of determinant 1 has degrees of freedom.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace tetrakis {

inline constexpr int kShearFractionBits = 10;
inline constexpr std::array<std::array<uint8_t, 3>, 6> kShearOrders = {
    {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};

/// Parameters of the transform, as they stand in the stream header. Every value is legal.
struct ColourTransform {
  std::array<uint16_t, 4> centre{};  ///< subtracted from each channel
  uint8_t order = 0;                 ///< index into kShearOrders, taken modulo 6
  std::array<int16_t, 8> shears{};   ///< in units of 2^-kShearFractionBits; all 0: identity
};

/// Samples to components, in place. planes: 1 (grey), 2 (grey, alpha), 3 (RGB) or 4 (RGB, alpha)
/// distinct planes of `count` values. Only RGB is sheared, every plane is centred.
/// Exactly undone by inverseColour with fraction_bits 0. Arithmetic wraps modulo 2^32; transforms
/// of fitColour and RGB of at most 16 bits stay clear of it.
void forwardColour(const ColourTransform& transform, std::span<int32_t* const> planes,
                   size_t count);

/// Components to samples, in place. The components carry fraction_bits (0 to 8) binary places,
/// which are rounded off after the shears: lossy reconstructions gain by them (wavelet.hpp).
/// Defined for all values; the caller clamps the result to the range of its samples.
void inverseColour(const ColourTransform& transform, std::span<int32_t* const> planes, size_t count,
                   int fraction_bits);

using Matrix3 = std::array<std::array<double, 3>, 3>;

/// The linear version of the shears: component i = sum_j matrix[i][j] * (channel j - centre).
Matrix3 colourMatrix(const ColourTransform& transform);

/// Squared RGB error, summed over the three channels, for a unit squared error in each component.
std::array<double, 3> componentEnergies(const ColourTransform& transform);

}  // namespace tetrakis
