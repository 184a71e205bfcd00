// SPDX-License-Identifier: Apache-2.0
// Reading texture images: 8 or 16 bits, 1 to 4 channels.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <utility>

#include "apps/tools/files/file_bytes.hpp"
#include "apps/tools/files/files.hpp"
#include "apps/tools/files/gdal_mask.hpp"
#include "apps/tools/files/pictures/alpha.hpp"
#include "apps/tools/files/pictures/picture_header.hpp"
#include "apps/tools/files/pictures/raster.hpp"
#include "apps/tools/files/pictures/shown_colours.hpp"
#include "apps/tools/files/pictures/tag_number.hpp"
#include "apps/tools/files/pictures/tiff.hpp"
#include "apps/tools/files/place/pam.hpp"
#include "apps/tools/files/place/world_file.hpp"
#include "apps/tools/files/plain_heights.hpp"
#include "apps/tools/files/turned_image.hpp"

namespace tetrakis::tools {
namespace {

/// The type to read: OpenImageIO widens fewer bits to full range itself.
Result<tks_sample> sampleOf(const Raster& raster) {
  switch (raster.shape.sample) {
    case PictureSample::kU8:
      return TKS_U8;
    case PictureSample::kU16:
    case PictureSample::kU32:
      return TKS_U16;
    case PictureSample::kHalf:
    case PictureSample::kFloat:
    case PictureSample::kDouble:
      return Status(TKS_USAGE, raster.name +
                                   " holds floats: a texture has unsigned integers, to which "
                                   "gdal_translate -ot UInt16 -scale rounds them");
    case PictureSample::kI8:
    case PictureSample::kI16:
    case PictureSample::kI32:
      return Status(TKS_USAGE, raster.name +
                                   " holds signed samples: a texture has unsigned ones, to which "
                                   "gdal_translate -ot UInt16 -scale stretches them");
    case PictureSample::kOther:
      break;
  }
  return Status(TKS_USAGE, raster.name + " holds samples of 64 bits: a texture is 8 or 16 bits");
}

/// Samples of 32 bits as 16, which have to hold them: what they stand for is not ours to scale.
Result<std::vector<std::byte>> narrowed(const std::vector<std::byte>& wide,
                                        const std::string& name) {
  std::vector<std::byte> narrow(wide.size() / 2);
  for (size_t i = 0; i < wide.size() / sizeof(uint32_t); ++i) {
    uint32_t value = 0;
    std::memcpy(&value, wide.data() + i * sizeof value, sizeof value);
    if (value > UINT16_MAX) {
      return Status(TKS_USAGE, name +
                                   " holds values above 65535: a texture has 8 or 16 bits, to "
                                   "which gdal_translate -ot UInt16 -scale rounds them");
    }
    const auto sample = static_cast<uint16_t>(value);
    std::memcpy(narrow.data() + i * sizeof sample, &sample, sizeof sample);
  }
  return narrow;
}

Result<std::vector<std::byte>> textureSamples(Raster& raster, tks_sample sample) {
  if (raster.shape.sample != PictureSample::kU32)
    return readSamples(raster, sample == TKS_U8 ? PictureSample::kU8 : PictureSample::kU16);
  const auto wide = readSamples(raster, PictureSample::kU32);
  return wide.ok() ? narrowed(*wide, raster.name) : wide.status();
}

/// Whether all samples are what 8 bits become as 16.
bool isWidened(const ImageFile& image) {
  if (image.sample != TKS_U16) return false;
  for (size_t i = 0; i < image.data.size(); i += 2)
    if (image.data[i] != image.data[i + 1]) return false;
  return true;
}

/// What has become of the mask.
enum class Masked {
  kNo,
  kAsAlpha,
  kOfBands,
  kBesideAlpha,
  kNodataAsAlpha,
  kNodataBesideAlpha,
  kNodataEverywhere
};

bool hasAlpha(const std::vector<BandColour>& colours) {
  return std::find(colours.begin(), colours.end(), BandColour::kAlpha) != colours.end();
}

/// Puts the bands of a TIFF into the order of a texture. The note says which are where; "" if they
/// stay where they are.
Result<std::string> arrangeBands(const Raster& raster, const std::string& path, ImageFile& image) {
  std::vector<BandColour> colours = raster.colours;
  if (colours.size() != image.channels) return std::string();
  takePam(path, colours);
  image.opaque = colours.size() % 2 == 0 && !hasAlpha(colours);
  if (colours.size() == 3 && hasAlpha(colours)) {
    return Status(TKS_USAGE, raster.name +
                                 " has two bands and an alpha: a texture is grey or RGB, which "
                                 "gdal_translate -b, -colorinterp make of them");
  }
  const std::vector<uint32_t> order = textureOrder(colours);
  if (std::is_sorted(order.begin(), order.end())) return std::string();
  reorderChannels(image, order);
  std::string bands;
  for (const uint32_t band : order) bands += (bands.empty() ? "" : ", ") + std::to_string(band + 1);
  return "bands taken in the order " + bands + ", as their colours say";
}

/// Whether alpha is 0 everywhere.
bool hidesAll(const ImageFile& image) {
  if (!image.hasAlpha()) return false;
  const size_t sample = tks_sample_bytes(image.sample), pixel = image.channels * sample;
  for (size_t at = pixel - sample; at < image.data.size(); at += pixel)
    for (size_t i = 0; i < sample; ++i)
      if (image.data[at + i] != std::byte{0}) return false;
  return true;
}

std::string noteOn(const Raster& raster, const ImageFile& image, Masked masked,
                   const std::string& arranged) {
  std::string note;
  const auto add = [&note](const char* text) {
    note += (note.empty() ? "" : ", ") + std::string(text);
  };
  if (raster.palette) add("palette converted to RGB");
  if (raster.cmyk) add("CMYK converted to RGB");
  if (raster.white_is_zero) add("shades turned over, because it stores white as 0");
  if (raster.fourth_reserved) add("fourth channel left out, because the file does not use it");
  if (raster.shape.sample == PictureSample::kU32) add("16 of its 32 bits hold all its values");
  if (raster.alpha == Raster::Alpha::kAssociated) add("colours divided by their alpha");
  if (raster.orientation != 1) add("turned upright as its orientation tag says");
  if (raster.profile) add("colour profile not applied and not kept");
  if (!arranged.empty()) add(arranged.c_str());
  const int bits = raster.stored_bits;
  if (isWidened(image)) add("its 16 bits say no more than 8, which would take far fewer bytes");
  if (raster.shape.sample == PictureSample::kU16 && bits > 8 && bits < 16)
    add((std::to_string(bits) + (raster.as_stored && !raster.cmyk
                                     ? " bits kept as they are, with a white level"
                                     : " bits stretched to 16"))
            .c_str());
  if (image.hasFurtherColour())
    add("last channel taken for a colour, because the file does not call it alpha");
  if (masked == Masked::kAsAlpha) add("mask kept as alpha");
  if (masked == Masked::kOfBands)
    add("masks of its bands differ: texels that all of them hide have alpha 0");
  if (masked == Masked::kNodataAsAlpha) {
    add("texels of its nodata value have alpha 0");
  } else if (masked == Masked::kNodataEverywhere) {
    add("nodata value not applied, because all texels have it");
  } else if (masked == Masked::kNodataBesideAlpha) {
    add("nodata value not applied and not kept");
  }
  if (raster.sparse) add("strips or tiles that the file leaves out filled as GDAL does");
  if (hidesAll(image))
    add("its alpha hides every texel; gdal_translate -b 1 -b 2 -b 3 leaves an alpha out");
  if (masked == Masked::kBesideAlpha) add("mask not applied and not kept beside its last channel");
  if (raster.further_pages) add("further pages left out");
  if (raster.unread_place) add("place in GML, or in damaged tags, not read");
  return note.empty() ? note : raster.name + ": " + note;
}

/// A mask beside the file goes before the one in it, as GDAL has it. Empty: there is none.
Result<GdalMask> maskOf(const Raster& raster, const std::string& path) {
  const auto width = static_cast<uint32_t>(raster.shape.width);
  const auto height = static_cast<uint32_t>(raster.shape.height);
  auto beside = readMaskBeside(path, width, height);
  if (!beside.ok() || !beside->shown.empty() || !raster.mask) return beside;
  return readMaskPage(raster.file.path(), width, height);
}

/// As GDAL's mask does: texels that have the nodata value in all samples that the file stores are
/// not there. Empty: not all bands have such a value.
std::vector<uint8_t> nodataMask(const Raster& raster, const std::string& path,
                                const ImageFile& stored) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> nodata(stored.channels, tagNumber(raster.nodata).value_or(kNone));
  takePam(path, nodata);
  for (const double value : nodata)
    if (std::isnan(value)) return {};
  return maskOfValues(stored, nodata);
}

/// An alpha goes before it, and so does a picture of which nothing else is there.
Masked applyNodata(const std::vector<uint8_t>& mask, ImageFile& image) {
  if (mask.empty()) return Masked::kNo;
  if (image.channels % 2 == 0) return Masked::kNodataBesideAlpha;
  const auto there = std::count(mask.begin(), mask.end(), 1);
  if (static_cast<size_t>(there) == mask.size()) return Masked::kNo;
  if (there == 0) return Masked::kNodataEverywhere;
  image = withAlpha(image, mask);
  return Masked::kNodataAsAlpha;
}

/// Pixels that a mask leaves out get alpha 0; an image of two or four channels has no room for it.
Result<Masked> applyMask(const Raster& raster, const std::string& path,
                         const std::vector<uint8_t>& nodata, ImageFile& image) {
  const auto mask = maskOf(raster, path);
  if (!mask.ok()) return mask.status();
  const bool hides = std::find(mask->shown.begin(), mask->shown.end(), 0) != mask->shown.end();
  if (!hides && !mask->differs) return applyNodata(nodata, image);
  if (image.channels % 2 == 0) return Masked::kBesideAlpha;
  if (hides) image = withAlpha(image, mask->shown);
  return mask->differs ? Masked::kOfBands : Masked::kAsAlpha;
}

/// Applies the orientation tag (TIFF 6.0: where the stored row 0 and column 0 stand in the
/// picture). From 5 on rows and columns change places.
ImageFile turnedUpright(const ImageFile& stored, int orientation) {
  QuarterTurn turn{GroundAxes()};
  turn.transposed = orientation >= 5;
  turn.columns_back = orientation == 2 || orientation == 3 || orientation >= 7;
  turn.rows_back = orientation == 3 || orientation == 4 || orientation == 6 || orientation == 7;
  return turned(stored, turn);
}

/// Of the pixels as they are stored. Tags and what GDAL keeps go before a world file beside.
Result<Georeference> placeOf(const Raster& raster, const std::string& path, Notes& notes) {
  Georeference place;
  if (const std::string tagged = raster.tagged(); !tagged.empty()) {
    auto tags = readGeoreference(tagged, notes);
    if (!tags.ok()) return tags;
    place = std::move(*tags);
  }
  takePam(path, place, notes);
  if (place.geotransform) return place;
  const auto transform = readWorldFile(path);
  if (!transform.ok()) return transform.status();
  place.geotransform = *transform;
  return place;
}

/// One to four colours, one place in a palette (and an alpha), or four inks.
Status checkChannels(const Raster& raster) {
  const int channels = raster.shape.channels, most = raster.palette && !raster.map.empty() ? 2 : 4;
  const bool deep = raster.shape.sample == PictureSample::kU32;
  if (deep && (raster.white_is_zero || raster.cmyk || raster.palette))
    return {TKS_USAGE, raster.name +
                           " has inks, a palette, or white as 0 in more than 16 bits: no texture "
                           "is made of it but by the program that wrote it, with 8 or 16"};
  if (channels <= most) return {};
  const char* const picked = most == 2     ? "-b 1 picks"
                             : raster.inks ? "-co PHOTOMETRIC=CMYK -b 1 -b 2 -b 3 -b 4 picks"
                                           : "-b 1 -b 2 -b 3 picks";
  return {TKS_USAGE, raster.name + " has " + std::to_string(channels) +
                         " channels: a texture has 1 to 4, which gdal_translate " + picked};
}

/// What heights alone are kept in is told by its name.
bool isNamedAsHeights(const std::string& path) {
  return isNamedHgt(path) || formatOf(path, "") == "raw" || parseRawName(path);
}

}  // namespace

