// SPDX-License-Identifier: Apache-2.0
// PNG (ISO/IEC 15948) by libspng.
#include "apps/tools/files/pictures/png.hpp"

#include <spng.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <memory>
#include <string_view>
#include <vector>

#include "apps/tools/files/pictures/exif.hpp"
#include "apps/tools/files/pictures/raster.hpp"

namespace tetrakis::tools {
namespace {

struct FreeContext {
  void operator()(spng_ctx* context) const { spng_ctx_free(context); }
};
using Context = std::unique_ptr<spng_ctx, FreeContext>;

/// How to ask libspng for the samples as stored: fewer than 8 bits widened, palettes expanded, a
/// transparent colour turned into an alpha channel.
struct Layout {
  int format = SPNG_FMT_PNG;
  uint32_t channels = 0;
};

Layout layoutOf(const spng_ihdr& header, bool transparent) {
  const bool wide = header.bit_depth == 16;
  switch (header.color_type) {
    case SPNG_COLOR_TYPE_GRAYSCALE:
      if (transparent) return {wide ? SPNG_FMT_GA16 : SPNG_FMT_GA8, 2};
      return {wide ? SPNG_FMT_PNG : SPNG_FMT_G8, 1};
    case SPNG_COLOR_TYPE_GRAYSCALE_ALPHA:
      return {SPNG_FMT_PNG, 2};
    case SPNG_COLOR_TYPE_TRUECOLOR:
      if (transparent) return {wide ? SPNG_FMT_RGBA16 : SPNG_FMT_RGBA8, 4};
      return {SPNG_FMT_PNG, 3};
    case SPNG_COLOR_TYPE_INDEXED:
      return transparent ? Layout{SPNG_FMT_RGBA8, 4} : Layout{SPNG_FMT_RGB8, 3};
    default:
      return {SPNG_FMT_PNG, 4};
  }
}

Status unreadable(const std::string& name, int error) {
  return {TKS_IO, "cannot read " + name + ": PNG " + spng_strerror(error)};
}

/// Whether the chunk of animations is there (APNG), which libspng does not know.
bool isAnimated(spng_ctx* context) {
  uint32_t count = 0;
  if (spng_get_unknown_chunks(context, nullptr, &count) != 0) return false;
  std::vector<spng_unknown_chunk> chunks(count);
  if (spng_get_unknown_chunks(context, chunks.data(), &count) != 0) return false;
  return std::any_of(chunks.begin(), chunks.end(), [](const spng_unknown_chunk& chunk) {
    return std::string_view(reinterpret_cast<const char*>(chunk.type), 4) == "acTL";
  });
}

/// The profile, and the orientation; libspng has read all chunks by then.
void noteChunks(spng_ctx* context, DecodedPng& png) {
  png.animated = isAnimated(context);
  spng_iccp profile{};
  png.profile = spng_get_iccp(context, &profile) == 0;
  spng_exif exif{};
  if (spng_get_exif(context, &exif) != 0) return;
  png.orientation = exifOrientation({reinterpret_cast<const std::byte*>(exif.data), exif.length});
}

}  // namespace

Result<DecodedPng> decodePng(std::span<const std::byte> bytes, const std::string& name) {
  const Context context(spng_ctx_new(0));
  if (!context) return Status(TKS_NO_MEMORY, "out of memory");
  spng_ihdr header{};
  int error = spng_set_option(context.get(), SPNG_KEEP_UNKNOWN_CHUNKS, 1);
  if (!error) error = spng_set_png_buffer(context.get(), bytes.data(), bytes.size());
  if (!error) error = spng_get_ihdr(context.get(), &header);
  if (error) return unreadable(name, error);
  spng_trns colour{};
  const Layout layout = layoutOf(header, spng_get_trns(context.get(), &colour) == 0);
  DecodedPng png;
  png.image = {
      header.width, header.height, layout.channels, header.bit_depth == 16 ? TKS_U16 : TKS_U8, {}};
  png.stored_bits = header.bit_depth;
  png.palette = header.color_type == SPNG_COLOR_TYPE_INDEXED;
  const uint64_t samples = uint64_t{header.width} * header.height * layout.channels;
  const size_t sample_bytes = tks_sample_bytes(png.image.sample);
  if (Status status = checkSize(name, samples, sample_bytes); !status.ok()) return status;
  png.image.data.resize(samples * sample_bytes);
  error = spng_decode_image(context.get(), png.image.data.data(), png.image.data.size(),
                            layout.format, SPNG_DECODE_TRNS);
  if (error) return unreadable(name, error);
  // What stands behind the pixels; damage there takes nothing from them.
  spng_decode_chunks(context.get());
  noteChunks(context.get(), png);
  return png;
}

Result<std::vector<std::byte>> encodePng(const ImageFile& image) {
  constexpr std::array<uint8_t, 4> kColourTypes{
      SPNG_COLOR_TYPE_GRAYSCALE, SPNG_COLOR_TYPE_GRAYSCALE_ALPHA, SPNG_COLOR_TYPE_TRUECOLOR,
      SPNG_COLOR_TYPE_TRUECOLOR_ALPHA};
  const Context context(spng_ctx_new(SPNG_CTX_ENCODER));
  if (!context) return Status(TKS_NO_MEMORY, "out of memory");
  spng_ihdr header{};
  header.width = image.width;
  header.height = image.height;
  header.bit_depth = image.sample == TKS_U8 ? 8 : 16;
  header.color_type = kColourTypes[image.channels - 1];
  int error = spng_set_option(context.get(), SPNG_ENCODE_TO_BUFFER, 1);
  // Fast deflate: decoded textures hold noise that more effort hardly shrinks.
  if (!error) error = spng_set_option(context.get(), SPNG_IMG_COMPRESSION_LEVEL, 2);
  if (!error) error = spng_set_ihdr(context.get(), &header);
  if (!error) {
    error = spng_encode_image(context.get(), image.data.data(), image.data.size(), SPNG_FMT_PNG,
                              SPNG_ENCODE_FINALIZE);
  }
  if (error) return Status(TKS_IO, std::string("cannot encode PNG: ") + spng_strerror(error));
  size_t size = 0;
  const std::unique_ptr<void, decltype(&std::free)> buffer(
      spng_get_png_buffer(context.get(), &size, &error), std::free);
  if (!buffer) return Status(TKS_NO_MEMORY, "out of memory");
  const auto* bytes = static_cast<const std::byte*>(buffer.get());
  return std::vector<std::byte>(bytes, bytes + size);
}

}  // namespace tetrakis::tools
