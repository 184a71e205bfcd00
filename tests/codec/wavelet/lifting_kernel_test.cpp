// SPDX-License-Identifier: Apache-2.0
// The vectors of a processor do what plain arithmetic does, on any values.
#include "codec/wavelet/lifting/lifting_kernel.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/support/random_planes.hpp"
#include "tests/support/wavelet_cases.hpp"

namespace tetrakis::test {
namespace {

/// A step of `count` targets on random sources, by either kernel.
class KernelCase {
 public:
  KernelCase(Random& random, size_t count, const LiftingRule& rule) : count_(count), rule_(rule) {
    target_ = randomPlane(random, count + 1, kLowest, kHighest);
    for (size_t k = 0; k < rule.step.pairs; ++k) {
      // As long as the targets, so that a sanitizer sees what is read behind them.
      planes_.push_back(extremePlane(random, count, kLowest, kHighest));
      planes_.push_back(randomPlane(random, count, kLowest, kHighest));
    }
    for (size_t k = 0; k < rule.step.pairs; ++k) {
      sources_.before[k] = planes_[2 * k].data();
      sources_.after[k] = planes_[2 * k + 1].data();
    }
  }

  Plane byScalar() const {
    Plane result = target_;
    liftStepScalar(result.data(), sources_, rule_, count_);
    return result;
  }
  Plane byBoth() const {
    Plane result = target_;
    liftStep(result.data(), sources_, rule_, count_);
    return result;
  }

 private:
  size_t count_;
  LiftingRule rule_;
  Plane target_;
  std::vector<Plane> planes_;
  LiftingSources sources_{};
};

TEST(LiftingKernel, VectorsEqualScalars) {
  Random random(11);
  for (const FilterId id : kAllFilters) {
    const LiftingFilter filter = liftingFilter(id);
    for (const LiftingStep& step : filter.steps) {
      for (const bool wide : {false, true}) {
        for (const Direction direction : {Direction::kAnalysis, Direction::kSynthesis}) {
          for (const size_t count : {0, 1, 7, 8, 9, 15, 16, 17, 100, 1000}) {
            const KernelCase task(random, count, {step, filter.shift, direction, wide});
            ASSERT_EQ(task.byBoth(), task.byScalar()) << count << " targets, wide: " << wide;
          }
        }
      }
    }
  }
}

/// What the vectors of exact sums rely on.
TEST(LiftingKernel, WeightsLeaveRoomForSumsOfHalves) {
  for (const FilterId id : kAllFilters) {
    const LiftingFilter filter = liftingFilter(id);
    EXPECT_GE(filter.shift, 1);
    EXPECT_LT(filter.shift, 16);
    for (const LiftingStep& step : filter.steps) {
      int sum = 0;
      for (const int16_t weight : step.weights) sum += std::abs(weight);
      EXPECT_LE(sum, 1 << 14);
    }
  }
}

}  // namespace
}  // namespace tetrakis::test
