// SPDX-License-Identifier: Apache-2.0
// Heights and texels of whole planes, or of a mip level.
#include <algorithm>
#include <string>

#include "api/decoder.hpp"
#include "api/memory.hpp"
#include "api/written.hpp"
#include "base/samples.hpp"
#include "texture_wavelet/texture_decoder.hpp"

namespace tetrakis {

Status wrongSize(uint64_t wanted, uint64_t given) {
  return {TKS_USAGE, "The output takes " + std::to_string(wanted) + " bytes, the buffer has " +
                         std::to_string(given) + "."};
}

Status noHeights() {
  return {TKS_USAGE, "The stream holds no heights."};
}

Status noTexture() {
  return {TKS_USAGE, "The stream holds no texture."};
}

Result<const DecodedHeights*> decodedHeights(tks_decoder& decoder) {
  const StreamHeader& header = decoder.parsed.header;
  if (!header.geometry) return noHeights();
  if (!decoder.heights) {
    decoder.heights =
        decodeLayers(decoder.payload.codewordsOf(Component::kGeometry), *header.geometry,
                     header.layers, decoder.heights_level, decoder.threads);
  }
  return &*decoder.heights;
}

Result<const DecodedGeometry*> decodedGeometry(tks_decoder& decoder) {
  const Result<const DecodedHeights*> heights = decodedHeights(decoder);
  if (!heights.ok()) return heights.status();
  return &(*heights)->geometry;
}

namespace {

/// Samples of the level that is set; 0: there are no heights.
size_t heightCount(const tks_decoder& decoder) {
  const auto& header = decoder.parsed.header.geometry;
  return header ? MipLevel(header->width, header->height, decoder.heights_level).samples() : 0;
}

/// The stream holds heights, the output is of the right size, and memory suffices.
Status admitHeights(tks_decoder& decoder, tks_part part, const void* out, size_t bytes,
                    size_t sample_bytes) {
  if (!decoder.parsed.header.geometry) return noHeights();
  const size_t wanted = heightCount(decoder) * sample_bytes;
  if (bytes != wanted || out == nullptr) return wrongSize(wanted, bytes);
  return checkMemory(decoder, {part, nullptr, 0});
}

Status decodeHeights(tks_decoder& decoder, void* out, size_t bytes) {
  const auto& header = decoder.parsed.header.geometry;
  const auto sample = static_cast<tks_sample>(header ? header->sample : 0);
  Status status = admitHeights(decoder, TKS_PART_HEIGHTS, out, bytes, tks_sample_bytes(sample));
  if (!status.ok()) return status;
  if (decoder.payload.nothingOf(Component::kGeometry)) {
    writeUnsentHeights(decoder, out, heightCount(decoder));
    return {};
  }
  const Result<const DecodedHeights*> decoded = decodedHeights(decoder);
  if (!decoded.ok()) return decoded.status();
  writeHeights(decoder, **decoded, out);
  return {};
}

Status decodeSurface(tks_decoder& decoder, float* out, size_t count) {
  Status status =
      admitHeights(decoder, TKS_PART_HEIGHTS, out, count * sizeof(float), sizeof(float));
  if (!status.ok()) return status;
  if (decoder.payload.nothingOf(Component::kGeometry)) {
    writeUnsentSurface(decoder, out, count);
    return {};
  }
  const Result<const DecodedHeights*> decoded = decodedHeights(decoder);
  if (!decoded.ok()) return decoded.status();
  writeSurface(decoder, **decoded, out);
  return {};
}

Status decodeValidity(tks_decoder& decoder, uint8_t* out, size_t count) {
  if (Status s = admitHeights(decoder, TKS_PART_VALIDITY, out, count, 1); !s.ok()) return s;
  std::vector<uint8_t> valid;
  if (decoder.heights) {
    valid = decoder.heights->geometry.valid;
  } else if (!decoder.payload.nothingOf(Component::kGeometry)) {
    const StreamHeader& header = decoder.parsed.header;
    valid = decodeValidityLayer(decoder.payload.codewordsOf(Component::kGeometry), *header.geometry,
                                header.layers, decoder.heights_level);
  }
  if (valid.empty()) {
    std::fill_n(out, count, uint8_t{1});
  } else {
    std::copy(valid.begin(), valid.end(), out);
  }
  return {};
}

Status decodeTexels(tks_decoder& decoder, void* out, size_t bytes) {
  const auto& header = decoder.parsed.header.texture;
  if (!header) return noTexture();
  const auto sample = static_cast<tks_sample>(header->sample);
  const int level = decoder.texture_level;
  const size_t count = MipLevel(header->width, header->height, level).samples();
  const size_t wanted = count * header->channels * tks_sample_bytes(sample);
  if (bytes != wanted || out == nullptr) return wrongSize(wanted, bytes);
  if (Status s = checkMemory(decoder, {TKS_PART_TEXTURE, nullptr, 0}); !s.ok()) return s;
  if (decoder.payload.nothingOf(Component::kTexture)) {
    writeUnsentTexels(*header, out, count);
    return {};
  }
  writeTexels(decodeTexture(*header, decoder.payload.codewordsOf(Component::kTexture), level,
                            decoder.threads),
              sample, out);
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
