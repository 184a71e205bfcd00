// SPDX-License-Identifier: Apache-2.0
// Large reads of a dataset, strip by strip: GDAL itself would ask for one block after the other.
#include <algorithm>
#include <memory>
#include <span>

#include "apps/doors/gdal/dataset.hpp"

namespace tetrakis::gdal {
namespace {

/// Who wants to hear of progress hears of it so many times, at least where strips are high: more
/// strips decode more regions twice.
constexpr int kReports = 8, kHigh = 1024;

struct ScaledProgress {
  void operator()(void* progress) const { GDALDestroyScaledProgress(progress); }
};

}  // namespace

CPLErr Dataset::readStrips(const SampleWindow& window, std::span<const int> bands,
                           const GDALRasterIOExtraArg& extra, const ReadStrip& read) {
  const auto& [x, y, width, height] = window;
  const int most = extra.pfnProgress == nullptr ? height : std::max(height / kReports, kHigh);
  for (int top = y; top < y + height;) {
    const auto rows = static_cast<int>(
        blocks_.rowsAtOnce(static_cast<uint32_t>(width), static_cast<uint32_t>(top)));
    const int bottom = std::min({y + height, top + rows, top + most});
    const tks_window strip{static_cast<uint32_t>(x), static_cast<uint32_t>(top),
                           static_cast<uint32_t>(width), static_cast<uint32_t>(bottom - top)};
    for (const int band : bands)
      if (!blocks_.fill(*GetRasterBand(band), strip)) return CE_Failure;
    const auto done = [&](int row) { return static_cast<double>(row - y) / height; };
    const std::unique_ptr<void, ScaledProgress> part(
        GDALCreateScaledProgress(done(top), done(bottom), extra.pfnProgress, extra.pProgressData));
    GDALRasterIOExtraArg of_strip = extra;
    of_strip.bFloatingPointWindowValidity = FALSE;
    of_strip.pfnProgress = part ? GDALScaledProgress : nullptr;
    of_strip.pProgressData = part.get();
    if (const CPLErr error = read(top, bottom, &of_strip); error != CE_None) return error;
    top = bottom;
  }
  return CE_None;
}

CPLErr Dataset::IRasterIO(GDALRWFlag flag, int x, int y, int width, int height, void* data,
                          int columns, int rows, GDALDataType type, int bands, BandMap map,
                          GSpacing pixel, GSpacing line, GSpacing band,
                          GDALRasterIOExtraArg* extra) {
  const auto read = [&](int top, int bottom, GDALRasterIOExtraArg* of_strip) {
    const bool all = bottom - top == height;
    return GDALPamDataset::IRasterIO(
        flag, x, top, width, bottom - top, static_cast<GByte*>(data) + (top - y) * line, columns,
        all ? rows : bottom - top, type, bands, map, pixel, line, band, of_strip);
  };
  const bool whole = flag == GF_Read && columns == width && rows == height;
  if (!whole || !readsWindows()) return read(y, y + height, extra);
  return readStrips({x, y, width, height}, {map, static_cast<size_t>(bands)}, *extra, read);
}

}  // namespace tetrakis::gdal
