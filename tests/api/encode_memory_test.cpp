// SPDX-License-Identifier: Apache-2.0
// What encoding takes at most: 16 bytes a sample beside the stream and the caller's samples. Each
// encoding runs in a process of its own, because a peak never falls.
#include <malloc.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/support/stream_fixture.hpp"

namespace tetrakis::test {
namespace {

using samples::make;
using samples::Pattern;
using samples::Raster;

// Sanitizers keep what is freed, and shadows of it.
#if defined(__SANITIZE_ADDRESS__)
constexpr bool kSanitized = true;
#elif defined(__has_feature)
constexpr bool kSanitized = __has_feature(address_sanitizer);
#else
constexpr bool kSanitized = false;
#endif

/// Bytes by which a child that does the work peaks above one that does nothing.
template <class Work>
double peakOf(Work work) {
  const auto child_peak = [](const auto& task) {
    const pid_t child = fork();
    if (child == 0) {
      task();
      _exit(0);
    }
    int state = 0;
    rusage usage = {};
    EXPECT_EQ(wait4(child, &state, 0, &usage), child);
    EXPECT_TRUE(WIFEXITED(state) && WEXITSTATUS(state) == 0);
    return 1024.0 * static_cast<double>(usage.ru_maxrss);
  };
  malloc_trim(0);  // else a child would reuse freed blocks that the idle one counts already
  const double idle = child_peak([] {});
  return child_peak(work) - idle;
}

TEST(EncodeMemory, TakesNoMoreThanSixteenBytesASample) {
  if (kSanitized) GTEST_SKIP();
  constexpr uint32_t kSide = 700;
  const Raster image = make({Pattern::kRidges, kSide, kSide, 3, TKS_U8});
  const Raster heights = make({Pattern::kRidges, kSide, kSide, 1, TKS_U16});
  constexpr double kImageSamples = 3.0 * kSide * kSide, kHeightSamples = 1.0 * kSide * kSide;
  constexpr double kOnceForAll = 4 << 20;  // tables, code that is touched for the first time
  for (const tks_encode_options& options : {lossless(), budget(kSide * kSide / 8)}) {
    const auto stream = static_cast<double>(encode(nullptr, &image, options).size());
    EXPECT_LE(peakOf([&] { encode(nullptr, &image, options); }),
              16 * kImageSamples + 2 * stream + kOnceForAll)
        << (options.lossless ? "lossless" : "lossy");
    EXPECT_LE(peakOf([&] { encode(&heights, nullptr, options); }),
              28 * kHeightSamples + kOnceForAll)
        << (options.lossless ? "lossless heights" : "lossy heights");
  }
}

}  // namespace
}  // namespace tetrakis::test
