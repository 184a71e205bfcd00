// SPDX-License-Identifier: Apache-2.0
// LinkedKnots tells the neighbours of each knot of a curve among the knots that are not yet
// removed.
#pragma once

#include <cstdint>
#include <vector>

namespace tetrakis::inline polyline {

class LinkedKnots {
 public:
  explicit LinkedKnots(uint32_t count) : links_(count) {
    for (uint32_t k = 0; k < count; ++k) links_[k] = {k - 1, k + 1};
  }

  /// The neighbours that are left of a knot that is left and has such a neighbour.
  uint32_t before(uint32_t knot) const { return links_[knot].before; }
  uint32_t after(uint32_t knot) const { return links_[knot].after; }

  /// knot: not an end.
  void remove(uint32_t knot) {
    const Link link = links_[knot];
    links_[link.before].after = link.after;
    links_[link.after].before = link.before;
  }

 private:
  struct Link {
    uint32_t before = 0, after = 0;
  };
  std::vector<Link> links_;
};

}  // namespace tetrakis::inline polyline
