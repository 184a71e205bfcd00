// SPDX-License-Identifier: Apache-2.0
// Encoding says how far it is, often, and ends where the caller wants no more.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>

#include "base/parallel.hpp"
#include "base/watch.hpp"
#include "encoder/encode_stream.hpp"
#include "tests/support/stream_fixture.hpp"

namespace tetrakis::test {
namespace {

using namespace std::chrono_literals;
using samples::make;
using samples::Pattern;
using samples::Raster;

/// Work of many pieces tells how far it is while it goes on, not only when it has ended.
TEST(ToldProgress, IsToldBetweenPieces) {
  for (const uint32_t threads : {1u, 3u}) {
    std::vector<double> told;
    ToldProgress watch([&](double done) {
      told.push_back(done);
      return true;
    });
    const Watched watched(&watch);
    beginStage(0.5);
    parallelFor(threads, 9, [](size_t) { std::this_thread::sleep_for(60ms); });
    EXPECT_GE(told.size(), 4u);
    EXPECT_EQ(told.front(), 0);
    EXPECT_LT(told.back(), 0.5);
    beginStage(1);
    EXPECT_EQ(told.back(), 0.5);
    EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
  }
}

/// No piece begins behind the one that was the last, on any thread.
TEST(ToldProgress, EndsWork) {
  for (const uint32_t threads : {1u, 3u}) {
    ToldProgress watch([](double done) { return done == 0; });
    const Watched watched(&watch);
    beginStage(1);
    std::atomic<size_t> pieces = 0;
    const auto piece = [&](size_t) {
      ++pieces;
      std::this_thread::sleep_for(60ms);
    };
    EXPECT_THROW(parallelFor(threads, 1000, piece), Stopped);
    EXPECT_LE(pieces, 3u * threads);
    EXPECT_THROW(passPiece(1), Stopped);
  }
}

/// What is told may use the library, which then watches nothing.
TEST(ToldProgress, DoesNotWatchWhatItTells) {
  size_t told = 0;
  ToldProgress watch([&](double) {
    ++told;
    beginStage(1);
    parallelFor(2, 4, [](size_t) { passPiece(1); });
    return true;
  });
  const Watched watched(&watch);
  beginStage(1);
  EXPECT_EQ(told, 1u);
}

/// Counts calls, and ends the encoding at one of them.
struct Caller {
  size_t last = SIZE_MAX;
  std::vector<double> told;

  static int call(void* user, double done) {
    auto& caller = *static_cast<Caller*>(user);
    caller.told.push_back(done);
    return caller.told.size() >= caller.last ? 1 : 0;
  }
};

TEST(Progress, RisesFromZeroToOne) {
  const Raster surface = make({Pattern::kRidges, 161, 140, 1, TKS_U16});
  const Raster picture = make({Pattern::kRidges, 120, 90, 3, TKS_U8});
  for (const uint32_t threads : {1u, 2u}) {
    Caller caller;
    tks_encode_options options = lossless();
    options.threads = threads;
    options.progress = Caller::call;
    options.user = &caller;
    encode(&surface, &picture, options);
    ASSERT_FALSE(caller.told.empty());
    EXPECT_TRUE(std::is_sorted(caller.told.begin(), caller.told.end()));
    EXPECT_EQ(caller.told.front(), 0);
    EXPECT_EQ(caller.told.back(), 1);
  }
}

/// Whenever the caller wants no more there is no stream, and a sentence.
TEST(Progress, StopsAtEveryCall) {
  const Raster surface = make({Pattern::kRidges, 161, 140, 1, TKS_U16});
  const tks_heights heights = surface.heights();
  for (const uint32_t threads : {1u, 2u}) {
    for (size_t last = 1; last <= 5; ++last) {
      Caller caller;
      caller.last = last;
      tks_encode_options options = lossless();
      options.threads = threads;
      options.progress = Caller::call;
      options.user = &caller;
      tks_buffer stream = {};
      char message[100] = "";
      EXPECT_EQ(tks_encode(&heights, nullptr, &options, &stream, message, sizeof message),
                TKS_USAGE);
      EXPECT_STREQ(message, "Encoding was stopped by the caller.");
      EXPECT_EQ(stream.data, nullptr);
      EXPECT_EQ(caller.told.size(), last);
    }
  }
}

}  // namespace
}  // namespace tetrakis::test
