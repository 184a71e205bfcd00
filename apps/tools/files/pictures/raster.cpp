// SPDX-License-Identifier: Apache-2.0
// Pictures: which library reads them.
#include "apps/tools/files/pictures/raster.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <exception>
#include <fstream>
#include <new>
#include <string_view>
#include <system_error>
#include <utility>

#include "apps/tools/files/memory_limit.hpp"
#include "apps/tools/files/pictures/jpeg2000.hpp"
#include "apps/tools/files/pictures/picture_header.hpp"
#include "apps/tools/files/pictures/png.hpp"
#include "apps/tools/files/pictures/stored_form.hpp"
#include "apps/tools/files/pictures/tiff_picture.hpp"

namespace tetrakis::tools {
namespace {

Status unreadable(const std::string& name, const std::string& reason) {
  return {TKS_IO, "cannot read " + name + ": " + firstLine(reason)};
}

Status outOfMemory(const std::string& name) {
  return {TKS_NO_MEMORY, name + " does not fit in memory"};
}

/// "II" or "MM", and 42, or 43 for BigTIFF, in that order of bytes.
Result<bool> startsAsTiff(const InputFile& file, const std::string& name) {
  std::array<char, 4> head{};
  std::ifstream stream(file.path(), std::ios::binary);
  if (!stream) return unreadable(name, std::generic_category().message(errno));
  stream.read(head.data(), head.size());
  const std::string_view text(head.data(), head.size());
  for (const char version : {char{42}, char{43}})
    if (text == std::string{'I', 'I', version, 0} || text == std::string{'M', 'M', 0, version})
      return true;
  return false;
}

Status takePng(Raster& raster, std::span<const std::byte> bytes) {
  auto png = decodePng(bytes, raster.name);
  if (!png.ok()) return png.status();
  raster.shape = shapeOf(png->image);
  raster.stored_bits = png->stored_bits;
  raster.palette = png->palette;
  raster.profile = png->profile;
  raster.orientation = png->orientation;
  raster.further_pages = png->animated;
  raster.decoded = std::move(png->image.data);
  return {};
}

Status openAsTiff(Raster& raster, uint64_t most_side) {
  auto reader = openTiff(raster.file.path(), raster.name, most_side);
  if (!reader.ok()) return reader.status();
  raster.reader = std::move(*reader);
  raster.shape = raster.reader->shape();
  return {};
}

/// Its form has been read once: samples come as they are coded.
Status openAsJpeg2000(Raster& raster, std::span<const std::byte> bytes, uint64_t most_side) {
  const auto form = jpeg2000Form(bytes, raster.name);
  if (!form.ok()) return form.status();
  Status sides = checkSides(raster.name, form->width, form->height, most_side);
  if (!sides.ok()) return sides;
  raster.reader = openJpeg2000(raster.file.path(), *form);
  raster.shape = raster.reader->shape();
  raster.stored_bits = form->bits;
  raster.as_stored = true;
  raster.colours = form->colours;
  if (form->associated_alpha) raster.alpha = Raster::Alpha::kAssociated;
  return {};
}

/// OpenImageIO's formats, of which the header says what is to be read.
Status openOther(Raster& raster, const PictureHeader& header) {
  const auto formats = pictureFormats();
  if (!formats.ok()) return formats.status();
  auto reader = (*formats)->open(raster.file.path(), header.format);
  if (!reader.ok()) return unreadable(raster.name, reader.status().message());
  raster.reader = std::move(*reader);
  raster.shape = raster.reader->shape();
  raster.fourth_reserved = header.fourth_reserved;
  return checkShape(raster.name, header, raster.shape);
}

/// What is neither TIFF nor PNG.
Status openCoded(Raster& raster, std::span<const std::byte> bytes, uint64_t most_side) {
  if (isJpeg2000(bytes)) return openAsJpeg2000(raster, bytes, most_side);
  const auto header = readPictureHeader(bytes, raster.name);
  if (!header.ok()) return header.status();
  if (header->format.empty())
    return unreadable(raster.name,
                      "it is in no picture format that is read; of what GDAL reads gdal_translate "
                      "IN OUT.tif makes a TIFF");
  Status sides = checkSides(raster.name, header->width, header->height, most_side);
  if (!sides.ok()) return sides;
  if (!header->refused.empty()) return {TKS_USAGE, header->refused};
  return header->format == "png" ? takePng(raster, bytes) : openOther(raster, *header);
}

Result<Raster> openUnguarded(const std::string& path, uint64_t most_side) {
  auto file = InputFile::open(path);
  if (!file.ok()) return file.status();
  Raster raster{std::move(*file), quoted(path), nullptr, {}};
  const auto tiff = startsAsTiff(raster.file, raster.name);
  if (!tiff.ok()) return tiff.status();
  Status status;
  if (*tiff) {
    status = openAsTiff(raster, most_side);
  } else {
    const auto bytes = readBytes(raster.file.path());
    if (!bytes.ok()) return bytes.status();
    status = openCoded(raster, *bytes, most_side);
  }
  if (!status.ok()) return status;
  status = checkSize(raster.name, raster.shape.samples(), sizeOf(raster.shape.sample));
  if (status.ok() && raster.reader) status = noteStoredForm(raster);
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

Result<Raster> openRaster(const std::string& path, uint64_t most_side) {
  try {
    return openUnguarded(path, most_side);
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
