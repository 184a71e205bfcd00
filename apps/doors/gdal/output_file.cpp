// SPDX-License-Identifier: Apache-2.0
#include "apps/doors/gdal/output_file.hpp"

#include <utility>

#include <cpl_conv.h>
#include <cpl_string.h>
#include <cpl_vsi.h>
#include <cpl_vsi_error.h>
#include "apps/doors/gdal/source.hpp"

namespace tetrakis::gdal {
namespace {

/// A device, a pipe or a folder.
bool isNoFile(const std::string& name) {
  VSIStatBufL stat;
  return VSIStatL(name.c_str(), &stat) == 0 && !VSI_ISREG(stat.st_mode);
}

VSILFILE* openToWrite(const std::string& file, const std::string& name) {
  VSILFILE* const out = VSIFOpenExL(file.c_str(), "wb", TRUE);
  if (out != nullptr) return out;
  const std::string why = VSIGetLastErrorMsg();
  reportFailure(TKS_IO, name,
                "The file cannot be written" + (why.empty() ? "." : " (" + why + ")."));
  return nullptr;
}

bool failToWrite(const std::string& name) {
  reportFailure(TKS_IO, name, "The file cannot be written whole: is the disk full?");
  return false;
}

bool writeDirectly(const std::string& name, std::span<const uint8_t> bytes) {
  VSILFILE* const out = openToWrite(name, name);
  if (out == nullptr) return false;
  const bool written = VSIFWriteL(bytes.data(), 1, bytes.size(), out) == bytes.size();
  if (VSIFCloseL(out) == 0 && written) return true;
  discard(name);
  return failToWrite(name);
}

}  // namespace

std::string temporaryNameFor(const std::string& name) {
  const std::string unique = CPLGenerateTempFilename(".tetrakis");
  if (!canBeRenamed(name)) return unique;
  const std::string folder = CPLGetPath(name.c_str());
  return CPLFormFilename(folder.c_str(), CPLGetFilename(unique.c_str()), nullptr);
}

bool canBeRenamed(const std::string& name) {
  return !STARTS_WITH(name.c_str(), "/vsi") || STARTS_WITH(name.c_str(), "/vsimem/");
}

bool isFile(const std::string& name) {
  VSIStatBufL stat;
  return VSIStatL(name.c_str(), &stat) == 0 && VSI_ISREG(stat.st_mode);
}

void discard(const std::string& name) {
  if (isFile(name)) VSIUnlink(name.c_str());
}

StagedFile::StagedFile(std::string name)
    : name_(std::move(name)), staged_(temporaryNameFor(name_)) {}

StagedFile::~StagedFile() {
  if (file_ == nullptr) return;
  VSIFCloseL(file_);
  VSIUnlink(staged_.c_str());
}

bool StagedFile::open() {
  file_ = openToWrite(staged_, name_);
  return file_ != nullptr;
}

bool StagedFile::write(uint64_t offset, std::span<const uint8_t> bytes) {
  if (VSIFSeekL(file_, offset, SEEK_SET) == 0 &&
      VSIFWriteL(bytes.data(), 1, bytes.size(), file_) == bytes.size())
    return true;
  return failToWrite(name_);
}

bool StagedFile::finish() {
  const bool closed = VSIFCloseL(std::exchange(file_, nullptr)) == 0;
  if (closed && VSIRename(staged_.c_str(), name_.c_str()) == 0) return true;
  VSIUnlink(staged_.c_str());
  if (!closed) return failToWrite(name_);
  reportFailure(TKS_IO, name_, "The file cannot be written: it cannot be given its name.");
  return false;
}

bool writeFile(const std::string& name, std::span<const uint8_t> bytes) {
  if (!canBeRenamed(name) || isNoFile(name)) return writeDirectly(name, bytes);
  StagedFile file(name);
  return file.open() && file.write(0, bytes) && file.finish();
}

}  // namespace tetrakis::gdal
