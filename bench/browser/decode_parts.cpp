// SPDX-License-Identifier: Apache-2.0
// bench_decode_parts FILE RUNS: processor time, in ms, of decoding the texture, the surface and a
// mesh of a stream, each by a fresh decoder: the least of RUNS, as {"texture": …}. Without the
// vectors of AVX2, which WebAssembly does not have.
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <utility>
#include <vector>

#include "codec/wavelet/lifting/lifting_kernel.hpp"
#include "tetrakis/tetrakis.hpp"

namespace tetrakis::inline wavelet {

/// Takes the place of codec/wavelet/lifting/lifting_avx2.cpp in this program: no vectors.
size_t liftStepVectors(int32_t*, const LiftingSources&, const LiftingRule&, size_t) {
  return 0;
}

}  // namespace tetrakis::inline wavelet

namespace {

using namespace tetrakis;

constexpr uint32_t kTriangles = 20000;

struct Part {
  const char* name;
  std::function<Status(Decoder&)> decode;
};

const std::array<Part, 3> kParts = {
    {{"texture", [](Decoder& decoder) { return decoder.texture().status(); }},
     {"surface", [](Decoder& decoder) { return decoder.surface().status(); }},
     {"mesh", [](Decoder& decoder) { return decoder.budgetMesh(kTriangles).status(); }}}};

Result<double> leastOf(int runs, const std::vector<uint8_t>& bytes, const Part& part) {
  double least = std::numeric_limits<double>::infinity();
  for (int run = 0; run < runs; ++run) {
    const std::clock_t start = std::clock();
    Result<Decoder> decoder = Decoder::open(bytes);
    if (!decoder) return decoder.status();
    if (Status status = part.decode(*decoder); !status.ok()) return status;
    least = std::min(least, 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  return least;
}

}  // namespace

int main(int argc, char** argv) {
  const int runs = argc == 3 ? std::atoi(argv[2]) : 0;
  if (runs < 1) {
    std::fputs("usage: bench_decode_parts FILE RUNS\n", stderr);
    return 1;
  }
  std::ifstream file(argv[1], std::ios::binary);
  const std::vector<uint8_t> bytes(std::istreambuf_iterator<char>(file), {});
  const char* separator = "{";
  for (const Part& part : kParts) {
    const Result<double> milliseconds = leastOf(runs, bytes, part);
    if (!milliseconds) {
      std::fprintf(stderr, "%s: %s\n", argv[1], milliseconds.status().message().c_str());
      return 1;
    }
    std::printf("%s\"%s\": %.2f", separator, part.name, *milliseconds);
    separator = ", ";
  }
  std::puts("}");
  return 0;
}
