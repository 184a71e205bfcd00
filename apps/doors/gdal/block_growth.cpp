// SPDX-License-Identifier: Apache-2.0
#include "apps/doors/gdal/block_growth.hpp"

#include <algorithm>

namespace tetrakis::gdal {
namespace {

/// Two may be a window that has moved.
constexpr uint32_t kLeastInRow = 3;

struct Span {
  uint32_t begin, end;
};

/// The blocks, and those on either side that take no region more.
Span withFree(Span asked, const BlockAxis& axis) {
  const uint32_t first = asked.begin * axis.block;
  const uint32_t end = std::min(asked.end * axis.block, axis.samples);
  // The last region may be half as long again (docs/FORMAT.md, section 5.1).
  const uint32_t regions = std::max((axis.samples + axis.region / 2) / axis.region, 1U);
  const uint32_t left =
      std::min(first > axis.reach ? (first - axis.reach) / axis.region : 0, regions - 1);
  const uint32_t right = (std::min(end + axis.reach, axis.samples) - 1) / axis.region;
  uint32_t free_begin = 0, free_end = axis.samples;
  if (left > 0) free_begin = left * axis.region + axis.reach;
  if (right + 1 < regions) free_end = (right + 1) * axis.region - axis.reach;
  const uint32_t whole = free_end == axis.samples ? axis.blocks() : free_end / axis.block;
  return {std::min((free_begin + axis.block - 1) / axis.block, asked.begin),
          std::max(whole, asked.end)};
}

tks_window withFree(const tks_window& asked, const BlockGrid& grid) {
  const Span x = withFree({asked.x, asked.x + asked.width}, grid.across);
  const Span y = withFree({asked.y, asked.y + asked.height}, grid.down);
  return {x.begin, y.begin, x.end - x.begin, y.end - y.begin};
}

uint64_t count(const tks_window& blocks) {
  return uint64_t{blocks.width} * blocks.height;
}

}  // namespace

bool BlockGrowth::goesDown(const tks_window& asked, const BlockGrid& grid) const {
  const bool rows = in_row_ >= kLeastInRow || read_.width == grid.across.blocks();
  return rows && asked.x == begin_ && asked.y == read_.y + read_.height;
}

bool BlockGrowth::goesRight(const tks_window& asked) const {
  return asked.x == read_.x + read_.width && asked.y >= read_.y && asked.y < read_.y + read_.height;
}

tks_window BlockGrowth::grown(const tks_window& asked, const BlockGrid& grid) {
  tks_window wanted = asked;
  const bool down = goesDown(asked, grid), right = goesRight(asked);
  if (down) {
    const uint32_t rows = std::min(read_.height, grid.down.blocks() - asked.y);
    wanted = {read_.x, asked.y, std::max(read_.width, asked.x + asked.width - read_.x),
              std::max(asked.height, rows)};
  }
  const auto withMore = [&] { return down || right ? withFree(wanted, grid) : wanted; };
  tks_window all = withMore();
  while (count(all) > grid.most && wanted.height > asked.height) {
    wanted.height = std::max(wanted.height / 2, asked.height);
    all = withMore();
  }
  if (count(all) > grid.most) all = asked;
  if (down) {
    read_.height = all.y + all.height - read_.y;
  } else if (right) {
    // What is beside the first block of a row is decoded as far down, and shows what lies below it.
    if (in_row_ == 1 && all.x <= read_.x) read_.height = all.y + all.height - read_.y;
    read_.width = all.x + all.width - read_.x;
    ++in_row_;
  } else {
    read_ = all;
    begin_ = asked.x;
    in_row_ = 1;
  }
  return all;
}

}  // namespace tetrakis::gdal
