// SPDX-License-Identifier: Apache-2.0
// StepHeap holds some of the numbers below a bound, each with a cost, and finds the cheapest one: a
// binary heap that knows where each number is. Of those that cost the same it is the lowest.
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace tetrakis::inline trianglemesh {

class StepHeap {
 public:
  static constexpr uint32_t kNone = UINT32_MAX;

  explicit StepHeap(size_t bound) : places_(bound, kNone), costs_(bound) {}

  bool empty() const { return heap_.empty(); }
  bool holds(uint32_t number) const { return places_[number] != kNone; }
  uint64_t costOf(uint32_t number) const { return costs_[number]; }
  uint32_t cheapest() const { return heap_.front(); }

  /// Adds the number, or changes its cost.
  void set(uint32_t number, uint64_t cost) {
    if (!holds(number)) {
      places_[number] = static_cast<uint32_t>(heap_.size());
      heap_.push_back(number);
    }
    costs_[number] = cost;
    sink(rise(places_[number]));
  }

  void erase(uint32_t number) {
    const uint32_t place = places_[number];
    if (place == kNone) return;
    places_[number] = kNone;
    const uint32_t last = heap_.back();
    heap_.pop_back();
    if (last == number) return;
    put(last, place);
    sink(rise(place));
  }

 private:
  bool isBefore(uint32_t a, uint32_t b) const {
    return std::pair(costs_[a], a) < std::pair(costs_[b], b);
  }
  void put(uint32_t number, size_t place) {
    heap_[place] = number;
    places_[number] = static_cast<uint32_t>(place);
  }
  size_t rise(size_t place) {
    const uint32_t number = heap_[place];
    for (; place > 0 && isBefore(number, heap_[(place - 1) / 2]); place = (place - 1) / 2)
      put(heap_[(place - 1) / 2], place);
    put(number, place);
    return place;
  }
  void sink(size_t place) {
    const uint32_t number = heap_[place];
    while (2 * place + 1 < heap_.size()) {
      size_t child = 2 * place + 1;
      if (child + 1 < heap_.size() && isBefore(heap_[child + 1], heap_[child])) ++child;
      if (!isBefore(heap_[child], number)) break;
      put(heap_[child], place);
      place = child;
    }
    put(number, place);
  }

  std::vector<uint32_t> heap_, places_;
  std::vector<uint64_t> costs_;
};

}  // namespace tetrakis::inline trianglemesh
