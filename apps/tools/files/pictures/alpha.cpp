// SPDX-License-Identifier: Apache-2.0
// What the last of two or four channels is: alpha, or a further colour.
#include "apps/tools/files/pictures/alpha.hpp"

#include <algorithm>
#include <limits>
#include <span>
#include <type_traits>

namespace tetrakis::tools {
namespace {

/// Calls `visit` with the samples of each pixel, in their type.
template <class T, class Visit>
void forEachPixel(std::span<T> samples, uint32_t channels, const Visit& visit) {
  for (; !samples.empty(); samples = samples.subspan(channels)) visit(samples.first(channels));
}

/// The samples are const where the image is.
template <class Image, class Visit>
void forEachPixel(Image& image, const Visit& visit) {
  const size_t count = image.data.size() / tks_sample_bytes(image.sample);
  const auto visitAll = [&](auto* first) {
    forEachPixel(std::span(first, count), image.channels, visit);
  };
  using Word = std::conditional_t<std::is_const_v<Image>, const uint16_t, uint16_t>;
  using Byte = std::conditional_t<std::is_const_v<Image>, const uint8_t, uint8_t>;
  if (image.sample == TKS_U8) {
    visitAll(reinterpret_cast<Byte*>(image.data.data()));
  } else {
    visitAll(reinterpret_cast<Word*>(image.data.data()));
  }
}

template <class T>
void divide(std::span<T> pixel) {
  constexpr uint64_t kFull = std::numeric_limits<T>::max();
  const uint64_t alpha = pixel.back();
  if (alpha == 0 || alpha == kFull) return;
  for (T& colour : pixel.first(pixel.size() - 1)) {
    colour = static_cast<T>(std::min(kFull, (colour * kFull + alpha / 2) / alpha));
  }
}

}  // namespace

bool isOpaque(const ImageFile& image) {
  if (!image.hasAlpha()) return true;
  const size_t sample = tks_sample_bytes(image.sample), pixel = image.channels * sample;
  for (size_t at = pixel - sample; at < image.data.size(); at += pixel) {
    for (size_t i = 0; i < sample; ++i) {
      if (image.data[at + i] != std::byte{0xff}) return false;
    }
  }
  return true;
}

ImageFile withAlpha(const ImageFile& colours, const std::vector<uint8_t>& mask) {
  ImageFile image{colours.width, colours.height, colours.channels + 1, colours.sample, {},
                  colours.place};
  image.white_level = colours.white_level;
  const size_t sample = tks_sample_bytes(image.sample), pixel = colours.channels * sample;
  image.data.reserve(mask.size() * (pixel + sample));
  auto from = colours.data.begin();
  for (const uint8_t shown : mask) {
    image.data.insert(image.data.end(), from, from + pixel);
    image.data.insert(image.data.end(), sample, shown != 0 ? std::byte{255} : std::byte{0});
    from += pixel;
  }
  return image;
}

std::vector<uint8_t> maskOfValues(const ImageFile& image, std::span<const double> values) {
  std::vector<uint8_t> mask;
  mask.reserve(size_t{image.width} * image.height);
  forEachPixel(image, [&](auto pixel) {
    mask.push_back(!std::equal(pixel.begin(), pixel.end(), values.begin(), values.end()));
  });
  return mask;
}

void divideByAlpha(ImageFile& image) {
  if (!image.hasAlpha()) return;
  forEachPixel(image, [](auto pixel) { divide(pixel); });
}

ImageFile withoutFurtherColour(const ImageFile& image) {
  if (!image.hasFurtherColour()) return image;
  ImageFile picture{image.width, image.height, image.channels - 1, image.sample, {}, image.place};
  picture.white_level = image.white_level;
  const size_t sample = tks_sample_bytes(image.sample), pixel = image.channels * sample;
  picture.data.reserve(image.data.size() / image.channels * picture.channels);
  for (auto from = image.data.begin(); from != image.data.end(); from += pixel)
    picture.data.insert(picture.data.end(), from, from + (pixel - sample));
  return picture;
}

}  // namespace tetrakis::tools
