// SPDX-License-Identifier: Apache-2.0
#include "tests/pace/slow_case.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <memory>
#include <random>
#include <utility>

#include "bitstream/stream/fields.hpp"
#include "bitstream/stream/header.hpp"

namespace tetrakis::test {

namespace {

using Bytes = std::vector<uint8_t>;

class Dice {
 public:
  explicit Dice(uint64_t seed) : random_(seed) {}
  /// From 0 to n - 1.
  uint64_t below(uint64_t n) { return random_() % n; }
  bool oneIn(uint64_t n) { return below(n) == 0; }
  /// From 1 to most, every order of magnitude as often.
  uint64_t anySize(uint64_t most) {
    const auto bits = static_cast<int>(below(static_cast<uint64_t>(std::bit_width(most))));
    return std::min(most, (uint64_t{1} << bits) + below(uint64_t{1} << bits));
  }
  uint8_t byte() { return static_cast<uint8_t>(random_()); }

 private:
  std::mt19937_64 random_;
};

/// A codeword: pieces of noise, of one byte and of short patterns. It mostly begins near an end of
/// the range.
Bytes codeword(Dice& dice, size_t size, std::string& description) {
  static const std::array<Bytes, 8> kBegins = {{{},
                                                {0xff, 0xff, 0xff, 0xff},
                                                {0xff, 0xff, 0xff, 0xfe},
                                                {0xff, 0xff, 0xff, 0xfd},
                                                {0xff, 0xff, 0xfe},
                                                {0, 0, 0, 0},
                                                {0, 0, 0, 1},
                                                {0x80, 0, 0, 0}}};
  const size_t begin = dice.below(kBegins.size());
  Bytes bytes = kBegins[begin];
  description += " begin" + std::to_string(begin);
  while (bytes.size() < size) {
    const size_t run = dice.anySize(size);
    const uint64_t kind = dice.below(4);
    description += "+" + std::to_string(run) + "nfbp"[kind];
    const uint8_t one = kind == 1 ? uint8_t{0xff} : dice.byte();
    const Bytes pattern = {dice.byte(), dice.byte(), dice.byte()};
    for (size_t i = 0; i < run; ++i)
      bytes.push_back(kind == 0 ? dice.byte() : kind == 3 ? pattern[i % pattern.size()] : one);
  }
  bytes.resize(size);
  return bytes;
}

std::string text(Dice& dice) {
  std::string unused;
  const Bytes bytes = codeword(dice, dice.anySize(300), unused);
  return std::string(bytes.begin(), bytes.end());
}

Extent anyExtent(Dice& dice, uint64_t most_samples, uint32_t most_side) {
  const uint64_t samples =
      std::max<uint64_t>(1, most_samples >> (dice.oneIn(2) ? 0 : dice.below(8)));
  const auto root = static_cast<uint64_t>(std::bit_floor(samples)) == samples
                        ? uint64_t{1} << (std::bit_width(samples) / 2)
                        : std::bit_floor(samples);
  const uint64_t width = dice.oneIn(3) ? dice.anySize(std::min<uint64_t>(most_side, samples))
                                       : std::min<uint64_t>({most_side, samples, root});
  const uint64_t height = std::clamp<uint64_t>(samples / width, 1, most_side);
  return {static_cast<uint32_t>(width), static_cast<uint32_t>(height)};
}

void anyWavelet(Dice& dice, WaveletHeader& wavelet) {
  for (uint8_t& filter : wavelet.filters) filter = static_cast<uint8_t>(dice.below(6));
  wavelet.fraction_bits = dice.oneIn(2) ? static_cast<uint8_t>(dice.below(9)) : uint8_t{0};
  wavelet.bits = static_cast<uint8_t>(dice.below(33));
  if (wavelet.fraction_bits > 0) return;
  wavelet.first_doubled = static_cast<uint8_t>(dice.below(5));
  wavelet.rounded_bytes = dice.oneIn(2) ? dice.below(2000) : 0;
}

void anyPriorities(Dice& dice, Extent plane, PriorityHeader& priorities) {
  uint8_t log2 = static_cast<uint8_t>(4 + dice.below(4));
  while (uint64_t{tilesAlong(plane.width, log2)} * tilesAlong(plane.height, log2) >
         PriorityHeader::kMostTiles)
    ++log2;
  priorities = {log2, text(dice)};
}

void anyVoids(Dice& dice, GeometryLayers& layers) {
  layers.validity_bytes = dice.anySize(400);
  layers.has_nodata = 1;
  layers.nodata = 5;
  if (dice.oneIn(3))
    layers.bridge = static_cast<uint8_t>(dice.oneIn(2) ? 255 : 1 + dice.below(254));
  if (layers.bridge > 0 || !dice.oneIn(3)) return;
  layers.late_mask = true;
  layers.lifted_bytes = dice.oneIn(3) ? 0 : dice.anySize(200);
  layers.validity_after = dice.below(100);
}

void anyTable(Dice& dice, GeometryLayers& layers) {
  layers.table_bytes = dice.anySize(300);
  layers.table_values = static_cast<uint32_t>(1 + dice.anySize(GeometryLayers::kMostValues - 1));
  layers.table_after = dice.below(100);
  if (dice.oneIn(2)) layers.table_knots = {{0, -1000}, {layers.table_values - 1, 100000}};
}

void anyCorrections(Dice& dice, GeometryHeader& heights, GeometryLayers& layers) {
  const bool table = layers.table_bytes > 0;
  layers.corrections =
      table ? CorrectionKind::kSamples : static_cast<CorrectionKind>(1 + dice.below(4));
  if (layers.corrections == CorrectionKind::kFacets) heights.sample = TKS_F32;
  layers.coefficient_bytes = 100 + dice.below(300);
  if (layers.corrections == CorrectionKind::kSteps)
    layers.correction_step = dice.oneIn(2) ? 1 : static_cast<uint32_t>(dice.anySize(1 << 26));
  if (layers.corrections == CorrectionKind::kRelative) layers.relative = {0.7, 2};
  if (layers.corrections == CorrectionKind::kFacets)
    layers.facet_unit = static_cast<uint8_t>(1 + dice.below(254));
}

/// Layers of heights that are coded by wavelet.
void anyLayers(Dice& dice, GeometryHeader& heights, GeometryLayers& layers) {
  if (dice.oneIn(2)) anyVoids(dice, layers);
  if (dice.oneIn(4)) anyTable(dice, layers);
  if (dice.oneIn(4)) {
    layers.flat_bytes = dice.anySize(200);
    layers.flat_areas = static_cast<uint32_t>(dice.anySize(200));
  }
  if (dice.oneIn(2)) anyCorrections(dice, heights, layers);
}

/// Repeated lines, before the size of what is coded is known.
void anyRepeats(Dice& dice, LineRepeats& repeats, uint32_t& width, uint32_t& height) {
  repeats = {{width, height}, text(dice)};
  const Extent coded = lineMapsOf(repeats).coded();
  width = coded.width;
  height = coded.height;
}

/// Few large patches or many small ones, of which any two sides are glued.
SharedForest anyForest(Dice& dice, uint64_t most_samples) {
  int depth = 1 + static_cast<int>(dice.below(10));
  while (depth > 1 && most_samples >> 2 * depth == 0) --depth;
  const uint64_t most = std::max<uint64_t>(1, most_samples >> 2 * depth);
  const auto patches =
      static_cast<uint32_t>(dice.anySize(std::min<uint64_t>(most, Forest::mostPatches(depth))));
  std::vector<uint32_t> sides(size_t{Forest::kSides} * patches, Forest::kBorder);
  for (uint32_t side = 0; side < sides.size(); ++side) {
    const auto other = static_cast<uint32_t>(dice.below(sides.size()));
    if (other == side || sides[side] != Forest::kBorder || sides[other] != Forest::kBorder)
      continue;
    sides[side] = other;
    sides[other] = side;
  }
  return std::make_shared<const Forest>(depth, std::move(sides));
}

/// Of heights or a texture, with the tools that may stand there.
template <class Plane>
void putOnForest(Dice& dice, uint64_t most_samples, Plane& plane) {
  anyWavelet(dice, plane.wavelet);
  plane.wavelet.forest = anyForest(dice, most_samples);
  plane.width = plane.wavelet.forest->raster().width;
  plane.height = plane.wavelet.forest->raster().height;
  if (dice.oneIn(4)) anyPriorities(dice, plane.extent(), plane.priorities);
}

StreamHeader anyForestHeights(Dice& dice, uint64_t most_samples) {
  StreamHeader header;
  GeometryHeader& g = header.geometry.emplace();
  g.sample = static_cast<uint8_t>(dice.oneIn(2) ? TKS_F32 : TKS_I16);
  g.planes = static_cast<uint8_t>(dice.oneIn(2) ? 30 : dice.below(31));
  putOnForest(dice, most_samples, g);
  if (dice.oneIn(4)) anyTable(dice, header.layers);
  if (dice.oneIn(2)) anyCorrections(dice, g, header.layers);
  return header;
}

StreamHeader anyHeights(Dice& dice, uint64_t most_samples) {
  if (dice.oneIn(4)) return anyForestHeights(dice, most_samples);
  StreamHeader header;
  GeometryHeader& g = header.geometry.emplace();
  const Extent extent = anyExtent(dice, most_samples, kMaxSide);
  g.width = extent.width;
  g.height = extent.height;
  g.sample = static_cast<uint8_t>(dice.oneIn(2) ? TKS_F32 : TKS_I16);
  g.planes = static_cast<uint8_t>(dice.oneIn(2) ? 30 : dice.below(31));
  if (dice.oneIn(4)) anyRepeats(dice, g.repeats, g.width, g.height);
  anyWavelet(dice, g.wavelet);
  if (dice.oneIn(6)) {
    g.planes = GeometryHeader::kDirectPlanes;
    g.drawn = dice.oneIn(2);
    if (dice.oneIn(2)) header.layers = {.validity_bytes = dice.anySize(99), .has_nodata = 1};
    return header;
  }
  if (dice.oneIn(4)) anyPriorities(dice, g.extent(), g.priorities);
  if (dice.oneIn(2)) g.regions.side_log2 = static_cast<uint8_t>(5 + dice.below(6));
  GeometryLayers& layers = header.layers;
  anyLayers(dice, g, layers);
  const bool plain = layers.validity_bytes > 0 && layers.bridge == 0 && !layers.late_mask &&
                     layers.flat_bytes == 0 && !g.wavelet.ring;
  if (plain && takesRegionMasks(g.extent(), g.regions.side_log2))
    layers.region_masks = dice.oneIn(2);
  return header;
}

void anyMasks(Dice& dice, TextureHeader& t) {
  if (t.hasAlpha() && dice.oneIn(2)) {
    t.alpha_bytes = dice.anySize(300);
    t.hidden = static_cast<uint8_t>(dice.below(2));
  }
  if (dice.oneIn(3)) t.overlay_bytes = dice.anySize(300);
  if ((t.hidden || t.overlay_bytes > 0) && dice.oneIn(3))
    t.bridge = static_cast<uint8_t>(1 + dice.below(255));
}

StreamHeader anyTexture(Dice& dice, uint64_t most_samples) {
  StreamHeader header;
  TextureHeader& t = header.texture.emplace();
  t.channels = static_cast<uint8_t>(1 + dice.below(4));
  t.sample = TKS_U8;
  t.centre = {100, 130, 90, 128};
  t.planes = static_cast<uint8_t>(dice.oneIn(2) ? 30 : dice.below(31));
  if (dice.oneIn(4)) {
    putOnForest(dice, most_samples / t.channels, t);
    return header;
  }
  const Extent extent = anyExtent(dice, most_samples / t.channels, kMaxTextureSide);
  t.width = extent.width;
  t.height = extent.height;
  t.sample = static_cast<uint8_t>(dice.oneIn(2) ? TKS_U8 : TKS_U16);
  if (dice.oneIn(4)) anyRepeats(dice, t.repeats, t.width, t.height);
  anyWavelet(dice, t.wavelet);
  if (dice.oneIn(5)) {
    t.planes = kDrawnPlanes;
    return header;
  }
  if (dice.oneIn(4)) anyPriorities(dice, t.extent(), t.priorities);
  if (dice.oneIn(2)) t.regions.side_log2 = static_cast<uint8_t>(5 + dice.below(6));
  anyMasks(dice, t);
  return header;
}

/// Packets of some of the tracks, of so many bytes together at most.
Bytes anyPayload(Dice& dice, const StreamHeader& header, size_t size, std::string& description) {
  const TrackCount tracks = trackCounts(header)[header.geometry ? 0 : 1];
  FieldWriter payload;
  const uint64_t sent = std::min<uint64_t>(tracks.tracks, dice.oneIn(2) ? 1 : dice.anySize(2000));
  const uint64_t step = tracks.tracks / sent;
  const size_t most = std::max<size_t>(1, size / sent);
  const Bytes common = codeword(dice, most, description);
  for (uint64_t i = 0; i < sent; ++i) {
    payload.put(uint64_t{common.size()} << 2);
    if (tracks.named) payload.put(i * step);
    payload.bytes.push_back(64);
    payload.bytes.insert(payload.bytes.end(), common.begin(), common.end());
  }
  return payload.bytes;
}

std::string described(const SharedForest& forest) {
  return forest == nullptr ? "" : ", patches " + std::to_string(forest->patches());
}

std::string described(const StreamHeader& header) {
  if (header.texture) {
    const TextureHeader& t = *header.texture;
    return "texture " + std::to_string(t.shown().width) + " x " + std::to_string(t.shown().height) +
           " x " + std::to_string(t.channels) + ", planes " + std::to_string(t.planes) +
           ", regions " + std::to_string(t.regions.side_log2) + ", alpha " +
           std::to_string(t.alpha_bytes) + ", overlay " + std::to_string(t.overlay_bytes) +
           ", bridge " + std::to_string(t.bridge) + ", priorities " +
           std::to_string(t.priorities.tile_log2) + described(t.wavelet.forest);
  }
  const GeometryHeader& g = *header.geometry;
  const GeometryLayers& l = header.layers;
  return "heights " + std::to_string(g.shown().width) + " x " + std::to_string(g.shown().height) +
         ", planes " + std::to_string(g.planes) + (g.drawn ? " (drawn)" : "") + ", regions " +
         std::to_string(g.regions.side_log2) + ", validity " + std::to_string(l.validity_bytes) +
         (l.region_masks ? " (of regions)" : "") + ", bridge " + std::to_string(l.bridge) +
         (l.late_mask ? " (late mask)" : "") + ", flat " + std::to_string(l.flat_bytes) +
         ", table " + std::to_string(l.table_values) + ", corrections " +
         std::to_string(static_cast<int>(l.corrections)) + "/" + std::to_string(l.correction_step) +
         ", priorities " + std::to_string(g.priorities.tile_log2) + described(g.wavelet.forest);
}

}  // namespace

SlowCase slowCase(uint64_t seed, uint64_t most_samples) {
  Dice dice(seed);
  StreamHeader header =
      dice.oneIn(3) ? anyTexture(dice, most_samples) : anyHeights(dice, most_samples);
  SlowCase made;
  made.description = described(header) + ";";
  const Bytes payload = anyPayload(dice, header, dice.anySize(5000), made.description);
  header.payload_bytes = payload.size();
  made.stream = writeHeader(header);
  made.stream.insert(made.stream.end(), payload.begin(), payload.end());
  return made;
}

}  // namespace tetrakis::test
