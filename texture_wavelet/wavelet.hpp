// SPDX-License-Identifier: Apache-2.0
// Reversible separable integer wavelet with two lifting steps of six taps
// (W. Sweldens, "The lifting scheme", 1996; integer form: A. R. Calderbank et al., 1998).
//
//   predict   high[i] = x[2i + 1] - round(sum_k p_k (x[2i - 2k] + x[2i + 2 + 2k]) / 256)
//   update    low[i]  = x[2i]     + round(sum_k u_k (high[i - 1 - k] + high[i + k]) / 256)
//   p = 147, -28, 9 (sum 128)     u = 78, -20, 6 (sum 64)
//
// with x mirrored about its first and last sample. The sums keep straight lines out of the high
// band and the mean in the low one. Within these constraints the weights were fitted to the rate of
// ten aerial images at 0.02 to 3 bits a sample: 2.7 % fewer bytes than the 13/7 filter, 1.4 % more
// than the irreversible 9/7. With 1/256 ties are rare (one in 128): rounding is unbiased.
//
// Rounding noise enters at every level, and that of the coarse levels spreads over the whole image.
// After the levels of kDoubledLevels the low band is therefore doubled, which lifts it out of the
// noise; with the fraction bits of a lossy reconstruction this saves another 3 % of the bytes at
// 0.03 to 3 bits a texel, for 0.9 % more lossless ones.
//
// Level 1 splits the image, level l + 1 splits the low band of level l, which lies in the upper
// left corner (Mallat's layout):
//
//   LL HL     HL: high along the rows (x), low along the columns (y)
//   LH HH
//
// A side of kSmallestSide samples or fewer is not split; then HL or LH, and HH, are empty.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace tetrakis {

inline constexpr uint32_t kSmallestSide = 4;
inline constexpr int kMaxWaveletLevels = 14;  ///< enough for sides up to 2^16
inline constexpr std::array<int, 2> kDoubledLevels = {3, 4};

enum class Orientation : uint8_t { kLL, kHL, kLH, kHH };

/// One rectangle of coefficients in the plane.
struct Subband {
  int level = 0;  ///< kLL: the number of levels
  Orientation orientation = Orientation::kLL;
  uint32_t x = 0, y = 0, width = 0, height = 0;
  int splits_x = 0, splits_y = 0;  ///< how often each direction was split down to here
};

/// LL, then HL, LH and HH of the coarsest level, and so on to level 1: 3 * levels + 1 bands, some
/// of them empty. Together they tile the plane. Sides from 1 to 2^16.
std::vector<Subband> subbandsOf(uint32_t width, uint32_t height);

/// In place, row by row: width * height samples to coefficients. Memory: one strip of 32 columns.
/// Exactly undone by inverseWavelet. Arithmetic wraps modulo 2^32; |samples| < 2^18 stay clear of
/// it.
void forwardWavelet(std::span<int32_t> plane, uint32_t width, uint32_t height);

/// Coefficients to samples. Defined for all values. Where coefficients are known in part only, hand
/// in coefficient * 2^f: the samples then come with f binary places (round them off last, after
/// inverseColour) and the decoder adds no rounding noise of its own. f = 4 for samples of 8 bits
/// and f = 1 for 16 bits stay clear of overflow; f = 0 restores a complete plane exactly.
void inverseWavelet(std::span<int32_t> plane, uint32_t width, uint32_t height);

}  // namespace tetrakis
