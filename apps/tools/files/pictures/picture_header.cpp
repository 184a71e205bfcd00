// SPDX-License-Identifier: Apache-2.0
// Headers of formats: PNG ISO/IEC 15948, JPEG ITU-T T.81 B.2.2, GIF89a, WebP RFC 9649, BMP (Windows
// GDI, BITMAPINFOHEADER to BITMAPV5HEADER), ICO, TGA (Truevision 2.0), SGI (Haeberli, 1993),
// Photoshop (Adobe, File Formats Specification), DDS (Direct3D), RLA (Wavefront), IFF (Maya),
// OpenEXR, HEIF ISO/IEC 23008-12, Netpbm.
#include "apps/tools/files/pictures/picture_header.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "apps/tools/files/pictures/pnm.hpp"

namespace tetrakis::tools {
namespace {

/// The bytes of a file; 0 behind its end.
class Bytes {
 public:
  explicit Bytes(std::span<const std::byte> file)
      : text_(reinterpret_cast<const char*>(file.data()), file.size()) {}

  bool holds(size_t at, std::string_view text) const {
    return at <= text_.size() && text_.substr(at).starts_with(text);
  }
  uint64_t byte(size_t at) const {
    return at < text_.size() ? static_cast<unsigned char>(text_[at]) : 0;
  }
  uint64_t little(size_t at, size_t bytes) const {
    uint64_t value = 0;
    for (size_t i = bytes; i-- > 0;) value = value << 8 | byte(at + i);
    return value;
  }
  uint64_t big(size_t at, size_t bytes) const {
    uint64_t value = 0;
    for (size_t i = 0; i < bytes; ++i) value = value << 8 | byte(at + i);
    return value;
  }
  size_t size() const { return text_.size(); }
  std::string_view text() const { return text_; }

