// SPDX-License-Identifier: Apache-2.0
// The SIZ marker segment (ITU-T T.800, A.5.1) and the boxes of the header (annex I.5.3).
#include "apps/tools/files/pictures/jpeg2000.hpp"

#include <openjpeg.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <string_view>
#include <utility>

#include "apps/tools/files/memory_limit.hpp"
#include "apps/tools/files/pictures/jp2_boxes.hpp"

namespace tetrakis::tools {
namespace {

constexpr std::string_view kStart("\xFF\x4F\xFF\x51", 4);

std::string_view asText(std::span<const std::byte> file) {
  return {reinterpret_cast<const char*>(file.data()), file.size()};
}

PictureSample sampleTypeOf(const Jpeg2000Form& form) {
  if (form.bits <= 8) return form.is_signed ? PictureSample::kI8 : PictureSample::kU8;
  if (form.bits <= 16) return form.is_signed ? PictureSample::kI16 : PictureSample::kU16;
  return form.is_signed ? PictureSample::kI32 : PictureSample::kU32;
}

// Codecs and streams are both of type void* to OpenJPEG.
struct DestroyCodec {
  void operator()(opj_codec_t* codec) const { opj_destroy_codec(codec); }
};
struct DestroyStream {
  void operator()(opj_stream_t* stream) const { opj_stream_destroy(stream); }
};
struct DestroyImage {
  void operator()(opj_image_t* image) const { opj_image_destroy(image); }
};
using OpenedImage = std::unique_ptr<opj_image_t, DestroyImage>;

void keepMessage(const char* message, void* text) {
  auto& kept = *static_cast<std::string*>(text);
  if (kept.empty()) kept = message;
}

/// One component, as the samples of each pixel's channel.
template <class T>
void interleave(const opj_image_comp_t& component, size_t channel, size_t channels,
                std::span<std::byte> samples) {
  const size_t pixels = size_t{component.w} * component.h;
  for (size_t i = 0; i < pixels; ++i) {
    const auto sample = static_cast<T>(component.data[i]);
    std::memcpy(&samples[(i * channels + channel) * sizeof sample], &sample, sizeof sample);
  }
}

class Jpeg2000Picture final : public PictureReader {
 public:
  Jpeg2000Picture(std::string path, const Jpeg2000Form& form)
      : path_(std::move(path)), form_(form) {}

  PictureShape shape() const override {
    return {static_cast<int>(form_.width), static_cast<int>(form_.height),
            static_cast<int>(form_.colours.size()), sampleTypeOf(form_)};
  }
  std::string format() const override { return "jpeg2000"; }
  bool has(const char*) const override { return false; }
  int number(const char*) const override { return 0; }
  std::string text(const char*) const override { return {}; }

  Status read(PictureSample type, std::span<std::byte> samples) override {
    if (type != shape().sample) return {TKS_USAGE, "its samples are of another type"};
    const uint64_t bytes = shape().samples() * sizeof(OPJ_INT32);
    if (Status memory = checkMemoryFor("reading JPEG 2000", bytes); !memory.ok()) return memory;
    std::string reason;
    const auto image = decoded(reason);
    if (!image) return {TKS_IO, reason};
    for (size_t i = 0; i < form_.colours.size(); ++i) {
      const opj_image_comp_t& component = image->comps[i];
      switch (sizeOf(type)) {
        case 1:
          interleave<uint8_t>(component, i, form_.colours.size(), samples);
          break;
        case 2:
          interleave<uint16_t>(component, i, form_.colours.size(), samples);
          break;
        default:
          interleave<uint32_t>(component, i, form_.colours.size(), samples);
      }
    }
    return {};
  }

 private:
  /// Null if it is damaged, or other than its header says.
  OpenedImage decoded(std::string& reason) const {
    const std::unique_ptr<opj_stream_t, DestroyStream> stream(
        opj_stream_create_default_file_stream(path_.c_str(), OPJ_TRUE));
    const auto kind = form_.boxed ? OPJ_CODEC_JP2 : OPJ_CODEC_J2K;
    const std::unique_ptr<opj_codec_t, DestroyCodec> codec(opj_create_decompress(kind));
    if (!stream || !codec) return nullptr;
    opj_set_error_handler(codec.get(), keepMessage, &reason);
    opj_dparameters_t how;
    opj_set_default_decoder_parameters(&how);
    how.flags |= OPJ_DPARAMETERS_IGNORE_PCLR_CMAP_CDEF_FLAG;  // components as they are coded
    opj_image_t* opened = nullptr;
    if (!opj_setup_decoder(codec.get(), &how) ||
        !opj_read_header(stream.get(), codec.get(), &opened))
      return nullptr;
    OpenedImage image(opened);
    if (!opj_decode(codec.get(), stream.get(), image.get()) ||
        !opj_end_decompress(codec.get(), stream.get()) || !isAsSaid(*image))
      return nullptr;
    return image;
  }

  bool isAsSaid(const opj_image_t& image) const {
    return image.numcomps == form_.colours.size() &&
           std::all_of(image.comps, image.comps + image.numcomps, [this](const auto& component) {
             return component.data && component.w == form_.width && component.h == form_.height &&
                    static_cast<int>(component.prec) == form_.bits &&
                    (component.sgnd != 0) == form_.is_signed;
           });
  }

