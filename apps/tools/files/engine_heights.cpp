// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/files/engine_heights.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "apps/tools/files/little_endian.hpp"
#include "apps/tools/files/pictures/png.hpp"

namespace tetrakis::tools {
namespace {

/// Epic's recommended sizes, which components of 63, 127 or 255 quads make without a rest.
constexpr std::array<uint32_t, 7> kUnrealSides{127, 253, 505, 1009, 2017, 4033, 8129};
constexpr std::array<uint32_t, 8> kUnitySides{33, 65, 129, 257, 513, 1025, 2049, 4097};

std::span<const uint32_t> sidesOf(Engine engine) {
  if (engine == Engine::kUnreal) return kUnrealSides;
  return kUnitySides;
}

std::string listed(std::span<const uint32_t> sides) {
  std::string text;
  for (const uint32_t side : sides) text += (text.empty() ? "" : ", ") + std::to_string(side);
  return text;
}

/// Keys' kernel (a = -1/2) around a place: four samples and their weights. It needs no state at the
/// border, where the outer sample counts for those beyond.
struct Taps {
  std::array<size_t, 4> at;
  std::array<double, 4> weight;
};

/// beyond: of EngineGround.
std::vector<Taps> tapsOf(uint32_t side, uint32_t samples, double beyond) {
  std::vector<Taps> taps(side);
  for (uint32_t i = 0; i < side; ++i) {
    const double place = std::min(i * (samples - 1 + beyond) / (side - 1), samples - 1.0);
    const double first = std::min(std::floor(place), samples - 2.0), t = place - first;
    for (size_t k = 0; k < 4; ++k)
      taps[i].at[k] = static_cast<size_t>(std::clamp(first + double(k) - 1, 0.0, samples - 1.0));
    taps[i].weight = {((-t + 2) * t - 1) * t / 2, ((3 * t - 5) * t * t + 2) / 2,
                      ((-3 * t + 4) * t + 1) * t / 2, (t - 1) * t * t / 2};
  }
  return taps;
}

bool isAskew(const GroundAxes& axes) {
  constexpr double kSlack = 1e-6;
  const auto leans = [](const std::array<double, 2>& axis) {
    return std::min(std::abs(axis[0]), std::abs(axis[1])) > kSlack;
  };
  return leans(axes.along) || leans(axes.down);
}

/// The samples of a square, row by row.
std::vector<uint16_t> resampled(const EngineGround& ground, uint32_t side, const QuarterTurn& turn,
                                const std::array<double, 2>& range) {
  const auto [low, high] = range;
  const double unit = high > low ? 65535 / (high - low) : 0;
  std::vector<Taps> columns = tapsOf(side, ground.width, ground.beyond_x);
  std::vector<Taps> rows = tapsOf(side, ground.height, ground.beyond_y);
  if (turn.columns_back) std::reverse(columns.begin(), columns.end());
  if (turn.rows_back) std::reverse(rows.begin(), rows.end());
  std::vector<uint16_t> samples;
  samples.reserve(size_t{side} * side);
  for (uint32_t i = 0; i < side; ++i) {
    for (uint32_t j = 0; j < side; ++j) {
      const Taps& row = rows[turn.transposed ? j : i];
      const Taps& column = columns[turn.transposed ? i : j];
      double sum = 0;
      for (size_t y = 0; y < 4; ++y) {
        const float* const line = &ground.heights[row.at[y] * ground.width];
        for (size_t x = 0; x < 4; ++x) {
          const double height = line[column.at[x]];
          sum += row.weight[y] * column.weight[x] * (std::isnan(height) ? low : height);
        }
      }
      samples.push_back(
          static_cast<uint16_t>(std::lround((std::clamp(sum, low, high) - low) * unit)));
    }
  }
  return samples;
}

}  // namespace

Result<EngineSize> parseEngineSize(const std::string& text, uint32_t longest) {
  const size_t colon = text.find(':');
  const std::string name = text.substr(0, colon);
  if (name != "unreal" && name != "unity")
    return Status(TKS_USAGE, "--size takes unreal or unity, alone or with a side as unreal:2017");
  EngineSize size{name == "unreal" ? Engine::kUnreal : Engine::kUnity, 0};
  const std::span<const uint32_t> sides = sidesOf(size.engine);
  if (colon == text.npos) {
    const auto fits = std::lower_bound(sides.begin(), sides.end(), longest);
    size.side = fits == sides.end() ? sides.back() : *fits;
    return size;
  }
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data() + colon + 1, end, size.side);
  const bool known = std::find(sides.begin(), sides.end(), size.side) != sides.end();
  if (error == std::errc() && stop == end && known) return size;
  return Status(TKS_USAGE, "the sides of --size " + name + " are " + listed(sides) + ", not " +
                               text.substr(colon + 1));
}

Status checkEngineFormat(const EngineSize& size, const std::string& path) {
  const std::string format = formatOf(path, "");
  if (format == "r16" || format == "raw") return {};
  if (size.engine == Engine::kUnity)
    return {TKS_USAGE, "Unity imports 16-bit RAW: end the name of --height in .raw or .r16"};
  if (format == "png") return {};
  return {TKS_USAGE, "Unreal imports 16-bit .png and .r16: end the name of --height in one"};
}

Result<EngineHeights> engineHeights(const EngineGround& ground, const EngineSize& size) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  EngineHeights out;
  out.size = size;
  for (const float height : ground.heights) {
    if (std::isnan(height)) {
      ++out.voids;
      continue;
    }
    low = std::min(low, double{height});
    high = std::max(high, double{height});
  }
  if (out.voids == ground.heights.size())
    return Status(TKS_USAGE, "all samples are void: there is no height to write");
  out.lowest = low * ground.metres_per_unit;
  out.highest = high * ground.metres_per_unit;
  out.width = (ground.width - 1 + ground.beyond_x) * ground.spacing_x;
  out.length = (ground.height - 1 + ground.beyond_y) * ground.spacing_y;
  const QuarterTurn turn(ground.axes);
  if (turn.transposed) std::swap(out.width, out.length);
  out.samples = resampled(ground, size.side, turn, {low, high});
  out.askew = isAskew(ground.axes);
  return out;
}

Status writeEngineHeights(const std::string& path, const EngineHeights& heights) {
  if (formatOf(path, "") != "png") {
    LittleEndianBuffer file;
    file.putAll(std::span(heights.samples));
    return writeBytes(path, file.bytes);
  }
  ImageFile image{heights.size.side, heights.size.side, 1, TKS_U16, {}};
  const auto bytes = std::as_bytes(std::span(heights.samples));
  image.data.assign(bytes.begin(), bytes.end());
  const auto png = encodePng(image);
  return png.ok() ? writeBytes(path, *png) : png.status();
}

}  // namespace tetrakis::tools
