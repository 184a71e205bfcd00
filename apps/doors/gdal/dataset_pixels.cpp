// SPDX-License-Identifier: Apache-2.0
// The pixels of a dataset, and of its overviews: which level of the stream they are made of, and
// how.
#include <algorithm>
#include <new>
#include <optional>
#include <vector>

#include "apps/doors/gdal/dataset.hpp"
#include "apps/doors/gdal/overview.hpp"
#include "apps/doors/gdal/pixels.hpp"

namespace tetrakis::gdal {
namespace {

constexpr uint32_t kPieceRows = 2048;  ///< of the raster, decoded at once for an overview

}  // namespace

bool Dataset::hasClasses() const {
  if (source_->isDrawn()) return true;
  for (auto&& band : raster_->GetBands()) {
    const char* const layer = band->GetMetadataItem("LAYER_TYPE");
    if (band->GetColorTable() != nullptr || band->GetCategoryNames() != nullptr) return true;
    if (layer != nullptr && EQUAL(layer, "thematic")) return true;  // so says Erdas Imagine
  }
  return false;
}

uint32_t Dataset::finerLevel() const {
  if (level_ == 0) return 0;
  // Levels of drawings hold samples of the raster, those of wavelets means.
  return hasClasses() && !source_->isDrawn() ? 0 : level_ - 1;
}

NodataValues Dataset::nodataValues() const {
  NodataValues values;
  for (int band = 1; band <= raster_->GetRasterCount(); ++band) {
    const bool alpha = source_->hasAlpha() && band == raster_->GetRasterCount();
    int found = FALSE;
    const double nodata = raster_->GetRasterBand(band)->GetNoDataValue(&found);
    auto& value = values.at(static_cast<size_t>(band) - 1);
    value = found ? nodata : void_value_;
    if (alpha) value.reset();
  }
  return values;
}

bool Dataset::makeOverview(const tks_window& part, std::byte* out) {
  const uint32_t finer = finerLevel();
  const bool classes = hasClasses();
  const uint32_t width = source_->width(finer), height = source_->height(finer);
  const OverviewAxis across{finer, source_->width(0), source_->width(level_), width};
  const OverviewAxis down{finer, source_->height(0), source_->height(level_), height};
  tks_window area = classes ? areaOfMiddles(across, down, part) : areaOfMeans(across, down, part);
  std::vector<std::byte> window;
  const std::byte* pixels = nullptr;
  if (readsWindows()) {
    if (!source_->window(finer, area, window)) return false;
    pixels = window.data();
  } else {
    pixels = source_->level(finer);
    area = {0, 0, width, height};
  }
  if (pixels == nullptr) return false;
  const FinerLevel below{
      pixels, area, source_->sample(), source_->channels(), source_->hasAlpha(), nodataValues()};
  (classes ? takeMiddles : makeMeans)(below, across, down, part, out);
  return true;
}

bool Dataset::read(const tks_window& window, std::vector<std::byte>& out) {
  try {
    if (source_->cubeDepth() > 0) return source_->gridWindow(level_, window, out);
    if (level_ == 0 && readsWindows()) return source_->window(0, window, out);
    const size_t pixel = source_->pixelBytes(), row = window.width * pixel;
    if (level_ == 0) {
      const std::byte* const pixels = source_->level(0);
      if (pixels == nullptr) return false;
      const size_t line = source_->width(0) * pixel;
      out.resize(row * window.height);
      copySamples(
          {pixels + window.y * line + window.x * pixel, line, pixel, window.width, window.height},
          pixel, out.data(), row);
      return true;
    }
    out.resize(row * window.height);
    // Of classes many rows of the raster may lie below few of an overview: piece by piece.
    const uint32_t coarser = level_ - finerLevel();
    const uint32_t rows = coarser > 1 ? std::max(kPieceRows >> coarser, 1U) : window.height;
    for (uint32_t y = 0; y < window.height; y += rows) {
      const tks_window piece{window.x, window.y + y, window.width,
                             std::min(rows, window.height - y)};
      if (!makeOverview(piece, out.data() + y * row)) return false;
    }
    return true;
  } catch (const std::bad_alloc&) {
    reportFailure(TKS_NO_MEMORY, source_->name(), "");
    return false;
  }
}

}  // namespace tetrakis::gdal
