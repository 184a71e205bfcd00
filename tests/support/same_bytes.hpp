// SPDX-License-Identifier: Apache-2.0
// Samples as std::byte, which GoogleTest can only dump: a comparison that says where they differ.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <span>

namespace tetrakis::test {

/// Succeeds if both hold the same bytes; otherwise names the first that differs.
inline testing::AssertionResult sameBytes(std::span<const std::byte> actual,
                                          std::span<const std::byte> expected) {
  if (actual.size() != expected.size())
    return testing::AssertionFailure() << actual.size() << " bytes instead of " << expected.size();
  const auto [at, other] = std::mismatch(actual.begin(), actual.end(), expected.begin());
  if (at == actual.end()) return testing::AssertionSuccess();
  return testing::AssertionFailure()
         << "byte " << at - actual.begin() << " of " << actual.size() << " is "
         << std::to_integer<int>(*at) << " instead of " << std::to_integer<int>(*other);
}

}  // namespace tetrakis::test
