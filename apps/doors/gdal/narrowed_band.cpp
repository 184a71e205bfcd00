// SPDX-License-Identifier: Apache-2.0
#include "apps/doors/gdal/narrowed_band.hpp"

#include <algorithm>
#include <cstddef>

#include "apps/doors/gdal/copied_voids.hpp"

namespace tetrakis::gdal {

NarrowedBand::NarrowedBand(GDALRasterBand& band)
    : band_(band),
      nodata_(nodataOf(band)),
      mark_(nodata_ ? narrowedNodata(*nodata_) : kNaN),
      masked_(hasMask(band)) {}

bool NarrowedBand::read(const tks_window& window, std::span<float> out) {
  const auto x = static_cast<int>(window.x), columns = static_cast<int>(window.width);
  row_.resize(window.width);
  mask_.assign(window.width, 255);
  for (uint32_t y = 0; y < window.height; ++y) {
    const auto line = static_cast<int>(window.y + y);
    if (band_.RasterIO(GF_Read, x, line, columns, 1, row_.data(), columns, 1, GDT_Float64, 0, 0,
                       nullptr) != CE_None ||
        (masked_ && band_.GetMaskBand()->RasterIO(GF_Read, x, line, columns, 1, mask_.data(),
                                                  columns, 1, GDT_Byte, 0, 0, nullptr) != CE_None))
      return false;
    const size_t from = size_t{y} * window.width;
    for (size_t i = 0; i < window.width; ++i) out[from + i] = narrowed(row_[i], mask_[i] != 0);
  }
  return true;
}

void NarrowedBand::mark(std::span<float> samples) const {
  if (!nodata_ || merged_) return;
  std::replace_if(
      samples.begin(), samples.end(), [](float sample) { return std::isnan(sample); }, mark_);
}

std::optional<double> NarrowedBand::nodata() const {
  if (!nodata_) return std::nullopt;
  return double{merged_ ? kNaN : mark_};
}

/// NaN for voids, until all samples are known.
float NarrowedBand::narrowed(double value, bool valid) {
  if (nodata_ && meetsNodata(value, *nodata_)) return kNaN;
  const float rounded = toFloat(value);  // an infinity is refused by the library with its place
  if (!valid || !std::isfinite(rounded)) return rounded;
  merged_ = merged_ || meetsNodata(rounded, mark_);
  rounding_ = std::max(rounding_, std::abs(value - static_cast<double>(rounded)));
  return rounded;
}

}  // namespace tetrakis::gdal
