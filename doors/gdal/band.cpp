// SPDX-License-Identifier: Apache-2.0
#include "doors/gdal/band.hpp"

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "doors/gdal/block_strips.hpp"
#include "doors/gdal/pixels.hpp"

namespace tetrakis::gdal {
namespace {

constexpr int kBlock = 256;       ///< side of blocks where there are no regions
constexpr int kWindowBlock = 64;  ///< where there are

/// GDAL's type of samples. Before GDAL 3.7 signed bytes are Byte, and the metadata item PIXELTYPE
/// says that they have a sign.
GDALDataType typeOf(tks_sample sample) {
  switch (sample) {
    case TKS_I8:
#if GDAL_VERSION_NUM >= 3070000
      return GDT_Int8;
#endif
    case TKS_U8:
      return GDT_Byte;
    case TKS_U16:
      return GDT_UInt16;
    case TKS_I16:
      return GDT_Int16;
    case TKS_U32:
      return GDT_UInt32;
    case TKS_I32:
      return GDT_Int32;
    case TKS_F32:
      break;
  }
  return GDT_Float32;
}

/// Pixels that were decoded, channels interleaved.
struct DecodedWindow {
  tks_window window;
  std::vector<std::byte> pixels;
};

class Band final : public GDALPamRasterBand {
 public:
  Band(Dataset& dataset, int number, BandFacts facts) : facts_(std::move(facts)) {
    poDS = &dataset;
    nBand = number;
    const Source& source = dataset.source();
    eDataType = typeOf(source.sample());
    nRasterXSize = static_cast<int>(source.width(dataset.level()));
    nRasterYSize = static_cast<int>(source.height(dataset.level()));
    // A window is decoded from the first block that it meets to the last one: small blocks decode
    // little around it.
    const int side = source.regionSide() == 0 ? kBlock : kWindowBlock;
    nBlockXSize = std::min(side, nRasterXSize);
    nBlockYSize = std::min(side, nRasterYSize);
    if (source.sample() == TKS_I8 && eDataType == GDT_Byte)
      GDALRasterBand::SetMetadataItem("PIXELTYPE", "SIGNEDBYTE", "IMAGE_STRUCTURE");
  }

  double GetNoDataValue(int* success) override {
    if (raster() != nullptr) return raster()->GetNoDataValue(success);
    int found = FALSE;
    const double pam = GDALPamRasterBand::GetNoDataValue(&found);
    if (success != nullptr) *success = found || facts_.nodata;
    return found ? pam : facts_.nodata.value_or(pam);
  }
  CPLErr DeleteNoDataValue() override {
    int kept = FALSE;
    GDALPamRasterBand::GetNoDataValue(&kept);
    if (!kept && facts_.nodata) return refuseToTakeOff("nodata value");
    return GDALPamRasterBand::DeleteNoDataValue();
  }
  double GetScale(int* success) override {
    if (success != nullptr) *success = scaling().isAny();
    return scaling().scale;
  }
  double GetOffset(int* success) override {
    if (success != nullptr) *success = scaling().isAny();
    return scaling().offset;
  }
  CPLErr SetScale(double scale) override { return keepScaling({scale, scaling().offset}); }
  CPLErr SetOffset(double offset) override { return keepScaling({scaling().scale, offset}); }
  const char* GetUnitType() override {
    const char* const pam = GDALPamRasterBand::GetUnitType();
    return pam != nullptr && *pam != '\0' ? pam : facts_.unit.c_str();
  }
  CPLErr SetUnitType(const char* unit) override {
    const bool none = unit == nullptr || *unit == '\0';
    if (none && !facts_.unit.empty()) return refuseToTakeOff("unit");
    return GDALPamRasterBand::SetUnitType(unit);
  }
  GDALColorInterp GetColorInterpretation() override {
    if (raster() != nullptr) return raster()->GetColorInterpretation();
    const GDALColorInterp pam = GDALPamRasterBand::GetColorInterpretation();
    return pam != GCI_Undefined ? pam : facts_.colour;
  }
  GDALColorTable* GetColorTable() override {
    return raster() != nullptr ? raster()->GetColorTable() : GDALPamRasterBand::GetColorTable();
  }
  char** GetCategoryNames() override {
    return raster() != nullptr ? raster()->GetCategoryNames()
                               : GDALPamRasterBand::GetCategoryNames();
  }

  int GetOverviewCount() override { return static_cast<int>(dataset().overviews().size()); }
  GDALRasterBand* GetOverview(int i) override {
    const auto& overviews = dataset().overviews();
    if (i < 0 || i >= static_cast<int>(overviews.size())) return nullptr;
    return overviews[static_cast<size_t>(i)]->GetRasterBand(nBand);
  }

