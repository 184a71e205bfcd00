// SPDX-License-Identifier: Apache-2.0
#include "apps/doors/gdal/mosaic_parts.hpp"

#include <algorithm>
#include <utility>

#include <cpl_conv.h>
#include <cpl_vsi_error.h>
#include "apps/doors/gdal/output_file.hpp"
#include "apps/doors/gdal/source.hpp"

namespace tetrakis::gdal {
namespace {

std::string placeFor(const std::string& name) {
  const bool elsewhere = CPLGetConfigOption("CPL_TMPDIR", nullptr) != nullptr;
  if (elsewhere || STARTS_WITH(name.c_str(), "/vsi")) return CPLGenerateTempFilename(".tetrakis");
  return temporaryNameFor(name);
}

}  // namespace

MosaicParts::MosaicParts(std::string file_name, VSILFILE* file)
    : file_name_(std::move(file_name)), file_(file) {
  VSIUnlink(file_name_.c_str());
}

MosaicParts::~MosaicParts() {
  VSIFCloseL(file_);
  discard(file_name_);
}

std::unique_ptr<MosaicParts> MosaicParts::beside(const std::string& name) {
  const std::string place = placeFor(name);
  VSILFILE* const file = VSIFOpenExL(place.c_str(), "wb+", TRUE);
  if (file != nullptr) return std::unique_ptr<MosaicParts>(new MosaicParts(place, file));
  const std::string why = VSIGetLastErrorMsg();
  reportFailure(TKS_IO, name, "The temporary file " + place + " cannot be written (" + why + ").");
  return nullptr;
}

tks_mosaic_files MosaicParts::files() {
  return {sizeof(tks_mosaic_files), read, length, write, this};
}

int MosaicParts::read(void* user, const char* name, uint64_t offset, uint64_t bytes, void* out,
                      uint64_t* done) {
  auto& parts = *static_cast<MosaicParts*>(user);
  const auto found = parts.places_.find(name);
  if (found == parts.places_.end() || offset > found->second.size) return 1;
  const uint64_t count = std::min(bytes, found->second.size - offset);
  if (VSIFSeekL(parts.file_, found->second.offset + offset, SEEK_SET) != 0) return 1;
  *done = VSIFReadL(out, 1, static_cast<size_t>(count), parts.file_);
  return *done == count ? 0 : 1;
}

int MosaicParts::length(void* user, const char* name, uint64_t* size) {
  const auto& parts = *static_cast<MosaicParts*>(user);
  const auto found = parts.places_.find(name);
  if (found == parts.places_.end()) return 1;
  *size = found->second.size;
  return 0;
}

int MosaicParts::write(void* user, const char* name, const void* data, size_t size) {
  auto& parts = *static_cast<MosaicParts*>(user);
  if (VSIFSeekL(parts.file_, parts.end_, SEEK_SET) != 0 ||
      VSIFWriteL(data, 1, size, parts.file_) != size)
    return 1;
  parts.places_[name] = {parts.end_, size};
  parts.end_ += size;
  return 0;
}

}  // namespace tetrakis::gdal
