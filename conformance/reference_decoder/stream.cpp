// SPDX-License-Identifier: Apache-2.0
// Reference decoder: header and packets (docs/FORMAT.md, sections 2, 3 and 12).
#include "conformance/reference_decoder/stream.hpp"

#include "conformance/reference_decoder/layers.hpp"
#include "conformance/reference_decoder/metadata.hpp"
#include "conformance/reference_decoder/reader.hpp"
#include "conformance/reference_decoder/regions.hpp"

#include <algorithm>
#include <cmath>

namespace tetrakis::reference {
namespace {

/// FORMAT 2: CRC-32, "polynomial EDB88320 reflected, initial and final xor FFFFFFFF".
uint32_t crc32(std::span<const uint8_t> bytes) {
  uint32_t crc = 0xFFFFFFFFu;
  for (const uint8_t byte : bytes) {
    crc ^= byte;
    for (int i = 0; i < 8; ++i) crc = crc & 1 ? crc >> 1 ^ 0xEDB88320u : crc >> 1;
  }
  return ~crc;
}

/// FORMAT 2, table Wavelet.
WaveletHeader readWavelet(Reader& in) {
  WaveletHeader w;
  for (int& filter : w.filters) filter = in.u8(0, 4);
  w.fractionBits = in.u8(0, 8);
  w.sampleBits = in.u8(0, 32);
  if (w.fractionBits > 0) return w;
  w.firstDoubled = in.u8(0, 4);
  w.roundedBytes = in.varint(0, INT64_MAX);
  return w;
}

/// FORMAT 2, table Priorities.
PriorityHeader readPriorities(Reader& in, int width, int height) {
  PriorityHeader priorities;
  priorities.tileLog2 = in.u8(4, 20);
  const auto code = in.take(in.varint(0, UINT64_MAX));
  priorities.code.assign(code.begin(), code.end());
  const int64_t columns = ((width - 1) >> priorities.tileLog2) + 1;
  const int64_t rows = ((height - 1) >> priorities.tileLog2) + 1;
  if (columns * rows > 65536) in.fail(Outcome::kCorrupt);
  return priorities;
}

/// FORMAT 8.3: the size becomes that of the coded lines.
template <class Header>
void readLines(Reader& in, Header& g) {
  const auto code = in.take(in.varint(0, UINT64_MAX));
  if (in.outcome() != Outcome::kDone) return;
  g.lines = LineMap(code, g.width, g.height);
  g.width = g.lines.columns.back() + 1;
  g.height = g.lines.rows.back() + 1;
}

/// FORMAT 2, table Geometry.
GeometryHeader readGeometry(Reader& in) {
  GeometryHeader g;
  g.width = static_cast<int>(in.varint(1, 1 << 20));
  g.height = static_cast<int>(in.varint(1, 1 << 20));
  const int kind = in.u8(0, 14);
  g.sample = kind % 8;
  if (g.sample > kF32) in.fail(Outcome::kCorrupt);
  if (kind >= 8) readLines(in, g);
  const int coding = in.u8(0, 63);
  g.planes = coding % 32;
  g.drawn = coding == 63;
  if (coding >= 32 && !g.drawn) g.priorities = readPriorities(in, g.width, g.height);
  in.u8(0, 1);  // exact
  g.base = in.f64();
  g.step = in.f64();
  const double maxError = in.f64();
  if (g.planes != kStoredPlanes) g.wavelet = readWavelet(in);
  const bool finite = std::isfinite(g.base) && std::isfinite(g.step) && std::isfinite(maxError);
  if (!finite || g.step <= 0) in.fail(Outcome::kCorrupt);
  return g;
}

/// Whether a value is an integer of the type.
bool holds(int sample, double value) {
  constexpr double kLeast[] = {0, -128, 0, -32768, 0, -2147483648.0};
  constexpr double kLargest[] = {255, 127, 65535, 32767, 4294967295.0, 2147483647};
  return value >= kLeast[sample] && value <= kLargest[sample] && value == std::floor(value);
}

/// FORMAT 2, the fields of a table but the first two.
void readKnots(Reader& in, Layers& layers) {
  constexpr int64_t kMostRise = 1 << 28;
  layers.tableAfter = in.varint(0, INT64_MAX);
  const int count = in.u8(0, 64);
  TableKnot knot;
  for (int i = 0; i < count; ++i) {
    const int64_t most = int64_t{layers.tableValues} - 1 - knot.place, least = i > 0 ? 1 : 0;
    if (most < least) in.fail(Outcome::kCorrupt);
    knot.place += static_cast<int64_t>(in.varint(least, std::max(least, most)));
    knot.rise += in.zigzag(2 * kMostRise);
    if (std::abs(knot.rise) > kMostRise) in.fail(Outcome::kCorrupt);
    layers.tableKnots.push_back(knot);
  }
}

/// FORMAT 2, the fields of table Layers from coefficient_bytes on.
void readCorrections(Reader& in, Layers& layers) {
  if (layers.corrections == 0) return;
  const uint64_t least = std::max(layers.tableAfter, layers.validityAfter);
  layers.coefficientBytes = in.varint(least, INT64_MAX);
  if (layers.corrections == 1) {
    layers.correctionStep = static_cast<uint32_t>(in.varint(1, 1 << 26));
  }
  if (layers.corrections == 3) {
    layers.relativeStep = in.f64();
    layers.relativeQuarters = in.u8(1, 4);
    if (!std::isfinite(layers.relativeStep) || layers.relativeStep <= 0) in.fail(Outcome::kCorrupt);
  }
  if (layers.corrections == 4) layers.facetUnit = in.u8(1, 254);
}

/// Whether such heights may have the layers. kinds: which there are.
bool suit(const GeometryHeader& geometry, const Layers& layers, int kinds) {
  const bool integer = geometry.sample != kF32, direct = geometry.planes == kStoredPlanes;
  if (layers.corrections == 4 && integer) return false;
  if (layers.flatBytes > 0 && uint64_t(geometry.width) * uint64_t(geometry.height) > 1u << 31)
    return false;
  if (direct && !geometry.drawn && kinds > 0) return false;
  if (direct && (kinds >= 7 || layers.corrections % 2 == 1)) return false;
  if (integer && std::isinf(layers.nodata)) return false;
  return !integer || layers.validityBytes == 0 ||
         (layers.hasNodata && holds(geometry.sample, layers.nodata));
}

/// FORMAT 2, table Layers.
Layers readLayers(Reader& in, const std::optional<GeometryHeader>& geometry) {
  Layers layers;
  layers.validityBytes = in.varint(0, INT64_MAX);
  layers.hasNodata = in.u8(0, 1);
  if (layers.hasNodata) layers.nodata = in.f64();
  const int kinds = in.u8(0, 47);
  const bool facets = kinds % 8 == 7;
  layers.corrections = facets ? 4 : kinds % 4;
  if (kinds % 8 == 5) in.fail(Outcome::kCorrupt);
  if (kinds & 4 && !facets) {
    layers.tableBytes = in.varint(1, INT64_MAX);
    layers.tableValues = static_cast<uint32_t>(in.varint(2, 1 << 20));
    readKnots(in, layers);
  }
  if (kinds & 8) {
    layers.flatBytes = in.varint(1, INT64_MAX);
    layers.flatAreas = static_cast<uint32_t>(in.varint(1, 65535));
  }
  if (kinds & 16) layers.bridge = in.u8(1, 255);
  if (kinds & 32) {
    layers.lateMask = true;
    layers.liftedBytes = in.varint(0, INT64_MAX);
    layers.validityAfter = in.varint(0, INT64_MAX);
  }
  if (kinds & (16 | 32) && layers.validityBytes == 0) in.fail(Outcome::kCorrupt);
  readCorrections(in, layers);
  const bool meant = layers.validityBytes > 0 || layers.hasNodata || kinds > 0;
  const bool suits = geometry ? suit(*geometry, layers, kinds) : !meant;
  if (!suits || std::isnan(layers.nodata)) in.fail(Outcome::kCorrupt);
  return layers;
}

/// FORMAT 2, table Texture.
TextureHeader readTexture(Reader& in) {
  TextureHeader t;
  t.width = static_cast<int>(in.varint(1, 1 << 15));
  t.height = static_cast<int>(in.varint(1, 1 << 15));
  const int kind = in.u8(1, 8);
  const bool cutout = kind == 5 || kind == 6;
  t.opaque = kind > 6;
  t.channels = t.opaque ? 2 * (kind - 6) : cutout ? 2 * (kind - 4) : kind;
  t.colourPlanes = t.channels - cutout;
  const int type = in.u8(0, 62);
  const bool tables = type & 4, bridges = type & 16;
  t.sample = type % 4;
  if (t.sample != kU8 && t.sample != kU16) in.fail(Outcome::kCorrupt);
  if (type & 8) readLines(in, t);
  t.white = t.sample == kU8 ? 255 : 65535;
  if (type & 32) t.white = static_cast<int>(in.varint(1, 65534));
  if (type & 32 && t.sample != kU16) in.fail(Outcome::kCorrupt);
  const int all = in.u8(0, 126), coding = all % 64;
  t.planes = coding % 32;
  t.stored = coding == 63;
  if (all >= 64) t.priorities = readPriorities(in, t.width, t.height);
  if (all >= 64 && t.planes == kDrawnPlanes) in.fail(Outcome::kCorrupt);
  if (t.planes == kDrawnPlanes && (tables || bridges)) in.fail(Outcome::kCorrupt);
  if (t.planes == kDrawnPlanes) return t;
  t.wavelet = readWavelet(in);
  if (cutout) {
    t.alphaBytes = in.varint(1, INT64_MAX);
    t.hidden = in.u8(0, 1);
  }
  if (coding >= 32) t.overlayBytes = in.varint(1, INT64_MAX);
  if (bridges) t.bridge = in.u8(1, 255);
  if (bridges && !t.hidden && t.overlayBytes == 0) in.fail(Outcome::kCorrupt);
  for (int i = 0; i < t.colourPlanes; ++i) {
    t.centre[i] = static_cast<int>(in.varint(0, 65535));
    t.priority[i] = in.zigzag(128);
  }
  if (t.colourPlanes >= 3) {
    const int colour = in.u8(0, 47);
    t.colourOrder = colour % 6;
    t.shears.resize(colour / 6 + 1);
    for (auto& shears : t.shears) {
      for (int& h : shears) h = in.zigzag(32767);
    }
  }
  for (int i = 0; t.opaque && i + 1 < t.channels; ++i) t.furtherShears[i] = in.zigzag(32767);
  if (!tables) return t;
  std::vector<uint32_t> values;
  for (int i = 0; i < t.colourPlanes; ++i)
    values.push_back(static_cast<uint32_t>(in.varint(0, 65536)));
  const auto code = in.take(in.varint(0, UINT64_MAX));
  t.tables = decodeTables(code, values, t.sample == kU8 ? 8 : 16);
  return t;
}

/// FORMAT 2, table Regions, of one component.
RegionHeader readRegions(Reader& in) {
  RegionHeader regions;
  regions.log2 = in.u8(0, 20);
  if (regions.log2 > 0 && regions.log2 < 4) in.fail(Outcome::kCorrupt);
  return regions;
}

/// FORMAT 2, table Weights.
void readWeights(Reader& in, TextureHeader& texture) {
  const int levels = in.u8(1, 8);
  for (int c = 0; c < texture.colourPlanes; ++c) {
    texture.bandPriority[c].resize(levels);
    for (auto& level : texture.bandPriority[c]) {
      for (int& priority : level) priority = in.zigzag(128);
    }
  }
}

/// FORMAT 3: whether packets of a component say which track they belong to.
bool namesTracks(const Stream& stream, uint64_t component) {
  if (component == 0) return stream.geometry && stream.geometry->regions.log2 > 0;
  return stream.texture && stream.texture->regions.log2 > 0;
}

/// FORMAT 2, Index: it decodes nothing, but its syntax counts.
void skipIndex(Reader& in, const Stream& stream) {
  for (uint64_t left = in.varint(1, 1 << 19); left > 0; --left) {
    const uint64_t head = in.varint(0, UINT64_MAX);
    if (namesTracks(stream, head & 1)) in.varint(0, UINT32_MAX);
    in.byte();  // quality
    in.byte();  // slope
  }
}

/// Of the larger component.
uint64_t samplesOf(const Stream& stream) {
  uint64_t heights = 0, texels = 0;
  if (const auto& g = stream.geometry) heights = uint64_t(g->shownWidth()) * g->shownHeight();
  if (const auto& t = stream.texture) texels = uint64_t(t->shownWidth()) * t->shownHeight();
  return std::max(heights, texels);
}

/// FORMAT 2: "smallest n such that neither component has more than 4^(n + 8) samples".
int levelOf(const Stream& stream) {
  int level = 0;
  while (samplesOf(stream) > uint64_t{1} << (2 * (level + 8))) ++level;
  return level;
}

/// FORMAT 2, Body. Returns `payload_bytes`.
uint64_t readBody(std::span<const uint8_t> body, Stream& stream) {
  Reader in(body);
  const int parts = in.u8(1, 255);
  const uint64_t payloadBytes = in.varint(0, INT64_MAX);
  if (in.u8(0, 3) >= 2) in.littleEndian(4);  // payload_crc, which a decoder need not look at
  in.varint(0, UINT32_MAX);                  // triangles
  if ((parts & 3) == 0) in.fail(Outcome::kCorrupt);
  if (parts & 1) stream.geometry = readGeometry(in);
  if (parts & 2) stream.texture = readTexture(in);
  const Transform spacing = parts & 4 ? skipMetadata(in) : Transform{0, 0, 0, 0, 0, -0.0};
  if (parts & 16) stream.layers = readLayers(in, stream.geometry);
  if (parts & 32 && stream.geometry) stream.geometry->regions = readRegions(in);
  if (stream.geometry && stream.geometry->planes == kStoredPlanes &&
      stream.geometry->regions.log2 > 0)
    in.fail(Outcome::kCorrupt);
  if (parts & 32 && stream.texture) stream.texture->regions = readRegions(in);
  if (parts & 64 && stream.texture) readWeights(in, *stream.texture);
  if (stream.texture && stream.texture->planes == kDrawnPlanes &&
      (stream.texture->regions.log2 > 0 || parts & 64))
    in.fail(Outcome::kCorrupt);
  if (parts & 128) skipGeoreference(in, stream, spacing);
  if (parts & 8) skipIndex(in, stream);
  // Optional parts inform: whatever stands there, no status depends on it.
  if (in.outcome() != Outcome::kDone) stream.outcome = Outcome::kCorrupt;
  return payloadBytes;
}

/// FORMAT 2, the whole header. Returns the part of the payload that there is.
std::span<const uint8_t> readHeader(std::span<const uint8_t> prefix, Stream& stream) {
  Reader in(prefix);
  for (const int expected : {0x54, 0x4B, 0x53, 0x1A}) in.u8(expected, expected);
  const uint8_t version = in.byte(), profile = in.byte(), level = in.byte();
  if (in.rest().empty()) in.fail(Outcome::kTruncated);  // says nothing of the version
  if (version != 1 || profile != 0) in.fail(Outcome::kUnsupported);
  const auto body = in.take(in.varint(0, 1 << 20));
  const auto sealed = prefix.first(prefix.size() - in.rest().size());
  const uint64_t crc = in.littleEndian(4);
  stream.outcome = in.outcome();
  if (stream.outcome != Outcome::kDone) return {};
  const uint64_t payloadBytes = readBody(body, stream);
  if (crc != crc32(sealed) || level != levelOf(stream)) stream.outcome = Outcome::kCorrupt;
  return in.rest().first(std::min<uint64_t>(payloadBytes, in.rest().size()));
}

/// One codeword for each track of either component.
void makeCodewords(Stream& stream) {
  const auto count = [](const auto& c) {
    return c ? regionsOf(c->width, c->height, c->regions.log2).size() : 0;
  };
  const auto corrections = [&](const GeometryHeader& g) {
    return stream.layers.corrections > 0 ? finestRegionsOf(g.width, g.height, g.regions.log2).size()
                                         : 0;
  };
  stream.codewords[0].resize(count(stream.geometry));
  if (stream.geometry)
    stream.codewords[0].resize(stream.codewords[0].size() + corrections(*stream.geometry));
  stream.codewords[1].resize(count(stream.texture));
}

/// FORMAT 3: the payload of each packet goes to the codeword of its track.
Outcome readPackets(std::span<const uint8_t> payload, Stream& stream) {
  makeCodewords(stream);
  Reader in(payload);
  while (!in.rest().empty()) {
    const uint64_t head = in.shortestVarint(0, UINT64_MAX);
    const uint64_t length = head >> 2, component = head & 1;
    const uint64_t track = namesTracks(stream, component) ? in.shortestVarint(0, UINT32_MAX) : 0;
    in.byte();  // quality
    if (in.outcome() == Outcome::kTruncated) break;
    const bool whole = head & 2, announced = track < stream.codewords[component].size();
    if (in.outcome() != Outcome::kDone || length == 0 || !announced) return Outcome::kCorrupt;
    if (whole && length > in.rest().size()) break;
    const auto bytes = in.take(std::min<uint64_t>(length, in.rest().size()));
    std::vector<uint8_t>& codeword = stream.codewords[component][track];
    codeword.insert(codeword.end(), bytes.begin(), bytes.end());
  }
  return Outcome::kDone;
}

Stream readStream(std::span<const uint8_t> prefix, uint64_t maxSamples) {
  Stream stream;
  const auto payload = readHeader(prefix, stream);
  if (stream.outcome != Outcome::kDone) return stream;
  const bool tooLarge = samplesOf(stream) > maxSamples;
  stream.outcome = tooLarge ? Outcome::kTooLarge : readPackets(payload, stream);
  return stream;
}

}  // namespace

Decoded decode(std::span<const uint8_t> prefix, uint64_t maxSamples, Levels levels) {
  const Stream stream = readStream(prefix, maxSamples);
  Decoded decoded;
  decoded.outcome = stream.outcome;
  if (decoded.outcome != Outcome::kDone) return decoded;
  if (stream.geometry)
    decoded.heights =
        decodeShownHeights(*stream.geometry, stream.layers, stream.codewords[0], levels.heights);
  if (stream.texture)
    decoded.texture = decodeShownTexture(*stream.texture, stream.codewords[1], levels.texture);
  return decoded;
}

}  // namespace tetrakis::reference
