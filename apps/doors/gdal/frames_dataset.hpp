// SPDX-License-Identifier: Apache-2.0
// The heights of a sequence as a dataset with a band for each frame. Each group of frames is a
// dataset of its own, which is opened when one of its bands is read.
#pragma once

#include <deque>
#include <map>
#include <memory>
#include <string>

#include <cpl_string.h>
#include <gdal_pam.h>
#include "apps/doors/gdal/dataset.hpp"
#include "apps/doors/gdal/sequence_groups.hpp"

namespace tetrakis::gdal {

/// A sequence in an open file.
struct OpenSequence {
  std::unique_ptr<SequenceGroups> groups;
  File file;
  OpenSettings settings;
};

/// Items of the plain domain that the stream tells once they are asked for. They are not PAM's,
/// which would keep them beside the file.
class ToldItems {
 public:
  static bool areIn(const char* domain) { return domain == nullptr || *domain == '\0'; }

  void tell(const char* key, const std::string& value) { told_.SetNameValue(key, value.c_str()); }
  const char* find(const char* key) const { return told_.FetchNameValue(key); }
  /// With others. Valid until the next call.
  char** with(CSLConstList others) {
    all_.Assign(CSLMerge(CSLDuplicate(others), told_.List()), TRUE);
    return all_.List();
  }

 private:
  CPLStringList told_, all_;
};

class FramesDataset final : public GDALPamDataset {
 public:
  /// first: of the first group. Null after a reported error.
  static std::unique_ptr<FramesDataset> of(OpenSequence sequence, std::shared_ptr<Source> first,
                                           const char* description, char** siblings);
  /// What is kept beside is written while SerializeToXML is still this class's.
  ~FramesDataset() override { FlushCache(true); }

  CPLErr GetGeoTransform(double* transform) override;
  const OGRSpatialReference* GetSpatialRef() const override;
  char** GetFileList() override;
  char** GetMetadata(const char* domain) override;
  const char* GetMetadataItem(const char* name, const char* domain) override;

  const std::string& name() const { return sequence_.groups->name(); }
  const SequenceClock& clock() const { return sequence_.groups->clock(); }
  /// What all frames are like.
  GDALRasterBand& like() const { return *like_->GetRasterBand(1); }
  /// The time of a band, from 1 on, in ticks; nothing after a reported error.
  std::optional<int64_t> timeOf(int band);
  /// The band of the group that a band is. Null after a reported error.
  GDALRasterBand* frame(int band);

 protected:
  CPLXMLNode* SerializeToXML(const char* path) override;
  CPLErr IBuildOverviews(const char* resampling, int count, const int* factors, int bands,
                         const int* band_list, GDALProgressFunc progress, void* user,
                         CSLConstList options) override;

 private:
  FramesDataset(OpenSequence sequence, std::unique_ptr<Dataset> first);
  void tellFacts();
  void tellTimes();
  const FrameGroup* groupOf(int band);
  Dataset* opened(const FrameGroup& group);
  bool isAlike(const Dataset& group, const FrameGroup& head) const;
  /// Only the last groups that were read keep what they have decoded.
  void wake(Dataset& group);

  OpenSequence sequence_;
  std::map<uint64_t, std::unique_ptr<Dataset>> groups_;  ///< by the first frames
  Dataset* like_;
  std::deque<Dataset*> awake_;
  ToldItems times_;
  bool times_told_ = false;
};

/// GDAL owns it.
GDALRasterBand* makeFrameBand(FramesDataset& dataset, int number);

}  // namespace tetrakis::gdal
