// SPDX-License-Identifier: Apache-2.0
// The integer samples that every codec of a benchmark is given; see raster.hpp.
#include "bench/peers/raster.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "base/samples.hpp"

namespace tetrakis::bench {
namespace {

constexpr double kMaxSample = 65535;

// One level of a mean pyramid: values with the number of real samples below each.
struct Level {
  size_t width = 0, height = 0;
  std::vector<double> value;
  std::vector<uint8_t> real;
};

Level halve(const Level& fine) {
  Level coarse{(fine.width + 1) / 2, (fine.height + 1) / 2, {}, {}};
  coarse.value.resize(coarse.width * coarse.height);
  coarse.real.resize(coarse.value.size());
  std::vector<int> count(coarse.value.size());
  for (size_t i = 0; i < fine.value.size(); ++i) {
    if (!fine.real[i]) continue;
    const size_t parent = i / fine.width / 2 * coarse.width + i % fine.width / 2;
    coarse.value[parent] += fine.value[i];
    ++count[parent];
  }
  for (size_t i = 0; i < count.size(); ++i) {
    coarse.real[i] = count[i] > 0;
    if (count[i] > 0) coarse.value[i] /= count[i];
  }
  return coarse;
}

// Push-pull filling (Gortler et al., The Lumigraph, 1996): a hole takes the mean of the finest
// surroundings that hold a real sample. Needs one real sample.
void fillHoles(Level& level) {
  if (std::find(level.real.begin(), level.real.end(), 0) == level.real.end()) return;
  Level coarse = halve(level);
  fillHoles(coarse);
  for (size_t i = 0; i < level.value.size(); ++i) {
    if (level.real[i]) continue;
    level.value[i] = coarse.value[i / level.width / 2 * coarse.width + i % level.width / 2];
  }
}

// Copies the pixels (x(i), y(j)) for i < width, j < height.
template <class X, class Y>
Raster gather(const Raster& raster, uint32_t width, uint32_t height, X x, Y y) {
  Raster out{width, height, raster.channels, raster.bits, raster.unit, {}, {}};
  for (uint32_t j = 0; j < height; ++j) {
    for (uint32_t i = 0; i < width; ++i) {
      const size_t from = size_t{y(j)} * raster.width + x(i);
      const auto pixel = raster.samples.begin() + static_cast<ptrdiff_t>(from * raster.channels);
      out.samples.insert(out.samples.end(), pixel, pixel + raster.channels);
      if (!raster.real.empty()) out.real.push_back(raster.real[from]);
    }
  }
  return out;
}

// Whole-sample symmetric extension: ... 2 1 0 1 2 ... n-2 n-1 n-2 ...
uint32_t mirror(int64_t i, uint32_t n) {
  if (n == 1) return 0;
  const int64_t period = 2 * (int64_t{n} - 1);
  i = (i % period + period) % period;
  return static_cast<uint32_t>(std::min(i, period - i));
}

}  // namespace

std::vector<double> samplesOf(std::span<const std::byte> data, tks_sample sample) {
  std::vector<double> values;
  withSampleType(sample, [&](auto value) {
    values.reserve(data.size() / sizeof value);
    for (size_t at = 0; at + sizeof value <= data.size(); at += sizeof value) {
      std::memcpy(&value, data.data() + at, sizeof value);
      values.push_back(static_cast<double>(value));
    }
  });
  return values;
}

Result<Raster> heightRaster(const tools::HeightFile& file) {
  Level level{file.width, file.height, samplesOf(file.data, file.sample), {}};
  level.real.resize(level.value.size());
  double low = std::numeric_limits<double>::infinity(), high = -low;
  bool whole = true;
  for (size_t i = 0; i < level.value.size(); ++i) {
    const double v = level.value[i];
    level.real[i] = std::isfinite(v) && !(file.nodata && v == *file.nodata);
    if (!level.real[i]) continue;
    low = std::min(low, v);
    high = std::max(high, v);
    whole = whole && v == std::floor(v);
  }
  if (low > high) return Status(TKS_USAGE, "The height field holds no height.");
  fillHoles(level);

  const double range = high - low;
  const double step = whole && range <= kMaxSample ? 1 : range / kMaxSample;
  Raster raster{file.width, file.height, 1, 1, step * file.scale, {}, {}};
  raster.bits = std::max<int>(1, std::bit_width(static_cast<uint32_t>(std::lround(range / step))));
  for (const double v : level.value) {
    raster.samples.push_back(static_cast<uint16_t>(std::lround((v - low) / step)));
  }
  if (std::find(level.real.begin(), level.real.end(), 0) != level.real.end()) {
    raster.real = std::move(level.real);
  }
  return raster;
}

Raster imageRaster(const tools::ImageFile& file) {
  const std::vector<double> values = samplesOf(file.data, file.sample);
  const double step = file.sample == TKS_U16 ? 257 : 1;  // 65535 / 255
  Raster raster{file.width, file.height, file.channels >= 3 ? 3u : 1u, 8, 1, {}, {}};
  for (size_t i = 0; i < raster.pixels(); ++i) {
    for (uint32_t c = 0; c < raster.channels; ++c) {
      raster.samples.push_back(
          static_cast<uint16_t>(std::lround(values[i * file.channels + c] / step)));
    }
  }
  return raster;
}

Raster cropCentre(const Raster& raster, uint64_t max_pixels) {
  if (raster.pixels() <= max_pixels) return raster;
  const double shrink =
      std::sqrt(static_cast<double>(max_pixels) / static_cast<double>(raster.pixels()));
  const auto width = std::max(1u, static_cast<uint32_t>(raster.width * shrink));
  const auto height = std::max(1u, static_cast<uint32_t>(raster.height * shrink));
  const uint32_t left = (raster.width - width) / 2, top = (raster.height - height) / 2;
  return gather(
      raster, width, height, [&](uint32_t i) { return left + i; },
      [&](uint32_t j) { return top + j; });
}

Raster mirrorTo(const Raster& raster, uint32_t width, uint32_t height) {
  const int64_t left = (int64_t{raster.width} - width) / 2;
  const int64_t top = (int64_t{raster.height} - height) / 2;
  return gather(
      raster, width, height, [&](uint32_t i) { return mirror(left + i, raster.width); },
      [&](uint32_t j) { return mirror(top + j, raster.height); });
}

namespace {

template <class T>
double meanSquare(const Raster& raster, const std::vector<T>& decoded) {
  double sum = 0;
  uint64_t count = 0;
  for (size_t i = 0; i < raster.samples.size(); ++i) {
    if (!raster.real.empty() && !raster.real[i / raster.channels]) continue;
    const double error = static_cast<double>(raster.samples[i]) - static_cast<double>(decoded[i]);
    sum += error * error;
    ++count;
  }
  return sum / static_cast<double>(count);
}

}  // namespace

double meanSquaredError(const Raster& raster, const std::vector<uint16_t>& decoded) {
  return meanSquare(raster, decoded);
}

double meanSquaredError(const Raster& raster, const std::vector<float>& decoded) {
  return meanSquare(raster, decoded);
}

}  // namespace tetrakis::bench
