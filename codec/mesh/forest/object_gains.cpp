// SPDX-License-Identifier: Apache-2.0
#include "codec/mesh/forest/object_gains.hpp"

#include <cmath>
#include <cstddef>

#include "base/vec3.hpp"

namespace tetrakis::inline forest {

namespace {

/// What errors along the axes count beside those along normals. Without them folds of a patch would
/// be overlooked; more would spend triangles on places that nobody sees move.
constexpr double kAxesPart = 0.25;

int32_t rounded(double value) {
  return static_cast<int32_t>(std::floor(value + 0.5));
}

/// That of the quad between the corners of a patch, of length 1; 0 where it has no area.
base::Vec3 patchNormal(const Forest& forest, uint32_t patch, const ObjectRasters& places) {
  const size_t side = forest.side(), n = side - 1, first = patch * side * side;
  const auto between = [&](size_t from, size_t to) {
    base::Vec3 out{};
    for (size_t axis = 0; axis < 3; ++axis)
      out[axis] = double{1} * places[axis][first + to] - places[axis][first + from];
    return out;
  };
  return base::normalized(base::cross(between(0, side * side - 1), between(n, n * side)));
}

}  // namespace

std::array<std::vector<int32_t>, 4> coordinatesOfErrors(const Forest& forest,
                                                        const ObjectRasters& places) {
  std::array<std::vector<int32_t>, 4> out;
  const size_t samples = size_t{forest.side()} * forest.side();
  out[0].reserve(places[0].size());
  for (uint32_t patch = 0; patch < forest.patches(); ++patch) {
    const base::Vec3 normal = patchNormal(forest, patch, places);
    for (size_t i = patch * samples; i < (patch + 1) * samples; ++i)
      out[0].push_back(
          rounded(normal[0] * places[0][i] + normal[1] * places[1][i] + normal[2] * places[2][i]));
  }
  for (size_t axis = 0; axis < 3; ++axis) {
    out[axis + 1].reserve(places[axis].size());
    for (const int32_t place : places[axis]) out[axis + 1].push_back(rounded(kAxesPart * place));
  }
  return out;
}

}  // namespace tetrakis::inline forest
