// SPDX-License-Identifier: Apache-2.0
// Storage and control of the semi-linear quadtree; see semilinear_quadtree.hpp.
#include "codec/mesh/quadtree/semilinear_quadtree.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <numeric>

#include "base/heap_sort.hpp"

namespace tetrakis::inline quadtree {
namespace {

using Entry = SemilinearQuadtree::Entry;

bool before(const Entry& a, const Entry& b) {
  return a.place < b.place;
}

/// Radix sort: about half the time of std::sort on the million vertices of a mesh.
void sortByPlace(std::vector<Entry>& entries) {
  constexpr uint32_t kDigitBits = 10, kDigits = 1u << kDigitBits;
  std::vector<Entry> sorted(entries.size());
  for (uint32_t shift = 0; shift < QuadtreePlace::kOrderBits; shift += kDigitBits) {
    const auto digit = [&](const Entry& entry) {
      return static_cast<size_t>(entry.place.order() >> shift & (kDigits - 1));
    };
    std::array<size_t, kDigits> next{};
    for (const Entry& entry : entries) ++next[digit(entry)];
    std::exclusive_scan(next.begin(), next.end(), next.begin(), size_t{0});
    for (const Entry& entry : entries) sorted[next[digit(entry)]++] = entry;
    entries.swap(sorted);
  }
}

/// The tree's vertices but the roots, less those of `erased` and those that `inserted` replaces.
std::vector<Entry> remaining(const SemilinearQuadtree& tree, std::span<const Entry> inserted,
                             std::span<const QuadtreePlace> erased) {
  std::vector<Entry> kept;
  kept.reserve(tree.vertexCount() + inserted.size());
  uint32_t number = tree.rootCount();
  tree.forEachVertex([&](const QuadtreePlace& place) {
    const float value = tree.values()[number++];
    while (!erased.empty() && erased.front() < place) erased = erased.subspan(1);
    while (!inserted.empty() && inserted.front().place < place) inserted = inserted.subspan(1);
    const bool gone = !erased.empty() && erased.front() == place;
    const bool replaced = !inserted.empty() && inserted.front().place == place;
    if (!gone && !replaced) kept.push_back({place, value});
  });
  return kept;
}

}  // namespace

SemilinearQuadtree::SemilinearQuadtree(QuadtreeShape shape, std::span<const float> roots)
    : shape_(shape), values_(roots.begin(), roots.end()) {
  assert(roots.size() == rootCount());
  for (uint32_t level = 0; level < shape_.depth; ++level) addLevel(level, {});
}

void SemilinearQuadtree::update(std::vector<Entry> inserted, std::vector<QuadtreePlace> erased) {
  if (!std::is_sorted(inserted.begin(), inserted.end(), before)) sortByPlace(inserted);
  heapSort(erased);
  std::vector<Entry> entries = remaining(*this, inserted, erased);
  const auto middle = static_cast<std::ptrdiff_t>(entries.size());
  entries.insert(entries.end(), inserted.begin(), inserted.end());
  std::inplace_merge(entries.begin(), entries.begin() + middle, entries.end(), before);

  levels_.clear();
  values_.resize(rootCount());
  values_.reserve(rootCount() + entries.size());
  std::span<const Entry> rest = entries;
  for (uint32_t level = 0; level < shape_.depth; ++level) {
    const auto end = std::partition_point(
        rest.begin(), rest.end(), [&](const Entry& entry) { return entry.place.level <= level; });
    const auto count = static_cast<size_t>(end - rest.begin());
    addLevel(level, rest.first(count));
    rest = rest.subspan(count);
  }
  assert(rest.empty());
}

void SemilinearQuadtree::addLevel(uint32_t level, std::span<const Entry> entries) {
  const auto count = [&](QuadtreePlace::Tree tree) {
    return static_cast<uint32_t>(std::count_if(
        entries.begin(), entries.end(), [&](const Entry& e) { return e.place.tree == tree; }));
  };
  const uint32_t east = vertexCount() + count(QuadtreePlace::kNodes);
  const uint32_t south = east + count(QuadtreePlace::kEastBorder);
  Level& l = levels_.emplace_back(Level{{shape_.nodesOf(level), vertexCount()},
                                        {shape_.rowsOf(level), east},
                                        {shape_.columnsOf(level), south}});
  for (const Entry& entry : entries) {
    const QuadtreePlace& place = entry.place;
    if (place.tree == QuadtreePlace::kNodes) l.nodes.append(place.node, place.vertex);
    if (place.tree == QuadtreePlace::kEastBorder) l.east.append(place.node, 0);
    if (place.tree == QuadtreePlace::kSouthBorder) l.south.append(place.node, 0);
    values_.push_back(entry.value);
  }
  l.nodes.gather();
  l.east.gather();
  l.south.gather();
}

uint32_t SemilinearQuadtree::find(QuadtreePlace place) const {
  assert(place.level < levels_.size());
  const Level& level = levels_[place.level];
  switch (place.tree) {
    case QuadtreePlace::kNodes:
      return level.nodes.find(place.node, place.vertex);
    case QuadtreePlace::kEastBorder:
      return level.east.find(place.node, 0);
    case QuadtreePlace::kSouthBorder:
      return level.south.find(place.node, 0);
  }
  return kNoVertex;
}

size_t SemilinearQuadtree::bytes() const {
  size_t bytes = values_.capacity() * sizeof(float) + levels_.capacity() * sizeof(Level);
  for (const Level& level : levels_)
    bytes += level.nodes.bytes() + level.east.bytes() + level.south.bytes();
  return bytes;
}

}  // namespace tetrakis::inline quadtree
