// SPDX-License-Identifier: Apache-2.0
// First-in-first-out push-relabel; exact distances again after as many relabels as vertices.
#include "codec/mesh/closure/closure.hpp"

#include <algorithm>

namespace tetrakis::inline closure {

ClosureFlow::ClosureFlow(std::vector<Arcs> parents)
    : parents_(std::move(parents)),
      children_(parents_.size(), Children{kNone, kNone, kNone, kNone}),
      loans_(parents_.size()),
      excess_(parents_.size()),
      label_(parents_.size()),
      part_(parents_.size()) {
  std::vector<uint8_t> count(parents_.size());
  for (uint32_t v = 0; v < parents_.size(); ++v)
    for (const uint32_t parent : parents_[v])
      if (parent != kNone) children_[parent][count[parent]++] = v;
}

/// visit(parent, loan to it) within the part.
template <class Visit>
void ClosureFlow::forEachParent(uint32_t v, Visit&& visit) const {
  for (size_t slot = 0; slot < 2; ++slot) {
    const uint32_t parent = parents_[v][slot];
    if (parent != kNone && part_[parent] == part_[v]) visit(parent, slot);
  }
}

/// visit(child, slot of its arc to v) within the part.
template <class Visit>
void ClosureFlow::forEachChild(uint32_t v, Visit&& visit) const {
  for (const uint32_t child : children_[v]) {
    if (child == kNone) return;
    if (part_[child] == part_[v]) visit(child, parents_[child][0] == v ? size_t{0} : size_t{1});
  }
}

void ClosureFlow::setExcess(std::span<const uint32_t> part, std::span<const int64_t> weights) {
  for (size_t i = 0; i < part.size(); ++i) excess_[part[i]] = weights[i];
  for (const uint32_t v : part)
    forEachParent(v, [&](uint32_t parent, size_t slot) {
      excess_[v] -= loans_[v][slot];
      excess_[parent] += loans_[v][slot];
    });
}

/// Exact distances to the deficits along residual arcs.
void ClosureFlow::label(std::span<const uint32_t> part) {
  queue_.clear();
  for (const uint32_t v : part) {
    label_[v] = excess_[v] < 0 ? 0 : kUnreached;
    if (excess_[v] < 0) queue_.push_back(v);
  }
  const auto reach = [&](uint32_t v, uint32_t distance) {
    if (label_[v] != kUnreached) return;
    label_[v] = distance;
    queue_.push_back(v);
  };
  for (size_t i = 0; i < queue_.size(); ++i) {
    const uint32_t v = queue_[i];
    const uint32_t distance = label_[v] + 1;
    forEachChild(v, [&](uint32_t child, size_t) { reach(child, distance); });
    forEachParent(v, [&](uint32_t parent, size_t slot) {
      if (loans_[v][slot] > 0) reach(parent, distance);
    });
  }
  relabels_ = 0;
}

void ClosureFlow::solve(std::span<const uint32_t> part, std::span<const int64_t> weights) {
  setExcess(part, weights);
  label(part);
  active_.clear();
  for (const uint32_t v : part)
    if (excess_[v] > 0 && label_[v] != kUnreached) active_.push_back(v);
  if (active_.empty()) return;
  while (!active_.empty()) {
    round_.swap(active_);
    active_.clear();
    for (const uint32_t v : round_) discharge(v);
    if (relabels_ > part.size()) label(part);
  }
  label(part);
}

/// Gives away all of e(v), or finds that no deficit can be reached.
void ClosureFlow::discharge(uint32_t v) {
  while (excess_[v] > 0 && label_[v] != kUnreached) {
    const uint32_t target = label_[v] - 1;
    if (label_[v] > 0) {
      forEachParent(v, [&](uint32_t parent, size_t slot) {
        if (label_[parent] != target || excess_[v] == 0) return;
        loans_[v][slot] += excess_[v];
        pushTo(parent, excess_[v]);
        excess_[v] = 0;
      });
      forEachChild(v, [&](uint32_t child, size_t slot) {
        int64_t& loan = loans_[child][slot];
        const int64_t amount = std::min(loan, excess_[v]);
        if (label_[child] != target || amount == 0) return;
        loan -= amount;
        excess_[v] -= amount;
        pushTo(child, amount);
      });
      if (excess_[v] == 0) return;
    }
    label_[v] = labelAboveNeighbours(v);
    ++relabels_;
  }
}

void ClosureFlow::pushTo(uint32_t to, int64_t amount) {
  if (excess_[to] <= 0 && excess_[to] + amount > 0) active_.push_back(to);
  excess_[to] += amount;
}

uint32_t ClosureFlow::labelAboveNeighbours(uint32_t v) const {
  uint32_t least = kUnreached;
  forEachParent(v, [&](uint32_t parent, size_t) { least = std::min(least, label_[parent]); });
  forEachChild(v, [&](uint32_t child, size_t slot) {
    if (loans_[child][slot] > 0) least = std::min(least, label_[child]);
  });
  return least == kUnreached ? kUnreached : least + 1;
}

std::vector<size_t> ClosureFlow::split(std::span<uint32_t> part) {
  std::vector<size_t> ends;
  queue_.clear();
  const uint32_t first = part_count_;
  for (const uint32_t seed : part) {
    if (part_[seed] >= first) continue;
    const auto join = [&](uint32_t v) {
      part_[v] = part_count_;
      queue_.push_back(v);
    };
    const uint32_t old = part_[seed];
    const auto visit = [&](uint32_t v, uint32_t from) {
      if (v != kNone && part_[v] == old && inClosure(v) == inClosure(from)) join(v);
    };
    size_t next = queue_.size();
    join(seed);
    for (; next < queue_.size(); ++next) {
      const uint32_t v = queue_[next];
      for (const uint32_t parent : parents_[v]) visit(parent, v);
      for (const uint32_t child : children_[v]) visit(child, v);
    }
    ++part_count_;
    ends.push_back(queue_.size());
  }
  std::copy(queue_.begin(), queue_.end(), part.begin());
  return ends;
}

}  // namespace tetrakis::inline closure
