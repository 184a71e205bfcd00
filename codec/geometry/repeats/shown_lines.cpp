// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/repeats/shown_lines.hpp"

#include <algorithm>
#include <cassert>
#include <span>

#include "wavelet/pyramid.hpp"

namespace tetrakis::inline repeats {

namespace {

/// The mip level of the coded lines whose samples lie as far apart as those of a level of the shown
/// ones, or less.
int codedLevel(Extent shown, Extent coded, int level) {
  int least = 0;
  while (uint64_t{coded.width} << least < shown.width ||
         uint64_t{coded.height} << least < shown.height)
    ++least;
  return std::clamp(level - least, 0, coarsestLevel(coded));
}

/// The lines that a view shows. lines: those of a side from the first on that is shown; count: how
/// many are shown; coded_count: how many the coded view has.
std::vector<uint32_t> linesOf(std::span<const uint32_t> lines, uint32_t count, const View& view,
                              const View& coded, uint32_t coded_count) {
  const uint32_t half = coded.level > 0 ? uint32_t{1} << (coded.level - 1) : 0;
  const uint32_t start = coded.window ? lines.front() : 0;
  std::vector<uint32_t> shown(count);
  for (uint32_t i = 0; i < count; ++i) {
    const uint32_t line = lines[size_t{i} << view.level] - start;
    shown[i] = std::min((line + half) >> coded.level, coded_count - 1);
  }
  return shown;
}

View codedViewOf(const GeometryHeader& header, const LineMaps& maps, const View& view) {
  if (!view.window) return {codedLevel(header.shown(), header.extent(), view.level), {}};
  const auto& [x, y, width, height] = *view.window;
  const uint32_t west = maps.columns[x], north = maps.rows[y];
  return {0, Window{west, north, maps.columns[x + width - 1] - west + 1,
                    maps.rows[y + height - 1] - north + 1}};
}

}  // namespace

View codedView(const GeometryHeader& header, const View& view) {
  return ShownLines(header, view).coded();
}

ShownLines::ShownLines(const GeometryHeader& header, const View& view)
    : none_(header.repeats.none()), coded_(view) {
  if (none_) return;
  const LineMaps maps = lineMapsOf(header.repeats);
  coded_ = codedViewOf(header, maps, view);
  coded_extent_ = coded_.extentIn(header.extent());
  const Extent shown = view.extentIn(header.shown());
  const auto columns = std::span(maps.columns).subspan(view.firstColumn());
  const auto rows = std::span(maps.rows).subspan(view.firstRow());
  columns_ = linesOf(columns, shown.width, view, coded_, coded_extent_.width);
  rows_ = linesOf(rows, shown.height, view, coded_, coded_extent_.height);
}

template <class T>
std::vector<T> ShownLines::copied(const std::vector<T>& values) const {
  if (values.empty()) return {};
  assert(values.size() == coded_extent_.samples());
  std::vector<T> out;
  out.reserve(columns_.size() * rows_.size());
  for (const uint32_t row : rows_) {
    const T* const from = values.data() + size_t{row} * coded_extent_.width;
    for (const uint32_t column : columns_) out.push_back(from[column]);
  }
  return out;
}

std::vector<uint8_t> ShownLines::shown(const std::vector<uint8_t>& mask) const {
  return none_ ? mask : copied(mask);
}

DecodedHeights ShownLines::shown(DecodedHeights decoded) const {
  if (none_) return decoded;
  DecodedGeometry& geometry = decoded.geometry;
  geometry.heights = copied(geometry.heights);
  geometry.valid = copied(geometry.valid);
  geometry.significant = copied(geometry.significant);
  decoded.corrections = copied(decoded.corrections);
  geometry.width = static_cast<uint32_t>(columns_.size());
  geometry.height = static_cast<uint32_t>(rows_.size());
  geometry.quiet_levels = 0;
  if (geometry.significant.empty()) return decoded;
  for (size_t y = 0, i = 0; y < rows_.size(); ++y) {
    const bool repeated_row = y > 0 && rows_[y] == rows_[y - 1];
    for (size_t x = 0; x < columns_.size(); ++x, ++i) {
      if (repeated_row || (x > 0 && columns_[x] == columns_[x - 1])) geometry.significant[i] = 0;
    }
  }
  return decoded;
}

}  // namespace tetrakis::inline repeats
