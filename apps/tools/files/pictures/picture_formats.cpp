// SPDX-License-Identifier: Apache-2.0
// Loading the module of picture formats.
#include "apps/tools/files/pictures/picture_formats.hpp"

#include <dlfcn.h>

namespace tetrakis::tools {
namespace {

/// Never unloaded: libraries that it brings start threads.
Result<const PictureFormats*> load() {
  // Found by the run path of the executable. Other libraries' symbols stay out of ours.
  void* const module = dlopen("tetrakis_pictures.so", RTLD_LAZY | RTLD_LOCAL);
  using Formats = const PictureFormats*();
  auto* const formats =
      module ? reinterpret_cast<Formats*>(dlsym(module, "tetrakis_picture_formats")) : nullptr;
  if (formats) return formats();
  const char* const reason = dlerror();
  return Status(TKS_IO, std::string("the picture formats cannot be loaded: ") +
                            (reason ? reason : "they are of another version"));
}

}  // namespace

size_t sizeOf(PictureSample sample) {
  switch (sample) {
    case PictureSample::kU8:
    case PictureSample::kI8:
      return 1;
    case PictureSample::kU16:
    case PictureSample::kI16:
    case PictureSample::kHalf:
      return 2;
    case PictureSample::kU32:
    case PictureSample::kI32:
    case PictureSample::kFloat:
      return 4;
    case PictureSample::kDouble:
    case PictureSample::kOther:
      break;
  }
  return 8;
}

Result<const PictureFormats*> pictureFormats() {
  static const Result<const PictureFormats*> formats = load();
  return formats;
}

}  // namespace tetrakis::tools
