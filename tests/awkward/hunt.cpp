// SPDX-License-Identifier: Apache-2.0
// awkward_hunt SECONDS [FIRST_SEED [MOST_SAMPLES]]: goes through awkward terrains until the time is
// up. Exit status 1 and the seed of the case on the first broken promise; a case that takes over a
// minute of processor time is one.
#include <sys/time.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>

#include "tests/awkward/promises.hpp"

namespace {

constexpr int kMostSeconds = 60;

/// A signal ends the program after so much processor time from now on; 0: none does.
void limitTo(int seconds) {
  itimerval timer = {};
  timer.it_value.tv_sec = seconds;
  setitimer(ITIMER_PROF, &timer, nullptr);
}

}  // namespace

int main(int argc, char** argv) {
  using Clock = std::chrono::steady_clock;
  if (argc < 2) {
    std::fprintf(stderr, "usage: awkward_hunt SECONDS [FIRST_SEED [MOST_SAMPLES]]\n");
    return 1;
  }
  const auto end = Clock::now() + std::chrono::seconds(std::atoll(argv[1]));
  const uint64_t first = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1000;
  const auto most = static_cast<uint32_t>(argc > 3 ? std::atoll(argv[3]) : 40000);
  uint64_t seed = first;
  for (; Clock::now() < end; ++seed) {
    const tetrakis::test::AwkwardCase c = tetrakis::test::awkwardCase(seed, most);
    std::printf("%llu: %s\n", static_cast<unsigned long long>(seed), c.description.c_str());
    std::fflush(stdout);
    limitTo(kMostSeconds);  // the last line says where
    const std::string broken = tetrakis::test::brokenPromise(c);
    if (broken.empty()) continue;
    std::printf("BROKEN: %s\n", broken.c_str());
    return 1;
  }
  limitTo(0);
  std::printf("%llu cases, no promise broken\n", static_cast<unsigned long long>(seed - first));
  return 0;
}
