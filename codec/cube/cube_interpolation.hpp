// SPDX-License-Identifier: Apache-2.0
// What lies between the samples of a cube: the mean of 4 x 4 samples around, by the weights of the
// cubic convolution (R. G. Keys, "Cubic convolution interpolation for digital image processing",
// 1981). One row or column of them may lie beyond a side. A great circle through such a row of the
// patch runs along a row of the next one as well, but has its samples elsewhere: there they are
// means of two samples. (At equal angles, rows of both are great circles through one axis.)
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/forest.hpp"
#include "codec/cube/cube_sphere.hpp"

namespace tetrakis::inline cube {

inline constexpr int kMostCubeDepth = 14;  ///< so that 32 bits number the samples

inline constexpr uint32_t kTaps = 4;  ///< along a row, and along a column

/// What the samples weigh around a place between the second and the third of them, where it lies
/// `part` of the way.
std::array<float, kTaps> cubicWeights(float part);

/// A place on the cube as the sample to the north-west of it and how far it is from there.
struct CubeCell {
  uint32_t patch, x, y;  ///< of the sample; below n
  float part_x, part_y;
};

/// The samples around a place: their numbers in the raster of the cube, of one with others that of
/// the owner.
class CubeTaps {
 public:
  void add(uint32_t sample, float weight) {
    samples_[count_] = sample;
    weights_[count_++] = weight;
  }
  /// Calls visit(sample, weight) for each.
  template <class Visit>
  void forEach(const Visit& visit) const {
    for (uint32_t i = 0; i < count_; ++i) visit(samples_[i], weights_[i]);
  }

 private:
  static constexpr uint32_t kMost = kTaps * kTaps + 2 * kTaps;  ///< of two a tap beyond a side

  uint32_t count_ = 0;
  std::array<uint32_t, kMost> samples_;
  std::array<float, kMost> weights_;
};

class CubeInterpolation {
 public:
  /// Refers to the forest of a cube of depth kMostCubeDepth or less.
  explicit CubeInterpolation(const Forest& cube);

  CubeCell cellAt(const CubePlace& place) const;
  CubeTaps taps(const CubeCell& cell) const;
  /// samples[i]: sample i of the raster, of those that taps() names.
  template <class Samples>
  float at(const Samples& samples, const CubeCell& cell) const {
    float sum = 0;
    taps(cell).forEach([&](uint32_t sample, float weight) { sum += weight * samples[sample]; });
    return sum;
  }
  /// Whether all samples around are of the patch, and of no other one.
  bool isInside(const CubeCell& cell) const { return isInside(cell.x) && isInside(cell.y); }

 private:
  uint32_t numberOf(const Forest::Place& sample) const {
    return (sample.patch * (n_ + 1) + static_cast<uint32_t>(sample.y)) * (n_ + 1) +
           static_cast<uint32_t>(sample.x);
  }
  bool isInside(uint32_t x) const { return x >= kTaps / 2 && x + kTaps / 2 < n_; }

  void addInside(CubeTaps& taps, const Forest::Place& sample, float weight) const;
  void addBeyond(CubeTaps& taps, Forest::Place sample, float weight) const;

  const Forest* cube_;
  uint32_t n_;
  std::vector<double> beyond_;  ///< where a row's samples lie that are one beyond a side
};

}  // namespace tetrakis::inline cube
