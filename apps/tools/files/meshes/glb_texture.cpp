// SPDX-License-Identifier: Apache-2.0
// The texture inside a GLB: JPEG and PNG, which glTF 2.0 has, WebP (EXT_texture_webp), or KTX2
// (KHR_texture_basisu).
#include "apps/tools/files/meshes/glb_document.hpp"
#include "apps/tools/files/meshes/mesh_writers.hpp"
#include "apps/tools/files/pictures/png.hpp"
#include "apps/tools/files/pictures/raster.hpp"

namespace tetrakis::tools {
namespace {

using nlohmann::json;

constexpr int kTextureQuality = 90;
constexpr int kLinear = 9729, kLinearMipmapLinear = 9987, kClampToEdge = 33071, kRepeat = 10497;

Result<EncodedTexture> ofType(const char* mime_type, Result<std::vector<std::byte>> bytes) {
  if (!bytes.ok()) return bytes.status();
  return EncodedTexture{mime_type, std::move(*bytes)};
}

Result<std::vector<std::byte>> encodeWebp(const ImageFile& image) {
  constexpr uint32_t kMaxSide = 16383;
  if (std::max(image.width, image.height) > kMaxSide)
    return Status(TKS_USAGE, "a WebP has sides of at most 16383: write --mesh-texture png");
  return encodeRaster("webp",
                      {shapeOf(image), image.data, "webp:" + std::to_string(kTextureQuality)});
}

/// What a reader has to know beyond glTF 2.0; null: nothing.
const char* extensionOf(MeshTexture format) {
  if (format == MeshTexture::kWebp) return "EXT_texture_webp";
  return format == MeshTexture::kKtx2 ? "KHR_texture_basisu" : nullptr;
}

}  // namespace

ImageFile greyInColour(const ImageFile& grey) {
  ImageFile colour{grey.width, grey.height, grey.channels + 2, TKS_U8, {}};
  colour.data.reserve(grey.data.size() / grey.channels * colour.channels);
  for (size_t i = 0; i < grey.data.size(); i += grey.channels) {
    colour.data.insert(colour.data.end(), 3, grey.data[i]);
    if (grey.channels == 2) colour.data.push_back(grey.data[i + 1]);
  }
  return colour;
}

ImageFile channelOf(const ImageFile& image, size_t channel) {
  ImageFile grey{image.width, image.height, 1, TKS_U8, {}};
  grey.data.reserve(image.data.size() / image.channels);
  for (size_t at = channel; at < image.data.size(); at += image.channels)
    grey.data.push_back(image.data[at]);
  return grey;
}

ImageFile reducedTo8Bits(const ImageFile& image) {
  ImageFile reduced{image.width, image.height, image.channels, TKS_U8, {}};
  reduced.data.resize(image.data.size() / 2);
  for (size_t i = 0; i < reduced.data.size(); ++i) {
    uint16_t value;
    std::copy_n(&image.data[2 * i], 2, reinterpret_cast<std::byte*>(&value));
    const bool is_alpha = image.hasAlpha() && i % image.channels + 1 == image.channels;
    const uint32_t white = is_alpha ? largestTexel(image.sample) : image.white();
    reduced.data[i] = static_cast<std::byte>(shownIn8Bits(value, white));
  }
  return reduced;
}

Result<EncodedTexture> encodeTexture(const ImageFile& image, MeshTexture format) {
  const ImageFile reduced = image.sample == TKS_U8 ? ImageFile{} : reducedTo8Bits(image);
  const ImageFile& texels = image.sample == TKS_U8 ? image : reduced;
  const auto coloured = [&] { return image.channels < 3 ? greyInColour(texels) : texels; };
  switch (format) {
    case MeshTexture::kKtx2:
      return ofType("image/ktx2", encodeKtx2(coloured()));
    case MeshTexture::kWebp:
      return ofType("image/webp", encodeWebp(coloured()));
    case MeshTexture::kJpeg:
      if (image.channels % 2 == 0)
        return Status(TKS_USAGE,
                      "a JPEG holds no alpha, which the texture has: write "
                      "--mesh-texture png or webp");
      return ofType("image/jpeg", encodeJpeg(texels, kTextureQuality));
    case MeshTexture::kChosen:
      if (auto jpeg = encodeJpeg(texels, kTextureQuality); jpeg.ok())
        return ofType("image/jpeg", std::move(jpeg));
      break;
    case MeshTexture::kPng:
      break;
  }
  return ofType("image/png", encodePng(texels));
}

Result<size_t> addTexture(Glb& glb, const ImageFile& image, std::span<const float> texcoords,
                          MeshTexture format) {
  const auto encoded = encodeTexture(image, format);
  if (!encoded.ok()) return encoded.status();
  const size_t view = glb.addView(std::span<const std::byte>(encoded->bytes), 0);
  const size_t number = glb.document["images"].size();
  glb.document["images"].push_back({{"bufferView", view}, {"mimeType", encoded->mime_type}});
  const auto wrapOf = [&](size_t first) {
    for (size_t i = first; i < texcoords.size(); i += 2)
      if (!(texcoords[i] >= 0 && texcoords[i] <= 1)) return kRepeat;
    return kClampToEdge;
  };
  glb.document["samplers"] = listOf({{"magFilter", kLinear},
                                     {"minFilter", kLinearMipmapLinear},
                                     {"wrapS", wrapOf(0)},
                                     {"wrapT", wrapOf(1)}});
  json texture{{"sampler", 0}};
  if (const char* const extension = extensionOf(format)) {
    texture["extensions"] = {{extension, {{"source", number}}}};
    glb.useExtension(extension, true);
  } else {
    texture["source"] = number;
  }
  glb.document["textures"].push_back(texture);
  return number;
}

}  // namespace tetrakis::tools
