// SPDX-License-Identifier: Apache-2.0
#include "bench/meshes/surface_simplified.hpp"

#include <meshoptimizer.h>

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <map>
#include <utility>

namespace tetrakis::bench {
namespace {

std::array<float, 3> floatsOf(const Point& p) {
  return {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])};
}

FloatMesh compact(const FloatMesh& mesh, const std::vector<uint32_t>& corners) {
  std::vector<uint32_t> numbers(mesh.points.size(), UINT32_MAX);
  FloatMesh out;
  for (const uint32_t corner : corners) {
    if (numbers[corner] == UINT32_MAX) {
      numbers[corner] = static_cast<uint32_t>(out.points.size());
      out.points.push_back(mesh.points[corner]);
      if (!mesh.texcoords.empty()) out.texcoords.push_back(mesh.texcoords[corner]);
    }
    out.corners.push_back(numbers[corner]);
  }
  return out;
}

}  // namespace

FloatMesh floatMesh(const TriangleMesh& mesh) {
  FloatMesh out;
  for (const Point& p : mesh.points) out.points.push_back(floatsOf(p));
  for (const Triangle& t : mesh.triangles)
    out.corners.insert(out.corners.end(), t.begin(), t.end());
  return out;
}

FloatMesh texturedFloatMesh(const tools::PaintedMesh& painted) {
  FloatMesh out;
  std::map<std::pair<uint32_t, std::array<float, 2>>, uint32_t> numbers;
  for (size_t i = 0; i < painted.texcoords.size(); ++i) {
    const uint32_t point = painted.mesh.triangles[i / 3][i % 3];
    const auto next = static_cast<uint32_t>(out.points.size());
    const auto [found, is_new] = numbers.try_emplace({point, painted.texcoords[i]}, next);
    if (is_new) {
      out.points.push_back(floatsOf(painted.mesh.points[point]));
      out.texcoords.push_back(painted.texcoords[i]);
    }
    out.corners.push_back(found->second);
  }
  return out;
}

TriangleMesh triangleMesh(const FloatMesh& mesh) {
  TriangleMesh out;
  for (const auto& p : mesh.points) out.points.push_back({p[0], p[1], p[2]});
  for (size_t i = 0; i < mesh.corners.size(); i += 3)
    out.triangles.push_back({mesh.corners[i], mesh.corners[i + 1], mesh.corners[i + 2]});
  return out;
}

FloatMesh simplified(const FloatMesh& mesh, uint32_t budget) {
  if (3 * size_t{budget} >= mesh.corners.size()) return compact(mesh, mesh.corners);
  std::vector<uint32_t> fewer(mesh.corners.size());
  fewer.resize(meshopt_simplify(fewer.data(), mesh.corners.data(), mesh.corners.size(),
                                mesh.points[0].data(), mesh.points.size(), sizeof mesh.points[0],
                                3 * size_t{budget}, FLT_MAX));
  return compact(mesh, fewer);
}

std::vector<uint32_t> budgetsOf(const FloatMesh& mesh, uint32_t sizes) {
  constexpr uint32_t kFewest = 250, kMost = 120000;
  const auto all = static_cast<uint32_t>(mesh.corners.size() / 3);
  const double most = std::min(all, kMost), fewest = std::min(all, kFewest);
  std::vector<uint32_t> budgets;
  for (uint32_t i = 0; i < sizes; ++i) {
    const double share = sizes > 1 ? double{1} * i / (sizes - 1) : 0;
    budgets.push_back(static_cast<uint32_t>(most * std::pow(fewest / most, share)));
  }
  budgets.erase(std::unique(budgets.begin(), budgets.end()), budgets.end());
  return budgets;
}

}  // namespace tetrakis::bench
