// SPDX-License-Identifier: Apache-2.0
// Opens any bytes as a stream: header, limits, packets. Nothing is decoded yet.
#include <algorithm>
#include <string>

#include "api/decoder.hpp"
#include "api/message.hpp"
#include "api/sized.hpp"

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

Status checkLimits(const StreamHeader& header, const tks_limits& limits) {
  const auto or_default = [](uint64_t given, uint64_t fallback) {
    return given != 0 ? given : fallback;
  };
  const uint64_t most_samples = or_default(limits.max_samples, kDefaultSamples);
  const uint64_t most_texels = or_default(limits.max_texels, kDefaultSamples);
  const uint64_t most_memory = or_default(limits.max_memory, kDefaultMemory);
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
  tks_limits known{};
  if (limits != nullptr) {
    if (Status status = takeSized("limits", *limits, sizeof limits->size, known); !status.ok())
      return status;
  }
  Result<ParsedHeader> parsed = readHeader(data);
  if (!parsed.ok()) return parsed.status();
  decoder.parsed = std::move(*parsed);
  const StreamHeader& header = decoder.parsed.header;
  if (Status status = checkLimits(header, known); !status.ok()) return status;
  const size_t start = decoder.parsed.bytes;
  const auto available =
      static_cast<size_t>(std::min<uint64_t>(data.size() - start, header.payload_bytes));
  Result<Demultiplexed> payload =
      demultiplex(data.subspan(start, available), start, trackCounts(header));
  if (!payload.ok()) return payload.status();
  decoder.payload = std::move(*payload);
  return {};
}

}  // namespace

}  // namespace tetrakis

tks_status tks_open(const uint8_t* data, size_t size, const tks_limits* limits, tks_decoder** out,
                    char* message, size_t message_size) {
  if (out == nullptr || (data == nullptr && size != 0)) return TKS_USAGE;
  *out = nullptr;
  tks_decoder* decoder = nullptr;
  const tetrakis::Status status = tetrakis::guarded([&]() -> tetrakis::Status {
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

tks_status tks_set_threads(tks_decoder* decoder, uint32_t threads) {
  if (decoder == nullptr) return TKS_USAGE;
  decoder->threads = threads;
  return TKS_OK;
}
