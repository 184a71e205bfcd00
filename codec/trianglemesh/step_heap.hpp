// SPDX-License-Identifier: Apache-2.0
// StepHeap holds some of the numbers below a bound, each with a cost, and finds the cheapest one: a
// binary heap that knows where each number is. Of those that cost the same it is the lowest.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tetrakis::inline trianglemesh {

class StepHeap {
 public:
  explicit StepHeap(size_t bound) : places_(bound, kNowhere) {}

  bool holds(uint32_t number) const { return places_[number] != kNowhere; }
  uint64_t costOf(uint32_t number) const { return heap_[places_[number]].cost; }
  uint32_t cheapest() const { return heap_.front().number; }

  /// Adds the number, or changes its cost.
  void set(uint32_t number, uint64_t cost) {
    if (!holds(number)) {
      places_[number] = static_cast<uint32_t>(heap_.size());
      heap_.emplace_back();
    }
    settle({cost, number}, places_[number]);
  }

  void erase(uint32_t number) {
    if (!holds(number)) return;
    const uint32_t place = places_[number];
    places_[number] = kNowhere;
    const Entry last = heap_.back();
    heap_.pop_back();
    if (last.number != number) settle(last, place);
  }

 private:
  static constexpr uint32_t kNowhere = UINT32_MAX;

  struct Entry {
    uint64_t cost = 0;
    uint32_t number = 0;
    bool operator<(const Entry& other) const {
      return cost != other.cost ? cost < other.cost : number < other.number;
    }
  };

  void put(const Entry& entry, size_t place) {
    heap_[place] = entry;
    places_[entry.number] = static_cast<uint32_t>(place);
  }

  /// Puts the entry at the place, or above or below it where it belongs.
  void settle(const Entry& entry, size_t place) {
    for (; place > 0 && entry < heap_[(place - 1) / 2]; place = (place - 1) / 2)
      put(heap_[(place - 1) / 2], place);
    while (2 * place + 1 < heap_.size()) {
      size_t child = 2 * place + 1;
      if (child + 1 < heap_.size() && heap_[child + 1] < heap_[child]) ++child;
      if (!(heap_[child] < entry)) break;
      put(heap_[child], place);
      place = child;
    }
    put(entry, place);
  }

  std::vector<Entry> heap_;
  std::vector<uint32_t> places_;  ///< of each number in it
};

}  // namespace tetrakis::inline trianglemesh
