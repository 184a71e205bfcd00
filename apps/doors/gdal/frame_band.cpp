// SPDX-License-Identifier: Apache-2.0
// The band of a frame. What all frames have in common is that of the first one, so that nothing of
// a frame is read before its samples are asked for.
#include <cstring>
#include <string>

#include <cpl_string.h>
#include "apps/doors/gdal/frame_times.hpp"
#include "apps/doors/gdal/frames_dataset.hpp"

namespace tetrakis::gdal {
namespace {

class FrameBand final : public GDALPamRasterBand {
 public:
  FrameBand(FramesDataset& dataset, int number) {
    poDS = &dataset;
    nBand = number;
    GDALRasterBand& like = dataset.like();
    eDataType = like.GetRasterDataType();
    nRasterXSize = like.GetXSize();
    nRasterYSize = like.GetYSize();
    like.GetBlockSize(&nBlockXSize, &nBlockYSize);
    if (const char* const type = like.GetMetadataItem("PIXELTYPE", "IMAGE_STRUCTURE"))
      GDALRasterBand::SetMetadataItem("PIXELTYPE", type, "IMAGE_STRUCTURE");
  }

  double GetNoDataValue(int* success) override {
    int kept = FALSE;
    const double nodata = GDALPamRasterBand::GetNoDataValue(&kept);
    if (!kept) return like().GetNoDataValue(success);
    if (success != nullptr) *success = TRUE;
    return nodata;
  }
  double GetScale(int* success) override { return like().GetScale(success); }
  double GetOffset(int* success) override { return like().GetOffset(success); }
  const char* GetUnitType() override { return like().GetUnitType(); }
  GDALColorInterp GetColorInterpretation() override { return GCI_Undefined; }

  const char* GetDescription() const override {
    const_cast<FrameBand*>(this)->tellTime();
    return GDALPamRasterBand::GetDescription();
  }
  char** GetMetadata(const char* domain) override {
    tellTime();
    return GDALPamRasterBand::GetMetadata(domain);
  }
  const char* GetMetadataItem(const char* name, const char* domain) override {
    tellTime();
    return GDALPamRasterBand::GetMetadataItem(name, domain);
  }

  int GetOverviewCount() override { return like().GetOverviewCount(); }
  GDALRasterBand* GetOverview(int i) override {
    GDALRasterBand* const of_group = frame();
    return of_group != nullptr ? of_group->GetOverview(i) : nullptr;
  }

 protected:
  CPLErr IReadBlock(int x, int y, void* out) override {
    GDALRasterBand* const of_group = frame();
    GDALRasterBlock* const block =
        of_group != nullptr ? of_group->GetLockedBlockRef(x, y) : nullptr;
    if (block == nullptr) return CE_Failure;
    std::memcpy(out, block->GetDataRef(), static_cast<size_t>(block->GetBlockSize()));
    block->DropLock();
    return CE_None;
  }

  CPLErr IRasterIO(GDALRWFlag flag, int x, int y, int width, int height, void* data, int columns,
                   int rows, GDALDataType type, GSpacing pixel, GSpacing line,
                   GDALRasterIOExtraArg* extra) override {
    GDALRasterBand* const of_group = frame();
    if (of_group == nullptr) return CE_Failure;
    return of_group->RasterIO(flag, x, y, width, height, data, columns, rows, type, pixel, line,
                              extra);
  }

 private:
  FramesDataset& dataset() const { return static_cast<FramesDataset&>(*poDS); }
  GDALRasterBand& like() const { return dataset().like(); }
  GDALRasterBand* frame() { return dataset().frame(nBand); }

  void tellTime() {
    if (time_told_) return;
    time_told_ = true;
    const std::optional<int64_t> time = dataset().timeOf(nBand);
    if (!time) return;
    const SequenceClock& clock = dataset().clock();
    const std::optional<CfUnit> unit = cfUnit(clock);
    const double number = static_cast<double>(*time) * (unit ? unit->per_tick : 1);
    const std::string of_netcdf = CPLSPrintf("%.15g", number), text = rfc3339(clock, *time);
    GDALRasterBand::SetMetadataItem("NETCDF_DIM_time", of_netcdf.c_str());
    if (*dataset().like().GetDescription() != '\0')
      GDALRasterBand::SetMetadataItem("long_name", dataset().like().GetDescription());
    if (!text.empty()) GDALRasterBand::SetMetadataItem("TIME", text.c_str());
    GDALRasterBand::SetDescription(text.empty() ? ("time " + of_netcdf).c_str() : text.c_str());
  }

  bool time_told_ = false;
};

}  // namespace

GDALRasterBand* makeFrameBand(FramesDataset& dataset, int number) {
  return new FrameBand(dataset, number);
}

}  // namespace tetrakis::gdal
