// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/commands/receiver_plan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "apps/tools/files/stream.hpp"
#include "apps/tools/report/scene.hpp"

namespace tetrakis::tools {
namespace {

constexpr double kMeshShare = 4;  ///< squared error of the mesh beside that of the stream

/// Mean squared distance; samples that are void on either side count for nothing.
double meanSquare(std::span<const float> a, const auto& b) {
  double sum = 0;
  size_t count = 0;
  for (size_t i = 0; i < a.size(); ++i) {
    const double difference = a[i] - b[i];
    if (std::isnan(difference)) continue;
    sum += difference * difference;
    ++count;
  }
  return count > 0 ? sum / static_cast<double>(count) : 0;
}

/// Prefixes and meshes of one stream, held against the whole of it.
class Errors {
 public:
  static Result<Errors> of(std::span<const uint8_t> stream) {
    Errors errors(stream);
    Result<Decoder> decoder = openDecoder(stream);
    if (!decoder) return decoder.status();
    Result<std::vector<float>> truth = decoder->surface();
    if (!truth) return truth.status();
    errors.width_ = decoder->info().width;
    errors.height_ = decoder->info().height;
    errors.truth_ = std::move(*truth);
    return errors;
  }

  Result<double> ofBytes(uint64_t bytes) const {
    Result<Decoder> decoder = openDecoder(stream_.first(bytes));
    if (!decoder) return decoder.status();
    const Result<std::vector<float>> surface = decoder->surface();
    if (!surface) return surface.status();
    return meanSquare(truth_, *surface);
  }

  Result<double> ofMesh(uint64_t bytes, uint32_t triangles) const {
    Result<Decoder> decoder = openDecoder(stream_.first(bytes));
    if (!decoder) return decoder.status();
    const Result<Mesh> mesh = decoder->budgetMesh(triangles);
    if (!mesh) return mesh.status();
    return meanSquare(truth_, rasterize(*mesh, width_, height_).values);
  }

  uint32_t mostTriangles() const {
    const uint64_t most = 2 * (uint64_t{width_} - 1) * (height_ - 1);
    return static_cast<uint32_t>(std::min<uint64_t>(most, std::numeric_limits<uint32_t>::max()));
  }

 private:
  explicit Errors(std::span<const uint8_t> stream) : stream_(stream) {}

  std::span<const uint8_t> stream_;
  uint32_t width_ = 0, height_ = 0;
  std::vector<float> truth_;
};

/// The least number between two that suffices, to 1 %; errors fall as it grows. error: of a number.
template <class Error>
Result<uint64_t> leastThat(uint64_t low, uint64_t high, double most, const Error& error) {
  while (high - low > std::max<uint64_t>(1, high / 100)) {
    const uint64_t middle = low + (high - low) / 2;
    const Result<double> at = error(middle);
    if (!at.ok()) return at.status();
    (*at <= most ? high : low) = middle;
  }
  return high;
}

/// Where the heights are as good as a mesh of so many triangles shows.
Result<uint64_t> bytesFor(const Errors& errors, const tks_info& info, uint32_t triangles) {
  const Result<double> mesh = errors.ofMesh(info.available_bytes, triangles);
  if (!mesh.ok()) return mesh.status();
  return leastThat(info.header_bytes, info.available_bytes, *mesh / kMeshShare,
                   [&](uint64_t bytes) { return errors.ofBytes(bytes); });
}

/// Where the texture ends, which any mesh shows.
Result<uint64_t> bytesOfTexture(std::span<const uint8_t> stream, const tks_info& info) {
  if (info.texture_bytes == 0) return info.header_bytes;
  return leastThat(info.header_bytes, info.available_bytes, 0,
                   [&](uint64_t bytes) -> Result<double> {
                     const Result<Decoder> decoder = openDecoder(stream.first(bytes));
                     if (!decoder) return decoder.status();
                     return static_cast<double>(info.texture_bytes - decoder->info().texture_bytes);
                   });
}

Result<uint32_t> trianglesFor(const Errors& errors, uint64_t bytes) {
  const Result<double> stream = errors.ofBytes(bytes);
  if (!stream.ok()) return stream.status();
  const Result<uint64_t> most = leastThat(
      1, errors.mostTriangles(), *stream * kMeshShare,
      [&](uint64_t triangles) { return errors.ofMesh(bytes, static_cast<uint32_t>(triangles)); });
  if (!most.ok()) return most.status();
  return static_cast<uint32_t>(*most);
}

Status checkReceiver(const Receiver& receiver) {
  const int known = int(receiver.channel.has_value()) + int(receiver.renderer.has_value()) +
                    int(receiver.seconds.has_value());
  if (known >= 2) return {};
  return {TKS_USAGE, "give two of --channel, --renderer and --seconds, or all"};
}

/// The bytes that come in time, if that bounds them.
Status boundByChannel(const tks_info& info, ReceiverPlan& plan) {
  const auto& [channel, renderer, seconds, fps] = plan.receiver;
  if (!channel || !seconds) return {};
  const double bytes = std::floor(*channel / 8 * *seconds);
  if (bytes >= static_cast<double>(plan.bytes)) return {};
  plan.bytes = static_cast<uint64_t>(bytes);
  plan.limit = "channel";
  if (plan.bytes >= info.least_bytes) return {};
  return {TKS_USAGE, "in that time " + std::to_string(plan.bytes) +
                         " bytes come, and the header alone takes " +
                         std::to_string(info.least_bytes)};
}

}  // namespace

Result<ReceiverPlan> planFor(std::span<const uint8_t> stream, const Receiver& receiver) {
  if (Status status = checkReceiver(receiver); !status.ok()) return status;
  const Result<Decoder> decoder = openDecoder(stream);
  if (!decoder) return decoder.status();
  const tks_info& info = decoder->info();
  ReceiverPlan plan = {info.available_bytes, {}, receiver, "stream"};
  if (Status status = boundByChannel(info, plan); !status.ok()) return status;
  if (info.has_heights) {
    const Result<Errors> errors = Errors::of(stream);
    if (!errors.ok()) return errors.status();
    if (receiver.renderer) {
      const double most = errors->mostTriangles();
      plan.triangles =
          static_cast<uint32_t>(std::clamp(*receiver.renderer / receiver.fps, 1.0, most));
      const Result<uint64_t> heights = bytesFor(*errors, info, *plan.triangles);
      if (!heights.ok()) return heights.status();
      const Result<uint64_t> texture = bytesOfTexture(stream, info);
      if (!texture.ok()) return texture.status();
      if (const uint64_t enough = std::max(*heights, *texture); enough < plan.bytes) {
        plan.bytes = enough;
        plan.limit = "renderer";
      }
    } else {
      const Result<uint32_t> triangles = trianglesFor(*errors, plan.bytes);
      if (!triangles.ok()) return triangles.status();
      plan.triangles = *triangles;
      plan.receiver.renderer = *triangles * receiver.fps;
    }
  }
  const double bits = 8 * static_cast<double>(plan.bytes);
  if (!receiver.seconds) plan.receiver.seconds = bits / *receiver.channel;
  if (!receiver.channel) plan.receiver.channel = bits / *receiver.seconds;
  return plan;
}

}  // namespace tetrakis::tools
