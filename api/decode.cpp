// SPDX-License-Identifier: Apache-2.0
// The decoding half of the C interface (include/tetrakis/tetrakis.h).
#include <algorithm>
#include <cmath>
#include <limits>

#include "api/decoder.hpp"
#include "api/height_steps.hpp"
#include "api/message.hpp"
#include "api/samples.hpp"
#include "texture_wavelet/texture_decoder.hpp"
#include "wavelet/mip_level.hpp"

namespace tetrakis {

namespace {

constexpr uint64_t kDefaultSamples = uint64_t{1} << 28;
constexpr uint64_t kDefaultMemory = uint64_t{8} << 30;
// Working memory: coefficients and band state of one track, and the output.
constexpr uint64_t kBytesPerHeight = 24;
constexpr uint64_t kBytesPerLayer = 6;   // validity or corrections, with their hints
constexpr uint64_t kBytesPerTexel = 24;  // per channel
constexpr uint64_t kBytesPerRegion = 64;

Status exceeds(const char* what, uint64_t value, uint64_t limit) {
  return {TKS_LIMIT, "The stream holds " + std::to_string(value) + " " + what + "; the limit is " +
                         std::to_string(limit) + "."};
}

Status checkLimits(const StreamHeader& header, const tks_limits* limits) {
  const auto or_default = [](uint64_t given, uint64_t fallback) {
    return given != 0 ? given : fallback;
  };
  const uint64_t most_samples = or_default(limits ? limits->max_samples : 0, kDefaultSamples);
  const uint64_t most_texels = or_default(limits ? limits->max_texels : 0, kDefaultSamples);
  const uint64_t most_memory = or_default(limits ? limits->max_memory : 0, kDefaultMemory);
  uint64_t memory = 0;
  if (header.geometry) {
    const uint64_t samples = uint64_t{header.geometry->width} * header.geometry->height;
    if (samples > most_samples) return exceeds("height samples", samples, most_samples);
    const uint64_t layers =
        (header.layers.validity_bytes > 0) + (header.layers.corrections != CorrectionKind::kNone);
    memory = std::max(memory, samples * (kBytesPerHeight + layers * kBytesPerLayer) +
                                  kBytesPerRegion * trackCounts(header)[0].tracks);
  }
  if (header.texture) {
    const uint64_t texels = uint64_t{header.texture->width} * header.texture->height;
    if (texels > most_texels) return exceeds("texels", texels, most_texels);
    memory = std::max(memory, texels * header.texture->channels * kBytesPerTexel +
                                  kBytesPerRegion * trackCounts(header)[1].tracks);
  }
  if (memory > most_memory) {
    return {TKS_LIMIT, "Decoding takes about " + std::to_string(memory) +
                           " bytes of memory; the limit is " + std::to_string(most_memory) + "."};
  }
  return {};
}

Status open(std::span<const uint8_t> data, const tks_limits* limits, tks_decoder& decoder) {
  decoder.data = data;
  Result<ParsedHeader> parsed = readHeader(data);
  if (!parsed.ok()) return parsed.status();
  decoder.parsed = std::move(*parsed);
  const StreamHeader& header = decoder.parsed.header;
  if (Status status = checkLimits(header, limits); !status.ok()) return status;
  const size_t start = decoder.parsed.bytes;
  const auto available =
      static_cast<size_t>(std::min<uint64_t>(data.size() - start, header.payload_bytes));
  Result<Demultiplexed> payload =
      demultiplex(data.subspan(start, available), start, trackCounts(header));
  if (!payload.ok()) return payload.status();
  decoder.payload = std::move(*payload);
  return {};
}

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

/// Of a part that is missing: 0.
int coarsestLevels(const auto& part) {
  return part ? MipLevel::coarsestLevel(part->width, part->height) : 0;
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

Status verify(const tks_decoder& decoder) {
  const StreamHeader& header = decoder.parsed.header;
  const uint64_t total = decoder.parsed.bytes + header.payload_bytes;
  if (decoder.data.size() < total) {
    return {TKS_TRUNCATED, "The stream ends at byte " + std::to_string(decoder.data.size()) +
                               " of " + std::to_string(total) + "."};
  }
  if (decoder.data.size() > total) {
    return {TKS_CORRUPT, "Corrupt stream: " + std::to_string(decoder.data.size() - total) +
                             " bytes follow its end at byte " + std::to_string(total) + "."};
  }
  // The encoder may cut the payload to a budget; the index then runs ahead of the packets.
  const auto& index = header.index;
  const auto& heads = decoder.payload.heads;
  if (!index.empty() &&
      (heads.size() > index.size() || !std::equal(heads.begin(), heads.end(), index.begin()))) {
    return {TKS_CORRUPT, "Corrupt stream: its index does not describe its packets."};
  }
  return {};
}

void fillQuality(const tks_decoder& decoder, tks_info& info) {
  const StreamHeader& header = decoder.parsed.header;
  info.heights_rmse = info.texture_psnr = -1;
  if (const auto quality = decoder.payload.quality[0]; quality && header.geometry) {
    info.heights_rmse = rmseOf(*quality) * header.geometry->step * std::abs(header.metadata.scale);
  }
  if (const auto quality = decoder.payload.quality[1]; quality && header.texture) {
    const double peak = header.texture->sample == TKS_U8 ? 255 : 65535;
    const double rmse = rmseOf(*quality);
    info.texture_psnr =
        rmse == 0 ? std::numeric_limits<double>::infinity() : 20 * std::log10(peak / rmse);
  }
}

uint64_t bytesOf(const std::vector<std::vector<uint8_t>>& codewords) {
  uint64_t bytes = 0;
  for (const std::vector<uint8_t>& codeword : codewords) bytes += codeword.size();
  return bytes;
}

uint32_t sideOf(const RegionHeader& regions) {
  return regions.side_log2 == 0 ? 0 : uint32_t{1} << regions.side_log2;
}

void fillInfo(const tks_decoder& decoder, tks_info& info) {
  const StreamHeader& header = decoder.parsed.header;
  info = {};
  info.size = sizeof(tks_info);
  info.format_version = header.version;
  info.profile = header.profile;
  info.level = header.level;
  info.header_bytes = decoder.parsed.bytes;
  info.stream_bytes = decoder.parsed.bytes + header.payload_bytes;
  info.available_bytes = decoder.data.size();
  info.packets = decoder.payload.heads.size();
  info.geometry_bytes = bytesOf(decoder.payload.codewords[0]);
  info.texture_bytes = bytesOf(decoder.payload.codewords[1]);
  info.has_heights = header.geometry.has_value();
  info.has_texture = header.texture.has_value();
  info.lossless = header.lossless;
  info.triangles = header.triangles;
  info.max_error = -1;
  if (header.geometry) {
    const GeometryHeader& g = *header.geometry;
    const MipLevel mip(g.width, g.height, decoder.heights_level);
    info.width = mip.size().width;
    info.height = mip.size().height;
    info.coarsest_level = static_cast<uint32_t>(coarsestLevels(header.geometry));
    info.regions = sideOf(g.regions);
    info.sample = static_cast<tks_sample>(g.sample);
    info.base = g.base;
    info.step = g.step;
    info.exact_steps = g.exact;
    info.max_error = g.max_error;
    info.has_voids = header.layers.validity_bytes > 0;
    info.has_nodata = header.layers.has_nodata;
    info.nodata = header.layers.nodata;
  }
  if (header.texture) {
    const MipLevel mip(header.texture->width, header.texture->height, decoder.texture_level);
    info.texture_width = mip.size().width;
    info.texture_height = mip.size().height;
    info.texture_coarsest_level = static_cast<uint32_t>(coarsestLevels(header.texture));
    info.texture_regions = sideOf(header.texture->regions);
    info.texture_channels = header.texture->channels;
    info.texture_cutout = header.texture->alpha_bytes > 0 ? 1 + header.texture->hidden : 0;
    info.texture_drawn = header.texture->drawn() ? 1 : header.texture->overlay_bytes > 0 ? 2 : 0;
    info.texture_sample = static_cast<tks_sample>(header.texture->sample);
  }
  const Metadata& m = header.metadata;
  info.scale = m.scale;
  info.offset = m.offset;
  info.spacing_x = std::ldexp(m.spacing_x, decoder.heights_level);
  info.spacing_y = std::ldexp(m.spacing_y, decoder.heights_level);
  info.unit = m.unit.c_str();
  info.vertical_datum = m.vertical_datum.c_str();
  info.crs = m.crs.c_str();
  fillQuality(decoder, info);
}

/// Runs f and keeps its sentence in the decoder.
template <class F>
tks_status keeping(tks_decoder* decoder, F&& f) {
  if (decoder == nullptr) return TKS_USAGE;
  const Status status = guarded(f);
  decoder->message = status.message();
  return status.code();
}

}  // namespace

}  // namespace tetrakis

using tetrakis::Status;

size_t tks_sample_bytes(tks_sample sample) {
  if (sample < TKS_U8 || sample > TKS_F32) return 0;
  return tetrakis::withSampleType(sample, [](auto type) { return sizeof(type); });
}

tks_status tks_open(const uint8_t* data, size_t size, const tks_limits* limits, tks_decoder** out,
                    char* message, size_t message_size) {
  if (out == nullptr || (data == nullptr && size != 0)) return TKS_USAGE;
  *out = nullptr;
  tks_decoder* decoder = nullptr;
  const Status status = tetrakis::guarded([&]() -> Status {
    decoder = new tks_decoder;
    return tetrakis::open({data, size}, limits, *decoder);
  });
  if (status.ok()) {
    *out = decoder;
  } else {
    delete decoder;
  }
  return tetrakis::report(status, message, message_size);
}

void tks_close(tks_decoder* decoder) {
  delete decoder;
}

const char* tks_message(const tks_decoder* decoder) {
  return decoder ? decoder->message.c_str() : "";
}

tks_status tks_get_info(const tks_decoder* decoder, tks_info* info) {
  if (decoder == nullptr || info == nullptr || info->size != sizeof(tks_info)) return TKS_USAGE;
  tetrakis::fillInfo(*decoder, *info);
  return TKS_OK;
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

tks_status tks_set_threads(tks_decoder* decoder, uint32_t threads) {
  if (decoder == nullptr) return TKS_USAGE;
  decoder->threads = threads;
  return TKS_OK;
}

tks_status tks_verify(tks_decoder* decoder) {
  return tetrakis::keeping(decoder, [&] { return tetrakis::verify(*decoder); });
}
