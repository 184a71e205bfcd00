// SPDX-License-Identifier: Apache-2.0
#include "api/written.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <vector>

#include "base/samples.hpp"
#include "codec/geometry/steps/decoded_heights.hpp"
#include "texture_wavelet/texture_decoder.hpp"

namespace tetrakis::inline api {

bool isComplete(const tks_decoder& decoder) {
  return decoder.data.size() >= decoder.parsed.bytes + decoder.parsed.header.payload_bytes;
}

bool keepsPromise(const tks_decoder& decoder) {
  return isComplete(decoder) && decoder.heights_level == 0 &&
         decoder.parsed.header.geometry->max_error >= 0;
}

SurfaceScale surfaceScale(const StreamHeader& header, const DecodedGeometry& geometry) {
  const GeometryHeader& g = *header.geometry;
  const double step = std::ldexp(g.step, -geometry.fraction_bits);
  return {step * header.metadata.scale, g.base * header.metadata.scale + header.metadata.offset};
}

namespace {

/// In the place of `count` samples, at the front of `out`: no sample is wider than a float, so that
/// from the last one on none is written over before it is read.
template <class T>
void samplesToSurface(const DecodedGeometry& geometry, const Metadata& metadata, float* out) {
  auto* const bytes = reinterpret_cast<std::byte*>(out);
  for (size_t i = geometry.heights.size(); i-- > 0;) {
    T sample;
    std::memcpy(&sample, bytes + i * sizeof sample, sizeof sample);
    const bool valid = geometry.valid.empty() || geometry.valid[i];
    out[i] = valid ? finiteFloat(sample * metadata.scale + metadata.offset)
                   : std::numeric_limits<float>::quiet_NaN();
  }
}

float surfaceAt(const DecodedGeometry& geometry, const SurfaceScale& scale, size_t sample) {
  const bool valid = geometry.valid.empty() || geometry.valid[sample];
  return valid ? finiteFloat(geometry.heights[sample] * scale.scale + scale.offset)
               : std::numeric_limits<float>::quiet_NaN();
}

/// The heights that stand where nothing was sent, as a plane of the smallest size: all samples are
/// like its first.
DecodedHeights unsentHeights(const StreamHeader& header) {
  GeometryHeader smallest = *header.geometry;
  smallest.width = smallest.height = 2;
  smallest.wavelet.forest = nullptr;
  smallest.repeats = {};
  return decodeHeights(smallest, header.layers, Codewords(1));
}

Texels unsentTexel(const TextureHeader& header) {
  TextureHeader smallest = header;
  smallest.width = smallest.height = 1;
  smallest.repeats = {};
  smallest.wavelet.forest = nullptr;
  return decodeTexture(smallest, Codewords(1));
}

}  // namespace

void writeHeights(const tks_decoder& decoder, const DecodedHeights& decoded, void* out) {
  fromSteps(decoded, *decoder.parsed.header.geometry, decoder.parsed.header.layers, out);
}

void writeSurface(const tks_decoder& decoder, const DecodedHeights& decoded, float* out) {
  const StreamHeader& header = decoder.parsed.header;
  if (keepsPromise(decoder)) {
    writeHeights(decoder, decoded, out);
    withSampleType(static_cast<tks_sample>(header.geometry->sample), [&](auto type) {
      samplesToSurface<decltype(type)>(decoded.geometry, header.metadata, out);
    });
    return;
  }
  const SurfaceScale scale = surfaceScale(header, decoded.geometry);
  for (size_t i = 0; i < decoded.geometry.heights.size(); ++i)
    out[i] = surfaceAt(decoded.geometry, scale, i);
}

void writeUnsentHeights(const tks_decoder& decoder, void* out, size_t count) {
  const DecodedHeights alike = unsentHeights(decoder.parsed.header);
  const auto sample = static_cast<tks_sample>(decoder.parsed.header.geometry->sample);
  withSampleType(sample, [&](auto type) {
    std::vector<decltype(type)> samples(alike.geometry.heights.size());
    writeHeights(decoder, alike, samples.data());
    std::fill_n(static_cast<decltype(type)*>(out), count, samples.front());
  });
}

void writeUnsentSurface(const tks_decoder& decoder, float* out, size_t count) {
  const DecodedHeights alike = unsentHeights(decoder.parsed.header);
  std::vector<float> surface(alike.geometry.heights.size());
  writeSurface(decoder, alike, surface.data());
  std::fill_n(out, count, surface.front());
}

void writeTexels(const Texels& texels, tks_sample sample, void* out) {
  withSampleType(sample, [&](auto type) {
    std::transform(texels.samples.begin(), texels.samples.end(), static_cast<decltype(type)*>(out),
                   [](uint16_t v) { return static_cast<decltype(type)>(v); });
  });
}

void writeUnsentTexels(const TextureHeader& header, void* out, size_t count) {
  const Texels alike = unsentTexel(header);
  withSampleType(static_cast<tks_sample>(header.sample), [&](auto type) {
    auto* texel = static_cast<decltype(type)*>(out);
    for (size_t i = 0; i < count; ++i, texel += header.channels)
      std::transform(alike.samples.begin(), alike.samples.end(), texel,
                     [](uint16_t v) { return static_cast<decltype(type)>(v); });
  });
}

}  // namespace tetrakis::inline api
