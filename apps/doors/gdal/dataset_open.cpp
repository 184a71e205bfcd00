// SPDX-License-Identifier: Apache-2.0
// What a name opens.
#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "apps/doors/gdal/dataset.hpp"
#include "apps/doors/gdal/frames_dataset.hpp"
#include "apps/doors/gdal/sequence_groups.hpp"
#include "apps/doors/gdal/settings.hpp"
#include "apps/doors/gdal/subdataset_name.hpp"

namespace tetrakis::gdal {
namespace {

using Magic = std::array<uint8_t, 4>;
constexpr Magic kStream = {'T', 'K', 'S', 0x1A};

bool isFileOfOurs(const GDALOpenInfo& info) {
  Magic magic{};
  if (info.nHeaderBytes < static_cast<int>(magic.size())) return false;
  std::copy_n(info.pabyHeader, magic.size(), magic.begin());
  return magic == kStream || isSequence(magic);
}

/// What is asked for.
struct Request {
  const char* description;
  std::optional<SubdatasetName> named;  ///< nothing: all of the file
  std::string file;
  OpenSettings settings;
  char** siblings;

  tks_part partOf(const Source& source) const {
    const tks_part first = source.info().has_heights ? TKS_PART_HEIGHTS : TKS_PART_TEXTURE;
    const tks_part part = source.askedPart().value_or(first);
    return named ? named->part.value_or(part) : part;
  }
  std::optional<uint64_t> frame() const { return named ? named->frame : std::nullopt; }
};

/// The name that its place beside the file has: "" of what the file's own name opens.
std::string placeBeside(const Request& request, const Source& source, tks_part part) {
  if (request.frame()) return selectionOf(*request.named);
  const std::optional<uint32_t> number = source.takenFor(part);
  if (number && !source.isFirst(*number))
    return selectionOf({"", std::nullopt, std::nullopt, std::to_string(*number)});
  return part == TKS_PART_TEXTURE && source.info().has_heights ? partName(part) : "";
}

/// A component of a stream, all its frames or one.
std::unique_ptr<Dataset> openPart(const Request& request, std::shared_ptr<Source> source,
                                  std::optional<uint32_t> frame) {
  const tks_part part = request.partOf(*source);
  const std::string place = placeBeside(request, *source, part);
  std::unique_ptr<Dataset> dataset = Dataset::of(std::move(source), part, frame);
  if (!dataset) return nullptr;
  if (request.named || !request.settings.component.empty()) {
    dataset->beSubdataset(request.description, place, request.siblings);
  } else {
    dataset->beFile(request.siblings);
  }
  if (request.settings.bytes) dataset->keepNothing();
  return dataset;
}

GDALDataset* openStream(const Request& request, const File& file) {
  std::shared_ptr<Source> source = Source::open(request.file, file, {}, request.settings);
  if (!source) return nullptr;
  const std::optional<uint64_t> frame = request.frame();
  if (frame && *frame >= source->info().frames) {
    reportFailure(TKS_USAGE, request.file,
                  "The stream has no frame " + std::to_string(*frame) + ".");
    return nullptr;
  }
  const auto shown = frame ? std::optional(static_cast<uint32_t>(*frame)) : std::nullopt;
  return openPart(request, std::move(source), shown).release();
}

GDALDataset* openSequence(const Request& request, const File& file) {
  if (!request.settings.component.empty()) {
    reportFailure(TKS_USAGE, request.file, "The file is a sequence, which has no COMPONENT.");
    return nullptr;
  }
  std::unique_ptr<SequenceGroups> groups =
      SequenceGroups::open(request.file, file, request.settings);
  if (!groups) return nullptr;
  const uint64_t frame = request.frame().value_or(groups->firstFrame());
  const FrameGroup* const group = groups->holding(frame);
  if (group == nullptr) return nullptr;
  std::shared_ptr<Source> source =
      Source::open(request.file, file, group->stream, request.settings);
  if (!source) return nullptr;
  if (!request.frame() && request.partOf(*source) == TKS_PART_HEIGHTS)
    return FramesDataset::of({std::move(groups), file, request.settings}, std::move(source),
                             request.description, request.siblings)
        .release();
  return openPart(request, std::move(source), static_cast<uint32_t>(frame - group->first_frame))
      .release();
}

/// A component is named by the name of the dataset, or by the option. False after a reported error.
bool takeNamedComponent(Request& request) {
  if (!request.named || request.named->component.empty()) return true;
  if (!request.settings.component.empty()) {
    reportFailure(TKS_USAGE, request.file,
                  "COMPONENT and a name with component= exclude each other.");
    return false;
  }
  request.settings.component = request.named->component;
  return true;
}

}  // namespace

int Dataset::Identify(GDALOpenInfo* info) {
  return isFileOfOurs(*info) || isSubdatasetName(info->pszFilename);
}

GDALDataset* Dataset::Open(GDALOpenInfo* info) {
  if (!Identify(info)) return nullptr;
  Request request{
      info->pszFilename, {}, info->pszFilename, OpenSettings(), info->GetSiblingFiles()};
  if (!isFileOfOurs(*info)) {
    request.named = subdatasetName(info->pszFilename);
    if (!request.named) return nullptr;
    request.file = request.named->file;
  }
  if (info->eAccess == GA_Update) {
    CPLError(CE_Failure, CPLE_NotSupported,
             "%s: A stream cannot be changed in place; open it read-only and make a copy.",
             request.file.c_str());
    return nullptr;
  }
  const std::optional<OpenSettings> settings = openSettings(request.file, info->papszOpenOptions);
  if (!settings) return nullptr;
  request.settings = *settings;
  if (!takeNamedComponent(request)) return nullptr;
  const File file = openFile(request.file);
  if (!file) {
    reportFailure(TKS_IO, request.file, "The file cannot be opened.");
    return nullptr;
  }
  Magic magic{};
  const bool read = VSIFReadL(magic.data(), 1, magic.size(), file.get()) == magic.size();
  return read && isSequence(magic) ? openSequence(request, file) : openStream(request, file);
}

}  // namespace tetrakis::gdal
