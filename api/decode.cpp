// SPDX-License-Identifier: Apache-2.0
// Heights and texels of whole planes, or of a mip level.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "api/decoder.hpp"
#include "api/height_steps.hpp"
#include "api/samples.hpp"
#include "texture_wavelet/texture_decoder.hpp"

namespace tetrakis {

namespace {

Status wrongSize(uint64_t wanted, uint64_t given) {
  return {TKS_USAGE, "The output takes " + std::to_string(wanted) + " bytes, the buffer has " +
                         std::to_string(given) + "."};
}

}  // namespace

Result<const DecodedHeights*> decodedHeights(tks_decoder& decoder) {
  const StreamHeader& header = decoder.parsed.header;
  if (!header.geometry) return Status(TKS_USAGE, "The stream holds no heights.");
  if (!decoder.heights) {
    decoder.heights =
        decodeLayers(decoder.payload.codewordsOf(TrackId::kGeometry), *header.geometry,
                     header.layers, decoder.heights_level, decoder.threads);
  }
  return &*decoder.heights;
}

Result<const DecodedGeometry*> decodedGeometry(tks_decoder& decoder) {
  const Result<const DecodedHeights*> heights = decodedHeights(decoder);
  if (!heights.ok()) return heights.status();
  return &(*heights)->geometry;
}

SurfaceScale surfaceScale(const StreamHeader& header, const DecodedGeometry& geometry) {
  const GeometryHeader& g = *header.geometry;
  const double step = std::ldexp(g.step, -geometry.fraction_bits);
  return {step * header.metadata.scale, g.base * header.metadata.scale + header.metadata.offset};
}

namespace {

Status decodeHeights(tks_decoder& decoder, void* out, size_t bytes) {
  const Result<const DecodedHeights*> decoded = decodedHeights(decoder);
  if (!decoded.ok()) return decoded.status();
  const StreamHeader& header = decoder.parsed.header;
  const size_t wanted = (*decoded)->geometry.heights.size() *
                        tks_sample_bytes(static_cast<tks_sample>(header.geometry->sample));
  if (bytes != wanted || out == nullptr) return wrongSize(wanted, bytes);
  fromSteps(**decoded, *header.geometry, header.layers, out);
  return {};
}

Status decodeSurface(tks_decoder& decoder, float* out, size_t count) {
  const Result<const DecodedGeometry*> decoded = decodedGeometry(decoder);
  if (!decoded.ok()) return decoded.status();
  const std::vector<int32_t>& heights = (*decoded)->heights;
  const std::vector<uint8_t>& valid = (*decoded)->valid;
  if (count != heights.size() || out == nullptr)
    return wrongSize(heights.size() * sizeof(float), count * sizeof(float));
  const SurfaceScale scale = surfaceScale(decoder.parsed.header, **decoded);
  for (size_t i = 0; i < count; ++i)
    out[i] = static_cast<float>(heights[i] * scale.scale + scale.offset);
  for (size_t i = 0; i < valid.size(); ++i) {
    if (!valid[i]) out[i] = std::numeric_limits<float>::quiet_NaN();
  }
  return {};
}

Status decodeValidity(tks_decoder& decoder, uint8_t* out, size_t count) {
  const Result<const DecodedGeometry*> decoded = decodedGeometry(decoder);
  if (!decoded.ok()) return decoded.status();
  const std::vector<uint8_t>& valid = (*decoded)->valid;
  const size_t wanted = (*decoded)->heights.size();
  if (count != wanted || out == nullptr) return wrongSize(wanted, count);
  if (valid.empty()) {
    std::fill_n(out, count, uint8_t{1});
  } else {
    std::copy(valid.begin(), valid.end(), out);
  }
  return {};
}

Status decodeTexels(tks_decoder& decoder, void* out, size_t bytes) {
  const auto& header = decoder.parsed.header.texture;
  if (!header) return {TKS_USAGE, "The stream holds no texture."};
  const auto sample = static_cast<tks_sample>(header->sample);
  const int level = decoder.texture_level;
  const size_t wanted = MipLevel(header->width, header->height, level).samples() *
                        header->channels * tks_sample_bytes(sample);
  if (bytes != wanted || out == nullptr) return wrongSize(wanted, bytes);
  const Texels texels = decodeTexture(*header, decoder.payload.codewordsOf(TrackId::kTexture),
                                      level, decoder.threads);
  withSampleType(sample, [&](auto type) {
    std::transform(texels.samples.begin(), texels.samples.end(), static_cast<decltype(type)*>(out),
                   [](int32_t v) { return static_cast<decltype(type)>(v); });
  });
  return {};
}

Status checkLevel(const char* what, uint32_t level, int coarsest) {
  if (level <= static_cast<uint32_t>(coarsest)) return {};
  return {TKS_USAGE, std::string(what) + " have no level " + std::to_string(level) +
                         "; their coarsest is " + std::to_string(coarsest) + "."};
}

Status setLevels(tks_decoder& decoder, uint32_t heights, uint32_t texture) {
  const StreamHeader& header = decoder.parsed.header;
  Status status = checkLevel("The heights", heights, coarsestLevels(header.geometry));
  if (status.ok()) status = checkLevel("The texels", texture, coarsestLevels(header.texture));
  if (!status.ok()) return status;
  if (static_cast<int>(heights) != decoder.heights_level) decoder.heights.reset();
  decoder.heights_level = static_cast<int>(heights);
  decoder.texture_level = static_cast<int>(texture);
  return {};
}

}  // namespace

}  // namespace tetrakis

size_t tks_sample_bytes(tks_sample sample) {
  if (sample < TKS_U8 || sample > TKS_F32) return 0;
  return tetrakis::withSampleType(sample, [](auto type) { return sizeof(type); });
}

tks_status tks_set_levels(tks_decoder* decoder, uint32_t heights, uint32_t texture) {
  return tetrakis::keeping(decoder,
                           [&] { return tetrakis::setLevels(*decoder, heights, texture); });
}

tks_status tks_decode_heights(tks_decoder* decoder, void* out, size_t bytes) {
  return tetrakis::keeping(decoder, [&] { return tetrakis::decodeHeights(*decoder, out, bytes); });
}

tks_status tks_decode_surface(tks_decoder* decoder, float* out, size_t count) {
  return tetrakis::keeping(decoder, [&] { return tetrakis::decodeSurface(*decoder, out, count); });
}

tks_status tks_decode_validity(tks_decoder* decoder, uint8_t* out, size_t count) {
  return tetrakis::keeping(decoder, [&] { return tetrakis::decodeValidity(*decoder, out, count); });
}

tks_status tks_decode_texture(tks_decoder* decoder, void* out, size_t bytes) {
  return tetrakis::keeping(decoder, [&] { return tetrakis::decodeTexels(*decoder, out, bytes); });
}
