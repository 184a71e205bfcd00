// SPDX-License-Identifier: Apache-2.0
// libtiff (4.5 or later: per-file error handlers) without its printing.
#include <algorithm>
#include <cstdarg>
#include <cstdio>

#include "apps/tools/files/file_bytes.hpp"
#include "apps/tools/files/pictures/tiff.hpp"

namespace tetrakis::tools {
namespace {

int swallow(TIFF*, void*, const char*, const char*, va_list) {
  return 1;
}

int keepError(TIFF*, void* text, const char*, const char* format, va_list values) {
  std::array<char, 256> line{};
  std::vsnprintf(line.data(), line.size(), format, values);
  *static_cast<std::string*>(text) = line.data();
  return 1;
}

}  // namespace

uint16_t shortTag(TIFF* tiff, uint32_t tag) {
  uint16_t value = 0;
  return TIFFGetFieldDefaulted(tiff, tag, &value) ? value : uint16_t{0};
}

uint16_t photometricOf(TIFF* tiff) {
  uint16_t value = PHOTOMETRIC_MINISBLACK;
  TIFFGetField(tiff, TIFFTAG_PHOTOMETRIC, &value);
  return value;
}

std::string tagText(TIFF* tiff, uint32_t tag) {
  const std::vector<char> text = tagValues<char>(tiff, tag, TIFF_ASCII);
  return {text.begin(), std::find(text.begin(), text.end(), '\0')};
}

Result<TiffFile> TiffFile::open(const std::string& path, const char* mode) {
  TiffFile file;
  file.error_ = std::make_unique<std::string>("not a TIFF file");
  const std::unique_ptr<TIFFOpenOptions, decltype(&TIFFOpenOptionsFree)> options(
      TIFFOpenOptionsAlloc(), TIFFOpenOptionsFree);
  if (!options) return Status(TKS_NO_MEMORY, "out of memory");
  TIFFOpenOptionsSetErrorHandlerExtR(options.get(), keepError, file.error_.get());
  TIFFOpenOptionsSetWarningHandlerExtR(options.get(), swallow, nullptr);
  file.tiff_.reset(TIFFOpenExt(path.c_str(), mode, options.get()));
  if (!file.tiff_) {
    const char* verb = *mode == 'r' ? "cannot read " : "cannot write ";
    return Status(TKS_IO, verb + quoted(path) + ": " + *file.error_);
  }
  return file;
}

Status TiffFile::failure() const {
  const char* verb = TIFFGetMode(get()) == 0 ? "cannot read " : "cannot write ";
  return {TKS_IO, verb + quoted(TIFFFileName(get())) + ": " + *error_};
}

}  // namespace tetrakis::tools
