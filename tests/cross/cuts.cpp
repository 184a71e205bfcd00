// SPDX-License-Identifier: Apache-2.0
// cuts FOLDER < CUTS: for each line "FILE BYTES LEVEL ..." what the decoder answers there, as "FILE
// BYTES LEVEL STATUS HEIGHTS TEXTURE". scripts/cross gives it those of the manifest, and compares.
#include <cstdio>
#include <fstream>
#include <iostream>
#include <iterator>
#include <sstream>
#include <vector>

#include "conformance/decode_cut.hpp"

namespace tetrakis::conformance {
namespace {

const char* orNone(const std::string& digest) {
  return digest.empty() ? "-" : digest.c_str();
}

void answer(const std::string& folder, const std::string& line) {
  std::istringstream words(line);
  std::string file;
  size_t bytes = 0;
  int level = 0;
  words >> file >> bytes >> level;
  std::ifstream in(folder + "/" + file, std::ios::binary);
  std::vector<uint8_t> stream{std::istreambuf_iterator<char>(in), {}};
  stream.resize(bytes);
  const Cut cut = decodeCut(stream, level);
  std::printf("%s %zu %d %d %s %s\n", file.c_str(), bytes, level, cut.status, orNone(cut.heights),
              orNone(cut.texture));
}

}  // namespace
}  // namespace tetrakis::conformance

int main(int argc, char** argv) {
  if (argc != 2) return 1;
  for (std::string line; std::getline(std::cin, line);)
    tetrakis::conformance::answer(argv[1], line);
  return 0;
}
