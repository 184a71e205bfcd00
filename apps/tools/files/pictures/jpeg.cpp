// SPDX-License-Identifier: Apache-2.0
// JPEG by libjpeg-turbo (TurboJPEG API).
#include "apps/tools/files/pictures/jpeg.hpp"

#include <turbojpeg.h>

#include <memory>
#include <span>

#include "apps/tools/files/files.hpp"

namespace tetrakis::tools {
namespace {

struct DestroyHandle {
  void operator()(void* handle) const { tjDestroy(handle); }
};
struct FreeBuffer {
  void operator()(unsigned char* buffer) const { tjFree(buffer); }
};

/// What the decoder warns of; empty: nothing. Entropy decoding alone: a transform that transforms
/// nothing and is not written.
std::string warningOf(void* handle, std::span<const std::byte> bytes, int flags) {
  tjtransform nothing{};
  nothing.options = TJXOPT_NOOUTPUT;
  unsigned char* none = nullptr;
  unsigned long size = 0;
  const int failed = tjTransform(handle, reinterpret_cast<const unsigned char*>(bytes.data()),
                                 bytes.size(), 1, &none, &size, &nothing, flags);
  const std::unique_ptr<unsigned char, FreeBuffer> owner(none);
  return failed ? tjGetErrorStr2(handle) : "";
}

/// Some cameras write padding, which is no damage.
bool isHarmless(const std::string& warning) {
  return warning.empty() || warning.find("extraneous bytes") != std::string::npos;
}

}  // namespace

Status checkJpeg(std::span<const std::byte> bytes, const std::string& name) {
  const std::unique_ptr<void, DestroyHandle> handle(tjInitTransform());
  if (!handle) return {TKS_NO_MEMORY, "out of memory"};
  std::string warning = warningOf(handle.get(), bytes, TJFLAG_STOPONWARNING);
  if (!warning.empty() && isHarmless(warning)) warning = warningOf(handle.get(), bytes, 0);
  if (isHarmless(warning)) return {};
  return {TKS_IO, "cannot read " + name + ": " + warning};
}

Result<std::vector<std::byte>> encodeJpeg(const ImageFile& image, int quality) {
  constexpr uint32_t kMaxSide = 65500;  // JPEG_MAX_DIMENSION
  if (image.sample != TKS_U8 || (image.channels != 1 && image.channels != 3)) {
    return Status(TKS_USAGE, "JPEG holds 8-bit grey or RGB: write a .png instead");
  }
  if (image.width > kMaxSide || image.height > kMaxSide) {
    return Status(TKS_USAGE, "JPEG holds at most 65500 x 65500 pixels: write a .png instead");
  }
  const std::unique_ptr<void, DestroyHandle> handle(tjInitCompress());
  if (!handle) return Status(TKS_NO_MEMORY, "out of memory");
  unsigned char* buffer = nullptr;
  unsigned long size = 0;
  const bool grey = image.channels == 1;
  const int failed = tjCompress2(
      handle.get(), reinterpret_cast<const unsigned char*>(image.data.data()),
      static_cast<int>(image.width), 0, static_cast<int>(image.height), grey ? TJPF_GRAY : TJPF_RGB,
      &buffer, &size, grey ? TJSAMP_GRAY : TJSAMP_444, quality, TJFLAG_ACCURATEDCT);
  const std::unique_ptr<unsigned char, FreeBuffer> owner(buffer);
  if (failed) {
    return Status(TKS_USAGE, std::string("cannot encode JPEG: ") + tjGetErrorStr2(handle.get()));
  }
  const auto bytes = std::as_bytes(std::span(buffer, size));
  return std::vector<std::byte>(bytes.begin(), bytes.end());
}

}  // namespace tetrakis::tools