Result<ImageFile> readImage(const std::string& path, std::string* note) {
  if (isNamedAsHeights(path))
    return Status(TKS_USAGE, quoted(path) + " is a file of heights: a texture is a picture");
  auto raster = openRaster(path, kMostTexels);
  if (!raster.ok()) return raster.status();
  const PictureShape& shape = raster->shape;
  if (Status channels = checkChannels(*raster); !channels.ok()) return channels;
  const auto sample = sampleOf(*raster);
  if (!sample.ok()) return sample.status();
  auto data = textureSamples(*raster, *sample);
  if (!data.ok()) return data.status();
  ImageFile image{static_cast<uint32_t>(shape.width), static_cast<uint32_t>(shape.height),
                  static_cast<uint32_t>(shape.channels), *sample, std::move(*data)};
  const std::vector<uint8_t> nodata = nodataMask(*raster, path, image);
  const auto arranged = arrangeBands(*raster, path, image);
  if (!arranged.ok()) return arranged.status();
  if (raster->fourth_reserved) {
    image.opaque = true;
    image = withoutFurtherColour(image);
  }
  if (Status shown = showColours(*raster, image); !shown.ok()) return shown;
  if (raster->alpha == Raster::Alpha::kMultiplied && !isOpaque(image)) {
    return Status(TKS_USAGE, raster->name +
                                 " has an alpha that reading multiplies into the colours: "
                                 "gdal_translate IN OUT.png makes one that is read");
  }
  if (raster->alpha == Raster::Alpha::kAssociated) divideByAlpha(image);
  const auto masked = applyMask(*raster, path, nodata, image);
  if (!masked.ok()) return masked.status();
  const tks_image known = asImage(image);
  if (image.white_level == 0) image.white_level = tks_find_white_level(&known);
  if (note) *note = noteOn(*raster, image, *masked, *arranged);
  if (raster->orientation != 1) return turnedUpright(image, raster->orientation);
  Notes notes;
  auto place = placeOf(*raster, path, notes);
  if (!place.ok()) return place.status();
  for (const Note& of_place : notes)
    if (note) *note += (note->empty() ? "" : ", ") + of_place.text;
  image.place = std::move(*place);
  return image;
}

}  // namespace tetrakis::tools
