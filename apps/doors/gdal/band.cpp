// SPDX-License-Identifier: Apache-2.0
#include "apps/doors/gdal/band.hpp"

#include <algorithm>
#include <memory>
#include <utility>

namespace tetrakis::gdal {
namespace {

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

class Band final : public GDALPamRasterBand {
 public:
  Band(Dataset& dataset, int number, BandFacts facts) : facts_(std::move(facts)) {
    poDS = &dataset;
    nBand = number;
    const Source& source = dataset.source();
    eDataType = typeOf(source.sample());
    nRasterXSize = static_cast<int>(source.width(dataset.level()));
    nRasterYSize = static_cast<int>(source.height(dataset.level()));
    const int side = blockSide(source);
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
    const bool read = dataset().blocks().read(
        *this, static_cast<uint32_t>(x), static_cast<uint32_t>(y), static_cast<std::byte*>(out));
    return read ? CE_None : CE_Failure;
  }

  CPLErr IRasterIO(GDALRWFlag flag, int x, int y, int width, int height, void* data, int columns,
                   int rows, GDALDataType type, GSpacing pixel, GSpacing line,
                   GDALRasterIOExtraArg* extra) override {
    const bool whole = flag == GF_Read && columns == width && rows == height;
    if (!whole || !dataset().readsWindows()) {
      return GDALPamRasterBand::IRasterIO(flag, x, y, width, height, data, columns, rows, type,
                                          pixel, line, extra);
    }
    const auto read = [&](int top, int bottom, GDALRasterIOExtraArg* of_strip) {
      return GDALPamRasterBand::IRasterIO(flag, x, top, width, bottom - top,
                                          static_cast<GByte*>(data) + (top - y) * line, width,
                                          bottom - top, type, pixel, line, of_strip);
    };
    return dataset().readStrips({x, y, width, height}, {&nBand, 1}, *extra, read);
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

  BandFacts facts_;
};

}  // namespace

GDALRasterBand* makeBand(Dataset& dataset, int number, BandFacts facts) {
  return new Band(dataset, number, std::move(facts));
}

}  // namespace tetrakis::gdal
