// SPDX-License-Identifier: Apache-2.0
#include "api/encode_job.hpp"

#include <algorithm>
#include <cmath>
#include <future>

#include "api/samples.hpp"
#include "codec/geometry_encoder.hpp"
#include "ratecontrol/hull.hpp"
#include "ratecontrol/screen_model.hpp"

namespace tetrakis {

namespace {

/// A packet is at least this fraction of its track's bytes before it: heads stay below 1 %.
constexpr double kPacketGrowth = 0.1;

Texels toTexels(const tks_image& image) {
  Texels texels{image.width, image.height, image.channels, image.sample == TKS_U8 ? 8 : 16, {}};
  const size_t count = size_t{image.width} * image.height * image.channels;
  withSampleType(image.sample, [&](auto type) {
    const auto* from = static_cast<const decltype(type)*>(image.data);
    texels.samples.resize(count);
    std::transform(from, from + count, texels.samples.begin(), [](auto v) { return static_cast<int32_t>(v); });
  });
  return texels;
}

double metresPerUnit(const char* unit) {
  const std::string name = unit ? unit : "";
  return name == "ft" ? 0.3048 : name == "cm" ? 0.01 : name == "mm" ? 0.001 : name == "km" ? 1000 : 1;
}

}  // namespace

EncodeJob::EncodeJob(const tks_heights* heights, const tks_image* image, const tks_encode_options& options)
    : heights_(heights), image_(image), options_(options) {}

Result<std::vector<uint8_t>> EncodeJob::run() {
  if (Status status = quantise(); !status.ok()) return status;
  if (Status status = encodeTracks(); !status.ok()) return status;
  order();
  if (Status status = encodeLosslessGeometryIfItFits(); !status.ok()) return status;
  if (Status status = report(0.9); !status.ok()) return status;
  Result<Needs> wanted = needs();
  if (!wanted.ok()) return wanted.status();
  keepNeeded(*wanted);
  return assemble();
}

Status EncodeJob::report(double done) const {
  if (options_.progress == nullptr || options_.progress(options_.user, done) == 0) return {};
  return {TKS_USAGE, "Encoding was stopped by the caller."};
}

Status EncodeJob::quantise() {
  if (image_ != nullptr) texels_ = toTexels(*image_);
  if (heights_ == nullptr) return {};
  const double finest_useful = options_.max_error > 0 ? options_.max_error / std::abs(heights_->scale) / 16 : 0;
  Result<HeightSteps> steps = toSteps(*heights_, heights_->step, finest_useful);
  if (!steps.ok()) return steps.status();
  if (options_.lossless && !steps->exact) {
    return {TKS_USAGE,
            "No uniform step restores these heights bit for bit; use --max-error instead of lossless."};
  }
  geometry_.emplace();
  geometry_->steps = std::move(*steps);
  return {};
}

/// Every lifting step rounds to whole units; on coarse steps that noise is heard long before the
/// stream is lossless. Four more bits make it negligible; heights with many bits need none.
int EncodeJob::lossyFractionBits() const {
  const HeightSteps& steps = geometry_->steps;
  const double finest = steps.step * std::abs(heights_->scale);
  if (options_.lossless || (options_.max_error > 0 && options_.max_error < 2 * finest)) return 0;
  return std::clamp(20 - steps.range_bits, 0, 4);
}

void EncodeJob::encodeGeometryWith(int fraction_bits) {
  geometry_->fraction_bits = fraction_bits;
  std::vector<int32_t> scaled = geometry_->steps.steps;
  for (int32_t& q : scaled) q *= 1 << fraction_bits;
  geometry_->track = encodeGeometry(scaled, heights_->width, heights_->height,
                                    options_.bytes != 0 ? options_.bytes : UINT64_MAX);
}

Status EncodeJob::encodeTracks() {
  const uint64_t limit = options_.bytes != 0 ? options_.bytes : UINT64_MAX;
  const bool parallel = options_.threads > 1 && geometry_ && image_ != nullptr;
  const auto encode_texture = [&] { return encodeTexture(texels_, limit); };
  std::future<EncodedTexture> texture;
  if (image_ != nullptr) {
    texture = std::async(parallel ? std::launch::async : std::launch::deferred, encode_texture);
  }
  if (geometry_) encodeGeometryWith(lossyFractionBits());
  if (Status status = report(0.4); !status.ok()) return status;
  if (texture.valid()) texture_ = texture.get();
  return report(0.8);
}

/// Where a byte budget nearly reaches the heights' last step, whole units may reach it: they are the
/// cheaper way to lossless.
Status EncodeJob::encodeLosslessGeometryIfItFits() {
  constexpr double kNearlyExact = 0.6;  // RMSE in steps at which losslessness is in reach
  if (!geometry_ || options_.bytes == 0 || geometry_->fraction_bits == 0 || !geometry_->steps.exact) return {};
  uint64_t room = options_.bytes;
  double rmse = rmseOf(255);
  for (const Packet& packet : packets_) {
    const uint64_t size = overheadOf(packet) + packet.end - packet.begin;
    if (size > room) break;
    room -= size;
    if (packet.track == TrackId::kGeometry) rmse = rmseOf(packet.quality);
  }
  if (rmse > kNearlyExact) return {};
  Geometry lossy = *geometry_;
  encodeGeometryWith(0);
  order();
  if (geometry_->track.complete && everythingWithin(options_.bytes)) return {};
  geometry_ = std::move(lossy);
  order();
  return {};
}

bool EncodeJob::everythingWithin(uint64_t payload) const {
  uint64_t total = 0;
  for (const Packet& packet : packets_) total += overheadOf(packet) + packet.end - packet.begin;
  return total <= payload && (!geometry_ || geometry_->track.complete) && (!texture_ || texture_->track.complete);
}

TrackCurve EncodeJob::geometryCurve() const {
  TrackCurve curve;
  if (!geometry_) return curve;
  const double unit = geometry_->steps.step * std::abs(heights_->scale) * metresPerUnit(heights_->unit);
  const double samples = static_cast<double>(geometry_->steps.steps.size());
  const double to_steps = std::exp2(-2 * geometry_->fraction_bits) / samples;
  std::vector<RatePoint> points = geometry_->track.points;
  if (image_ != nullptr) {
    const double relief = std::exp2(geometry_->steps.range_bits) * unit;
    const double side = std::max(heights_->width, heights_->height) - 1;
    const double spacing = heights_->spacing_x > 0 ? heights_->spacing_x : 10 * relief / side;
    const double texel = spacing * (heights_->width - 1) / image_->width;
    const double parallax = options_.parallax > 0 ? options_.parallax : kDefaultParallax;
    const ScreenModel model(texels_, parallax / texel);
    for (RatePoint& p : points) p.distortion = model.cost(p.distortion * to_steps * unit * unit);
  } else {
    for (RatePoint& p : points) p.distortion *= to_steps;
  }
  curve.points = lowerHull(points, kPacketGrowth);
  for (const RatePoint& p : curve.points) {
    const auto same = std::find_if(geometry_->track.points.begin(), geometry_->track.points.end(),
                                   [&](const RatePoint& q) { return q.bytes == p.bytes; });
    curve.rmse.push_back(std::sqrt(same->distortion * to_steps));
  }
  return curve;
}

TrackCurve EncodeJob::textureCurve() const {
  TrackCurve curve;
  if (!texture_) return curve;
  const double samples = static_cast<double>(texels_.samples.size());
  std::vector<RatePoint> points = texture_->track.points;
  for (RatePoint& p : points) p.distortion /= samples;
  curve.points = lowerHull(points, kPacketGrowth);
  for (const RatePoint& p : curve.points) curve.rmse.push_back(std::sqrt(p.distortion));
  return curve;
}

void EncodeJob::order() { packets_ = allocate({geometryCurve(), textureCurve()}); }

StreamHeader EncodeJob::makeHeader(uint64_t payload_bytes, bool lossless) const {
  StreamHeader header;
  header.payload_bytes = payload_bytes;
  header.lossless = lossless && (!geometry_ || geometry_->steps.exact);
  header.triangles = options_.triangles;
  if (geometry_) {
    GeometryHeader& g = header.geometry.emplace();
    g.width = heights_->width;
    g.height = heights_->height;
    g.sample = static_cast<uint8_t>(heights_->sample);
    g.fraction_bits = static_cast<uint8_t>(geometry_->fraction_bits);
    g.planes = static_cast<uint8_t>(geometry_->track.planes);
    g.exact = geometry_->steps.exact;
    g.base = geometry_->steps.base;
    g.step = geometry_->steps.step;
    g.max_error = options_.max_error > 0 ? options_.max_error : header.lossless ? 0 : -1;
    const auto text = [](const char* s) { return std::string(s ? s : ""); };
    header.metadata = {heights_->scale, heights_->offset, heights_->spacing_x, heights_->spacing_y,
                       text(heights_->unit), text(heights_->vertical_datum), text(heights_->crs)};
  }
  if (texture_) header.texture = texture_->header;
  if (options_.index != 0) {
    for (const Packet& packet : packets_) header.index.push_back({packet.head(), packet.quality});
  }
  return header;
}

/// Cuts inside a packet head, or inside a packet that counts only whole, buy nothing: leave them out.
uint64_t EncodeJob::usefulPayload(uint64_t room) const {
  uint64_t used = 0;
  for (const Packet& packet : packets_) {
    const uint64_t head = overheadOf(packet), size = head + packet.end - packet.begin;
    if (size > room - used) return packet.whole || room - used <= head ? used : room;
    used += size;
  }
  return used;
}

Result<std::vector<uint8_t>> EncodeJob::assemble() const {
  std::array<std::span<const uint8_t>, kTracks> codewords;
  if (geometry_) codewords[0] = geometry_->track.codeword;
  if (texture_) codewords[1] = texture_->track.codeword;
  uint64_t room = UINT64_MAX >> 1;
  if (options_.bytes != 0) {
    const size_t header_bytes = writeHeader(makeHeader(options_.bytes, false)).size();
    if (options_.bytes < header_bytes) {
      return Status(TKS_USAGE, "A budget of " + std::to_string(options_.bytes) +
                                   " bytes is too small: the header alone takes " +
                                   std::to_string(header_bytes) + ", the least that works.");
    }
    room = options_.bytes - header_bytes;
  }
  const uint64_t payload_bytes = usefulPayload(room);
  std::vector<uint8_t> stream = writeHeader(makeHeader(payload_bytes, everythingWithin(room)));
  const std::vector<uint8_t> payload = multiplex(packets_, codewords, payload_bytes);
  stream.insert(stream.end(), payload.begin(), payload.end());
  return stream;
}

}  // namespace tetrakis
