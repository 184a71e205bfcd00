// SPDX-License-Identifier: Apache-2.0
#include "apps/doors/gdal/height_windows.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>

#include "apps/doors/gdal/copied_samples.hpp"
#include "apps/doors/gdal/copied_voids.hpp"

namespace tetrakis::gdal {
namespace {

bool readRaster(GDALRasterBand& band, const tks_window& window, void* samples, GDALDataType type) {
  const auto width = static_cast<int>(window.width), height = static_cast<int>(window.height);
  return band.RasterIO(GF_Read, static_cast<int>(window.x), static_cast<int>(window.y), width,
                       height, samples, width, height, type, 0, 0, nullptr) == CE_None;
}

size_t samplesOf(const tks_window& window) {
  return size_t{window.width} * window.height;
}

std::span<float> floatsOf(const tks_window& window, void* samples) {
  return {static_cast<float*>(samples), samplesOf(window)};
}

}  // namespace

HeightWindows::HeightWindows(GDALRasterBand& band, std::unique_ptr<CopiedHeights> copy)
    : band_(band), copy_(std::move(copy)) {}

std::unique_ptr<HeightWindows> HeightWindows::of(const std::string& name, GDALDataset& dataset,
                                                 bool strict, const ProgressPart& progress) {
  std::unique_ptr<CopiedHeights> copy = describeHeights(name, dataset);
  if (!copy) return nullptr;
  GDALRasterBand& band = *dataset.GetRasterBand(1);
  std::unique_ptr<HeightWindows> windows(new HeightWindows(band, std::move(copy)));
  const bool doubles = band.GetRasterDataType() == GDT_Float64;
  if (doubles && !windows->narrow(name, strict, progress)) return nullptr;
  takeNodata(name, band, windows->heights());
  if (!hasMask(band)) return windows;
  tks_heights& heights = windows->heights().heights;
  if (!canHaveNodata(heights)) heights.nodata = std::numeric_limits<double>::quiet_NaN();
  heights.has_nodata = 1;
  windows->hidden_ = heights.nodata;
  return windows;
}

bool HeightWindows::narrow(const std::string& name, bool strict, const ProgressPart& progress) {
  constexpr uint32_t kSide = 2048;
  const uint32_t width = copy_->heights.width, height = copy_->heights.height;
  NarrowedBand& doubles = doubles_.emplace(band_);
  std::vector<float> samples(size_t{kSide} * kSide);
  CPLErrorReset();
  for (uint32_t y = 0; y < height; y += kSide) {
    for (uint32_t x = 0; x < width; x += kSide) {
      const tks_window window{x, y, std::min(kSide, width - x), std::min(kSide, height - y)};
      if (!doubles.read(window, samples) || !progress.report(double(y) / double(height)))
        return reportStop(name);
    }
  }
  return takeNarrowed(name, doubles, strict, *copy_);
}

bool HeightWindows::read(const tks_window& window, void* samples) {
  if (!doubles_) return readPlain(window, samples) && hideMasked(window, samples);
  const std::span<float> floats = floatsOf(window, samples);
  if (!doubles_->read(window, floats)) return false;
  doubles_->mark(floats);
  return hideMasked(window, samples);
}

bool HeightWindows::readPlain(const tks_window& window, void* samples) {
  if (!readRaster(band_, window, samples, band_.GetRasterDataType())) return false;
  const tks_heights& heights = copy_->heights;
  if (heights.sample == TKS_F32 && heights.has_nodata)
    settleNodata(floatsOf(window, samples), heights.nodata);
  return true;
}

bool HeightWindows::hideMasked(const tks_window& window, void* samples) {
  if (!hidden_) return true;
  mask_.resize(samplesOf(window));
  if (!readRaster(*band_.GetMaskBand(), window, mask_.data(), GDT_Byte)) return false;
  const tks_sample type = copy_->heights.sample;
  const size_t bytes = mask_.size() * tks_sample_bytes(type);
  hide(type, {static_cast<std::byte*>(samples), bytes}, mask_, *hidden_);
  return true;
}

bool lacksNodata(GDALRasterBand& band, const tks_heights& heights) {
  if (!hasMask(band) || heights.sample == TKS_F32) return false;
  const std::optional<double> nodata = nodataOf(band);
  tks_heights declared = heights;
  declared.has_nodata = nodata.has_value();
  declared.nodata = nodata.value_or(0);
  return !canHaveNodata(declared);
}

}  // namespace tetrakis::gdal
