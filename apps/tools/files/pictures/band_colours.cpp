// SPDX-License-Identifier: Apache-2.0
// Colour interpretations (TIFF 6.0, PhotometricInterpretation and ExtraSamples; GDAL's GTiff
// driver, which adds Items of the role colorinterp).
#include "apps/tools/files/pictures/band_colours.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <numeric>
#include <pugixml.hpp>
#include <string>

#include "apps/tools/files/pictures/tiff.hpp"

namespace tetrakis::tools {
namespace {

std::vector<BandColour> coloursByTags(TIFF* tiff) {
  uint16_t samples = 1, photometric = PHOTOMETRIC_MINISBLACK, extras = 0;
  const uint16_t* kinds = nullptr;
  TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLESPERPIXEL, &samples);
  TIFFGetField(tiff, TIFFTAG_PHOTOMETRIC, &photometric);
  if (!TIFFGetField(tiff, TIFFTAG_EXTRASAMPLES, &extras, &kinds)) extras = 0;
  std::vector<BandColour> colours(samples, BandColour::kOther);
  if (photometric == PHOTOMETRIC_RGB && samples >= 3)
    std::copy_n(std::array{BandColour::kRed, BandColour::kGreen, BandColour::kBlue}.begin(), 3,
                colours.begin());
  for (size_t i = 0; i < std::min<size_t>(extras, samples); ++i) {
    if (kinds[i] == EXTRASAMPLE_ASSOCALPHA || kinds[i] == EXTRASAMPLE_UNASSALPHA)
      colours[samples - std::min<size_t>(extras, samples) + i] = BandColour::kAlpha;
  }
  return colours;
}

/// <GDALMetadata><Item sample="0" role="colorinterp">Blue</Item></GDALMetadata>
void takeMetadata(const std::string& xml, std::vector<BandColour>& colours) {
  pugi::xml_document document;
  if (!document.load_string(xml.c_str())) return;
  for (const pugi::xml_node item : document.child("GDALMetadata").children("Item")) {
    const size_t sample = item.attribute("sample").as_uint(UINT32_MAX);
    if (std::string_view(item.attribute("role").value()) == "colorinterp" &&
        sample < colours.size())
      colours[sample] = bandColour(item.text().get());
  }
}

}  // namespace

BandColour bandColour(std::string_view name) {
  std::string lower(name);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (lower == "red") return BandColour::kRed;
  if (lower == "green") return BandColour::kGreen;
  if (lower == "blue") return BandColour::kBlue;
  return lower == "alpha" ? BandColour::kAlpha : BandColour::kOther;
}

std::vector<BandColour> bandColours(TIFF* tiff) {
  std::vector<BandColour> colours = coloursByTags(tiff);
  takeMetadata(tagText(tiff, kGdalMetadataTag), colours);
  return colours;
}

std::vector<uint32_t> textureOrder(const std::vector<BandColour>& colours) {
  std::vector<uint32_t> order(colours.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](uint32_t a, uint32_t b) { return colours[a] < colours[b]; });
  return order;
}

void reorderChannels(ImageFile& image, const std::vector<uint32_t>& order) {
  const size_t sample = tks_sample_bytes(image.sample), pixel = order.size() * sample;
  std::vector<std::byte> stored(pixel);
  for (size_t at = 0; at + pixel <= image.data.size(); at += pixel) {
    std::copy_n(&image.data[at], pixel, stored.begin());
    for (size_t i = 0; i < order.size(); ++i)
      std::copy_n(&stored[order[i] * sample], sample, &image.data[at + i * sample]);
  }
}

}  // namespace tetrakis::tools