 private:
  std::string_view text_;
};

using Header = Result<PictureHeader>;

constexpr const char* kByGdal = ": gdal_translate IN OUT.png makes one that is";
constexpr const char* kByImageMagick = ": convert IN OUT.png (of ImageMagick) makes one that is";

/// what: "holds ...".
Header notRead(PictureHeader header, const std::string& what,
               const char* way_out = kByImageMagick) {
  header.refused = what + ", which is not read exactly" + way_out;
  return header;
}

Header jpegHeader(const Bytes& file) {
  constexpr uint64_t kSof0 = 0xC0, kSof15 = 0xCF, kDht = 0xC4, kJpg = 0xC8, kDac = 0xCC;
  constexpr uint64_t kFill = 0xFF;
  PictureHeader header{"jpeg"};
  for (size_t at = 2; at + 9 < file.size() && file.byte(at) == kFill;) {
    const uint64_t marker = file.byte(at + 1);
    if (marker == kFill) {
      ++at;
      continue;
    }
    if (marker < kSof0 || marker > kSof15 || marker == kDht || marker == kJpg || marker == kDac) {
      at += 2 + file.big(at + 2, 2);
      continue;
    }
    header.height = file.big(at + 5, 2);
    header.width = file.big(at + 7, 2);
    header.channels = static_cast<int>(std::min<uint64_t>(file.byte(at + 9), 3));
    if (file.byte(at + 4) == 8) return header;
    return notRead(header, "holds " + std::to_string(file.byte(at + 4)) + " bits a sample",
                   ": gdal_translate IN OUT.tif makes one that is, where GDAL has a libjpeg of 12 "
                   "bits, as that of conda-forge");
  }
  return Status(TKS_IO, "ends early or is damaged");
}

/// OpenImageIO 2.4 stops at the end of a line of runs, and rounds 16 bits. In 32 bits reading takes
/// the fourth byte for alpha, whatever the masks of the channels are.
Header bmpHeader(const Bytes& file) {
  constexpr uint64_t kCoreHeader = 12, kRgb = 0, kRle8 = 1, kFields = 3;
  constexpr size_t kInfo = 14, kMasks = kInfo + 40, kAlphaMask = kMasks + 12;
  const uint64_t head = file.little(kInfo, 4);
  const bool core = head == kCoreHeader;
  PictureHeader header{"bmp"};
  header.width = file.little(kInfo + 4, core ? 2 : 4);
  header.height = file.little(core ? kInfo + 6 : kInfo + 8, core ? 2 : 4);
  if (!core && header.height > INT32_MAX) header.height = (1ULL << 32) - header.height;  // from top
  const uint64_t bits = file.little(core ? kInfo + 10 : kInfo + 14, 2);
  const uint64_t coding = core ? kRgb : file.little(kInfo + 16, 4);
  const bool fields = coding == kFields && file.little(kMasks, 4) == 0xFF0000 &&
                      file.little(kMasks + 4, 4) == 0xFF00 && file.little(kMasks + 8, 4) == 0xFF;
  const bool whole = bits == 24 || bits == 32;
  const bool read =
      coding == kRgb ? whole || bits == 1 || bits == 4 || bits == 8 : bits == 32 && fields;
  if (!read)
    return notRead(
        header,
        "is a bitmap of " + std::to_string(bits) + " bits in coding " + std::to_string(coding),
        coding == kRle8 ? kByGdal : kByImageMagick);
  constexpr uint64_t kWithAlphaMask = 56;
  if (whole) header.channels = static_cast<int>(bits / 8);
  header.fourth_reserved =
      bits == 32 && !(head >= kWithAlphaMask && file.little(kAlphaMask, 4) == 0xFF000000);
  return header;
}

/// By the attribute bits, and by what a TGA 2.0 file says of them behind the pixels.
bool hasTargaAlpha(const Bytes& file) {
  constexpr uint64_t kUseful = 3, kMultiplied = 4;
  constexpr size_t kFooter = 26, kExtension = 495, kType = 494;
  const bool footer =
      file.size() >= kFooter && file.holds(file.size() - kFooter + 8, "TRUEVISION-XFILE.");
  const uint64_t extension = footer ? file.little(file.size() - kFooter, 4) : 0;
  if (extension != 0 && extension + kExtension <= file.size()) {
    const uint64_t type = file.byte(extension + kType);
    return type == kUseful || type == kMultiplied;
  }
  return (file.byte(17) & 15U) != 0;
}

/// Without a signature: the header has to make sense.
bool isTarga(const Bytes& file) {
  constexpr std::array<uint64_t, 6> kKinds{1, 2, 3, 9, 10, 11};
  constexpr std::array<uint64_t, 5> kBits{8, 15, 16, 24, 32};
  const uint64_t kind = file.byte(2), map = file.byte(1);
  return file.size() > 18 && std::count(kKinds.begin(), kKinds.end(), kind) != 0 && map <= 1 &&
         std::count(kBits.begin(), kBits.end(), file.byte(16)) != 0 &&
         (map == 1) == (kind == 1 || kind == 9) && (file.byte(17) & 0xC0U) == 0;
}

Header targaHeader(const Bytes& file) {
  constexpr uint64_t kGrey = 3;
  PictureHeader header{"targa", file.little(12, 2), file.little(14, 2)};
  const uint64_t bits = file.byte(16), kind = file.byte(2) & 7U;
  const bool deep = bits == 8 || bits == 24 || bits == 32 || (bits == 16 && kind == kGrey);
  if (!deep || (kind == 1 && bits != 8) || (kind == 1 && file.byte(7) < 24))
    return notRead(header, "is a TGA of " + std::to_string(bits) + " bits");
  if (bits == 32) header.channels = 4;
  header.fourth_reserved = bits == 32 && !hasTargaAlpha(file);
  return header;
}

Header webpHeader(const Bytes& file) {
  PictureHeader header{"webp"};
  if (file.holds(12, "VP8X")) {
    header.width = file.little(24, 3) + 1;
    header.height = file.little(27, 3) + 1;
  } else if (file.holds(12, "VP8L")) {
    const uint64_t sides = file.little(21, 4);
    header.width = (sides & 0x3FFF) + 1;
    header.height = (sides >> 14 & 0x3FFF) + 1;
  } else {
    header.width = file.little(26, 2) & 0x3FFF;
    header.height = file.little(28, 2) & 0x3FFF;
  }
  return header;
}

/// The picture that stands first, which may be a PNG.
Header iconHeader(const Bytes& file) {
  const size_t first = file.little(18, 4);
  PictureHeader header{"ico", file.little(first + 4, 4), file.little(first + 8, 4) / 2};
  if (!file.holds(first, "\x89PNG")) return header;
  header.width = file.big(first + 16, 4);
  header.height = file.big(first + 20, 4);
  return header;
}

/// Greys and RGB of 8 or 16 bits: of the further channels the file does not say which is alpha.
Header photoshopHeader(const Bytes& file) {
  PictureHeader header{"psd", file.big(18, 4), file.big(14, 4)};
  const uint64_t channels = file.big(12, 2), bits = file.big(22, 2), mode = file.big(24, 2);
  constexpr uint64_t kGrey = 1, kRgb = 3;
  const bool plain = (mode == kGrey && channels == 1) || (mode == kRgb && channels == 3);
  if (!plain || (bits != 8 && bits != 16))
    return notRead(header, "is a Photoshop file of " + std::to_string(channels) + " channels of " +
                               std::to_string(bits) + " bits in mode " + std::to_string(mode));
  header.channels = static_cast<int>(channels);
  return header;
}

/// Flat, with a byte a channel in the order that masks have on screens, or coded in blocks.
Header ddsHeader(const Bytes& file) {
  constexpr uint64_t kAlpha = 1, kFourCc = 4, kRgb = 0x40, kFlat = 0xFE00 | 0x200000;
  const uint64_t flags = file.little(80, 4), bits = file.little(88, 4);
  const bool masks =
      file.little(92, 4) == 0xFF0000 && file.little(96, 4) == 0xFF00 && file.little(100, 4) == 0xFF;
  PictureHeader header{"dds", file.little(16, 4), file.little(12, 4)};
  const bool coded = (flags & kFourCc) != 0 &&
                     (file.holds(84, "DXT1") || file.holds(84, "DXT3") || file.holds(84, "DXT5"));
  const bool plain = flags == kRgb && bits == 24 && masks;
  const bool alpha =
      flags == (kRgb | kAlpha) && bits == 32 && masks && file.little(104, 4) == 0xFF000000;
  if ((file.little(112, 4) & kFlat) != 0 || !(coded || plain || alpha))
    return notRead(header, "is a DDS file of another kind than RGB, RGBA, DXT1, DXT3 or DXT5");
  header.channels = plain ? 3 : 4;
  return header;
}

Header rlaHeader(const Bytes& file) {
  const auto side = [&file](size_t low, size_t high) {
    return static_cast<uint64_t>(static_cast<int16_t>(file.big(high, 2)) -
                                 static_cast<int16_t>(file.big(low, 2)) + 1);
  };
  return PictureHeader{"rla", side(8, 10), side(12, 14)};
}

Header exrHeader(const Bytes& file) {
  constexpr std::string_view kWindow("dataWindow\0box2i\0\x10\0\0\0", 21);
  const size_t at = file.text().substr(0, 1 << 20).find(kWindow);
  if (at == std::string_view::npos) return Status(TKS_IO, "ends early or is damaged");
  const auto number = [&](size_t i) {
    return static_cast<int64_t>(static_cast<int32_t>(file.little(at + kWindow.size() + 4 * i, 4)));
  };
  return PictureHeader{"openexr", static_cast<uint64_t>(number(2) - number(0) + 1),
                       static_cast<uint64_t>(number(3) - number(1) + 1)};
}

/// The largest picture of the file: others are tiles, thumbnails or alpha. Of turned ones reading
/// changes rows and columns.
Header heifHeader(const Bytes& file) {
  PictureHeader header{"heif"};
  const std::string_view text = file.text();
  for (size_t at = text.find("ispe"); at != text.npos; at = text.find("ispe", at + 4)) {
    header.width = std::max(header.width, file.big(at + 8, 4));
    header.height = std::max(header.height, file.big(at + 12, 4));
  }
  for (size_t at = text.find("pixi"); at != text.npos; at = text.find("pixi", at + 4)) {
    if (file.byte(at + 8) >= 1 && file.byte(at + 9) > 8)
      return notRead(header, "holds " + std::to_string(file.byte(at + 9)) + " bits a sample",
                     ": avifdec IN OUT.png (AVIF) or heif-convert IN OUT.png (HEIC) makes a PNG of "
                     "16 bits");
  }
  if (file.text().find("irot") != text.npos) std::swap(header.width, header.height);
  return header;
}

Header pnmHeader(const Bytes& file) {
  const auto sides = readPnmSides(file.text());
  if (!sides) return Status(TKS_IO, "ends early or is damaged");
  return PictureHeader{"pnm", (*sides)[0], (*sides)[1]};
}

Header mayaHeader(const Bytes& file) {
  const size_t at = file.text().substr(0, 4096).find("TBHD");
  if (at == std::string_view::npos) return Status(TKS_IO, "ends early or is damaged");
  return PictureHeader{"iff", file.big(at + 8, 4), file.big(at + 12, 4)};
}

bool isRla(const Bytes& file) {
  const uint64_t revision = file.big(26, 2);
  return file.size() > 740 && (revision == 0xFFFE || revision == 0xFFFD);
}

Header headerOf(const Bytes& file) {
  if (file.holds(0, "\x89PNG")) return PictureHeader{"png", file.big(16, 4), file.big(20, 4)};
  if (file.holds(0, "\xFF\xD8\xFF")) return jpegHeader(file);
  if (file.holds(0, "GIF8")) return PictureHeader{"gif", file.little(6, 2), file.little(8, 2)};
  if (file.holds(0, "RIFF") && file.holds(8, "WEBP")) return webpHeader(file);
  if (file.holds(0, "BM")) return bmpHeader(file);
  if (file.holds(0, {"\0\0\1\0", 4})) return iconHeader(file);
  if (file.holds(0, "8BPS")) return photoshopHeader(file);
  if (file.holds(0, "DDS ")) return ddsHeader(file);
  if (file.holds(0, "\x76\x2F\x31\x01")) return exrHeader(file);
  if (file.holds(0, "FOR4")) return mayaHeader(file);
  if (file.holds(4, "ftyp")) return heifHeader(file);
  if (file.holds(0, {"\x01\xDA", 2}))
    return PictureHeader{"sgi", file.big(6, 2), std::max<uint64_t>(file.big(8, 2), 1)};
  if (file.holds(0, "P") &&
      std::string_view("123456fF").find(static_cast<char>(file.byte(1))) != std::string_view::npos)
    return pnmHeader(file);
  if (isRla(file)) return rlaHeader(file);
  return isTarga(file) ? targaHeader(file) : PictureHeader();
}

}  // namespace

Header readPictureHeader(std::span<const std::byte> file, const std::string& name) {
  Header header = headerOf(Bytes(file));
  if (!header.ok())
    return Status(header.status().code(),
                  "cannot read " + name + ": it " + header.status().message());
  if (!header->refused.empty()) header->refused = name + " " + header->refused;
  return header;
}

Status checkSides(const std::string& name, uint64_t width, uint64_t height, uint64_t most) {
  if (width == 0 || height == 0) return {TKS_USAGE, name + " is not a flat picture"};
  if (std::max(width, height) <= most) return {};
  return {TKS_USAGE, name + " says that it has " + std::to_string(width) + " columns and " +
                         std::to_string(height) + " rows: at most " + std::to_string(most) +
                         " of each are taken, which gdal_translate -srcwin cuts out"};
}

Status checkShape(const std::string& name, const PictureHeader& header, const PictureShape& shape) {
  const bool same = static_cast<uint64_t>(shape.width) == header.width &&
                    static_cast<uint64_t>(shape.height) == header.height && shape.depth == 1 &&
                    (header.channels == 0 || shape.channels == header.channels);
  if (same) return {};
  return {TKS_IO, "cannot read " + name + ": its reader takes it for " +
                      std::to_string(shape.width) + " x " + std::to_string(shape.height) + " x " +
                      std::to_string(shape.channels) + ", which its header does not say" +
                      kByImageMagick};
}

}  // namespace tetrakis::tools
