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
    if (is_written_) return GDALPamRasterBand::GetDescription();
    const_cast<FrameBand*>(this)->tellTime();
    return description_.c_str();
  }
  char** GetMetadata(const char* domain) override {
    char** const kept = GDALPamRasterBand::GetMetadata(domain);
    if (!ToldItems::areIn(domain)) return kept;
    tellTime();
    return time_.with(kept);
  }
  const char* GetMetadataItem(const char* name, const char* domain) override {
    const char* const kept = GDALPamRasterBand::GetMetadataItem(name, domain);
    if (kept != nullptr || !ToldItems::areIn(domain)) return kept;
    tellTime();
    return time_.find(name);
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

  CPLXMLNode* SerializeToXML(const char* path) override {
    is_written_ = true;
    CPLXMLNode* const tree = GDALPamRasterBand::SerializeToXML(path);
    is_written_ = false;
    return tree;
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
    time_.tell("NETCDF_DIM_time", of_netcdf);
    const std::string name = dataset().like().GetDescription();
    if (!name.empty()) time_.tell("long_name", name);
    if (!text.empty()) time_.tell("TIME", text);
    description_ = text.empty() ? "time " + of_netcdf : text;
  }

  ToldItems time_;
  std::string description_;
  bool time_told_ = false, is_written_ = false;
};

}  // namespace

GDALRasterBand* makeFrameBand(FramesDataset& dataset, int number) {
  return new FrameBand(dataset, number);
}

}  // namespace tetrakis::gdal
