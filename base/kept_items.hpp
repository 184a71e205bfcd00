// SPDX-License-Identifier: Apache-2.0
// KeptItems keeps numbered things that took time to make for the calls that follow, within a number
// of bytes: those go first that no call has used for longest.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace tetrakis::inline base {

/// T says by bytes() what it takes.
template <class T>
class KeptItems {
 public:
  KeptItems(uint64_t most = UINT64_MAX) : most_bytes(most) {}

  /// All items together never take more, but for those that are in the making.
  uint64_t most_bytes;

  uint64_t bytes() const { return std::accumulate(bytes_.begin(), bytes_.end(), uint64_t{0}); }

  /// A call that uses items, which threads share. Of each item only one thread speaks.
  class Call {
   public:
    /// items: null: nothing is kept. count: how many there may be, the same in every call.
    Call(KeptItems* items, size_t count) : items_(items), bytes_(0) {
      if (items_ == nullptr) return;
      items_->begin(count);
      bytes_ = items_->bytes();
    }

    /// An item that is known, or has to be made.
    std::optional<T>& at(size_t number) {
      items_->used_[number] = items_->calls_;
      std::unique_ptr<std::optional<T>>& item = items_->items_[number].item;
      if (item == nullptr) item = std::make_unique<std::optional<T>>();
      return *item;
    }
    /// An item that was made, or has grown, stays unless there is no room.
    void keepIfFits(size_t number) {
      const uint64_t now = (*items_->items_[number].item)->bytes();
      const uint64_t more = now - std::exchange(items_->bytes_[number], now);
      if (bytes_.fetch_add(more) + more <= items_->most_bytes) return;
      bytes_ -= std::exchange(items_->bytes_[number], 0);
      items_->items_[number].item.reset();
    }

   private:
    KeptItems* items_;
    std::atomic<uint64_t> bytes_;
  };

 private:
  void begin(size_t count) {
    items_.resize(count);
    bytes_.resize(count);
    used_.resize(count);
    ++calls_;
    forgetOldest(most_bytes - most_bytes / 4);
  }

  void forgetOldest(uint64_t most) {
    uint64_t left = bytes();
    if (left <= most) return;
    std::vector<size_t> order(items_.size());
    std::iota(order.begin(), order.end(), size_t{0});
    std::sort(order.begin(), order.end(), [&](size_t a, size_t b) { return used_[a] < used_[b]; });
    for (size_t i = 0; left > most; ++i) {
      left -= std::exchange(bytes_[order[i]], 0);
      items_[order[i]].item.reset();
    }
  }

  /// There may be many numbers, few of which have an item: null for the others.
  struct Slot {
    std::unique_ptr<std::optional<T>> item;

    Slot() = default;
    Slot(const Slot& other)
        : item(other.item ? std::make_unique<std::optional<T>>(*other.item) : nullptr) {}
    Slot(Slot&&) noexcept = default;
    Slot& operator=(Slot other) noexcept {
      item = std::move(other.item);
      return *this;
    }
    ~Slot() = default;
  };

  std::vector<Slot> items_;
  std::vector<uint64_t> bytes_;  ///< of each
  std::vector<uint64_t> used_;   ///< the last call that used it
  uint64_t calls_ = 0;
};

}  // namespace tetrakis::inline base
