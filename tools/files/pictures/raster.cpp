// SPDX-License-Identifier: Apache-2.0
// Pictures: which library reads them.
#include "tools/files/pictures/raster.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <exception>
#include <fstream>
#include <new>
#include <system_error>
#include <utility>

#include "tools/files/memory_limit.hpp"
#include "tools/files/pictures/plain_tiff.hpp"
#include "tools/files/pictures/png.hpp"
#include "tools/files/pictures/stored_form.hpp"
#include "tools/files/pictures/tiff.hpp"

namespace tetrakis::tools {
namespace {

Status unreadable(const std::string& name, const std::string& reason) {
  return {TKS_IO, "cannot read " + name + ": " + firstLine(reason)};
}

Status outOfMemory(const std::string& name) {
  return {TKS_NO_MEMORY, name + " does not fit in memory"};
}

Result<bool> startsAsPng(const InputFile& file, const std::string& name) {
  std::array<char, 4> head{};
  std::ifstream stream(file.path(), std::ios::binary);
  if (!stream) return unreadable(name, std::generic_category().message(errno));
  stream.read(head.data(), head.size());
  return isPng(std::as_bytes(std::span(head).first(static_cast<size_t>(stream.gcount()))));
}

Result<Raster> openPng(InputFile file, const std::string& name) {
  const auto bytes = readBytes(file.path());
  if (!bytes.ok()) return bytes.status();
  auto png = decodePng(*bytes, name);
  if (!png.ok()) return png.status();
  const ImageFile& image = png->image;
  Raster raster{std::move(file), name, nullptr, shapeOf(image)};
  raster.stored_bits = png->stored_bits;
  raster.palette = png->palette;
  raster.profile = png->profile;
  raster.orientation = png->orientation;
  raster.further_pages = png->animated;
  raster.decoded = std::move(png->image.data);
  return raster;
}

Result<std::unique_ptr<PictureReader>> openByOpenImageIo(const std::string& path) {
  const auto formats = pictureFormats();
  if (!formats.ok()) return formats.status();
  auto reader = (*formats)->open(path);
  if (!reader.ok() &&
      reader.status().message().find("could not find a format reader") != std::string::npos) {
    return Status(TKS_IO,
                  "it is in no known picture format; of what GDAL reads gdal_translate IN OUT.tif "
                  "makes a TIFF");
  }
  return reader;
}

Result<Raster> openUnguarded(const std::string& path) {
  auto file = InputFile::open(path);
  if (!file.ok()) return file.status();
  const auto png = startsAsPng(*file, quoted(path));
  if (!png.ok()) return png.status();
  if (*png) return openPng(std::move(*file), quoted(path));
  Raster raster{std::move(*file), quoted(path), nullptr, {}};
  raster.reader = openPlainTiff(raster.file.path());
  raster.plain = raster.reader != nullptr;
  if (!raster.plain) {
    const Status taken = checkTiffSamples(raster.file.path(), raster.name);
    if (!taken.ok()) return taken;
    auto reader = openByOpenImageIo(raster.file.path());
    if (!reader.ok()) return unreadable(raster.name, reader.status().message());
    raster.reader = std::move(*reader);
  }
  raster.shape = raster.reader->shape();
  if (raster.shape.depth > 1 || raster.shape.width < 1 || raster.shape.height < 1) {
    return Status(TKS_USAGE, raster.name + " is not a flat picture");
  }
  Status status = checkSize(raster.name, raster.shape.samples(), sizeOf(raster.shape.sample));
  if (status.ok()) status = noteStoredForm(raster);
  if (!status.ok()) return status;
  return raster;
}

}  // namespace

std::string firstLine(std::string message) {
  message.resize(std::min(message.size(), message.find('\n')));
  while (message.ends_with('.')) message.pop_back();
  return message.empty() ? "it ends early or is damaged" : message;
}

Status checkSize(const std::string& name, uint64_t samples, size_t sample_bytes) {
  constexpr uint64_t kCopies = 2;  // as read, and in the order that is wanted
  if (samples > kMaxSamples) return {TKS_LIMIT, name + " has more than 2^32 samples"};
  return checkMemoryFor("reading " + name, kCopies * samples * sample_bytes);
}

Result<Raster> openRaster(const std::string& path) {
  try {
    return openUnguarded(path);
  } catch (const std::bad_alloc&) {
    return outOfMemory(quoted(path));
  } catch (const std::exception& error) {
    return unreadable(quoted(path), error.what());
  }
}

PictureShape shapeOf(const ImageFile& image) {
  return {static_cast<int>(image.width), static_cast<int>(image.height),
          static_cast<int>(image.channels),
          image.sample == TKS_U8 ? PictureSample::kU8 : PictureSample::kU16};
}

Result<std::vector<std::byte>> readSamples(Raster& raster, PictureSample type) {
  if (!raster.reader) return std::move(raster.decoded);
  try {
    std::vector<std::byte> samples(raster.shape.samples() * sizeOf(type));
    const Status read = raster.reader->read(type, samples);
    if (!read.ok()) return unreadable(raster.name, read.message());
    return samples;
  } catch (const std::bad_alloc&) {
    return outOfMemory(raster.name);
  } catch (const std::exception& error) {
    return unreadable(raster.name, error.what());
  }
}

Result<std::vector<std::byte>> encodeRaster(const std::string& format,
                                            const PictureToWrite& picture) {
  const auto formats = pictureFormats();
  if (!formats.ok()) return formats.status();
  const std::string what = "cannot encode " + format + ": ";
  try {
    auto bytes = (*formats)->encode(format, picture);
    if (bytes.ok()) return bytes;
    return Status(TKS_IO, what + firstLine(bytes.status().message()));
  } catch (const std::exception& error) {
    return Status(TKS_IO, what + error.what());
  }
}

}  // namespace tetrakis::tools
