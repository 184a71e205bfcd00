// SPDX-License-Identifier: Apache-2.0
// TIFF 6.0: PhotometricInterpretation (sections 3 to 5), CMYK (section 16).
#include "apps/tools/files/pictures/shown_colours.hpp"

#include <cstring>
#include <limits>
#include <utility>

namespace tetrakis::tools {
namespace {

/// Calls change(sample, channel) on each sample, which it may change.
template <class T, class Change>
void forEachSample(ImageFile& image, const Change& change) {
  uint32_t channel = 0;
  for (size_t at = 0; at < image.data.size(); at += sizeof(T)) {
    T sample = 0;
    std::memcpy(&sample, &image.data[at], sizeof sample);
    sample = static_cast<T>(change(sample, channel));
    std::memcpy(&image.data[at], &sample, sizeof sample);
    if (++channel == image.channels) channel = 0;
  }
}

template <class Change>
void forEachSample(ImageFile& image, const Change& change) {
  if (image.sample == TKS_U8) return forEachSample<uint8_t>(image, change);
  forEachSample<uint16_t>(image, change);
}

/// The colours of an image with alpha, or all channels.
uint32_t colourChannels(const ImageFile& image) {
  return image.hasAlpha() ? image.channels - 1 : image.channels;
}

Status lookUp(const Raster& raster, ImageFile& image) {
  const size_t sample_bytes = tks_sample_bytes(image.sample);
  const size_t pixel = image.channels * sample_bytes;
  ImageFile shown{image.width, image.height, image.channels + 2, TKS_U8, {}};
  shown.data.reserve(size_t{image.width} * image.height * shown.channels);
  for (size_t at = 0; at < image.data.size(); at += pixel) {
    size_t place = std::to_integer<size_t>(image.data[at]);
    if (image.sample == TKS_U16) {
      uint16_t wide = 0;
      std::memcpy(&wide, &image.data[at], sizeof wide);
      place = wide;
    }
    if (place >= raster.map.size())
      return {TKS_IO, "cannot read " + raster.name + ": its palette lacks colours that it uses"};
    for (const uint8_t channel : raster.map[place]) shown.data.push_back(std::byte{channel});
    if (image.channels == 2) shown.data.push_back(image.data[at + sample_bytes]);
  }
  image = std::move(shown);
  return {};
}

/// Cyan, magenta, yellow and black, each 0 for none: what paper leaves of the light.
template <class T>
void mixInks(ImageFile& image) {
  constexpr uint64_t kFull = std::numeric_limits<T>::max();
  ImageFile mixed{image.width, image.height, 3, image.sample, {}};
  mixed.data.resize(image.data.size() / 4 * 3);
  for (size_t at = 0, to = 0; at < image.data.size(); at += 4 * sizeof(T)) {
    std::array<T, 4> inks{};
    std::memcpy(inks.data(), &image.data[at], sizeof inks);
    for (size_t i = 0; i < 3; ++i, to += sizeof(T)) {
      const auto light =
          static_cast<T>(((kFull - inks[i]) * (kFull - inks[3]) + kFull / 2) / kFull);
      std::memcpy(&mixed.data[to], &light, sizeof light);
    }
  }
  image = std::move(mixed);
}

/// Fewer bits than the type has: which channels take its whole range.
void widen(const Raster& raster, ImageFile& image) {
  const uint64_t most = (uint64_t{1} << raster.stored_bits) - 1, full = largestTexel(image.sample);
  const bool all = image.sample == TKS_U8 || raster.cmyk;
  const uint32_t first = all ? 0 : colourChannels(image);
  forEachSample(image, [&](uint64_t sample, uint32_t channel) {
    const uint64_t wide = channel < first ? sample : (sample * full + most / 2) / most;
    return wide;
  });
  if (!all) image.white_level = static_cast<uint32_t>(most);
}

}  // namespace

Status showColours(const Raster& raster, ImageFile& image) {
  if (!raster.as_stored) return {};
  if (raster.palette) return lookUp(raster, image);
  const int bits = raster.stored_bits;
  if (raster.white_is_zero) {
    const uint64_t most = bits >= 16 ? largestTexel(image.sample) : (uint64_t{1} << bits) - 1;
    const uint32_t colours = colourChannels(image);
    forEachSample(image, [&](uint64_t sample, uint32_t channel) {
      return channel < colours ? most - sample : sample;
    });
  }
  if (bits < 16 && bits != 8) widen(raster, image);
  if (!raster.cmyk) return {};
  if (image.sample == TKS_U8) {
    mixInks<uint8_t>(image);
  } else {
    mixInks<uint16_t>(image);
  }
  return {};
}

}  // namespace tetrakis::tools
