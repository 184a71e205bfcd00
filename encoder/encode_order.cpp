// SPDX-License-Identifier: Apache-2.0
// The joint order of the packets: what every byte of either track is worth to a viewer.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>

#include "codec/geometry/geometry_decoder.hpp"
#include "codec/mesh/decimation.hpp"
#include "encoder/encode_job.hpp"
#include "ratecontrol/hull.hpp"
#include "ratecontrol/screen_model.hpp"
#include "ratecontrol/track_order.hpp"
#include "texture_wavelet/texture_decoder.hpp"

namespace tetrakis {

namespace {

/// A packet is at least this fraction of its track's bytes before it: heads stay below 1 %.
constexpr double kPacketGrowth = 0.1;

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

/// The packets of a track and its hull in the common distortion. opening: bytes that come first
/// whatever they cost.
template <class MeanSquare, class Cost>
TrackCurve priced(TrackId track, std::vector<RatePoint> points, MeanSquare mean_square, Cost cost,
                  uint64_t opening = 0) {
  std::map<uint64_t, uint8_t> quality;
  for (RatePoint& point : points) {
    quality[point.bytes] = qualityOf(std::sqrt(mean_square(point.distortion)));
    point.distortion = cost(point.distortion);
  }
  favour(points, opening);
  TrackCurve curve{lowerHull(points, kPacketGrowth), {}};
  uint64_t begin = 0;
  for (size_t i = 1; i < curve.points.size(); ++i) {
    for (const RatePoint& end : packetEnds(points, curve.points[i - 1], curve.points[i])) {
      curve.packets.push_back({track, end.dips, quality[end.bytes], begin, end.bytes, {}});
      begin = end.bytes;
    }
  }
  return curve;
}

/// The same of several tracks, whose packets are in an order of their own.
template <class MeanSquare, class Cost>
TrackCurve priced(OrderedTracks tracks, MeanSquare mean_square, Cost cost, uint64_t opening = 0) {
  for (size_t i = 0; i < tracks.packets.size(); ++i) {
    const double squares = tracks.points[i + 1].distortion;
    tracks.packets[i].quality = qualityOf(std::sqrt(mean_square(squares)));
  }
  for (RatePoint& point : tracks.points) point.distortion = cost(point.distortion);
  favour(tracks.points, opening);
  return {lowerHull(tracks.points, 0), std::move(tracks.packets)};
}

double metresPerUnit(const char* unit) {
  const std::string name = unit ? unit : "";
  return name == "ft" || name == "us-ft" ? 0.3048
         : name == "cm"                  ? 0.01
         : name == "mm"                  ? 0.001
         : name == "km"                  ? 1000
                                         : 1;
}

}  // namespace

const std::vector<EncodedTrack>& EncodeJob::tracksOf(TrackId component) const {
  return component == TrackId::kGeometry ? geometry_->tracks : texture_->tracks;
}

/// Those that count in the error of a component.
double EncodeJob::samplesOf(TrackId component) const {
  if (component == TrackId::kTexture)
    return static_cast<double>(countedSamples(texels_, texture_->seen));
  return static_cast<double>(std::max<size_t>(geometry_->steps.validCount(), 1));
}

/// What the first bytes of a component's packets hold.
Codewords EncodeJob::cutAt(TrackId component, uint64_t bytes) const {
  Codewords all = codewordsOf(tracksOf(component));
  assert(bytes <= bytesOf(tracksOf(component)));
  if (all.size() == 1) return {all.front().first(bytes)};
  if (bytes >= bytesOf(tracksOf(component))) return all;
  Codewords cut(all.size());
  for (const Packet& packet : packets_) {
    if (packet.track != component) continue;
    const uint64_t taken = std::min(bytes, packet.end - packet.begin);
    cut[*packet.region] = all[*packet.region].first(packet.begin + taken);
    bytes -= taken;
    if (bytes == 0) break;
  }
  return cut;
}

DecodedHeights EncodeJob::decodedHeights(uint64_t bytes, HeightsMemory* memory) const {
  const StreamHeader header = makeHeader(0, false);
  return decodeHeights(*header.geometry, header.layers, cutAt(TrackId::kGeometry, bytes), {},
                       {options_.threads, memory});
}

Texels EncodeJob::decodedTexels(uint64_t bytes, TextureMemory* memory) const {
  const StreamHeader header = makeHeader(0, false);
  return decodeTexture(*header.texture, cutAt(TrackId::kTexture, bytes), {},
                       {options_.threads, memory});
}

AuditScope EncodeJob::auditScope(uint64_t samples) const {
  return {samples, budgeted() ? options_.bytes : UINT64_MAX};
}

/// Sum of squared errors of the samples, in steps, voids that are not known among them.
double EncodeJob::geometrySquares(uint64_t bytes, HeightsMemory* memory) const {
  const EncodedHeights& g = *geometry_;
  const bool corrected = g.layers.corrections == CorrectionKind::kSamples;
  if ((corrected || g.stored()) && bytes == bytesOf(g.tracks)) return 0;
  const DecodedGeometry decoded = decodedHeights(bytes, memory).geometry;
  HeightSteps prefix = {wholeSteps(decoded), g.steps.valid, g.steps.base, g.steps.step};
  double unknown = 0;
  for (size_t i = 0; i < decoded.valid.size(); ++i) {
    if (decoded.valid[i] == prefix.valid[i]) continue;
    unknown += g.validityWorth();
    prefix.valid[i] = 0;
  }
  const double squares = g.squaresOf(*heights_, prefix);
  return unknown + std::max(squares, std::min(g.left, EncodedHeights::kSomething));
}

double EncodeJob::textureSquares(uint64_t bytes, TextureMemory* memory) const {
  return countedSquares(texels_, decodedTexels(bytes, memory), texture_->seen);
}

TrackCurve EncodeJob::geometryCurve() const {
  if (!geometry_) return {};
  const double samples = samplesOf(TrackId::kGeometry);
  const double step =
      geometry_->steps.step * std::abs(heights_->scale) * metresPerUnit(heights_->unit);
  const double floor = meshFloor();
  const auto mean_square = [&](double squares) { return squares / samples; };
  const auto useful = [&](double squares) { return std::max(mean_square(squares), floor); };
  const uint64_t opening = geometry_->validity.size();
  const auto curve = [&](const auto& cost) {
    if (geometry_->tracks.size() > 1) {
      return priced(orderTracks(TrackId::kGeometry, geometry_->tracks,
                                {opening, geometry_->corrections.size()}),
                    mean_square, cost, opening);
    }
    HeightsMemory memory;
    return priced(TrackId::kGeometry,
                  audit(geometry_->tracks.front(), auditScope(geometry_->steps.steps.size()),
                        [&](uint64_t bytes) { return geometrySquares(bytes, &memory); }),
                  mean_square, cost, opening);
  };
  if (image_ == nullptr) return curve(useful);
  const ScreenModel model(texels_, texelsPerMetre(step));
  return curve([&](double squares) { return model.cost(useful(squares) * step * step); });
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
  return squares / samplesOf(TrackId::kGeometry) / 16;
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
  const double samples = samplesOf(TrackId::kTexture);
  const auto mean_square = [&](double squares) { return squares / samples; };
  const uint64_t opening = texture_->header.alpha_bytes + texture_->header.overlay_bytes;
  if (texture_->tracks.size() > 1) {
    return priced(orderTracks(TrackId::kTexture, texture_->tracks, {opening, 0}), mean_square,
                  mean_square, opening);
  }
  TextureMemory memory;
  return priced(TrackId::kTexture,
                audit(texture_->tracks.front(), auditScope(texels_.samples.size()),
                      [&](uint64_t bytes) { return textureSquares(bytes, &memory); }),
                mean_square, mean_square, opening);
}

void EncodeJob::order() {
  packets_ = allocate({geometryCurve(), textureCurve()});
}

}  // namespace tetrakis
