// SPDX-License-Identifier: Apache-2.0
// Pictures through OpenImageIO.
#include "tools/files/raster.hpp"
#include "tools/files/memory_limit.hpp"

#include <OpenImageIO/filesystem.h>

#include <algorithm>
#include <array>
#include <exception>
#include <new>
#include <utility>

#include "tools/files/png.hpp"
#include "tools/files/stored_form.hpp"

namespace tetrakis::tools {
namespace {

Status unreadable(const std::string& name, const std::string& reason) {
  return {TKS_IO, "cannot read " + name + ": " + firstLine(reason)};
}

Status outOfMemory(const std::string& name) {
  return {TKS_NO_MEMORY, name + " does not fit in memory"};
}

bool startsAsPng(const InputFile& file) {
  std::array<unsigned char, 4> head{};
  const size_t count = OIIO::Filesystem::read_bytes(file.path(), head.data(), head.size());
  return isPng(std::as_bytes(std::span(head).first(count)));
}

Result<Raster> openPng(InputFile file, const std::string& name) {
  const auto bytes = readBytes(file.path());
  if (!bytes.ok()) return bytes.status();
  auto png = decodePng(*bytes, name);
  if (!png.ok()) return png.status();
  const ImageFile& image = png->image;
  Raster raster{std::move(file), name, nullptr, {}};
  raster.spec = {static_cast<int>(image.width), static_cast<int>(image.height),
                 static_cast<int>(image.channels),
                 image.sample == TKS_U8 ? OIIO::TypeDesc::UINT8 : OIIO::TypeDesc::UINT16};
  raster.stored_bits = png->stored_bits;
  raster.palette = png->palette;
  raster.profile = png->profile;
  raster.orientation = png->orientation;
  raster.decoded = std::move(png->image.data);
  return raster;
}

Result<Raster> openUnguarded(const std::string& path) {
  auto file = InputFile::open(path);
  if (!file.ok()) return file.status();
  if (startsAsPng(*file)) return openPng(std::move(*file), quoted(path));
  OIIO::ImageSpec how;
  how["oiio:UnassociatedAlpha"] = 1;
  auto input = OIIO::ImageInput::open(file->path(), &how);
  if (!input) {
    const std::string reason = OIIO::geterror();
    const bool unknown = reason.find("could not find a format reader") != std::string::npos;
    return unreadable(quoted(path), unknown ? "it is in no known picture format" : reason);
  }
  Raster raster{std::move(*file), quoted(path), std::move(input), {}};
  raster.spec = raster.input->spec();
  if (raster.spec.depth > 1 || raster.spec.width < 1 || raster.spec.height < 1) {
    return Status(TKS_USAGE, raster.name + " is not a flat picture");
  }
  Status status = checkSize(raster.name, raster.spec.image_pixels() * raster.spec.nchannels,
                            raster.spec.format.size());
  if (status.ok()) status = noteStoredForm(raster);
  if (!status.ok()) return status;
  return raster;
}

Result<std::vector<std::byte>> encodeUnguarded(const std::string& format, OIIO::ImageSpec& spec,
                                               std::span<const std::byte> samples) {
  const auto output = OIIO::ImageOutput::create(format);
  if (!output) return Status(TKS_IO, "OpenImageIO lacks the format " + format);
  OIIO::Filesystem::IOVecOutput file;
  output->set_ioproxy(&file);
  spec["oiio:UnassociatedAlpha"] = 1;
  if (!output->open("memory." + format, spec) ||
      !output->write_image(spec.format, samples.data()) || !output->close()) {
    return Status(TKS_IO, "cannot encode " + format + ": " + firstLine(output->geterror()));
  }
  const auto bytes = std::as_bytes(std::span(file.buffer()));
  return std::vector<std::byte>(bytes.begin(), bytes.end());
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

Result<std::vector<std::byte>> readSamples(Raster& raster, OIIO::TypeDesc type) {
  if (!raster.input) return std::move(raster.decoded);
  try {
    const OIIO::ImageSpec& spec = raster.spec;
    std::vector<std::byte> samples(spec.image_pixels() * spec.nchannels * type.size());
    const bool read = raster.input->read_image(0, 0, 0, spec.nchannels, type, samples.data());
    // Some of its readers note that the file ends early, and go on.
    if (!read || raster.input->has_error()) {
      return unreadable(raster.name, raster.input->geterror());
    }
    return samples;
  } catch (const std::bad_alloc&) {
    return outOfMemory(raster.name);
  } catch (const std::exception& error) {
    return unreadable(raster.name, error.what());
  }
}

Result<std::vector<std::byte>> encodeRaster(const std::string& format, OIIO::ImageSpec spec,
                                            std::span<const std::byte> samples) {
  try {
    return encodeUnguarded(format, spec, samples);
  } catch (const std::exception& error) {
    return Status(TKS_IO, "cannot encode " + format + ": " + error.what());
  }
}

}  // namespace tetrakis::tools
