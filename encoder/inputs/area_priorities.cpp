// SPDX-License-Identifier: Apache-2.0
// The area of the ground below the rows of a grid of latitudes, and the priorities that follow.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/portable_math.hpp"
#include "encoder/inputs/encode_inputs.hpp"

namespace tetrakis::inline inputs {

namespace {

/// Rows of tiles, of a power of two samples. ETOPO (20') takes 0.2 to 1.1 % more bytes with 9 rows
/// than with 17; 34 rows are as good as 17.
constexpr uint32_t kMostTileRows = 32;
/// Columns of tiles: a row has few tiles that tell nothing new, twice as many as there are rows
/// around a globe.
constexpr uint32_t kMostTileColumns = 64;
/// By how many times less squared error a map has to promise. From pole to pole it promises 1.2,
/// and saves 3 % of the bytes; the half of it still covers what it costs.
constexpr double kLeastGain = 1.05;
/// A map may take this part of a budget, or of a byte for each sample where there is no budget. A
/// smaller number gives small budgets maps that cost more than they save.
constexpr uint64_t kAreaMapPart = 64;
/// Of a sample behind a pole, beside the mean. It has the lowest priority all the same.
constexpr double kLeastArea = 0x1p-20;

PriorityMap tilesOver(Extent plane) {
  PriorityMap map{plane, PriorityHeader::kLeastTileLog2, {}};
  while (map.rows() > kMostTileRows || map.columns() > kMostTileColumns) ++map.tile_log2;
  return map;
}

/// Of a latitude in degrees; behind a pole, that of the pole.
double sineOf(double latitude) {
  return portable::sin(std::clamp(latitude, -90.0, 90.0) * std::numbers::pi / 180);
}

/// Rows that one tile reaches over, the share of all rows that they are, the area of a sample of
/// them beside that of a mean sample of the grid, and how many bit-planes earlier it comes than one
/// of the largest, at most 0.
struct TileRow {
  double share, area;
  double priority = 0;
};

/// A bit-plane takes three quarters off squared errors: a sample of a quarter of the largest area
/// comes one bit-plane later. Rounded so, samples beyond 60 degrees are the first that do; counted
/// from the mean area, 71 degrees, a globe takes 0.6 to 1 % more bytes.
void prioritise(std::vector<TileRow>& rows) {
  double largest = 0;
  for (const TileRow& row : rows) largest = std::max(largest, row.area);
  for (TileRow& row : rows) row.priority = std::round(portable::log2(row.area / largest) / 2);
}

/// The area between two parallels goes as the difference of the sines of their latitudes. Empty
/// where the rows have none.
std::vector<TileRow> tileRowsOf(const tks_heights& heights, int tile_log2) {
  const double first = heights.first_latitude, last = heights.last_latitude;
  const double all = sineOf(last) - sineOf(first);
  std::vector<TileRow> rows;
  if (all == 0) return rows;
  const auto sine_at = [&](uint64_t row) {
    const double part = static_cast<double>(row) / heights.height;
    return sineOf(first + part * (last - first));
  };
  const uint64_t side = uint64_t{1} << tile_log2;
  for (uint64_t begin = 0; begin < heights.height; begin += side) {
    const uint64_t end = std::min<uint64_t>(begin + side, heights.height);
    const double share = static_cast<double>(end - begin) / heights.height;
    const double area = (sine_at(end) - sine_at(begin)) / all / share;
    rows.push_back({share, std::max(area, kLeastArea)});
  }
  prioritise(rows);
  return rows;
}

/// By how many times less squared error over the area there is in as many bytes. An error that is
/// reached p bit-planes earlier is 4^-p of what it was; p in the mean takes the other bit-planes as
/// many bytes later.
double gainOf(const std::vector<TileRow>& rows) {
  double error = 0, earlier = 0;
  for (const TileRow& row : rows) {
    error += row.share * row.area * portable::exp2(-2 * row.priority);
    earlier += row.share * row.priority;
  }
  return 1 / (error * portable::exp2(2 * earlier));
}

/// The top kPriorities, of which the lowest is 0.
std::vector<uint8_t> tiersOf(const std::vector<TileRow>& rows) {
  double least = 0;
  for (const TileRow& row : rows) least = std::min(least, row.priority);
  least = std::max(least, 1 - double{kPriorities});
  std::vector<uint8_t> tiers;
  for (const TileRow& row : rows)
    tiers.push_back(static_cast<uint8_t>(std::max(row.priority - least, 0.0)));
  return tiers;
}

}  // namespace

PriorityMap areaPriorities(const EncodeInputs& inputs) {
  const tks_heights& heights = *inputs.heights;
  if (heights.domain == TKS_DOMAIN_FOREST) return {};  // its raster has no parallels
  const Extent extent{heights.width, heights.height};
  PriorityMap map = tilesOver(extent);
  const std::vector<TileRow> rows = tileRowsOf(heights, map.tile_log2);
  if (rows.empty() || gainOf(rows) < kLeastGain) return {};
  for (const uint8_t tier : tiersOf(rows))
    map.priorities.insert(map.priorities.end(), map.columns(), tier);
  const uint64_t room = inputs.budgeted() ? inputs.options.bytes : extent.samples();
  return headerOf(map).code.size() > room / kAreaMapPart ? PriorityMap() : map;
}

}  // namespace tetrakis::inline inputs
