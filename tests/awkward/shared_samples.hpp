// SPDX-License-Identifier: Apache-2.0
// SharedSamples says which samples of a forest's raster are one, from what tetrakis.h says of sides
// alone, so that it shares no fault with the library.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace tetrakis::test {

class SharedSamples {
 public:
  /// sides: as those of tks_forest.
  SharedSamples(uint32_t depth, std::span<const uint32_t> sides);

  /// The first of the samples that are one with this one.
  uint32_t firstOf(size_t sample) const { return firsts_[sample]; }

  /// Whether a side that is not glued holds one of the samples that are one with this one.
  bool onBorder(size_t sample) const { return on_border_[firsts_[sample]]; }

  /// Gives all samples that are one the value of the first, of so many bytes each.
  void share(std::span<std::byte> raster, size_t bytes) const;

  /// A sample that differs from the first that it is one with.
  std::optional<size_t> torn(std::span<const std::byte> raster, size_t bytes) const;

 private:
  /// Sample k of a side, as the rows and columns of the raster run.
  uint32_t at(uint32_t side, uint32_t k) const;
  uint32_t rootOf(uint32_t sample) const;
  void join(uint32_t a, uint32_t b);

  uint32_t n_;  ///< samples along a side, less one
  std::vector<uint32_t> firsts_;
  std::vector<bool> on_border_;
};

}  // namespace tetrakis::test