 protected:
  CPLErr IReadBlock(int x, int y, void* out) override {
    const tks_window block{static_cast<uint32_t>(x), static_cast<uint32_t>(y), 1, 1};
    return readBlocks(grown(block), block, static_cast<std::byte*>(out));
  }

  /// Decoding one large window takes less than its blocks one by one, which take the regions around
  /// them each time: all blocks that are not in GDAL's cache are decoded together, in strips that
  /// the cache holds.
  CPLErr IRasterIO(GDALRWFlag flag, int x, int y, int width, int height, void* data, int columns,
                   int rows, GDALDataType type, GSpacing pixel, GSpacing line,
                   GDALRasterIOExtraArg* extra) override {
    const bool whole = flag == GF_Read && columns == width && rows == height;
    if (!whole || !dataset().readsWindows()) {
      return GDALPamRasterBand::IRasterIO(flag, x, y, width, height, data, columns, rows, type,
                                          pixel, line, extra);
    }
    const int strip = rowsOfStrip(width + 2 * nBlockXSize);
    for (int top = y; top < y + height;) {
      const int bottom = std::min(y + height, (top / nBlockYSize + strip) * nBlockYSize);
      if (!cacheBlocks(x, top, width, bottom - top)) return CE_Failure;
      const auto done = [&](int row) { return static_cast<double>(row - y) / height; };
      const std::unique_ptr<void, decltype(&GDALDestroyScaledProgress)> part(
          GDALCreateScaledProgress(done(top), done(bottom), extra->pfnProgress,
                                   extra->pProgressData),
          GDALDestroyScaledProgress);
      GDALRasterIOExtraArg of_strip = *extra;
      of_strip.pfnProgress = part ? GDALScaledProgress : nullptr;
      of_strip.pProgressData = part.get();
      const CPLErr read = GDALPamRasterBand::IRasterIO(
          flag, x, top, width, bottom - top, static_cast<GByte*>(data) + (top - y) * line, width,
          bottom - top, type, pixel, line, &of_strip);
      if (read != CE_None) return read;
      top = bottom;
    }
    return CE_None;
  }

 private:
  Dataset& dataset() const { return static_cast<Dataset&>(*poDS); }
  /// Of an overview: the band that it is of, which knows what is kept beside.
  GDALRasterBand* raster() const {
    return dataset().raster() == nullptr ? nullptr : dataset().raster()->GetRasterBand(nBand);
  }

  /// GDAL keeps no scale of 1 and no offset of 0 beside a file, so that both together say nothing.
  Scaling keptScaling() { return {GDALPamRasterBand::GetScale(), GDALPamRasterBand::GetOffset()}; }
  Scaling scaling() { return keptScaling().isAny() ? keptScaling() : facts_.scaling; }

  /// Another one would precede, but none would leave that of the stream.
  CPLErr refuseToTakeOff(const char* what) {
    CPLError(CE_Failure, CPLE_NotSupported,
             "%s: The stream has a %s, which cannot be taken off beside it; make a copy without.",
             dataset().source().name().c_str(), what);
    return CE_Failure;
  }

  /// Both, since one that is kept stands for both.
  CPLErr keepScaling(const Scaling& wanted) {
    if (facts_.scaling.isAny() && !wanted.isAny()) return refuseToTakeOff("scale or offset");
    const CPLErr kept = GDALPamRasterBand::SetScale(wanted.scale);
    return kept == CE_None ? GDALPamRasterBand::SetOffset(wanted.offset) : kept;
  }

  /// Rows of blocks of this width of which a quarter of the cache holds all bands; at least 1.
  int rowsOfStrip(int width) const {
    const GIntBig row = static_cast<GIntBig>(width) * nBlockYSize *
                        static_cast<GIntBig>(dataset().source().pixelBytes());
    return static_cast<int>(std::clamp<GIntBig>(GDALGetCacheMax64() / 4 / row, 1, 1 << 20));
  }

  /// What to decode where blocks are asked for.
  tks_window grown(const tks_window& blocks) {
    if (!dataset().readsWindows()) return blocks;
    const auto across = static_cast<uint32_t>(DIV_ROUND_UP(nRasterXSize, nBlockXSize));
    const auto down = static_cast<uint32_t>(DIV_ROUND_UP(nRasterYSize, nBlockYSize));
    const auto rows = static_cast<uint32_t>(rowsOfStrip(nRasterXSize));
    return strips_.grown(blocks, {across, down, rows, around(nBlockXSize), around(nBlockYSize)});
  }

