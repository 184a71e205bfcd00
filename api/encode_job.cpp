// SPDX-License-Identifier: Apache-2.0
#include "api/encode_job.hpp"

#include <algorithm>
#include <cmath>
#include <future>
#include <map>

#include "api/samples.hpp"
#include "codec/corrections_encoder.hpp"
#include "codec/decimation.hpp"
#include "codec/geometry_decoder.hpp"
#include "codec/geometry_encoder.hpp"
#include "lattice/validity_encoder.hpp"
#include "ratecontrol/audit.hpp"
#include "ratecontrol/hull.hpp"
#include "ratecontrol/screen_model.hpp"
#include "texture_wavelet/texture_choice.hpp"
#include "texture_wavelet/texture_decoder.hpp"

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
    std::transform(from, from + count, texels.samples.begin(),
                   [](auto v) { return static_cast<uint16_t>(v); });
  });
  return texels;
}

template <class T>
double squaredDistance(const std::vector<T>& a, const std::vector<T>& b) {
  double sum = 0;
  for (size_t i = 0; i < a.size(); ++i) {
    const double difference = static_cast<double>(a[i]) - b[i];
    sum += difference * difference;
  }
  return sum;
}

/// Raises the first point so that the first `opening` bytes are worth the most of all: what they
/// hold, the rest needs.
void favour(std::vector<RatePoint>& points, uint64_t opening) {
  double steepest = 0;
  const auto opened = std::find_if(points.begin(), points.end(),
                                   [&](const RatePoint& p) { return p.bytes >= opening; });
  if (opened == points.begin() || opened == points.end()) return;
  for (auto p = opened + 1; p != points.end(); ++p) {
    const auto bytes = static_cast<double>(p->bytes - opened->bytes);
    steepest = std::max(steepest, (opened->distortion - p->distortion) / bytes);
  }
  const double worth = 1.01 * steepest * static_cast<double>(opened->bytes);
  points.front().distortion = std::max(points.front().distortion, opened->distortion + worth);
}

/// The hull of a track in the common distortion, with the RMSE that each packet states. opening:
/// bytes that come first whatever they cost.
template <class MeanSquare, class Cost>
TrackCurve priced(std::vector<RatePoint> points, MeanSquare mean_square, Cost cost,
                  uint64_t opening = 0) {
  std::map<uint64_t, double> rmse;
  for (RatePoint& point : points) {
    rmse[point.bytes] = std::sqrt(mean_square(point.distortion));
    point.distortion = cost(point.distortion);
  }
  favour(points, opening);
  TrackCurve curve;
  curve.points = lowerHull(points, kPacketGrowth);
  for (const RatePoint& point : curve.points) curve.rmse.push_back(rmse[point.bytes]);
  return curve;
}

double metresPerUnit(const char* unit) {
  const std::string name = unit ? unit : "";
  return name == "ft"   ? 0.3048
         : name == "cm" ? 0.01
         : name == "mm" ? 0.001
         : name == "km" ? 1000
                        : 1;
}

}  // namespace

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
  keepNeeded(*wanted);
  keepWithinBudget();
  Result<std::vector<uint8_t>> stream = assemble();
  if (Status status = report(1); !status.ok()) return status;
  return stream;
}

Status EncodeJob::report(double done) const {
  if (options_.progress == nullptr || options_.progress(options_.user, done) == 0) return {};
  return {TKS_USAGE, "Encoding was stopped by the caller."};
}

Status EncodeJob::quantise() {
  if (image_ != nullptr) texels_ = toTexels(*image_);
  if (heights_ == nullptr) return {};
  const double error = options_.max_error / std::abs(heights_->scale);
  bool restore = options_.lossless != 0;
  Result<HeightSteps> steps = toSteps(*heights_, {heights_->step, restore, error});
  if (steps.ok() && error > 0 && errorsOf(*heights_, *steps).largest > error) {
    if (heights_->step > 0) {
      return {TKS_USAGE,
              "The maximum error is below what the step of these heights allows; give a smaller "
              "step."};
    }
    restore = true;
    steps = toSteps(*heights_, {0, restore, 0});
  }
  if (!steps.ok()) return steps.status();
  geometry_.emplace();
  geometry_->steps = std::move(*steps);
  encodeSideLayers(restore && !geometry_->steps.exact);
  return {};
}

