// SPDX-License-Identifier: Apache-2.0
#include "encoder/inputs/encode_inputs.hpp"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <numeric>
#include <utility>
#include <vector>

#include "codec/ground/camera.hpp"
#include "codec/lines/shown_lines.hpp"

namespace tetrakis::inline inputs {

tks_heights CodedLines::of(const tks_heights& whole) const {
  tks_heights coded = whole;
  coded.width = extent.width;
  coded.height = extent.height;
  coded.data = samples.data();
  const GroundFrame frame =
      knownFrame({whole.width, whole.height, whole.spacing_x, whole.spacing_y, 1});
  coded.spacing_x = frame.spacing_x * whole.width / extent.width;
  coded.spacing_y = frame.spacing_y * whole.height / extent.height;
  return coded;
}

tks_image CodedLines::of(const tks_image& whole) const {
  tks_image coded = whole;
  coded.width = extent.width;
  coded.height = extent.height;
  coded.data = samples.data();
  return coded;
}

namespace {

/// Of so many runs as this one may be longer than the others, and is broken. A larger number
/// lets longer runs be, so that fewer lines are coded, and samples count less alike.
constexpr size_t kLongRunIn = 20;
/// The longest run, in mean runs, with which lines still count as repeated. A larger number saves
/// the lines of more files, and lets samples count that much less alike.
constexpr size_t kMostUneven = 2;
/// The share of the samples that may be left where repeated lines are dropped. With a larger share
/// the map of lines takes more bytes than it saves.
constexpr double kMostLeft = 0.9;
/// A map of lines may take this part of a budget. A smaller number lets maps take more of small
/// budgets; a larger one codes lines that repeat others.
constexpr uint64_t kMapPart = 8;

/// The samples as bytes.
class SampleBytes {
 public:
  explicit SampleBytes(const SampleGrid& grid)
      : data_(static_cast<const std::byte*>(grid.data)),
        width_(grid.extent.width),
        height_(grid.extent.height),
        size_(grid.sample_bytes) {}

  /// 1 for each row that equals the one before.
  std::vector<uint8_t> repeatedRows() const {
    std::vector<uint8_t> repeated(height_);
    for (uint32_t y = 1; y < height_; ++y)
      repeated[y] = std::memcmp(at(0, y), at(0, y - 1), width_ * size_) == 0;
    return repeated;
  }
  /// 1 for columns that repeat the one before. Columns that differ somewhere are not looked at
  /// again.
  std::vector<uint8_t> repeatedColumns() const {
    std::vector<uint32_t> alike(width_ - 1);
    std::iota(alike.begin(), alike.end(), 1u);
    for (uint32_t y = 0; y < height_ && !alike.empty(); ++y) {
      std::erase_if(alike,
                    [&](uint32_t x) { return std::memcmp(at(x, y), at(x - 1, y), size_) != 0; });
    }
    std::vector<uint8_t> repeated(width_);
    for (const uint32_t x : alike) repeated[x] = 1;
    return repeated;
  }
  /// The samples of the lines that repeat no other.
  std::vector<std::byte> without(const std::vector<uint8_t>& columns,
                                 const std::vector<uint8_t>& rows) const {
    std::vector<std::byte> samples;
    for (uint32_t y = 0; y < height_; ++y) {
      if (rows[y]) continue;
      for (uint32_t x = 0; x < width_; ++x) {
        if (!columns[x]) samples.insert(samples.end(), at(x, y), at(x, y) + size_);
      }
    }
    return samples;
  }

 private:
  const std::byte* at(uint32_t x, uint32_t y) const {
    return data_ + (size_t{y} * width_ + x) * size_;
  }

  const std::byte* data_;
  uint32_t width_, height_;
  size_t size_;
};

/// The lengths of a line and its repeats.
std::vector<uint32_t> runsOf(const std::vector<uint8_t>& repeated) {
  std::vector<uint32_t> runs;
  for (const uint8_t repeat : repeated) {
    if (!repeat) runs.push_back(0);
    ++runs.back();
  }
  return runs;
}

uint32_t codedOf(const std::vector<uint8_t>& repeated) {
  return static_cast<uint32_t>(std::count(repeated.begin(), repeated.end(), 0));
}

struct EvenLines {
  std::vector<uint8_t> repeated;
  uint32_t longest;  ///< of their runs
};

/// Breaks runs that are longer than nearly all runs are, and runs that would leave fewer than
/// `least` lines: lines in them are coded though they repeat others. Where the longest run that is
/// left is still much longer than the mean, no line counts as repeated.
EvenLines evened(std::vector<uint8_t> repeated, uint32_t least) {
  std::vector<uint32_t> runs = runsOf(repeated);
  const auto usual =
      runs.begin() + static_cast<ptrdiff_t>((runs.size() - 1) * (kLongRunIn - 1) / kLongRunIn);
  std::nth_element(runs.begin(), usual, runs.end());
  const uint32_t most =
      std::min(*usual, static_cast<uint32_t>((repeated.size() + least - 1) / least));
  uint32_t run = 0;
  for (uint8_t& repeat : repeated) {
    if (run == most) repeat = 0;
    run = repeat ? run + 1 : 1;
  }
  const bool uneven = size_t{most} * codedOf(repeated) > kMostUneven * repeated.size();
  if (uneven) return {std::vector<uint8_t>(repeated.size()), 1};
  return {std::move(repeated), most};
}

/// The lines to code; none where all are. Lines count as repeated where runs of them are about as
/// long everywhere, so that all coded samples count alike: a sea in the first hundred rows is no
/// reason to code only one of these rows. least: how many columns, and how many rows, are coded at
/// least where there are as many.
CodedLines findRepeatedLines(const SampleGrid& grid, uint32_t least) {
  assert(grid.extent.samples() > 0 && least > 0);
  const SampleBytes samples(grid);
  auto [columns, most_columns] = evened(samples.repeatedColumns(), least);
  auto [rows, most_rows] = evened(samples.repeatedRows(), least);
  CodedLines lines;
  lines.extent = {codedOf(columns), codedOf(rows)};
  const uint64_t samples_of_all = grid.extent.samples();
  // A map of lines takes more bytes than one value does, but fewer than one value in regions.
  const bool one_value = lines.extent.width <= least && lines.extent.height <= least;  // likely
  if (one_value && samples_of_all <= kOneRegionHeights) return {};
  const auto all = static_cast<double>(samples_of_all);
  const double left = static_cast<double>(lines.extent.samples()) / all;
  if (left > kMostLeft) return {};
  lines.heaviest = static_cast<double>(uint64_t{most_columns} * most_rows) * left;
  lines.samples = samples.without(columns, rows);
  const std::vector<uint32_t> across = runsOf(columns), down = runsOf(rows);
  for (const uint32_t rows_of_one : down) {
    for (const uint32_t columns_of_one : across)
      lines.shown_by.push_back(rows_of_one * columns_of_one);
  }
  lines.repeats = encodeRepeats(std::move(columns), std::move(rows));
  return lines;
}

}  // namespace

CodedLines linesThatPay(const tks_encode_options& options, const SampleGrid& grid, uint32_t least) {
  if (options.picture_error != nullptr) return {};
  CodedLines lines = findRepeatedLines(grid, least);
  const bool long_map = options.bytes != 0 && lines.repeats.code.size() > options.bytes / kMapPart;
  return long_map ? CodedLines() : lines;
}

}  // namespace tetrakis::inline inputs