  bool cached(int x, int y) {
    GDALRasterBlock* const block = TryGetLockedBlockRef(x, y);
    if (block != nullptr) block->DropLock();
    return block != nullptr;
  }

  /// The rectangle of blocks that are missing beneath one of samples.
  bool cacheBlocks(int x, int y, int width, int height) {
    int left = std::numeric_limits<int>::max(), top = left, right = -1, bottom = -1;
    for (int by = y / nBlockYSize; by <= (y + height - 1) / nBlockYSize; ++by) {
      for (int bx = x / nBlockXSize; bx <= (x + width - 1) / nBlockXSize; ++bx) {
        if (cached(bx, by)) continue;
        left = std::min(left, bx);
        top = std::min(top, by);
        right = std::max(right, bx);
        bottom = std::max(bottom, by);
      }
    }
    if (right < 0) return true;
    const tks_window blocks{static_cast<uint32_t>(left), static_cast<uint32_t>(top),
                            static_cast<uint32_t>(right - left + 1),
                            static_cast<uint32_t>(bottom - top + 1)};
    return readBlocks(grown(blocks), blocks, nullptr) == CE_None;
  }

  /// Decodes a rectangle of blocks. The channel of the first one that is asked for goes to `out` if
  /// that is given, everything else into the cache.
  CPLErr readBlocks(const tks_window& blocks, const tks_window& asked, std::byte* out) {
    const uint32_t x = blocks.x * nBlockXSize, y = blocks.y * nBlockYSize;
    DecodedWindow decoded{{x, y, std::min<uint32_t>(blocks.width * nBlockXSize, nRasterXSize - x),
                           std::min<uint32_t>(blocks.height * nBlockYSize, nRasterYSize - y)},
                          {}};
    if (!dataset().read(decoded.window, decoded.pixels)) return CE_Failure;
    const auto own = [&](int band, uint32_t bx, uint32_t by) {
      return out != nullptr && band == nBand && bx == asked.x && by == asked.y;
    };
    for (int band = 1; band <= poDS->GetRasterCount(); ++band) {
      for (uint32_t by = blocks.y; by < blocks.y + blocks.height; ++by) {
        for (uint32_t bx = blocks.x; bx < blocks.x + blocks.width; ++bx) {
          if (own(band, bx, by)) {
            spread(decoded, band, bx, by, out);
          } else if (!intoCache(decoded, band, bx, by)) {
            return CE_Failure;
          }
        }
      }
    }
    return CE_None;
  }

  bool intoCache(const DecodedWindow& decoded, int band, uint32_t bx, uint32_t by) {
    Band& other = static_cast<Band&>(*poDS->GetRasterBand(band));
    const int x = static_cast<int>(bx), y = static_cast<int>(by);
    if (other.cached(x, y)) return true;
    GDALRasterBlock* const block = other.GetLockedBlockRef(x, y, TRUE);
    if (block == nullptr) return false;
    spread(decoded, band, bx, by, static_cast<std::byte*>(block->GetDataRef()));
    block->DropLock();
    return true;
  }

  /// One block of one channel out of the pixels of a window.
  void spread(const DecodedWindow& decoded, int band, uint32_t bx, uint32_t by,
              std::byte* to) const {
    const tks_window& window = decoded.window;
    const size_t sample = tks_sample_bytes(dataset().source().sample());
    const size_t pixel = dataset().source().pixelBytes();
    const uint32_t x = bx * nBlockXSize - window.x, y = by * nBlockYSize - window.y;
    const size_t row = window.width * pixel;
    const Pixels from{decoded.pixels.data() + y * row + x * pixel + (band - 1) * sample, row, pixel,
                      std::min<uint32_t>(nBlockXSize, window.width - x),
                      std::min<uint32_t>(nBlockYSize, window.height - y)};
    copySamples(from, sample, to, nBlockXSize * sample);
  }

  /// Columns, or rows, of blocks around some that are decoded with them: coefficients of coarse
  /// levels reach far, and regions are decoded whole.
  uint32_t around(int side) const {
    constexpr uint32_t kReach = 256;
    const auto blocks = static_cast<uint32_t>(side);
    const uint32_t regions = std::max(dataset().source().regionSide(), blocks);
    return 2 * DIV_ROUND_UP(kReach, blocks) + regions / blocks - 1;
  }

  BandFacts facts_;
  BlockStrips strips_;
};

}  // namespace

GDALRasterBand* makeBand(Dataset& dataset, int number, BandFacts facts) {
  return new Band(dataset, number, std::move(facts));
}

}  // namespace tetrakis::gdal
