// SPDX-License-Identifier: Apache-2.0
// Quality targets of an encoding: how many bytes of each track --psnr needs, found by decoding
// what would be sent, and what texture goes with heights of --max-error.
#include <algorithm>
#include <cmath>

#include "api/encode_job.hpp"
#include "api/samples.hpp"
#include "api/voids.hpp"

namespace tetrakis {

namespace {

double worstMeanSquare(double peak, double psnr) {
  return peak * peak / std::pow(10, psnr / 10);
}

/// Payload bytes up to the end of each of a component's packets, from none on.
std::vector<uint64_t> endsOf(const std::vector<Packet>& packets, TrackId track) {
  std::vector<uint64_t> ends = {0};
  for (const Packet& packet : packets) {
    if (packet.track == track) ends.push_back(ends.back() + packet.end - packet.begin);
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

HeightErrors EncodeJob::heightErrors(uint64_t bytes) const {
  const DecodedHeights decoded = decodedHeights(bytes);
  const StreamHeader header = makeHeader(0, false);
  const std::vector<uint8_t>& valid = geometry_->steps.valid;
  return withSampleType(heights_->sample, [&](auto type) {
    using T = decltype(type);
    std::vector<T> samples(decoded.geometry.heights.size());
    fromSteps(decoded, *header.geometry, header.layers, samples.data());
    const T* truth = static_cast<const T*>(heights_->data);
    const SampleRange range = rangeOf(*heights_, valid);
    HeightErrors errors;
    errors.range = range.high - range.low;
    double squares = 0;
    for (size_t i = 0; i < samples.size(); ++i) {
      if (!valid.empty() && !valid[i]) continue;
      const double error =
          std::abs(static_cast<double>(samples[i]) - static_cast<double>(truth[i]));
      squares += error * error;
      errors.largest = std::max(errors.largest, error);
    }
    errors.mean_square =
        squares / static_cast<double>(std::max<size_t>(geometry_->steps.validCount(), 1));
    return errors;
  });
}

bool EncodeJob::geometryMeetsTarget(uint64_t bytes) const {
  const HeightErrors errors = heightErrors(bytes);
  return errors.mean_square <= worstMeanSquare(errors.range, options_.psnr);
}

bool EncodeJob::textureMeetsTarget(uint64_t bytes) const {
  const double peak = (1 << texels_.bits) - 1;
  const uint64_t samples = countedSamples(texels_, texture_->seen);
  return textureSquares(bytes) / static_cast<double>(samples) <=
         worstMeanSquare(peak, options_.psnr);
}

Result<uint64_t> EncodeJob::geometryNeed() const {
  const uint64_t need = first(endsOf(packets_, TrackId::kGeometry),
                              [&](uint64_t bytes) { return geometryMeetsTarget(bytes); });
  if (geometryMeetsTarget(need)) return need;
  return Status(TKS_USAGE,
                "This PSNR is above what the step of the heights allows; give a smaller step.");
}

/// Without a target of its own the texture gets what the order puts before the last geometry
/// packet.
uint64_t EncodeJob::textureNeed(const Needs& so_far) const {
  if (options_.psnr > 0 || !geometry_) {
    return first(endsOf(packets_, TrackId::kTexture),
                 [&](uint64_t bytes) { return textureMeetsTarget(bytes); });
  }
  Needs sent = {};
  for (const Packet& packet : packets_) {
    sent[static_cast<size_t>(packet.track)] += packet.end - packet.begin;
    if (packet.track == TrackId::kGeometry && sent[0] >= so_far[0]) break;
  }
  return sent[1];
}

Result<EncodeJob::Needs> EncodeJob::needs() const {
  Needs needs = {UINT64_MAX, UINT64_MAX};
  if (options_.bytes != 0 || options_.lossless != 0) return needs;
  if (options_.max_error > 0) {  // the whole track, which was made for it
    const uint64_t coefficients = bytesOf(geometry_->tracks) - geometry_->corrections.size();
    if (texture_) needs[1] = textureNeed({coefficients, 0});
    return needs;
  }
  if (geometry_) {
    Result<uint64_t> need = geometryNeed();
    if (!need.ok()) return need.status();
    needs[0] = *need;
  }
  if (texture_) needs[1] = textureNeed(needs);
  return needs;
}

void EncodeJob::keepNeeded(const Needs& needs) {
  Needs sent = {};
  std::erase_if(packets_, [&](const Packet& packet) {
    const auto component = static_cast<size_t>(packet.track);
    const uint64_t begin = sent[component];
    sent[component] += packet.end - packet.begin;
    return begin >= needs[component];
  });
}

}  // namespace tetrakis
