// SPDX-License-Identifier: Apache-2.0
// Quality targets of an encoding: how many bytes of each track --psnr and --max-error need, found
// by decoding what would be sent.
#include <algorithm>
#include <cmath>

#include "api/encode_job.hpp"
#include "api/samples.hpp"

namespace tetrakis {

namespace {

struct HeightErrors {
  double mean_square = 0, largest = 0, range = 0;  // in sample units
};

/// Decoded samples against the input's, as a reader of the stream will see them.
HeightErrors measure(const tks_heights& original, const GeometryHeader& header,
                     const std::vector<int32_t>& steps) {
  return withSampleType(original.sample, [&](auto type) {
    using T = decltype(type);
    std::vector<T> decoded(steps.size());
    fromSteps(steps, header, decoded.data());
    const T* truth = static_cast<const T*>(original.data);
    const auto [low, high] = std::minmax_element(truth, truth + steps.size());
    HeightErrors errors;
    errors.range = static_cast<double>(*high) - static_cast<double>(*low);
    for (size_t i = 0; i < steps.size(); ++i) {
      const double error =
          std::abs(static_cast<double>(decoded[i]) - static_cast<double>(truth[i]));
      errors.mean_square += error * error / static_cast<double>(steps.size());
      errors.largest = std::max(errors.largest, error);
    }
    return errors;
  });
}

double worstMeanSquare(double peak, double psnr) {
  return peak * peak / std::pow(10, psnr / 10);
}

/// Ends of a track's packets, from none on.
std::vector<uint64_t> endsOf(const std::vector<Packet>& packets, TrackId track) {
  std::vector<uint64_t> ends = {0};
  for (const Packet& packet : packets) {
    if (packet.track == track) ends.push_back(packet.end);
  }
  return ends;
}

/// The first of the ends that `meets` accepts, by bisection (quality rises with bytes); the last
/// one if none does.
template <class Meets>
uint64_t first(const std::vector<uint64_t>& ends, Meets meets) {
  size_t low = 0, high = ends.size() - 1;
  while (low < high) {
    const size_t middle = (low + high) / 2;
    if (meets(ends[middle])) {
      high = middle;
    } else {
      low = middle + 1;
    }
  }
  return ends[high];
}

}  // namespace

bool EncodeJob::geometryMeetsTarget(uint64_t bytes) const {
  const StreamHeader header = makeHeader(0, false);
  const GeometryHeader& g = *header.geometry;
  const HeightErrors errors = measure(*heights_, g, decodedSteps(bytes));
  if (options_.max_error > 0)
    return errors.largest * std::abs(heights_->scale) <= options_.max_error;
  return errors.mean_square <= worstMeanSquare(errors.range, options_.psnr);
}

bool EncodeJob::textureMeetsTarget(uint64_t bytes) const {
  const double peak = (1 << texels_.bits) - 1;
  return textureSquares(bytes) / static_cast<double>(texels_.samples.size()) <=
         worstMeanSquare(peak, options_.psnr);
}

Result<uint64_t> EncodeJob::geometryNeed() const {
  const uint64_t need = first(endsOf(packets_, TrackId::kGeometry),
                              [&](uint64_t bytes) { return geometryMeetsTarget(bytes); });
  if (!geometryMeetsTarget(need)) {
    return Status(
        TKS_USAGE,
        options_.max_error > 0
            ? "The maximum error is below what the step of these heights allows; give a smaller "
              "step."
            : "This PSNR is above what the step of the heights allows; give a smaller step.");
  }
  return need;
}

/// Without a target of its own the texture gets what the order puts before the last geometry
/// packet.
uint64_t EncodeJob::textureNeed(const Needs& so_far) const {
  if (options_.psnr > 0 || !geometry_) {
    return first(endsOf(packets_, TrackId::kTexture),
                 [&](uint64_t bytes) { return textureMeetsTarget(bytes); });
  }
  uint64_t need = 0;
  for (const Packet& packet : packets_) {
    if (packet.track == TrackId::kTexture) need = packet.end;
    if (packet.track == TrackId::kGeometry && packet.end >= so_far[0]) break;
  }
  return need;
}

Result<EncodeJob::Needs> EncodeJob::needs() const {
  Needs needs = {UINT64_MAX, UINT64_MAX};
  if (options_.bytes != 0 || options_.lossless != 0) return needs;
  if (geometry_) {
    Result<uint64_t> need = geometryNeed();
    if (!need.ok()) return need.status();
    needs[0] = *need;
  }
  if (texture_) needs[1] = textureNeed(needs);
  return needs;
}

void EncodeJob::keepNeeded(const Needs& needs) {
  std::erase_if(packets_, [&](const Packet& packet) {
    return packet.begin >= needs[static_cast<size_t>(packet.track)];
  });
}

}  // namespace tetrakis