  std::string path_;
  Jpeg2000Form form_;
};

/// The components' sizes and depths; TKS_USAGE if they are not all alike.
Status readSizes(std::string_view siz, const std::string& name, Jpeg2000Form& form) {
  constexpr size_t kComponents = 42, kEach = 3, kMostComponents = 16384, kMostBits = 31;
  const auto number = [siz](size_t at) { return bigEndian(siz.substr(at, 4)); };
  const size_t count = siz.size() < kComponents ? 0 : bigEndian(siz.substr(40, 2));
  if (count == 0 || count > kMostComponents || siz.size() < kComponents + kEach * count)
    return {TKS_IO, "cannot read " + name + ": it ends early or is damaged"};
  form.width = number(8) - std::min(number(16), number(8));
  form.height = number(12) - std::min(number(20), number(12));
  form.colours.assign(count, BandColour::kOther);
  const std::string_view first = siz.substr(kComponents, kEach);
  const auto depth = static_cast<unsigned char>(first[0]);
  form.is_signed = (depth & 128U) != 0;
  form.bits = static_cast<int>(depth & 127U) + 1;
  for (size_t i = 1; i < count; ++i)
    if (siz.substr(kComponents + kEach * i, kEach) != first)
      return {TKS_USAGE, name +
                             " has components of several sizes or depths: opj_decompress -i IN -o "
                             "OUT.tif -upsample (of OpenJPEG) makes them alike"};
  if (first[1] == 1 && first[2] == 1 && form.bits <= static_cast<int>(kMostBits)) return {};
  return {TKS_USAGE, name + " has samples of " + std::to_string(form.bits) +
                         " bits, or coarser ones than its grid: opj_decompress -i IN -o OUT.tif "
                         "-upsample (of OpenJPEG) makes a file that is read"};
}

constexpr uint64_t kSrgbSpace = 16, kGreySpace = 17;

/// Enumerated colour space; 0: a profile, or nothing.
uint64_t colourSpace(std::string_view header) {
  const std::string_view colr = boxContent(header, "colr");
  return colr.size() >= 7 && colr[0] == 1 ? bigEndian(colr.substr(3, 4)) : 0;
}

/// Which colour each component is (I.5.3.6), or as they come where nothing says so.
void readColours(std::string_view header, Jpeg2000Form& form) {
  constexpr uint64_t kOpacity = 1, kPremultiplied = 2;
  constexpr std::array kRgb{BandColour::kRed, BandColour::kGreen, BandColour::kBlue};
  std::vector<BandColour>& colours = form.colours;
  const bool rgb = colours.size() >= kRgb.size();
  if (rgb) std::copy(kRgb.begin(), kRgb.end(), colours.begin());
  std::string_view cdef = boxContent(header, "cdef");
  if (cdef.empty() && colours.size() % 2 == 0) colours.back() = BandColour::kAlpha;
  for (cdef.remove_prefix(std::min<size_t>(cdef.size(), 2)); cdef.size() >= 6;
       cdef.remove_prefix(6)) {
    const uint64_t component = bigEndian(cdef.substr(0, 2)), type = bigEndian(cdef.substr(2, 2));
    const uint64_t colour = bigEndian(cdef.substr(4, 2));
    if (component >= colours.size()) continue;
    const bool alpha = type == kOpacity || type == kPremultiplied;
    form.associated_alpha = form.associated_alpha || type == kPremultiplied;
    colours[component] = alpha                                            ? BandColour::kAlpha
                         : rgb && type == 0 && colour >= 1 && colour <= 3 ? kRgb[colour - 1]
                                                                          : BandColour::kOther;
  }
}

}  // namespace

bool isJpeg2000(std::span<const std::byte> file) {
  return asText(file).starts_with(kJp2Signature) || asText(file).starts_with(kStart);
}

Result<Jpeg2000Form> jpeg2000Form(std::span<const std::byte> file, const std::string& name) {
  const std::string_view text = asText(file);
  const size_t start = text.find(kStart);
  Jpeg2000Form form;
  form.boxed = text.starts_with(kJp2Signature);
  const Status sizes =
      readSizes(start == text.npos ? std::string_view() : text.substr(start), name, form);
  if (!sizes.ok()) return sizes;
  const std::string_view header = form.boxed ? boxContent(text, "jp2h") : std::string_view();
  if (!boxContent(header, "pclr").empty())
    return Status(TKS_USAGE,
                  name + " has a palette: gdal_translate -expand rgb IN OUT.tif makes RGB of it");
  const uint64_t space = colourSpace(header);
  if (space != 0 && space != kSrgbSpace && space != kGreySpace && form.colours.size() > 1)
    return Status(TKS_USAGE, name +
                                 " stores its colours in another way than as grey or RGB: "
                                 "opj_decompress -i IN -o OUT.tif (of OpenJPEG) makes RGB of it");
  readColours(header, form);
  return form;
}

std::unique_ptr<PictureReader> openJpeg2000(const std::string& path, const Jpeg2000Form& form) {
  return std::make_unique<Jpeg2000Picture>(path, form);
}

}  // namespace tetrakis::tools
