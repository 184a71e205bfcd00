// SPDX-License-Identifier: Apache-2.0
// What an encoding does, step by step.
#include "encoder/encode_job.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <future>

#include "base/samples.hpp"

namespace tetrakis {

namespace {

Texels toTexels(const tks_image& image) {
  Texels texels{image.width, image.height, image.channels, image.sample == TKS_U8 ? 8 : 16, {}};
  const size_t count = size_t{image.width} * image.height * image.channels;
  withSampleType(image.sample, [&](auto type) {
    const auto* from = static_cast<const decltype(type)*>(image.data);
    texels.samples.resize(count);
    std::transform(from, from + count, texels.samples.begin(),
                   [](auto v) { return static_cast<uint16_t>(v); });
  });
  return texels;
}

/// Sides of regions, chosen so that they cost about 1 % of the bytes (docs/ARCHITECTURE.md).
constexpr int kRegionLog2 = 9;
constexpr uint64_t kOneRegionHeights = 1025 * 1025, kOneRegionTexels = 2048 * 2048;

/// 0: one region.
int regionLog2(uint32_t width, uint32_t height, uint32_t wanted, bool automatic) {
  const int log2 = wanted > 1                 ? std::countr_zero(wanted)
                   : wanted == 0 && automatic ? kRegionLog2
                                              : 0;
  return regionCount(width, height, log2) > 1 ? log2 : 0;
}

/// Corrections to a largest error lie behind all coefficients: no window of them can be decoded
/// alone.
int geometryRegions(const tks_heights& heights, const tks_encode_options& options) {
  const bool large = uint64_t{heights.width} * heights.height > kOneRegionHeights;
  return regionLog2(heights.width, heights.height, options.regions,
                    large && options.max_error == 0);
}

int textureRegions(const tks_image& image, const tks_encode_options& options) {
  const bool large = uint64_t{image.width} * image.height > kOneRegionTexels;
  return regionLog2(image.width, image.height, options.regions, large);
}

}  // namespace

Codewords codewordsOf(const std::vector<EncodedTrack>& tracks) {
  Codewords codewords;
  for (const EncodedTrack& track : tracks) codewords.push_back(track.codeword);
  return codewords;
}

EncodeJob::EncodeJob(const tks_heights* heights, const tks_image* image,
                     const tks_encode_options& options)
    : heights_(heights), image_(image), options_(options) {}

Result<std::vector<uint8_t>> EncodeJob::run() {
  if (Status status = report(0); !status.ok()) return status;
  if (Status status = quantise(); !status.ok()) return status;
  if (Status status = encodeTracks(); !status.ok()) return status;
  order();
  encodeLosslessIfItFits();
  if (Status status = report(0.9); !status.ok()) return status;
  Result<Needs> wanted = needs();
  if (!wanted.ok()) return wanted.status();
  if (options_.psnr > 0) preferLossless(*wanted);
  preferStored(*wanted);
  keepNeeded(*wanted);
  packets_ = joinNeighbours(packets_);
  keepWithinBudget();
  Result<std::vector<uint8_t>> stream = assemble();
  if (Status status = report(0.95); !status.ok()) return status;
  return stream;
}

Status reportProgress(const tks_encode_options& options, double done) {
  if (options.progress == nullptr || options.progress(options.user, done) == 0) return {};
  return {TKS_USAGE, "Encoding was stopped by the caller."};
}

Status EncodeJob::report(double done) const {
  return reportProgress(options_, done);
}

Status EncodeJob::quantise() {
  if (image_ != nullptr) source_ = toTexels(*image_);
  if (heights_ == nullptr) return {};
  const double error = options_.max_error / std::abs(heights_->scale);
  bool restore = options_.lossless != 0;
  Result<HeightSteps> steps = toSteps(*heights_, {heights_->step, restore, error, budgeted()});
  if (steps.ok() && error > 0 && errorsOf(*heights_, *steps).largest > error) {
    if (heights_->step > 0) {
      return {TKS_USAGE,
              "The maximum error is below what the step of these heights allows; give a smaller "
              "step."};
    }
    restore = true;
    steps = toSteps(*heights_, {.lossless = true});
  }
  if (!steps.ok()) return steps.status();
  geometry_.emplace();
  geometry_->steps = std::move(*steps);
  encodeSideLayers(restore && !geometry_->steps.exact);
  return {};
}

/// Without a target everything is sent, and whole steps are the cheapest way to the last bit.
Purpose EncodeJob::texturePurpose() const {
  const bool targeted = budgeted() || options_.psnr > 0 || options_.max_error > 0;
  return options_.lossless || !targeted ? Purpose::kLossless : Purpose::kLossy;
}

Purpose EncodeJob::geometryPurpose() const {
  const double finest = geometry_->steps.step * std::abs(heights_->scale);
  const bool fine = options_.max_error > 0 && options_.max_error < 2 * finest;
  const bool restores = geometry_->layers.corrections == CorrectionKind::kSamples;
  return fine || restores ? Purpose::kLossless : texturePurpose();
}

/// Bytes worth coding: beyond the budget, because the slopes of the last packets within
/// it depend on the points that follow, and the order must not depend on the budget.
TextureOptions EncodeJob::trackOptions(Component component) const {
  constexpr uint64_t kMargin = 4096;
  TextureOptions track;
  if (budgeted()) track.room = options_.bytes;
  if (track.room < UINT64_MAX / 4) track.limit = 2 * track.room + kMargin;
  track.region_log2 = component == Component::kGeometry ? geometryRegions(*heights_, options_)
                                                        : textureRegions(*image_, options_);
  track.threads = options_.threads;
  if (component == Component::kTexture && options_.psnr > 0)
    track.mean_square = worstMeanSquare(source_->texels.most(), options_.psnr);
  track.visual = component == Component::kTexture && options_.weights == TKS_WEIGHTS_VISUAL;
  return track;
}

Status EncodeJob::encodeTracks() {
  const bool parallel = options_.threads > 1 && geometry_ && image_ != nullptr;
  const auto encode_texture = [&] {
    return encodeTexture(*source_, texturePurpose(), trackOptions(Component::kTexture));
  };
  std::future<EncodedTexture> texture;
  if (image_ != nullptr) {
    texture = std::async(parallel ? std::launch::async : std::launch::deferred, encode_texture);
  }
  if (options_.max_error > 0) {
    boundHeights();
  } else if (geometry_) {
    encodeGeometry(geometryPurpose());
  }
  if (Status status = report(0.4); !status.ok()) return status;
  if (texture.valid()) texture_ = texture.get();
  if (texture_ && options_.psnr > 0) reachTarget();
  return report(0.8);
}

/// Coding that ended where the account met the target goes on if samples do not.
void EncodeJob::reachTarget() {
  const std::vector<EncodedTrack>& tracks = texture_->tracks;
  if (tracks.front().complete || textureMeetsTarget(bytesOf(tracks))) return;
  TextureOptions to_the_end = trackOptions(Component::kTexture);
  to_the_end.mean_square = 0;
  texture_ = encodeTexture(*source_, texturePurpose(), to_the_end);
}

/// The budget buys so much of every track that losslessness is in reach.
bool EncodeJob::nearlyExact() const {
  std::array<double, kComponents> rmse = {rmseOf(255), rmseOf(255)};
  uint64_t room = options_.bytes;
  for (const Packet& packet : packets_) {
    const uint64_t size = overheadOf(packet) + packet.end - packet.begin;
    if (size > room) break;
    room -= size;
    rmse[static_cast<size_t>(packet.component)] = rmseOf(packet.quality);
  }
  const auto reached = [&](bool present, size_t track) {
    return !present || rmse[track] <= kNearlyExact;
  };
  return reached(geometry_.has_value(), 0) && reached(texture_.has_value(), 1);
}

/// Where a byte budget nearly reaches the last bit, tracks without fraction bits may reach it: they
/// are the cheaper way to lossless.
void EncodeJob::encodeLosslessIfItFits() {
  const bool possible = !geometry_ || geometry_->steps.exact;
  const bool drawn = texture_ && texture_->header.direct();  // lossless as it stands
  if (!budgeted() || !possible || (drawn && !geometry_) || !nearlyExact()) return;
  const std::vector<Packet> lossy_packets = packets_;
  const std::optional<EncodedHeights> lossy_geometry = geometry_;
  std::vector<EncodedTexture> lossy_texture;
  if (geometry_) encodeGeometry(Purpose::kLossless);
  if (texture_ && !drawn) {
    lossy_texture.push_back(std::move(*texture_));
    texture_ = encodeTexture(*source_, Purpose::kLossless, trackOptions(Component::kTexture));
  }
  const uint64_t bytes =
      (geometry_ ? bytesOf(geometry_->tracks) : 0) + (texture_ ? bytesOf(texture_->tracks) : 0);
  if (bytes < options_.bytes) {
    order();
    const std::vector<Packet> ordered = packets_;
    packets_ = joinNeighbours(ordered);
    const bool fits = isLossless();
    packets_ = ordered;
    if (fits) return;
  }
  geometry_ = lossy_geometry;
  if (!lossy_texture.empty()) texture_ = std::move(lossy_texture.front());
  packets_ = lossy_packets;
}

}  // namespace tetrakis
