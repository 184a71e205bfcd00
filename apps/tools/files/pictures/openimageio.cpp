// SPDX-License-Identifier: Apache-2.0
// The module of picture formats: OpenImageIO behind pictures/picture_formats.hpp, with the
// samples as the file has them: no gamma, no colour profile, alpha not multiplied where OpenImageIO
// can do without.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <OpenImageIO/strutil.h>
#include <OpenImageIO/tiffutils.h>

#include <algorithm>
#include <array>
#include <utility>

#include "apps/tools/files/pictures/picture_formats.hpp"

namespace tetrakis::tools {
namespace {

using OIIO::TypeDesc;

constexpr std::array<std::pair<TypeDesc::BASETYPE, PictureSample>, 9> kSamples{{
    {TypeDesc::UINT8, PictureSample::kU8},
    {TypeDesc::INT8, PictureSample::kI8},
    {TypeDesc::UINT16, PictureSample::kU16},
    {TypeDesc::INT16, PictureSample::kI16},
    {TypeDesc::UINT32, PictureSample::kU32},
    {TypeDesc::INT32, PictureSample::kI32},
    {TypeDesc::HALF, PictureSample::kHalf},
    {TypeDesc::FLOAT, PictureSample::kFloat},
    {TypeDesc::DOUBLE, PictureSample::kDouble},
}};

PictureSample sampleOf(TypeDesc type) {
  for (const auto& [theirs, ours] : kSamples)
    if (theirs == type.basetype) return ours;
  return PictureSample::kOther;
}

TypeDesc typeOf(PictureSample sample) {
  for (const auto& [theirs, ours] : kSamples)
    if (ours == sample) return theirs;
  return TypeDesc::UNKNOWN;
}

OIIO::string_view textOf(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

Status failed(const std::string& reason) {
  return {TKS_IO, reason};
}

class Reader final : public PictureReader {
 public:
  explicit Reader(std::unique_ptr<OIIO::ImageInput> input) : input_(std::move(input)) {}

  PictureShape shape() const override {
    const OIIO::ImageSpec& spec = input_->spec();
    return {spec.width, spec.height, spec.nchannels, sampleOf(spec.format), spec.depth};
  }
  std::string format() const override { return input_->format_name(); }
  bool has(const char* attribute) const override {
    return input_->spec().find_attribute(attribute) != nullptr;
  }
  int number(const char* attribute) const override {
    return input_->spec().get_int_attribute(attribute);
  }
  std::string text(const char* attribute) const override {
    return std::string(input_->spec().get_string_attribute(attribute));
  }
  Status read(PictureSample type, std::span<std::byte> samples) override {
    const int channels = input_->spec().nchannels;
    const bool read = input_->read_image(0, 0, 0, channels, typeOf(type), samples.data());
    // Some of its readers note that the file ends early, and go on.
    return read && !input_->has_error() ? Status() : failed(input_->geterror());
  }

 private:
  std::unique_ptr<OIIO::ImageInput> input_;
};

OIIO::ImageSpec specOf(const PictureToWrite& picture) {
  const PictureShape& shape = picture.shape;
  OIIO::ImageSpec spec(shape.width, shape.height, shape.channels, typeOf(shape.sample));
  spec["oiio:UnassociatedAlpha"] = 1;
  // OpenImageIO takes the fourth channel for alpha, and no second one.
  spec.alpha_channel = shape.channels % 2 != 0 ? -1 : shape.channels - 1;
  if (!picture.compression.empty()) spec["compression"] = picture.compression;
  return spec;
}

/// proxy: where the file goes instead of to `path`; null: there.
Status writeTo(const std::string& path, OIIO::Filesystem::IOProxy* proxy, const std::string& format,
               const PictureToWrite& picture) {
  const auto output = OIIO::ImageOutput::create(format);
  if (!output) return failed(OIIO::geterror());
  if (proxy) output->set_ioproxy(proxy);
  const OIIO::ImageSpec spec = specOf(picture);
  const bool written = output->open(path, spec) &&
                       output->write_image(spec.format, picture.samples.data()) && output->close();
  return written ? Status() : failed(output->geterror());
}

class Formats final : public PictureFormats {
 public:
  Result<std::unique_ptr<PictureReader>> open(const std::string& path,
                                              const std::string& format) const override {
    OIIO::ImageSpec how, found;
    how["oiio:UnassociatedAlpha"] = 1;
    auto input = OIIO::ImageInput::create(format);
    if (!input) return failed(OIIO::geterror());
    if (!input->open(path, found, how)) return failed(input->geterror());
    return std::unique_ptr<PictureReader>(std::make_unique<Reader>(std::move(input)));
  }
  bool hasSecond(const std::string& path) const override {
    const auto input = OIIO::ImageInput::open(path);
    return input && input->seek_subimage(1, 0);
  }
  std::string named(const std::string& extension) const override {
    const auto output = OIIO::ImageOutput::create("x." + extension);
    if (output) return output->format_name();
    OIIO::geterror();  // clears it
    return {};
  }
  Result<std::vector<std::byte>> encode(const std::string& format,
                                        const PictureToWrite& picture) const override {
    OIIO::Filesystem::IOVecOutput file;
    const Status written = writeTo("memory." + format, &file, format, picture);
    if (!written.ok()) return written;
    const auto bytes = std::as_bytes(std::span(file.buffer()));
    return std::vector<std::byte>(bytes.begin(), bytes.end());
  }
  Status write(const std::string& path, const std::string& format,
               const PictureToWrite& picture) const override {
    return writeTo(path, nullptr, format, picture);
  }
  int orientation(std::span<const std::byte> exif) const override {
    OIIO::ImageSpec spec;
    if (exif.empty() || !OIIO::decode_exif(textOf(exif), spec)) return 1;
    return spec.get_int_attribute("Orientation", 1);
  }
  std::string base64(std::span<const std::byte> bytes) const override {
    return OIIO::Strutil::base64_encode(textOf(bytes));
  }
};

}  // namespace
}  // namespace tetrakis::tools

extern "C" __attribute__((visibility("default"))) const tetrakis::tools::PictureFormats*
tetrakis_picture_formats() {
  static const tetrakis::tools::Formats formats;
  return &formats;
}
