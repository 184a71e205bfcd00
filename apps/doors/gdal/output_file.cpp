// SPDX-License-Identifier: Apache-2.0
#include "apps/doors/gdal/output_file.hpp"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <cpl_vsi.h>
#include <cpl_vsi_error.h>
#include "apps/doors/gdal/source.hpp"

namespace tetrakis::gdal {
namespace {

/// Other file systems of GDAL show a file when it is closed, or pass on what is written.
bool canBeRenamed(const std::string& name) {
  return !STARTS_WITH(name.c_str(), "/vsi") || STARTS_WITH(name.c_str(), "/vsimem/");
}

/// A device, a pipe or a folder.
bool isNoFile(const std::string& name) {
  VSIStatBufL stat;
  return VSIStatL(name.c_str(), &stat) == 0 && !VSI_ISREG(stat.st_mode);
}

bool writeTo(const std::string& file, const std::string& name, std::span<const uint8_t> bytes) {
  VSILFILE* const out = VSIFOpenExL(file.c_str(), "wb", TRUE);
  if (out == nullptr) {
    const std::string why = VSIGetLastErrorMsg();
    reportFailure(TKS_IO, name,
                  "The file cannot be written" + (why.empty() ? "." : " (" + why + ")."));
    return false;
  }
  const bool written = VSIFWriteL(bytes.data(), 1, bytes.size(), out) == bytes.size();
  if (VSIFCloseL(out) == 0 && written) return true;
  discard(file);
  reportFailure(TKS_IO, name, "The file cannot be written whole: is the disk full?");
  return false;
}

}  // namespace

std::string temporaryNameFor(const std::string& name) {
  const std::string unique = CPLGenerateTempFilename(".tetrakis");
  if (!canBeRenamed(name)) return unique;
  const std::string folder = CPLGetPath(name.c_str());
  return CPLFormFilename(folder.c_str(), CPLGetFilename(unique.c_str()), nullptr);
}

bool isFile(const std::string& name) {
  VSIStatBufL stat;
  return VSIStatL(name.c_str(), &stat) == 0 && VSI_ISREG(stat.st_mode);
}

void discard(const std::string& name) {
  if (isFile(name)) VSIUnlink(name.c_str());
}

bool writeFile(const std::string& name, std::span<const uint8_t> bytes) {
  if (!canBeRenamed(name) || isNoFile(name)) return writeTo(name, name, bytes);
  const std::string staged = temporaryNameFor(name);
  if (!writeTo(staged, name, bytes)) return false;
  if (VSIRename(staged.c_str(), name.c_str()) == 0) return true;
  VSIUnlink(staged.c_str());
  reportFailure(TKS_IO, name, "The file cannot be written: it cannot be given its name.");
  return false;
}

}  // namespace tetrakis::gdal
