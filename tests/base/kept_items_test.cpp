// SPDX-License-Identifier: Apache-2.0
// KeptItems keeps what calls have made, as far as its bytes go.
#include "base/kept_items.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace tetrakis::test {
namespace {

struct Item {
  size_t number;
  uint64_t size;
  uint64_t bytes() const { return size; }
};

TEST(KeptItems, NeverTakeMoreThanTheyMayAndAreTheirOwn) {
  std::mt19937 random(4);
  for (const uint64_t most : {uint64_t{0}, uint64_t{50}, uint64_t{400}, UINT64_MAX}) {
    KeptItems<Item> items(most);
    uint64_t known = 0;
    for (int i = 0; i < 300; ++i) {
      KeptItems<Item>::Call call(&items, 40);
      std::set<size_t> numbers;
      for (int k = 0; k < 6; ++k) numbers.insert(random() % 40);
      for (const size_t number : numbers) {
        std::optional<Item>& item = call.at(number);
        known += item.has_value();
        if (!item) item = Item{number, 0};
        ASSERT_EQ(item->number, number);
        item->size += 1 + random() % 20;
        call.keepIfFits(number);
        ASSERT_LE(items.bytes(), most);
      }
    }
    EXPECT_EQ(known > 0, most > 0) << most;
  }
}

/// Who comes back soon is known.
TEST(KeptItems, ForgetTheOldestFirst) {
  KeptItems<Item> items(100);
  for (size_t i = 0; i < 40; ++i) {
    KeptItems<Item>::Call call(&items, 40);
    for (size_t number = i < 4 ? 0 : i - 4; number <= i; ++number) {
      std::optional<Item>& item = call.at(number);
      EXPECT_EQ(item.has_value(), number < i) << number;
      if (!item) item = Item{number, 10};
      call.keepIfFits(number);
    }
  }
}

}  // namespace
}  // namespace tetrakis::test
