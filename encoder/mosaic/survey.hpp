// SPDX-License-Identifier: Apache-2.0
// makePlan() turns a source and a target into a plan. A survey reads the source once, window by
// window, for what an encoder finds in a whole plane: range, voids, and the step that restores all
// samples. chooseSteps() then chooses by nine fields of the source (step_plan.cpp).
#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include "codec/geometry/quantiser/step_choice.hpp"
#include "encoder/mosaic/mosaic_plan.hpp"
#include "tetrakis/result.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::inline mosaic {

/// The target and the sizes that the caller wants: exactly one of bytes, psnr, max_error and
/// lossless is set.
struct MosaicOptions {
  uint64_t bytes = 0;    ///< of the whole stream, at most
  double psnr = 0;       ///< of the samples, by their range
  double max_error = 0;  ///< of every sample, in the unit of the heights
  bool lossless = false;
  int region_log2 = 9;
  int tile_log2 = kUsualTileLog2;
  double step = 0;  ///< > 0: of the samples, which nothing chooses then
  uint32_t threads = 1;
};

/// source: all of tks_heights but its samples, and a plane. TKS_USAGE: the target cannot be
/// promised, with the reason. Errors of `read`.
Result<MosaicPlan> makePlan(const tks_heights& source, const MosaicOptions& options,
                            const ReadSamples& read);

// A Survey is what has been seen of the samples of a source.

class Survey {
 public:
  /// Adds samples. TKS_USAGE: one is infinite.
  Status add(const tks_heights& heights);

  bool any() const { return any_; }
  bool voids() const { return voids_; }
  double low() const { return low_; }
  double high() const { return high_; }
  double range() const { return high_ - low_; }
  /// The step of which every sample is a multiple, from some sample on; 0: there is none that
  /// divides the range into 2^26 parts or fewer.
  double exactStep() const;
  bool floats() const { return floats_; }
  /// A sample is -0: no step tells it from 0.
  bool negativeZeros() const { return negative_zeros_; }

 private:
  static constexpr uint64_t kNone = std::numeric_limits<uint64_t>::max();

  template <class T>
  void addValid(const T* samples, size_t count, Mask valid);
  void addFloat(float sample);

  bool any_ = false, voids_ = false, floats_ = false, negative_zeros_ = false;
  double low_ = 0, high_ = 0;
  uint64_t divisor_ = 0;  ///< of the differences of integers
  double first_ = 0;      ///< integer that these are from
  /// Of floats: their greatest common divisor in each of kDecimalSteps; kNone: one is no multiple.
  std::array<uint64_t, kDecimalSteps.size()> decimals_{};
  int lowest_bit_ = std::numeric_limits<int>::max();  ///< exponent of the lowest bit of all floats
};

/// The part of makePlan() that says how samples become steps and how these are coded: base, step
/// and filters, and whether coefficients are cut, with corrections behind them. plan: with all that
/// the source and the target say of it. TKS_USAGE: the target cannot be promised, with the reason.
/// Errors of `read`.
Status chooseSteps(const Survey& survey, const MosaicOptions& options, const ReadSamples& read,
                   MosaicPlan& plan);

}  // namespace tetrakis::inline mosaic
