// SPDX-License-Identifier: Apache-2.0
// Reference decoder: places on a grid (docs/FORMAT.md, section 11, "tell").
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "conformance/reference_decoder/mixed.hpp"
#include "conformance/reference_decoder/range_decoder.hpp"

namespace tetrakis::reference {

/// A place of two or three coordinates, and the k of each.
struct TellPlace {
  std::array<int64_t, 3> at = {};
  std::array<int, 3> k = {};
};

/// Mean of so many, halves rounded up.
int64_t meanOf(int64_t sum, int64_t count);

class PlaceDecoder {
 public:
  PlaceDecoder(RangeDecoder& decoder, int axes, int bits);

  int64_t most() const { return (int64_t{1} << bits_) - 1; }
  /// The mean, its coordinates clamped.
  std::array<int64_t, 3> mean(const std::vector<std::array<int64_t, 3>>& all) const;

  TellPlace tell(const std::array<int64_t, 3>& expected, const std::vector<TellPlace>& nearby,
                 int f);

  /// Since a decision did not count, all have been 0.
  bool ended() const { return ended_; }

 private:
  int64_t difference(const std::array<int, 4>& states, int& k);
  template <class Decide>
  int ask(const Decide& decide);

  RangeDecoder& decoder_;
  int axes_, bits_;
  bool ended_ = false;
  std::vector<std::vector<ModelTable>> more_;  ///< along, here, all, last
  std::vector<std::array<int64_t, 4>> weights_;
  Model high_[25][4];
};

}  // namespace tetrakis::reference
