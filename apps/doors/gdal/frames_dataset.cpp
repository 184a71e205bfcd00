// SPDX-License-Identifier: Apache-2.0
#include "apps/doors/gdal/frames_dataset.hpp"

#include <algorithm>
#include <utility>

#include <cpl_string.h>
#include "apps/doors/gdal/frame_times.hpp"
#include "apps/doors/gdal/subdataset_name.hpp"

namespace tetrakis::gdal {
namespace {

/// Of programs that go to and fro between two groups.
constexpr size_t kAwake = 2;
constexpr uint64_t kMostBands = 65535;

}  // namespace

std::unique_ptr<FramesDataset> FramesDataset::of(OpenSequence sequence,
                                                 std::shared_ptr<Source> first,
                                                 const char* description, char** siblings) {
  const bool prefix = sequence.settings.bytes.has_value();
  std::unique_ptr<Dataset> like = Dataset::of(std::move(first), TKS_PART_HEIGHTS);
  if (!like) return nullptr;
  std::unique_ptr<FramesDataset> dataset(new FramesDataset(std::move(sequence), std::move(like)));
  dataset->tellFacts();
  const std::string& file = dataset->name();
  dataset->SetDescription(description);
  if (file != description) dataset->SetPhysicalFilename(file.c_str());
  dataset->PamInitialize();
  const char* const beside = dataset->BuildPamFilename();
  const std::string& checksum = dataset->like_->source().checksum();
  char** const listed = file == description ? siblings : nullptr;
  const bool there = beside != nullptr && !lacks(listed, file, beside);
  if (!there || !isOfAnotherStream(beside, "", checksum)) dataset->TryLoadXML(listed);
  if (prefix) dataset->nPamFlags |= GPF_NOSAVE;
  return dataset;
}

FramesDataset::FramesDataset(OpenSequence sequence, std::unique_ptr<Dataset> first)
    : sequence_(std::move(sequence)), like_(first.get()) {
  const SequenceGroups& groups = *sequence_.groups;
  nRasterXSize = first->GetRasterXSize();
  nRasterYSize = first->GetRasterYSize();
  groups_.emplace(groups.firstFrame(), std::move(first));
  awake_.push_back(like_);
  const uint64_t frames = groups.endFrame() - groups.firstFrame();
  if (frames > kMostBands)
    CPLError(CE_Warning, CPLE_AppDefined,
             "%s: There are %llu frames, and bands of the first %llu: open others by frame=NUMBER.",
             name().c_str(), static_cast<unsigned long long>(frames),
             static_cast<unsigned long long>(kMostBands));
  for (int band = 1; band <= static_cast<int>(std::min(frames, kMostBands)); ++band)
    SetBand(band, makeFrameBand(*this, band));
}

void FramesDataset::tellFacts() {
  const SequenceGroups& groups = *sequence_.groups;
  const tks_info& info = like_->source().info();
  const bool exact = info.lossless && groups.complete();
  GDALDataset::SetMetadataItem("COMPRESSION_REVERSIBILITY", exact ? "LOSSLESS" : "LOSSY",
                               "IMAGE_STRUCTURE");
  if (const char* const registration = like_->GetMetadataItem(GDALMD_AREA_OR_POINT, ""))
    GDALDataset::SetMetadataItem(GDALMD_AREA_OR_POINT, registration);
  const auto tell = [this](const char* key, const std::string& value) {
    if (!value.empty()) GDALDataset::SetMetadataItem(key, value.c_str(), "TKS");
  };
  for (const char* const key : {"TARGET", "INDEX", "BLOCKSIZE", "DOMAIN", "VERTICAL_DATUM"}) {
    const char* const value = like_->GetMetadataItem(key, "TKS");
    tell(key, value != nullptr ? value : "");
  }
  tell("COMPLETE", groups.complete() ? "YES" : "NO");
  tell("FRAMES", std::to_string(groups.endFrame() - groups.firstFrame()));
  tell("FIRST_FRAME", std::to_string(groups.firstFrame()));
  tell("EPOCH", clock().epoch);
  tell("CALENDAR", clock().calendar);
  if (!info.has_texture) return;
  CPLStringList list = subdatasetsOf(name(), info, groups.firstFrame(), groups.endFrame());
  GDALDataset::SetMetadata(list.List(), "SUBDATASETS");
}

/// As the netCDF driver reads and writes an axis of time.
void FramesDataset::tellTimes() {
  if (times_told_) return;
  times_told_ = true;
  const std::optional<CfUnit> unit = cfUnit(clock());
  std::string numbers;
  for (int band = 1; band <= nBands; ++band) {
    const std::optional<int64_t> time = timeOf(band);
    if (!time) return;
    const double number = static_cast<double>(*time) * (unit ? unit->per_tick : 1);
    numbers += CPLSPrintf(band > 1 ? ",%.15g" : "%.15g", number);
  }
  const auto tell = [this](const char* key, const std::string& value) { times_.tell(key, value); };
  constexpr int kDouble = 6;  // NC_DOUBLE
  tell("NETCDF_DIM_EXTRA", "{time}");
  tell("NETCDF_DIM_time_DEF", CPLSPrintf("{%d,%d}", nBands, kDouble));
  tell("NETCDF_DIM_time_VALUES", "{" + numbers + "}");
  if (!unit) return;
  tell("time#units", unit->name);
  tell("time#calendar", clock().calendar.empty() ? "standard" : clock().calendar);
}

const FrameGroup* FramesDataset::groupOf(int band) {
  SequenceGroups& groups = *sequence_.groups;
  return groups.holding(groups.firstFrame() + static_cast<uint64_t>(band) - 1);
}

std::optional<int64_t> FramesDataset::timeOf(int band) {
  const FrameGroup* const group = groupOf(band);
  if (group == nullptr) return std::nullopt;
  const uint64_t frame = sequence_.groups->firstFrame() + static_cast<uint64_t>(band) - 1;
  return group->times[frame - group->first_frame];
}

GDALRasterBand* FramesDataset::frame(int band) {
  const FrameGroup* const group = groupOf(band);
  if (group == nullptr) return nullptr;
  Dataset* const dataset = opened(*group);
  if (dataset == nullptr) return nullptr;
  wake(*dataset);
  const uint64_t frame = sequence_.groups->firstFrame() + static_cast<uint64_t>(band) - 1;
  return dataset->GetRasterBand(static_cast<int>(frame - group->first_frame) + 1);
}

Dataset* FramesDataset::opened(const FrameGroup& group) {
  const auto there = groups_.find(group.first_frame);
  if (there != groups_.end()) return there->second.get();
  std::shared_ptr<Source> source =
      Source::open(name(), sequence_.file, group.stream, sequence_.settings);
  if (!source) return nullptr;
  std::unique_ptr<Dataset> dataset = Dataset::of(std::move(source), TKS_PART_HEIGHTS);
  if (!dataset || !isAlike(*dataset, group)) return nullptr;
  return groups_.emplace(group.first_frame, std::move(dataset)).first->second.get();
}

bool FramesDataset::isAlike(const Dataset& group, const FrameGroup& head) const {
  auto& dataset = const_cast<Dataset&>(group);
  const bool alike = dataset.GetRasterXSize() == nRasterXSize &&
                     dataset.GetRasterYSize() == nRasterYSize &&
                     group.source().sample() == like_->source().sample() &&
                     dataset.GetRasterCount() == static_cast<int>(head.times.size());
  if (!alike)
    reportFailure(TKS_CORRUPT, name(),
                  "The frames of the sequence are not alike: those from frame " +
                      std::to_string(head.first_frame) + " on have another size or type.");
  return alike;
}

void FramesDataset::wake(Dataset& group) {
  if (!awake_.empty() && awake_.front() == &group) return;
  std::erase(awake_, &group);
  awake_.push_front(&group);
  // What programs read of an overview of theirs wakes others, too.
  for (const auto& [frame, dataset] : groups_) {
    const auto end = awake_.begin() + static_cast<ptrdiff_t>(std::min(kAwake, awake_.size()));
    if (std::find(awake_.begin(), end, dataset.get()) == end) dataset->rest();
  }
  if (awake_.size() > kAwake) awake_.resize(kAwake);
}

CPLErr FramesDataset::GetGeoTransform(double* transform) {
  if (GDALPamDataset::GetGeoTransform(transform) == CE_None) return CE_None;
  return like_->GetGeoTransform(transform);
}

const OGRSpatialReference* FramesDataset::GetSpatialRef() const {
  const OGRSpatialReference* const pam = GDALPamDataset::GetSpatialRef();
  return pam != nullptr ? pam : like_->GetSpatialRef();
}

char** FramesDataset::GetFileList() {
  char** files = GDALPamDataset::GetFileList();
  if (CSLFindString(files, name().c_str()) < 0) files = CSLInsertString(files, 0, name().c_str());
  return files;
}

char** FramesDataset::GetMetadata(const char* domain) {
  char** const kept = GDALPamDataset::GetMetadata(domain);
  if (!ToldItems::areIn(domain)) return kept;
  tellTimes();
  return times_.with(kept);
}

const char* FramesDataset::GetMetadataItem(const char* item, const char* domain) {
  if (!ToldItems::areIn(domain)) return GDALPamDataset::GetMetadataItem(item, domain);
  tellTimes();
  const char* const told = times_.find(item);
  return told != nullptr ? told : GDALPamDataset::GetMetadataItem(item, domain);
}

CPLXMLNode* FramesDataset::SerializeToXML(const char* path) {
  const std::string& checksum = like_->source().checksum();
  CPLXMLNode* tree = withoutStreamTexts(GDALPamDataset::SerializeToXML(path), {});
  tree = withSubdatasets(tree, BuildPamFilename(), checksum);
  tellChecksum(tree, checksum);
  return tree;
}

CPLErr FramesDataset::IBuildOverviews(const char*, int, const int*, int, const int*,
                                      GDALProgressFunc, void*, CSLConstList) {
  return refuseOverviews(name());
}

}  // namespace tetrakis::gdal
