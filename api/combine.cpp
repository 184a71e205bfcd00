// SPDX-License-Identifier: Apache-2.0
// Makes one stream of the components of several streams. The weights of their errors are measured
// by decoding a coarse level of each.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "api/component_ranges.hpp"
#include "api/encoded_stream.hpp"
#include "api/guarded.hpp"
#include "encoder/combination/combined_stream.hpp"
#include "tetrakis/components.h"

namespace tetrakis::inline api {
namespace {

constexpr size_t kMostNameBytes = 255;

Status inPart(const Status& status, size_t number) {
  return {status.code(), "Stream " + std::to_string(number) + ": " + status.message()};
}

Status checkPart(const StreamHeader& header, size_t number) {
  const auto moves = [](const auto& component) { return component && !component->frames.none(); };
  if (moves(header.geometry) || moves(header.texture))
    return {TKS_USAGE, "Streams of frames are not combined with others."};
  if (number > 0 && !header.triangle_mesh.none())
    return {TKS_USAGE, "A mesh of triangles stands in the first of the streams alone."};
  return {};
}

Status takePart(const tks_combined& given, size_t number, const tks_limits* limits,
                CombinedPart& part) {
  tks_combined known{};
  if (Status status = takeSized("the stream", given, sizeof given.size, known); !status.ok())
    return status;
  if (known.data == nullptr && known.data_size != 0)
    return {TKS_USAGE, "The bytes of the stream are missing."};
  part.bytes = {known.data, known.data_size};
  part.name = known.name != nullptr ? known.name : "";
  part.weight = known.weight == 0 ? 1 : known.weight;
  if (part.name.size() > kMostNameBytes)
    return {TKS_USAGE, "A name has at most " + std::to_string(kMostNameBytes) + " bytes."};
  if (!(part.weight > 0) || std::isinf(part.weight))
    return {TKS_USAGE, "A weight is a positive number."};
  Result<ParsedHeader> parsed = readHeader(part.bytes);
  if (!parsed.ok()) return parsed.status();
  part.parsed = *std::move(parsed);
  if (Status status = checkPart(part.parsed.header, number); !status.ok()) return status;
  const Result<std::vector<ComponentRange>> ranges = componentRanges(part.bytes, limits);
  if (!ranges.ok()) return ranges.status();
  return takePackets(part, *ranges);
}

Status combine(std::span<const tks_combined> streams, const tks_combine_options& options,
               tks_buffer& out) {
  std::vector<CombinedPart> parts(streams.size());
  for (size_t i = 0; i < streams.size(); ++i) {
    if (Status status = takePart(streams[i], i, options.limits, parts[i]); !status.ok())
      return inPart(status, i);
  }
  Result<CombinedStream> stream = combinedStream(parts, {});
  if (!stream.ok()) return stream.status();
  const bool is_cut = options.bytes != 0 && stream->bytes.size() > options.bytes;
  if (is_cut) stream = combinedStream(parts, options.bytes);
  if (!stream.ok()) return stream.status();
  if (Status status = checkKept(*stream, parts, !is_cut); !status.ok()) return status;
  giveBytes(stream->bytes, out);
  return {};
}

}  // namespace
}  // namespace tetrakis::inline api

tks_status tks_combine(const tks_combined* streams, uint32_t count,
                       const tks_combine_options* options, tks_buffer* out, char* message,
                       size_t message_size) {
  if (out != nullptr) *out = {nullptr, 0};
  return tetrakis::reporting(message, message_size, [&]() -> tetrakis::Status {
    if (out == nullptr) return tetrakis::outputMissing();
    if (streams == nullptr || count == 0) return {TKS_USAGE, "The streams are missing."};
    tks_combine_options known{};
    if (options != nullptr) {
      if (auto status = tetrakis::takeSized("the options", *options, sizeof options->size, known);
          !status.ok())
        return status;
    }
    return tetrakis::combine({streams, count}, known, *out);
  });
}