/// The layers that do not depend on the coefficients: validity, and corrections of the samples.
void EncodeJob::encodeSideLayers(bool restore_samples) {
  EncodedHeights& g = *geometry_;
  const bool infinite_integer = heights_->sample != TKS_F32 && !std::isfinite(heights_->nodata);
  g.layers.has_nodata =
      heights_->has_nodata != 0 && !std::isnan(heights_->nodata) && !infinite_integer;
  if (g.layers.has_nodata) g.layers.nodata = heights_->nodata + 0.0;  // -0 equals 0: one of them
  if (!g.steps.valid.empty()) {
    g.validity = encodeValidity(g.steps.valid, heights_->width, heights_->height);
    g.layers.validity_bytes = g.validity.size();
  }
  if (!restore_samples) return;
  g.layers.corrections = CorrectionKind::kSamples;
  const StreamHeader header = makeHeader(0, false);
  const std::vector<uint8_t> hints = sampleHints(g.steps.steps, *header.geometry);
  g.corrections = encodeCorrections(sampleCorrections(*heights_, g.steps),
                                    {heights_->width, heights_->height, g.steps.valid, hints});
  constexpr double kSomething = 1e-200;  // -0 for 0 is no distance, but not exact
  g.left =
      std::max(errorsOf(*heights_, g.steps).squares / (g.steps.step * g.steps.step), kSomething);
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

void EncodeJob::encodeGeometry(Purpose purpose) {
  const HeightSteps& steps = geometry_->steps;
  geometry_->wavelet = chooseWavelet(steps.steps, steps.valid, heights_->width, heights_->height,
                                     steps.range_bits, purpose);
  joinLayers(encodeCoefficients());
}

EncodedTrack EncodeJob::encodeCoefficients() const {
  return tetrakis::encodeGeometry(geometry_->steps.steps, heights_->width, heights_->height,
                                  geometry_->wavelet, trackLimit(), geometry_->steps.valid);
}

/// Validity before the coefficients, corrections of the samples behind them.
void EncodeJob::joinLayers(const EncodedTrack& coefficients) {
  EncodedHeights& g = *geometry_;
  EncodedTrack& track = g.track;
  track = coefficients;
  if (g.validity.empty() && g.corrections.empty() && g.left == 0) return;
  track.codeword = g.validity;
  track.codeword.insert(track.codeword.end(), coefficients.codeword.begin(),
                        coefficients.codeword.end());
  g.layers.coefficient_bytes = g.corrections.empty() ? 0 : coefficients.codeword.size();
  track.codeword.insert(track.codeword.end(), g.corrections.begin(), g.corrections.end());
  for (RatePoint& point : track.points) {
    point.bytes += g.validity.size();
    point.distortion += g.left;
  }
  if (!g.validity.empty()) {
    const auto voids = static_cast<double>(g.steps.steps.size() - g.steps.validCount());
    const double unknown = track.points.front().distortion + voids * g.validityWorth();
    track.points.insert(track.points.begin(), {0, unknown});
  }
  if (!g.corrections.empty()) track.points.push_back({track.codeword.size(), 0});
}

/// Bytes of a track worth coding. Beyond the budget, because the slopes of the last packets within
/// it depend on the points that follow, and the order must not depend on the budget.
uint64_t EncodeJob::trackLimit() const {
  constexpr uint64_t kMargin = 4096;
  const bool bounded = budgeted() && options_.bytes < UINT64_MAX / 4;
  return bounded ? 2 * options_.bytes + kMargin : UINT64_MAX;
}

Status EncodeJob::encodeTracks() {
  const bool parallel = options_.threads > 1 && geometry_ && image_ != nullptr;
  const auto encode_texture = [&] {
    return encodeTexture(texels_, texturePurpose(), trackLimit());
  };
  std::future<EncodedTexture> texture;
  if (image_ != nullptr) {
    texture = std::async(parallel ? std::launch::async : std::launch::deferred, encode_texture);
  }
  if (geometry_) encodeGeometry(geometryPurpose());
  if (options_.max_error > 0) boundHeights();
  if (Status status = report(0.4); !status.ok()) return status;
  if (texture.valid()) texture_ = texture.get();
  return report(0.8);
}

/// The budget buys so much of every track that losslessness is in reach.
bool EncodeJob::nearlyExact() const {
  constexpr double kNearlyExact = 0.6;  // RMSE in steps
  std::array<double, kTracks> rmse = {rmseOf(255), rmseOf(255)};
  uint64_t room = options_.bytes;
  for (const Packet& packet : packets_) {
    const uint64_t size = overheadOf(packet) + packet.end - packet.begin;
    if (size > room) break;
    room -= size;
    rmse[static_cast<size_t>(packet.track)] = rmseOf(packet.quality);
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
  if (!budgeted() || !possible || !nearlyExact()) return;
  std::optional<EncodedHeights> lossy_geometry = geometry_;
  std::optional<EncodedTexture> lossy_texture = texture_;
  if (geometry_) encodeGeometry(Purpose::kLossless);
  if (texture_) texture_ = encodeTexture(texels_, Purpose::kLossless, trackLimit());
  order();
  if (restoresEverything() && totalPayload() <= options_.bytes) return;
  geometry_ = std::move(lossy_geometry);
  texture_ = std::move(lossy_texture);
  order();
}

DecodedHeights EncodeJob::decodedHeights(uint64_t bytes) const {
  const StreamHeader header = makeHeader(0, false);
  return decodeLayers(std::span(geometry_->track.codeword).first(bytes), *header.geometry,
                      header.layers);
}

Texels EncodeJob::decodedTexels(uint64_t bytes) const {
  return decodeTexture(texture_->header, std::span(texture_->track.codeword).first(bytes));
}

/// Sum of squared errors in steps, voids that are not known among them.
double EncodeJob::geometrySquares(uint64_t bytes) const {
  const EncodedHeights& g = *geometry_;
  const DecodedGeometry decoded = decodedHeights(bytes).geometry;
  const std::vector<int32_t> steps = wholeSteps(decoded);
  const bool restored =
      g.layers.corrections == CorrectionKind::kSamples && bytes == g.track.codeword.size();
  double squares = restored ? 0 : g.left;
  if (g.validity.empty()) return squares + squaredDistance(steps, g.steps.steps);
  for (size_t i = 0; i < decoded.valid.size(); ++i) {
    const double difference = static_cast<double>(steps[i]) - g.steps.steps[i];
    const bool known = decoded.valid[i] == g.steps.valid[i];
    squares += known ? difference * difference : g.validityWorth();
  }
  return squares;
}

double EncodeJob::textureSquares(uint64_t bytes) const {
  return countedSquares(texels_, decodedTexels(bytes), texture_->seen);
}

TrackCurve EncodeJob::geometryCurve() const {
  if (!geometry_) return {};
  const auto samples = std::max<size_t>(geometry_->steps.validCount(), 1);
  const std::vector<RatePoint> points =
      audit(geometry_->track, geometry_->steps.steps.size(), budgeted(),
            [&](uint64_t bytes) { return geometrySquares(bytes); });
  const double step =
      geometry_->steps.step * std::abs(heights_->scale) * metresPerUnit(heights_->unit);
  const double floor = meshFloor();
  const auto mean_square = [&](double squares) { return squares / static_cast<double>(samples); };
  const auto useful = [&](double squares) { return std::max(mean_square(squares), floor); };
  const uint64_t opening = geometry_->validity.size();
  if (image_ == nullptr) return priced(points, mean_square, useful, opening);
  const ScreenModel model(texels_, texelsPerMetre(step));
  const auto seen = [&](double squares) { return model.cost(useful(squares) * step * step); };
  return priced(points, mean_square, seen, opening);
}

/// With a triangle budget, the mean squared error of the heights (in steps) below which more bytes
/// no longer help: a mesh of that many triangles is itself off by sixteen times as much, so that
/// its RMSE would fall by 3 % at most. 0 without a budget.
double EncodeJob::meshFloor() const {
  if (options_.triangles == 0) return 0;
  const Result<MeshSequence> sequence =
      decimate({heights_->width, heights_->height, geometry_->steps.steps});
  if (!sequence.ok()) return 0;
  const double squares = sequence->squaredError(sequence->bestPrefix(options_.triangles));
  return squares / static_cast<double>(std::max<size_t>(geometry_->steps.validCount(), 1)) / 16;
}

/// Texels that the texture moves per metre of height error. Terrain of unknown spacing is taken to
/// be ten times as wide as it is high.
double EncodeJob::texelsPerMetre(double step) const {
  const double relief = std::exp2(geometry_->steps.range_bits) * step;
  const double side = std::max(heights_->width, heights_->height) - 1;
  const double spacing = heights_->spacing_x > 0 ? heights_->spacing_x : 10 * relief / side;
  const double texel = spacing * (heights_->width - 1) / image_->width;
  return (options_.parallax > 0 ? options_.parallax : kDefaultParallax) / texel;
}

TrackCurve EncodeJob::textureCurve() const {
  if (!texture_) return {};
  const uint64_t samples = countedSamples(texels_, texture_->seen);
  const auto mean_square = [&](double squares) { return squares / static_cast<double>(samples); };
  return priced(audit(texture_->track, texels_.samples.size(), budgeted(),
                      [&](uint64_t bytes) { return textureSquares(bytes); }),
                mean_square, mean_square, texture_->header.alpha_bytes);
}

void EncodeJob::order() {
  packets_ = allocate({geometryCurve(), textureCurve()});
}

StreamHeader EncodeJob::makeHeader(uint64_t payload_bytes, bool lossless) const {
  StreamHeader header;
  header.payload_bytes = payload_bytes;
  header.lossless = lossless;
  header.triangles = options_.triangles;
  if (geometry_) {
    GeometryHeader& g = header.geometry.emplace();
    g.width = heights_->width;
    g.height = heights_->height;
    g.sample = static_cast<uint8_t>(heights_->sample);
    g.wavelet = geometry_->wavelet;
    g.planes = static_cast<uint8_t>(geometry_->track.planes);
    g.exact = geometry_->steps.exact;
    g.base = geometry_->steps.base;
    g.step = geometry_->steps.step;
    g.max_error = options_.max_error > 0 ? options_.max_error : header.lossless ? 0 : -1;
    header.layers = geometry_->layers;
    const auto text = [](const char* s) { return std::string(s ? s : ""); };
    header.metadata = {heights_->scale,     heights_->offset,     heights_->spacing_x,
                       heights_->spacing_y, text(heights_->unit), text(heights_->vertical_datum),
                       text(heights_->crs)};
  }
  if (texture_) header.texture = texture_->header;
  if (options_.index != 0) {
    for (const Packet& packet : packets_) header.index.push_back({packet.head(), packet.quality});
  }
  return header;
}

/// Packets that begin behind the budget are not sent, and no index need list them.
void EncodeJob::keepWithinBudget() {
  if (!budgeted()) return;
  uint64_t begin = 0;
  size_t kept = 0;
  for (; kept < packets_.size() && begin < options_.bytes; ++kept) {
    begin += overheadOf(packets_[kept]) + packets_[kept].end - packets_[kept].begin;
  }
  packets_.resize(kept);
}

uint64_t EncodeJob::totalPayload() const {
  uint64_t total = 0;
  for (const Packet& packet : packets_) total += overheadOf(packet) + packet.end - packet.begin;
  return total;
}

/// The last packet of either track states that nothing is left, or there was nothing to send.
bool EncodeJob::restoresEverything() const {
  std::array<bool, kTracks> exact = {!geometry_ || geometry_->track.points.front().distortion == 0,
                                     !texture_ || texture_->track.points.front().distortion == 0};
  for (const Packet& packet : packets_)
    exact[static_cast<size_t>(packet.track)] = packet.quality == 0;
  const bool restored = !geometry_ || geometry_->steps.exact ||
                        geometry_->layers.corrections == CorrectionKind::kSamples;
  const bool hidden = texture_ && texture_->header.hidden;
  return exact[0] && exact[1] && restored && !hidden;
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
  const uint64_t payload_bytes = std::min(room, totalPayload());
  const bool lossless = totalPayload() <= room && restoresEverything();
  std::vector<uint8_t> stream = writeHeader(makeHeader(payload_bytes, lossless));
  const std::vector<uint8_t> payload = multiplex(packets_, codewords, payload_bytes);
  stream.insert(stream.end(), payload.begin(), payload.end());
  return stream;
}

}  // namespace tetrakis
