// SPDX-License-Identifier: Apache-2.0
// Mipmaps by exact area, in integers.
#include "apps/tools/render/texture_pyramid.hpp"

#include <algorithm>
#include <cstring>

#include "base/samples.hpp"

namespace tetrakis::tools {
namespace {

uint8_t sampleAt(const ImageFile& image, size_t index, uint32_t white) {
  if (image.sample == TKS_U8) return static_cast<uint8_t>(image.data[index]);
  uint16_t value;
  std::memcpy(&value, image.data.data() + 2 * index, sizeof value);
  return shownIn8Bits(value, white);
}

TextureLevel premultiplied(const ImageFile& image) {
  const bool has_alpha = image.hasAlpha();
  const bool is_grey = image.channels < 3;
  const uint32_t white = image.white(), most = largestTexel(image.sample);
  const size_t texels = size_t{image.width} * image.height;
  TextureLevel level{image.width, image.height, std::vector<uint8_t>(4 * texels)};
  for (size_t i = 0; i < texels; ++i) {
    const size_t first = i * image.channels;
    const uint32_t alpha = has_alpha ? sampleAt(image, first + image.channels - 1, most) : 255;
    for (size_t c = 0; c < 3; ++c) {
      const uint32_t colour = sampleAt(image, first + (is_grey ? 0 : c), white);
      level.rgba[4 * i + c] = static_cast<uint8_t>((colour * alpha + 127) / 255);
    }
    level.rgba[4 * i + 3] = static_cast<uint8_t>(alpha);
  }
  return level;
}

/// Halving n samples to m = max(1, floor(n / 2)): in units of 1/m of a fine sample, coarse sample i
/// covers [i n, (i + 1) n) and fine sample j covers [j m, (j + 1) m). At most three overlap, with
/// weights that sum to n.
struct Taps {
  uint32_t first = 0, count = 0;
  uint32_t weight[3] = {};
};

std::vector<Taps> areaTaps(uint32_t n, uint32_t m) {
  std::vector<Taps> taps(m);
  for (uint32_t i = 0; i < m; ++i) {
    const uint64_t begin = uint64_t{i} * n, end = begin + n;
    taps[i].first = static_cast<uint32_t>(begin / m);
    for (uint64_t j = taps[i].first; j * m < end; ++j) {
      const uint64_t from = std::max(begin, j * m), to = std::min(end, (j + 1) * m);
      taps[i].weight[taps[i].count++] = static_cast<uint32_t>(to - from);
    }
  }
  return taps;
}

TextureLevel halved(const TextureLevel& fine) {
  TextureLevel coarse{std::max(1u, fine.width / 2), std::max(1u, fine.height / 2), {}};
  coarse.rgba.resize(size_t{4} * coarse.width * coarse.height);
  const std::vector<Taps> columns = areaTaps(fine.width, coarse.width);
  const std::vector<Taps> rows = areaTaps(fine.height, coarse.height);
  const uint64_t area = uint64_t{fine.width} * fine.height;
  size_t out = 0;
  for (const Taps& row : rows) {
    for (const Taps& column : columns) {
      uint64_t sum[4] = {};
      for (uint32_t r = 0; r < row.count; ++r) {
        const size_t line = size_t{row.first + r} * fine.width + column.first;
        for (uint32_t c = 0; c < column.count; ++c) {
          const uint64_t weight = uint64_t{row.weight[r]} * column.weight[c];
          for (size_t k = 0; k < 4; ++k) sum[k] += weight * fine.rgba[4 * (line + c) + k];
        }
      }
      for (const uint64_t value : sum)
        coarse.rgba[out++] = static_cast<uint8_t>((value + area / 2) / area);
    }
  }
  return coarse;
}

}  // namespace

std::vector<TextureLevel> texturePyramid(const ImageFile& image, uint32_t max_side) {
  TextureLevel level = premultiplied(image);
  while (std::max(level.width, level.height) > max_side) level = halved(level);
  std::vector<TextureLevel> levels;
  while (level.width > 1 || level.height > 1) {
    TextureLevel next = halved(level);
    levels.push_back(std::move(level));
    level = std::move(next);
  }
  levels.push_back(std::move(level));
  return levels;
}

}  // namespace tetrakis::tools
