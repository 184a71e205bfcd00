// SPDX-License-Identifier: Apache-2.0
// A reader of quantized-mesh-1.0, written from its specification.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <vector>

namespace tetrakis::test {

struct TerrainTile {
  std::array<double, 3> centre{}, sphere{}, horizon{};
  float lowest = 0, highest = 0;
  double radius = 0;
  std::vector<uint32_t> u, v, height;  ///< 0 to 32767
  std::vector<uint32_t> triangles;
  std::array<std::vector<uint16_t>, 4> edges;  ///< west, south, east, north
  std::map<int, std::string> extensions;       ///< by id
  double metres(size_t i) const {
    return lowest + height[i] / 32767.0 * (double{highest} - lowest);
  }
};

class TerrainTileReader {
 public:
  explicit TerrainTileReader(std::string bytes) : bytes_(std::move(bytes)) {}

  TerrainTile read() {
    TerrainTile tile;
    for (double& number : tile.centre) number = get<double>();
    tile.lowest = get<float>();
    tile.highest = get<float>();
    for (double& number : tile.sphere) number = get<double>();
    tile.radius = get<double>();
    for (double& number : tile.horizon) number = get<double>();
    const auto vertices = get<uint32_t>();
    EXPECT_LE(vertices, 65536U);
    for (auto* axis : {&tile.u, &tile.v, &tile.height}) {
      int32_t last = 0;
      for (uint32_t i = 0; i < vertices && !broken_; ++i) {
        const auto coded = get<uint16_t>();
        last += (coded >> 1) ^ -(coded & 1);
        axis->push_back(static_cast<uint32_t>(last));
      }
    }
    const auto triangles = get<uint32_t>();
    uint32_t next = 0;
    for (uint64_t i = 0; i < 3 * uint64_t{triangles} && !broken_; ++i) {
      const auto back = get<uint16_t>();
      tile.triangles.push_back(next - back);
      if (back == 0) ++next;
    }
    EXPECT_EQ(next, vertices);
    for (auto& edge : tile.edges) {
      const auto count = get<uint32_t>();
      for (uint32_t i = 0; i < count && !broken_; ++i) edge.push_back(get<uint16_t>());
    }
    while (at_ < bytes_.size() && !broken_) {
      const auto id = get<uint8_t>();
      const auto length = get<uint32_t>();
      tile.extensions[id] = bytes_.substr(at_, length);
      EXPECT_EQ(tile.extensions[id].size(), length);
      at_ += length;
    }
    EXPECT_FALSE(broken_);
    return tile;
  }

 private:
  template <class T>
  T get() {
    T value{};
    broken_ = broken_ || at_ + sizeof(T) > bytes_.size();
    if (!broken_) std::memcpy(&value, bytes_.data() + at_, sizeof(T));
    at_ += sizeof(T);
    return value;
  }

  std::string bytes_;
  size_t at_ = 0;
  bool broken_ = false;
};

}  // namespace tetrakis::test
