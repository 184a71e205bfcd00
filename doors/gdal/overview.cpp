// SPDX-License-Identifier: Apache-2.0
#include "doors/gdal/overview.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <type_traits>

namespace tetrakis::gdal {
namespace {

/// Samples 2X, 2X + 1 and 2X + 2 of level k - 1 beneath pixel X of overview k. In samples of that
/// level the pixel is 2 wide and reaches from 2X - 2^-k to 2X + 2 - 2^-k, and sample i from i - 1/2
/// to i + 1/2: these are the shares of its area. Overview 1 is the mean of 2 x 2.
using Shares = std::array<double, 3>;

Shares sharesOf(uint32_t k) {
  const double shift = std::ldexp(1.0, -static_cast<int>(k));
  return {(0.5 + shift) / 2, 0.5, (0.5 - shift) / 2};
}

template <class T>
T rounded(double value) {
  if constexpr (std::is_integral_v<T>) return static_cast<T>(std::floor(value + 0.5));
  return static_cast<T>(value);
}

/// The pixels of `finer` as numbers of this type.
template <class T>
class Averager {
 public:
  Averager(const FinerLevel& finer, uint32_t k) : finer_(finer), shares_(sharesOf(k)) {}

  void pixel(uint32_t x, uint32_t y, T* out) const {
    std::array<double, 4> sums{}, plain{};
    double weight = 0, opaque = 0;
    for (uint32_t row = 0; row < 3; ++row) {
      for (uint32_t column = 0; column < 3; ++column) {
        const T* const from = at(2 * uint64_t{x} + column, 2 * uint64_t{y} + row);
        const double share = shares_[row] * shares_[column];
        if (from == nullptr || share == 0 || isVoid(*from)) continue;
        const double alpha = hasAlpha() ? static_cast<double>(from[finer_.channels - 1]) : 1;
        weight += share;
        opaque += share * alpha;
        for (uint32_t channel = 0; channel < finer_.channels; ++channel) {
          plain[channel] += share * static_cast<double>(from[channel]);
          sums[channel] += share * alpha * static_cast<double>(from[channel]);
        }
      }
    }
    if (weight == 0) {
      *out = voidValue();
      return;
    }
    for (uint32_t channel = 0; channel < finer_.channels; ++channel) {
      const bool colour = !hasAlpha() || channel + 1 < finer_.channels;
      out[channel] =
          rounded<T>(colour && opaque > 0 ? sums[channel] / opaque : plain[channel] / weight);
    }
    *out = asGround(*out);
  }

 private:
  bool hasAlpha() const { return finer_.channels % 2 == 0; }

  /// Null outside of the level.
  const T* at(uint64_t x, uint64_t y) const {
    const tks_window& window = finer_.window;
    if (x >= finer_.width || y >= finer_.height) return nullptr;
    const uint64_t pixel = (y - window.y) * window.width + (x - window.x);
    return reinterpret_cast<const T*>(finer_.pixels) + pixel * finer_.channels;
  }

  bool isVoid(T sample) const {
    if (!finer_.nodata) return false;
    const auto value = static_cast<double>(sample);
    return value == *finer_.nodata || std::isnan(value);
  }

  /// A mean as ground, which the nodata value is not: of integers its neighbour, of floats the next
  /// towards 0 that GDAL does not take for it (ARE_REAL_EQUAL() in gdal_priv.h).
  T asGround(T mean) const {
    if (!finer_.nodata) return mean;
    if constexpr (std::is_integral_v<T>) {
      if (!isVoid(mean)) return mean;
      return static_cast<T>(mean == std::numeric_limits<T>::max() ? mean - 1 : mean + 1);
    } else {
      constexpr double kEpsilon = std::numeric_limits<T>::epsilon();
      const double nodata = *finer_.nodata, off = std::abs(mean - nodata);
      if (nodata == 0) return mean == 0 ? std::numeric_limits<T>::min() : mean;
      const bool taken = off < 2 * kEpsilon * std::abs(mean + nodata);
      return taken ? static_cast<T>(nodata * (1 - 8 * kEpsilon)) : mean;
    }
  }

  /// Only reached where samples were void.
  T voidValue() const {
    if (std::isnan(*finer_.nodata)) return std::numeric_limits<T>::quiet_NaN();
    return static_cast<T>(*finer_.nodata);
  }

  const FinerLevel& finer_;
  Shares shares_;
};

template <class T>
void average(const FinerLevel& finer, uint32_t k, const tks_window& part, std::byte* out) {
  const Averager<T> averager(finer, k);
  T* to = reinterpret_cast<T*>(out);
  for (uint32_t y = part.y; y < part.y + part.height; ++y) {
    for (uint32_t x = part.x; x < part.x + part.width; ++x, to += finer.channels)
      averager.pixel(x, y, to);
  }
}

}  // namespace

tks_window areaBelow(const tks_window& part, uint32_t finer_width, uint32_t finer_height) {
  const uint32_t x = 2 * part.x, y = 2 * part.y;
  return {x, y, std::min(2 * part.width + 1, finer_width - x),
          std::min(2 * part.height + 1, finer_height - y)};
}

void makeOverview(const FinerLevel& finer, uint32_t k, const tks_window& part, std::byte* out) {
  switch (finer.sample) {
    case TKS_U8:
      return average<uint8_t>(finer, k, part, out);
    case TKS_I8:
      return average<int8_t>(finer, k, part, out);
    case TKS_U16:
      return average<uint16_t>(finer, k, part, out);
    case TKS_I16:
      return average<int16_t>(finer, k, part, out);
    case TKS_U32:
      return average<uint32_t>(finer, k, part, out);
    case TKS_I32:
      return average<int32_t>(finer, k, part, out);
    case TKS_F32:
      return average<float>(finer, k, part, out);
  }
}

}  // namespace tetrakis::gdal
