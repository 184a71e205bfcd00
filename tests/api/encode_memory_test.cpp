// SPDX-License-Identifier: Apache-2.0
// What encoding takes at most beside the stream and the caller's samples, for each sample. Each
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

/// Bytes by which a child that does the work peaks above one that does nothing. Large blocks go
/// back to the system when they are freed: what the allocator would keep for each thread differs
/// from run to run on a busy machine.
template <class Work>
double peakOf(Work work) {
  const auto child_peak = [](const auto& task) {
    const pid_t child = fork();
    if (child == 0) {
      mallopt(M_MMAP_THRESHOLD, 1 << 16);
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

constexpr double kOnceForAll = 4 << 20;  // tables, code that is touched for the first time

TEST(EncodeMemory, IsBoundedByTheSamples) {
  if (kSanitized) GTEST_SKIP();
  constexpr uint32_t kSide = 700;
  const Raster image = make({Pattern::kRidges, kSide, kSide, 3, TKS_U8});
  const Raster heights = make({Pattern::kRidges, kSide, kSide, 1, TKS_U16});
  constexpr double kImageSamples = 3.0 * kSide * kSide, kHeightSamples = 1.0 * kSide * kSide;
  for (const tks_encode_options& options : {lossless(), budget(kSide * kSide / 8)}) {
    const auto stream = static_cast<double>(encode(nullptr, &image, options).size());
    EXPECT_LE(peakOf([&] { encode(nullptr, &image, options); }),
              16 * kImageSamples + 2 * stream + kOnceForAll)
        << (options.lossless ? "lossless" : "lossy");
    EXPECT_LE(peakOf([&] { encode(&heights, nullptr, options); }),
              24 * kHeightSamples + kOnceForAll)
        << (options.lossless ? "lossless heights" : "lossy heights");
  }
}

TEST(EncodeMemory, OfRegionsIsThatOfOneForEachThread) {
  if (kSanitized) GTEST_SKIP();
  constexpr uint32_t kImageSide = 1200, kSide = 2100;  // of more than 2^22 samples
  const Raster image = make({Pattern::kRidges, kImageSide, kImageSide, 3, TKS_U8});
  tks_encode_options options = lossless();
  options.regions = 128;
  options.threads = 2;
  EXPECT_LE(peakOf([&] { encode(nullptr, &image, options); }),
            13.0 * 3 * kImageSide * kImageSide + kOnceForAll);
  const Raster heights = make({Pattern::kRidges, kSide, kSide, 1, TKS_U16});
  EXPECT_LE(peakOf([&] { encode(&heights, nullptr, options); }),
            15.0 * kSide * kSide + kOnceForAll);
}

}  // namespace
}  // namespace tetrakis::test
