// SPDX-License-Identifier: Apache-2.0
#include "apps/doors/gdal/overview.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>
#include <vector>

namespace tetrakis::gdal {
namespace {

using Shares = std::array<double, 3>;

template <class T>
T rounded(double value) {
  if constexpr (std::is_integral_v<T>) return static_cast<T>(std::floor(value + 0.5));
  return static_cast<T>(value);
}

/// The pixels of `finer` as numbers of this type.
template <class T>
class Averager {
 public:
  explicit Averager(const FinerLevel& finer) : finer_(finer) {}

  /// Of three rows and columns of samples, from (x, y) of the level on.
  void pixel(uint32_t x, uint32_t y, const Shares& across, const Shares& down, T* out) const {
    for (uint32_t channel = 0; channel < finer_.channels; ++channel) {
      Sums of;
      for (uint32_t row = 0; row < 3; ++row) {
        for (uint32_t column = 0; column < 3; ++column) {
          const double share = down[row] * across[column];
          if (share == 0) continue;
          const T* const from = at(x + column, y + row);
          if (isVoid(channel, from[channel])) {
            out[channel] = from[channel];
            continue;
          }
          const double alpha =
              finer_.has_alpha ? static_cast<double>(from[finer_.channels - 1]) : 1;
          of.add(static_cast<double>(from[channel]), share, alpha);
        }
      }
      if (of.weight == 0) continue;  // all were void
      const bool colour = !finer_.has_alpha || channel + 1 < finer_.channels;
      const double mean = colour && of.opaque > 0 ? of.shown / of.opaque : of.plain / of.weight;
      out[channel] = asGround(channel, rounded<T>(mean));
    }
  }

 private:
  struct Sums {
    double weight = 0, plain = 0;
    double opaque = 0, shown = 0;  ///< weighted by alpha

    void add(double value, double share, double alpha) {
      weight += share;
      plain += share * value;
      opaque += share * alpha;
      shown += share * alpha * value;
    }
  };

  const T* at(uint32_t x, uint32_t y) const {
    const tks_window& window = finer_.window;
    const uint64_t pixel = uint64_t{y - window.y} * window.width + (x - window.x);
    return reinterpret_cast<const T*>(finer_.pixels) + pixel * finer_.channels;
  }

  bool isVoid(uint32_t channel, T sample) const {
    const std::optional<double>& nodata = finer_.nodata[channel];
    if (!nodata) return false;
    const auto value = static_cast<double>(sample);
    return value == *nodata || std::isnan(value);
  }

  /// A mean as ground, which the nodata value is not: of integers its neighbour, of floats the next
  /// towards 0 that GDAL does not take for it (ARE_REAL_EQUAL() in gdal_priv.h).
  T asGround(uint32_t channel, T mean) const {
    if (!finer_.nodata[channel]) return mean;
    if constexpr (std::is_integral_v<T>) {
      if (!isVoid(channel, mean)) return mean;
      return static_cast<T>(mean == std::numeric_limits<T>::max() ? mean - 1 : mean + 1);
    } else {
      constexpr double kEpsilon = std::numeric_limits<T>::epsilon();
      const double nodata = *finer_.nodata[channel], off = std::abs(mean - nodata);
      if (nodata == 0) return mean == 0 ? std::numeric_limits<T>::min() : mean;
      const bool taken = off < 2 * kEpsilon * std::abs(mean + nodata);
      return taken ? static_cast<T>(nodata * (1 - 8 * kEpsilon)) : mean;
    }
  }

  const FinerLevel& finer_;
};

template <class T>
void average(const FinerLevel& finer, const OverviewAxis& across, const OverviewAxis& down,
             const tks_window& part, std::byte* out) {
  const Averager<T> averager(finer);
  struct Column {
    uint32_t first;
    Shares shares;
  };
  std::vector<Column> columns;
  for (uint32_t x = part.x; x < part.x + part.width; ++x)
    columns.push_back({across.first(x), across.shares(x)});
  T* to = reinterpret_cast<T*>(out);
  for (uint32_t y = part.y; y < part.y + part.height; ++y) {
    const uint32_t first = down.first(y);
    const Shares shares = down.shares(y);
    for (const Column& column : columns) {
      averager.pixel(column.first, first, column.shares, shares, to);
      to += finer.channels;
    }
  }
}

}  // namespace

double OverviewAxis::place(double pixel) const {
  return std::ldexp(pixel * raster / overview - 0.5, -static_cast<int>(level));
}

uint32_t OverviewAxis::first(uint32_t pixel) const {
  return static_cast<uint32_t>(place(pixel) + 0.5);
}

uint32_t OverviewAxis::middle(uint32_t pixel) const {
  return std::min(static_cast<uint32_t>(place(pixel + 0.5) + 0.5), finer - 1);
}

std::array<double, 3> OverviewAxis::shares(uint32_t pixel) const {
  const double begin = place(pixel), end = place(pixel + 1.0);
  std::array<double, 3> shares{};
  for (uint32_t i = 0; i < 3; ++i) {
    const double sample = first(pixel) + i;
    if (sample < finer)
      shares[i] = std::max(std::min(end, sample + 0.5) - std::max(begin, sample - 0.5), 0.0);
  }
  return shares;
}

tks_window areaOfMeans(const OverviewAxis& x, const OverviewAxis& y, const tks_window& part) {
  const auto end = [](const OverviewAxis& axis, uint32_t last) {
    return std::min(axis.first(last) + 3, axis.finer);
  };
  const uint32_t left = x.first(part.x), top = y.first(part.y);
  return {left, top, end(x, part.x + part.width - 1) - left,
          end(y, part.y + part.height - 1) - top};
}

tks_window areaOfMiddles(const OverviewAxis& x, const OverviewAxis& y, const tks_window& part) {
  const uint32_t left = x.middle(part.x), top = y.middle(part.y);
  return {left, top, x.middle(part.x + part.width - 1) + 1 - left,
          y.middle(part.y + part.height - 1) + 1 - top};
}

void takeMiddles(const FinerLevel& finer, const OverviewAxis& x, const OverviewAxis& y,
                 const tks_window& part, std::byte* out) {
  const size_t pixel = finer.channels * tks_sample_bytes(finer.sample);
  for (uint32_t row = part.y; row < part.y + part.height; ++row) {
    const size_t line = size_t{y.middle(row) - finer.window.y} * finer.window.width;
    for (uint32_t column = part.x; column < part.x + part.width; ++column, out += pixel)
      std::memcpy(out, finer.pixels + (line + x.middle(column) - finer.window.x) * pixel, pixel);
  }
}

void makeMeans(const FinerLevel& finer, const OverviewAxis& x, const OverviewAxis& y,
               const tks_window& part, std::byte* out) {
  switch (finer.sample) {
    case TKS_U8:
      return average<uint8_t>(finer, x, y, part, out);
    case TKS_I8:
      return average<int8_t>(finer, x, y, part, out);
    case TKS_U16:
      return average<uint16_t>(finer, x, y, part, out);
    case TKS_I16:
      return average<int16_t>(finer, x, y, part, out);
    case TKS_U32:
      return average<uint32_t>(finer, x, y, part, out);
    case TKS_I32:
      return average<int32_t>(finer, x, y, part, out);
    case TKS_F32:
      return average<float>(finer, x, y, part, out);
  }
}

}  // namespace tetrakis::gdal
