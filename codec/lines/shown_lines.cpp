// SPDX-License-Identifier: Apache-2.0
#include "codec/lines/shown_lines.hpp"

#include <algorithm>
#include <span>

#include "codec/wavelet/pyramid.hpp"

namespace tetrakis::inline lines {

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

View codedViewOf(const LineMaps& maps, Extent shown, Extent coded, const View& view) {
  if (!view.window) return {codedLevel(shown, coded, view.level), {}};
  const auto& [x, y, width, height] = *view.window;
  const uint32_t west = maps.columns[x], north = maps.rows[y];
  return {0, Window{west, north, maps.columns[x + width - 1] - west + 1,
                    maps.rows[y + height - 1] - north + 1}};
}

}  // namespace

ShownLines::ShownLines(const LineRepeats& repeats, Extent coded, const View& view)
    : none_(repeats.none()), coded_(view) {
  if (none_) return;
  const LineMaps maps = lineMapsOf(repeats);
  coded_ = codedViewOf(maps, repeats.shown, coded, view);
  coded_extent_ = coded_.extentIn(coded);
  const Extent shown = view.extentIn(repeats.shown);
  const auto columns = std::span(maps.columns).subspan(view.firstColumn());
  const auto rows = std::span(maps.rows).subspan(view.firstRow());
  columns_ = linesOf(columns, shown.width, view, coded_, coded_extent_.width);
  rows_ = linesOf(rows, shown.height, view, coded_, coded_extent_.height);
}

}  // namespace tetrakis::inline lines
