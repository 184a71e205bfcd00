// SPDX-License-Identifier: Apache-2.0
// slow_hunt SECONDS [FIRST_SEED [SAMPLES_LOG2]]: goes through streams that could keep a decoder
// busy until the time is up, of planes of up to 2^SAMPLES_LOG2 samples. Prints the seed, the call
// and its time for each call that takes longer than it may. Exit status 1 if there is one.
#include <chrono>
#include <cstdio>
#include <cstdlib>

#include "tests/pace/pace.hpp"
#include "tests/pace/slow_case.hpp"

int main(int argc, char** argv) {
  using Clock = std::chrono::steady_clock;
  if (argc < 2) {
    std::fprintf(stderr, "usage: slow_hunt SECONDS [FIRST_SEED [SAMPLES_LOG2]]\n");
    return 1;
  }
  const auto end = Clock::now() + std::chrono::seconds(std::atoll(argv[1]));
  const uint64_t first = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1000;
  const uint64_t most = uint64_t{1} << (argc > 3 ? std::atoi(argv[3]) : 22);
  const double slow = tetrakis::test::slowness();
  uint64_t seed = first, found = 0;
  for (; Clock::now() < end; ++seed) {
    const tetrakis::test::SlowCase made = tetrakis::test::slowCase(seed, most);
    const std::string call = tetrakis::test::slowCall(made.stream, slow);
    if (call.empty()) continue;
    ++found;
    std::printf("%llu: %s\n  %s (%zu bytes)\n", static_cast<unsigned long long>(seed), call.c_str(),
                made.description.c_str(), made.stream.size());
    std::fflush(stdout);
  }
  std::printf("%llu streams, %llu of them slow\n", static_cast<unsigned long long>(seed - first),
              static_cast<unsigned long long>(found));
  return found > 0;
}
