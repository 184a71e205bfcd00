// SPDX-License-Identifier: Apache-2.0
// Quality targets of an encoding: how many bytes of each track --psnr needs, found by decoding
// what would be sent, and what texture goes with heights of --max-error.
#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/samples.hpp"
#include "codec/geometry/stored_heights.hpp"
#include "codec/geometry/voids.hpp"
#include "encoder/encode_job.hpp"
#include "texture_wavelet/stored_encoder.hpp"
#include "texture_wavelet/texture_choice.hpp"

namespace tetrakis {

namespace {

/// A packet among the payload bytes of its component.
struct PayloadRange {
  uint64_t begin, end;
  bool whole;
};

std::vector<PayloadRange> rangesOf(const std::vector<Packet>& packets, Component component) {
  std::vector<PayloadRange> ranges;
  uint64_t sent = 0;
  for (const Packet& packet : packets) {
    if (packet.component != component) continue;
    ranges.push_back({sent, sent + packet.end - packet.begin, packet.whole});
    sent = ranges.back().end;
  }
  return ranges;
}

/// The least bytes that `meets` accepts, to 1/64 of a packet, by bisection (quality rises with
/// bytes); all of them if it never does.
template <class Meets>
uint64_t leastBytes(const std::vector<PayloadRange>& packets, Meets meets) {
  if (packets.empty() || meets(0)) return 0;
  const auto packet = std::partition_point(packets.begin(), packets.end(),
                                           [&](const PayloadRange& p) { return !meets(p.end); });
  if (packet == packets.end()) return packets.back().end;
  if (packet->whole) return packet->end;
  uint64_t low = packet->begin, high = packet->end;
  const uint64_t close = std::max<uint64_t>(1, (high - low) / 64);
  while (high - low > close) {
    const uint64_t middle = low + (high - low) / 2;
    (meets(middle) ? high : low) = middle;
  }
  return high;
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
    errors.mean_square = squares / samplesOf(Component::kGeometry);
    return errors;
  });
}

/// Where voids are belongs to what is asked for.
bool EncodeJob::geometryMeetsTarget(uint64_t bytes) const {
  if (bytes < geometry_->validity.size()) return false;
  const HeightErrors errors = heightErrors(bytes);
  return errors.mean_square <= worstMeanSquare(errors.range, options_.psnr);
}

bool EncodeJob::textureMeetsTarget(uint64_t bytes) const {
  return textureSquares(bytes) / samplesOf(Component::kTexture) <=
         worstMeanSquare(source_->texels.most(), options_.psnr);
}

Result<uint64_t> EncodeJob::geometryNeed() const {
  const uint64_t need = leastBytes(rangesOf(packets_, Component::kGeometry),
                                   [&](uint64_t bytes) { return geometryMeetsTarget(bytes); });
  if (geometryMeetsTarget(need)) return need;
  return Status(TKS_USAGE,
                "This PSNR is above what the step of the heights allows; give a smaller step.");
}

/// Without a target of its own the texture gets what the order puts before the last geometry
/// packet.
uint64_t EncodeJob::textureNeed(const Needs& so_far) const {
  if (options_.psnr > 0 || !geometry_) {
    return leastBytes(rangesOf(packets_, Component::kTexture),
                      [&](uint64_t bytes) { return textureMeetsTarget(bytes); });
  }
  Needs sent = {};
  for (const Packet& packet : packets_) {
    sent[static_cast<size_t>(packet.component)] += packet.end - packet.begin;
    if (packet.component == Component::kGeometry && sent[0] >= so_far[0]) break;
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

/// Next to the last bit, tracks without fraction bits reach it in fewer bytes.
void EncodeJob::preferLossless(Needs& needs) {
  const auto nearly_exact = [&](Component component) {
    return rmseOf(qualityAfter(component, needs[static_cast<size_t>(component)])) <= kNearlyExact;
  };
  bool changed = false;
  const auto decide = [&](auto& lossless, auto lossy, uint64_t& need) {
    if (bytesOf(lossless->tracks) < need) {
      need = UINT64_MAX;
      changed = true;
    } else {
      lossless = std::move(lossy);
    }
  };
  if (geometry_ && geometry_->steps.exact && nearly_exact(Component::kGeometry)) {
    std::optional<EncodedHeights> lossy = geometry_;
    encodeGeometry(Purpose::kLossless);
    decide(geometry_, std::move(lossy), needs[0]);
  }
  if (texture_ && !texture_->header.direct() && nearly_exact(Component::kTexture)) {
    std::optional<EncodedTexture> lossy = std::move(texture_);
    texture_ = encodeTexture(*source_, Purpose::kLossless, trackOptions(Component::kTexture));
    decide(texture_, std::move(lossy), needs[1]);
  }
  if (changed) order();
}

/// What no model helps, as noise, takes more bytes coded than stored.
void EncodeJob::preferStored(Needs& needs) {
  if (budgeted()) return;
  const auto pays = [](uint64_t need, const auto& component, uint64_t samples, uint64_t opening) {
    return samples > 0 && samples + opening < std::min(need, bytesOf(component->tracks));
  };
  bool changed = false;
  if (geometry_) {
    const uint64_t samples = storedBytes(*heights_, geometry_->steps.validCount());
    if (pays(needs[0], geometry_, samples, geometry_->validity.size())) {
      storeHeights();
      needs[0] = UINT64_MAX;
      changed = true;
    }
  }
  if (texture_ && pays(needs[1], texture_, storedBytes(source_->texels), 0)) {
    texture_ = storeTexture(source_->texels);
    needs[1] = UINT64_MAX;
    changed = true;
  }
  if (changed) order();
}

/// The last packet of a component ends where its need does.
void EncodeJob::keepNeeded(const Needs& needs) {
  Needs left = needs;
  std::vector<Packet> kept;
  for (Packet packet : packets_) {
    assert(packet.begin < packet.end);
    const auto component = static_cast<size_t>(packet.component);
    const uint64_t taken = std::min(left[component], packet.end - packet.begin);
    left[component] -= taken;
    if (taken == 0) continue;
    if (packet.begin + taken < packet.end) {
      packet.end = packet.begin + taken;
      packet.quality = qualityAfter(packet.component, needs[component]);
    }
    kept.push_back(packet);
  }
  packets_ = std::move(kept);
}

uint8_t EncodeJob::qualityAfter(Component component, uint64_t bytes) const {
  const double squares =
      component == Component::kGeometry ? geometrySquares(bytes) : textureSquares(bytes);
  return qualityOf(std::sqrt(squares / samplesOf(component)));
}

}  // namespace tetrakis
