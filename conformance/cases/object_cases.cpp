// SPDX-License-Identifier: Apache-2.0
// Objects: heights on forests that lie over a base mesh.
#include <array>

#include "conformance/cases/case_builders.hpp"
#include "conformance/cases/cases.hpp"
#include "conformance/cases/crafted_streams.hpp"

namespace tetrakis::conformance {
namespace {

using Corner = std::array<int32_t, 3>;

/// Patches by the numbers of their corners, clockwise from the north-west one on: sides between the
/// same two are glued.
VectorCase over(VectorCase vector_case, const std::vector<std::array<uint32_t, 4>>& patches,
                const std::vector<Corner>& corners, uint32_t bits) {
  const auto end = [&](size_t side, size_t after) {
    return patches[side / 4][(side % 4 + after) % 4];
  };
  vector_case.sides.assign(4 * patches.size(), TKS_BORDER);
  for (uint32_t a = 0; a < vector_case.sides.size(); ++a) {
    for (uint32_t b = 0; b < vector_case.sides.size(); ++b)
      if (end(a, 0) == end(b, 1) && end(a, 1) == end(b, 0)) vector_case.sides[a] = b;
    const Corner& at = corners[end(a, 0)];
    vector_case.corners.insert(vector_case.corners.end(), at.begin(), at.end());
  }
  vector_case.corner_bits = bits;
  return vector_case;
}

/// Four squares round the hole, four round each of these.
VectorCase torusCase() {
  constexpr int32_t kRound[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  std::vector<std::array<uint32_t, 4>> patches;
  std::vector<Corner> corners;
  for (uint32_t i = 0; i < 4; ++i) {
    for (uint32_t j = 0; j < 4; ++j) {
      const int32_t radius = 70 + 31 * kRound[j][0];
      corners.push_back(
          {128 + radius * kRound[i][0], 128 + radius * kRound[i][1], 128 + 31 * kRound[j][1]});
      const uint32_t k = (i + 1) % 4, l = (j + 1) % 4;
      patches.push_back({4 * i + j, 4 * i + l, 4 * k + l, 4 * k + j});
    }
  }
  return over(heightsCase("object_torus_9x144", "an object with a hole: quads of a base mesh",
                          {Pattern::kRidges, 9, 144, 1, TKS_I16, 3}, budget(900)),
              patches, corners, 8);
}

/// A bent strip of three squares, and one apart.
VectorCase openCase() {
  return over(heightsCase("object_open_17x68", "an object with borders, in two pieces",
                          {Pattern::kHills, 17, 68, 1, TKS_U16}, maxError(40)),
              {{0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {8, 9, 10, 11}},
              {{100, 200, 3000},
               {1100, 190, 3300},
               {2000, 180, 2900},
               {2900, 210, 2200},
               {90, 1200, 3050},
               {1080, 1190, 3320},
               {2020, 1210, 2950},
               {2950, 1180, 2100},
               {3000, 3000, 400},
               {4000, 3100, 300},
               {4095, 4000, 0},
               {3050, 3900, 500}},
              12);
}

/// Heights and a texture whose patches have different depths.
VectorCase texturedCase() {
  VectorCase joint =
      heightsCase("object_joint_9x54_17x102", "an object and its texture: forests of two depths",
                  {Pattern::kRidges, 9, 54, 1, TKS_I16}, lossless());
  joint.texture = Recipe{Pattern::kRidges, 17, 102, 3, TKS_U8, 7};
  std::vector<Corner> corners;
  for (int32_t i = 0; i < 8; ++i) corners.push_back({7 * (i & 1), 5 * (i >> 1 & 1), 6 * (i >> 2)});
  return over(joint,
              {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {1, 3, 7, 5}, {3, 2, 6, 7}, {2, 0, 4, 6}},
              corners, 3);
}

/// Corners of noise, on patches of the largest depth that may have any.
VectorCase noiseCase() {
  StreamHeader header = heightsHeader(257, 514, TKS_I16, 8);
  header.geometry->wavelet.forest =
      std::make_shared<const Forest>(8, std::vector<uint32_t>{5, 4, 7, 6, 1, 0, 3, 2});
  const Bytes code = noise(70, 231);
  header.geometry->base_mesh = {20, 0x1p-20, {0.1, -1e9, 3}, {code.begin(), code.end()}};
  return crafted("noise_object_257x514", "corners of noise under the finest patches of an object",
                 streamOf(header, noise(90, 232)));
}

}  // namespace

std::vector<VectorCase> objectCases() {
  return {torusCase(), openCase(), texturedCase(), noiseCase()};
}

}  // namespace tetrakis::conformance
