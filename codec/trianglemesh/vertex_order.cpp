// SPDX-License-Identifier: Apache-2.0
#include "codec/trianglemesh/vertex_order.hpp"

#include <algorithm>
#include <array>
#include <optional>

namespace tetrakis::inline trianglemesh {
namespace {

class Ordering {
 public:
  Ordering(const std::vector<uint32_t>& sides, const CornerFans& fans)
      : sides_(sides), fans_(fans), unknown_(sides.size(), 3), vertices_(fans.first.size()) {}

  std::vector<uint32_t> run() {
    std::vector<uint32_t> order;
    order.reserve(vertices_.size());
    for (uint32_t first = 0; first < vertices_.size(); ++first) {
      waiting_[0].push_back(first);
      while (const auto next = take()) {
        order.push_back(*next);
        tell(*next);
      }
    }
    return order;
  }

 private:
  static constexpr uint32_t kMostForetellers = 4;  ///< more are not told apart

  struct Vertex {
    uint32_t foretellers = 0;  ///< triangles behind its opposite sides with known corners
    bool is_told = false;
  };

  /// Of the untold vertices with the highest rank, the one that came last.
  std::optional<uint32_t> take() {
    for (size_t rank = waiting_.size(); rank-- > 0;) {
      std::vector<uint32_t>& ones = waiting_[rank];
      while (!ones.empty()) {
        const uint32_t v = ones.back();
        ones.pop_back();
        if (!vertices_[v].is_told) return v;
      }
    }
    return {};
  }

  void tell(uint32_t v) {
    vertices_[v].is_told = true;
    visitFan(sides_, fans_.first[v], [&](uint32_t corner) {
      for (const uint32_t other : {after(corner), before(corner)}) {
        wait(fans_.of_corner[other]);
        know(other);
      }
      const uint32_t behind = sides_[after(corner)];
      if (behind != kBorder) know(before(behind));
    });
  }

  /// One more of the three corners is known from which a triangle foretells that of `corner`.
  void know(uint32_t corner) {
    if (sides_[after(corner)] == kBorder || --unknown_[corner] > 0) return;
    ++vertices_[fans_.of_corner[corner]].foretellers;
    wait(fans_.of_corner[corner]);
  }

  /// A neighbour of a known vertex that no triangle foretells still ranks above all others.
  void wait(uint32_t v) {
    if (!vertices_[v].is_told)
      waiting_[1 + std::min(vertices_[v].foretellers, kMostForetellers)].push_back(v);
  }

  const std::vector<uint32_t>& sides_;
  const CornerFans& fans_;
  std::vector<uint8_t> unknown_;  ///< of each corner
  std::vector<Vertex> vertices_;
  std::array<std::vector<uint32_t>, kMostForetellers + 2> waiting_;  ///< by rank; some told since
};

}  // namespace

std::vector<uint32_t> vertexOrder(const std::vector<uint32_t>& sides, const CornerFans& fans) {
  return Ordering(sides, fans).run();
}

}  // namespace tetrakis::inline trianglemesh
