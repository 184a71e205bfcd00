// SPDX-License-Identifier: Apache-2.0
// weldedMesh() counts what there is of a mesh whose vertices are one where their keys are equal:
// whether it is closed, and what it is.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <span>
#include <utility>
#include <vector>

namespace tetrakis::checks {

struct WeldedMesh {
  size_t vertices = 0, edges = 0, triangles = 0;
  size_t open = 0, loops = 0;  ///< edges of one triangle, and rings of them

  /// 2 for a sphere, 0 for a band, 1 for a disc.
  long euler() const { return static_cast<long>(vertices + triangles) - static_cast<long>(edges); }
};

/// Every edge must be of two triangles that run along it in opposite directions, or of one. Of few
/// columns the same two vertices may have more than one edge.
template <class Key>
WeldedMesh weldedMesh(const std::vector<Key>& keys, std::span<const uint32_t> triangles) {
  std::map<Key, size_t> numbers;
  for (const Key& key : keys) numbers.emplace(key, numbers.size());
  std::map<std::pair<size_t, size_t>, int> runs;
  for (size_t i = 0; i < triangles.size(); ++i) {
    const uint32_t next = triangles[i % 3 == 2 ? i - 2 : i + 1];
    ++runs[{numbers.at(keys[triangles[i]]), numbers.at(keys[next])}];
  }
  WeldedMesh welded{numbers.size(), 0, triangles.size() / 3, 0, 0};
  std::map<size_t, std::vector<size_t>> along;
  for (const auto& [edge, count] : runs) {
    const auto back = runs.find({edge.second, edge.first});
    const int other = back == runs.end() ? 0 : back->second;
    EXPECT_NE(edge.first, edge.second) << "a triangle without an area";
    EXPECT_LE(std::abs(count - other), 1) << "triangles that overlap";
    if (count > other) along[edge.first].push_back(edge.second);
    if (edge.first < edge.second || other == 0)
      welded.edges += static_cast<size_t>(std::max(count, other));
    welded.open += static_cast<size_t>(std::max(count - other, 0));
  }
  for (; !along.empty(); ++welded.loops) {
    for (auto at = along.begin(); at != along.end();) {
      const size_t next = at->second.back();
      at->second.pop_back();
      if (at->second.empty()) along.erase(at);
      at = along.find(next);
    }
  }
  return welded;
}

}  // namespace tetrakis::checks
