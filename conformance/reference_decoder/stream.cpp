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

/// FORMAT 2, Parts, in the order of their kinds: a decoder asks for those that it knows.
class Parts {
 public:
  explicit Parts(Reader& in) : in_(in) { readNext(); }

  /// Reads the next part, if it is of that kind: read(Reader&), which takes all of it.
  template <class Read>
  bool take(uint64_t kind, Read read) {
    skipBefore(kind);
    if (!next_ || next_->kind != kind) return false;
    Reader body(next_->body);
    read(body);
    if (!body.rest().empty()) body.fail(Outcome::kCorrupt);
    if (body.outcome() == Outcome::kTruncated) in_.fail(Outcome::kCorrupt);
    in_.fail(body.outcome());
    last_ = kind;
    readNext();
    return true;
  }
  void end() { skipBefore(UINT64_MAX); }

 private:
  struct Part {
    uint64_t kind;
    std::span<const uint8_t> body;
  };

  void readNext() {
    next_.reset();
    if (in_.outcome() != Outcome::kDone || in_.rest().empty()) return;
    const uint64_t kind = in_.varint(0, UINT64_MAX);
    const auto body = in_.take(in_.varint(0, UINT64_MAX));
    if (last_ && kind < *last_) in_.fail(Outcome::kCorrupt);
    if (in_.outcome() == Outcome::kDone) next_ = {kind, body};
  }
  /// A kind stands once, unless it is asked for again; one below 64 that is not asked for is not
  /// known.
  void skipBefore(uint64_t kind) {
    while (next_ && next_->kind < kind) {
      if (last_ == next_->kind) in_.fail(Outcome::kCorrupt);
      if (next_->kind < 64) in_.fail(Outcome::kUnsupported);
      last_ = next_->kind;
      readNext();
    }
  }

  Reader& in_;
  std::optional<Part> next_;
  std::optional<uint64_t> last_;
};

std::vector<uint8_t> restOf(Reader& in) {
  const auto rest = in.take(in.rest().size());
  return {rest.begin(), rest.end()};
}

/// FORMAT 2, table Wavelet.
WaveletHeader readWavelet(Reader& in, int& planes) {
  WaveletHeader w;
  planes = in.u8(0, 30);
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
  priorities.code = restOf(in);
  if (in.outcome() != Outcome::kDone) return priorities;
  const int64_t columns = ((width - 1) >> priorities.tileLog2) + 1;
  const int64_t rows = ((height - 1) >> priorities.tileLog2) + 1;
  if (columns * rows > 65536) in.fail(Outcome::kCorrupt);
  return priorities;
}

/// FORMAT 8.3: the size becomes that of the coded lines.
template <class Header>
void readLines(Reader& in, Header& g) {
  const std::vector<uint8_t> code = restOf(in);
  g.lines = LineMap(code, g.width, g.height);
  g.width = g.lines.columns.back() + 1;
  g.height = g.lines.rows.back() + 1;
}

/// FORMAT 2: what heights and textures have in common, behind `coding`. Returns `coding`.
template <class Header>
int readCoding(Reader& in, Parts& parts, int coding, Header& c) {
  const bool lifted = parts.take(0, [&](Reader& p) { c.wavelet = readWavelet(p, c.planes); });
  if (lifted != (coding == 2)) in.fail(Outcome::kCorrupt);
  if (coding != 2) c.planes = kDrawnPlanes;
  parts.take(1, [&](Reader& p) { readLines(p, c); });
  parts.take(2, [&](Reader& p) { c.priorities = readPriorities(p, c.width, c.height); });
  if (coding != 2 && c.priorities.tileLog2 > 0) in.fail(Outcome::kCorrupt);
  return coding;
}

/// Whether a value is an integer of the type.
bool holds(int sample, double value) {
  constexpr double kLeast[] = {0, -128, 0, -32768, 0, -2147483648.0};
  constexpr double kLargest[] = {255, 127, 65535, 32767, 4294967295.0, 2147483647};
  return value >= kLeast[sample] && value <= kLargest[sample] && value == std::floor(value);
}

/// FORMAT 2, Value table.
void readTable(Reader& in, Layers& layers) {
  constexpr int64_t kMostRise = 1 << 28;
  layers.tableBytes = in.varint(1, INT64_MAX);
  layers.tableValues = static_cast<uint32_t>(in.varint(2, 1 << 20));
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

/// FORMAT 2, Corrections.
void readCorrections(Reader& in, Layers& layers) {
  layers.corrections = in.u8(1, 4);
  const uint64_t least = std::max(layers.tableAfter, layers.validityAfter);
  layers.coefficientBytes = in.varint(least, INT64_MAX);
  if (layers.corrections == 1) layers.correctionStep = static_cast<uint32_t>(in.varint(1, 1 << 26));
  if (layers.corrections == 3) {
    layers.relativeStep = in.f64();
    layers.relativeQuarters = in.u8(1, 4);
    if (!std::isfinite(layers.relativeStep) || layers.relativeStep <= 0) in.fail(Outcome::kCorrupt);
  }
  if (layers.corrections == 4) layers.facetUnit = in.u8(1, 254);
}

/// Whether such heights may have the layers.
bool suit(const GeometryHeader& geometry, const Layers& layers) {
  const bool integer = geometry.sample != kF32, direct = geometry.planes == kStoredPlanes;
  const bool table = layers.tableBytes > 0, ground = layers.bridge > 0 || layers.lateMask;
  if (layers.corrections == 4 && integer) return false;
  if (table && layers.corrections % 2 == 1) return false;
  if (table && layers.corrections == 4) return false;
  if (layers.bridge > 0 && layers.lateMask) return false;
  if (ground && layers.validityBytes == 0) return false;
  if (layers.flatBytes > 0 && uint64_t(geometry.width) * uint64_t(geometry.height) > 1u << 31)
    return false;
  const bool others = layers.flatBytes > 0 || ground || geometry.regions.log2 > 0;
  if (direct && (others || (layers.corrections != 0 && layers.corrections != 2))) return false;
  if (direct && !geometry.drawn && (table || layers.corrections > 0)) return false;
  if (std::isnan(layers.nodata) || (integer && std::isinf(layers.nodata))) return false;
  return !integer || layers.validityBytes == 0 ||
         (layers.hasNodata && holds(geometry.sample, layers.nodata));
}

/// FORMAT 2, parts 3 to 9 of heights.
Layers readLayers(Parts& parts) {
  Layers layers;
  parts.take(3, [&](Reader& p) { layers.validityBytes = p.varint(1, INT64_MAX); });
  parts.take(4, [&](Reader& p) { layers.bridge = p.u8(1, 255); });
  layers.lateMask = parts.take(5, [&](Reader& p) {
    layers.liftedBytes = p.varint(0, INT64_MAX);
    layers.validityAfter = p.varint(0, INT64_MAX);
  });
  layers.hasNodata = parts.take(6, [&](Reader& p) { layers.nodata = p.f64(); });
  parts.take(7, [&](Reader& p) { readTable(p, layers); });
  parts.take(8, [&](Reader& p) {
    layers.flatBytes = p.varint(1, INT64_MAX);
    layers.flatAreas = static_cast<uint32_t>(p.varint(1, 65535));
  });
  parts.take(9, [&](Reader& p) { readCorrections(p, layers); });
  return layers;
}

/// FORMAT 2, Heights.
void readHeights(Reader& in, const Domain& domain, RegionHeader regions, Stream& stream) {
  GeometryHeader& g = stream.geometry.emplace();
  g.width = domain.width;
  g.height = domain.height;
  g.regions = regions;
  g.sample = in.u8(0, 6);
  const int coding = in.u8(0, 2);
  g.base = in.f64();
  g.step = in.f64();
  if (!std::isfinite(g.base) || !std::isfinite(g.step) || g.step <= 0) in.fail(Outcome::kCorrupt);
  g.drawn = coding == 1;
  Parts parts(in);
  readCoding(in, parts, coding, g);
  stream.layers = readLayers(parts);
  parts.take(64, [](Reader& p) {
    p.u8(0, 1);  // exact
    if (!std::isfinite(p.f64())) p.fail(Outcome::kCorrupt);
  });
  parts.end();
  if (!suit(g, stream.layers)) in.fail(Outcome::kCorrupt);
}

/// FORMAT 2, Colours.
void readColours(Reader& in, TextureHeader& t) {
  for (int i = 0; i < t.colourPlanes; ++i) {
    t.centre[i] = static_cast<int>(in.varint(0, 65535));
    t.priority[i] = in.zigzag(128);
  }
  if (t.colourPlanes < 3) return;
  t.colourOrder = in.u8(0, 5);
  t.shears.resize(in.u8(1, 8));
  for (auto& shears : t.shears) {
    for (int& h : shears) h = in.zigzag(32767);
  }
}

/// FORMAT 2, Tables of channels.
void readChannelTables(Reader& in, TextureHeader& t) {
  std::vector<uint32_t> values;
  for (int i = 0; i < t.colourPlanes; ++i)
    values.push_back(static_cast<uint32_t>(in.varint(0, 65536)));
  const std::vector<uint8_t> code = restOf(in);
  if (in.outcome() == Outcome::kDone)
    t.tables = decodeTables(code, values, t.sample == kU8 ? 8 : 16);
}

/// FORMAT 2, Weights.
void readWeights(Reader& in, TextureHeader& texture) {
  const int levels = in.u8(1, 8);
  for (int c = 0; c < texture.colourPlanes; ++c) {
    texture.bandPriority[c].resize(levels);
    for (auto& level : texture.bandPriority[c]) {
      for (int& priority : level) priority = in.zigzag(128);
    }
  }
}

/// FORMAT 2, Texture.
void readTexture(Reader& in, const Domain& domain, RegionHeader regions, Stream& stream) {
  TextureHeader& t = stream.texture.emplace();
  t.width = domain.width;
  t.height = domain.height;
  if (t.width > 1 << 15 || t.height > 1 << 15) in.fail(Outcome::kCorrupt);
  t.regions = regions;
  t.channels = t.colourPlanes = in.u8(1, 4);
  t.sample = in.u8(0, 2);
  if (t.sample == kI8) in.fail(Outcome::kCorrupt);
  const int coding = in.u8(0, 2);
  const bool lifted = coding == 2;
  t.stored = coding == 0;
  t.white = t.sample == kU8 ? 255 : 65535;
  Parts parts(in);
  readCoding(in, parts, coding, t);
  parts.take(4, [&](Reader& p) { t.bridge = p.u8(1, 255); });
  const bool cutout = parts.take(16, [&](Reader& p) {
    t.alphaBytes = p.varint(1, INT64_MAX);
    t.hidden = p.u8(0, 1);
  });
  if (cutout) --t.colourPlanes;
  parts.take(17, [&](Reader& p) { t.overlayBytes = p.varint(1, INT64_MAX); });
  if (parts.take(18, [&](Reader& p) { readColours(p, t); }) != lifted) in.fail(Outcome::kCorrupt);
  t.opaque = parts.take(19, [&](Reader& p) {
    for (int i = 0; lifted && i + 1 < t.channels; ++i) t.furtherShears[i] = p.zigzag(32767);
  });
  const bool tables = parts.take(20, [&](Reader& p) { readChannelTables(p, t); });
  const bool white = parts.take(21, [&](Reader& p) { t.white = int(p.varint(1, 65534)); });
  const bool weights = parts.take(22, [&](Reader& p) { readWeights(p, t); });
  parts.end();
  const bool odd = t.channels % 2 == 1;
  if ((cutout || t.opaque) && (odd || (cutout && t.opaque))) in.fail(Outcome::kCorrupt);
  if (white && t.sample == kU8) in.fail(Outcome::kCorrupt);
  if (t.bridge > 0 && !t.hidden && t.overlayBytes == 0) in.fail(Outcome::kCorrupt);
  if (!lifted && (cutout || t.overlayBytes > 0 || tables || weights || regions.log2 > 0))
    in.fail(Outcome::kCorrupt);
}

/// FORMAT 3: what the field `head` of a packet says.
struct Head {
  uint64_t length = 0, number = 0;
  bool whole = false;
};

Head headOf(uint64_t field, const Stream& stream) {
  int bits = 1;
  while (stream.components.size() > uint64_t{1} << bits) ++bits;
  return {field >> (bits + 1), field & ((uint64_t{1} << bits) - 1), (field >> bits & 1) != 0};
}

/// FORMAT 3: whether packets of a component say which track they belong to.
bool namesTracks(const Stream& stream, uint64_t number) {
  return number < stream.components.size() && stream.components[number].named;
}

/// FORMAT 2, Index: it decodes nothing, but its syntax counts.
void skipIndex(Reader& in, const Stream& stream) {
  for (uint64_t left = in.varint(1, 1 << 19); left > 0; --left) {
    const Head head = headOf(in.varint(0, UINT64_MAX), stream);
    if (namesTracks(stream, head.number)) in.varint(0, UINT32_MAX);
    in.byte();  // quality
    in.byte();  // slope
  }
}

/// Of the larger component that the decoder takes.
uint64_t samplesOf(const Stream& stream) {
  uint64_t heights = 0, texels = 0;
  if (const auto& g = stream.geometry) heights = uint64_t(g->shownWidth()) * g->shownHeight();
  if (const auto& t = stream.texture) texels = uint64_t(t->shownWidth()) * t->shownHeight();
  return std::max(heights, texels);
}

/// FORMAT 2: "smallest n such that the grid of no component has more than 4^(n + 8) samples".
int levelOf(const Stream& stream) {
  uint64_t most = 0;
  for (const Component& c : stream.components)
    if (c.domain.kind == 0) most = std::max(most, uint64_t(c.domain.width) * c.domain.height);
  int level = 0;
  while (most > uint64_t{1} << (2 * (level + 8))) ++level;
  return level;
}

/// FORMAT 2, Domain.
Domain readDomain(Reader& in) {
  Domain domain;
  domain.kind = in.byte();
  if (domain.kind != 0) {
    restOf(in);
    return domain;
  }
  domain.width = static_cast<int>(in.varint(1, 1 << 20));
  domain.height = static_cast<int>(in.varint(1, 1 << 20));
  return domain;
}

/// FORMAT 2, Component.
void readComponent(Reader& in, const std::vector<Domain>& domains, Stream& stream) {
  const int kind = in.byte();
  const uint64_t number = in.varint(0, 15);
  if (number >= domains.size()) in.fail(Outcome::kCorrupt);
  RegionHeader regions{in.u8(0, 20)};
  if (in.outcome() != Outcome::kDone) return;
  Component component{-1, regions.log2 > 0, domains[number]};
  const bool grid = component.domain.kind == 0;
  if (grid && kind == 0 && !stream.geometry) component.role = 0;
  if (grid && kind == 1 && !stream.texture) component.role = 1;
  if (component.role >= 0 && regions.log2 > 0 && regions.log2 < 4) in.fail(Outcome::kCorrupt);
  if (component.role == 0) readHeights(in, component.domain, regions, stream);
  if (component.role == 1) readTexture(in, component.domain, regions, stream);
  if (component.role < 0) restOf(in);
  stream.components.push_back(component);
}

/// FORMAT 2, parts 64 to 72 of the body.
void skipInformation(Parts& parts, const Stream& stream) {
  parts.take(64, [](Reader&) {});                              // lossless
  parts.take(65, [](Reader& p) { p.littleEndian(4); });        // payload_crc
  parts.take(66, [](Reader& p) { p.varint(1, UINT32_MAX); });  // triangles
  Places places(stream);
  parts.take(67, [&](Reader& p) { places.skipMetadata(p); });
  parts.take(68, [&](Reader& p) { places.skipHeights(p); });
  parts.take(69, [&](Reader& p) { places.skipTexture(p); });
  parts.take(70, [&](Reader& p) { skipIndex(p, stream); });
  parts.take(71, [](Reader& p) { restOf(p); });  // positions: no status depends on them
  parts.take(72, [](Reader& p) { restOf(p); });
}

/// FORMAT 2, Body. Returns `payload_bytes`.
uint64_t readBody(std::span<const uint8_t> body, Stream& stream) {
  Reader in(body);
  const uint64_t payloadBytes = in.varint(0, INT64_MAX);
  Parts parts(in);
  std::vector<Domain> domains;
  while (domains.size() < 16 &&
         parts.take(0, [&](Reader& p) { domains.push_back(readDomain(p)); })) {
  }
  while (stream.components.size() < 16 &&
         parts.take(1, [&](Reader& p) { readComponent(p, domains, stream); })) {
  }
  skipInformation(parts, stream);
  parts.end();
  if (stream.components.empty()) in.fail(Outcome::kCorrupt);
  if (!stream.geometry && !stream.texture) in.fail(Outcome::kUnsupported);
  stream.outcome = in.outcome() == Outcome::kTruncated ? Outcome::kCorrupt : in.outcome();
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
  const bool sound = stream.outcome != Outcome::kDone || level == levelOf(stream);
  if (crc != crc32(sealed) || !sound) stream.outcome = Outcome::kCorrupt;
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
    const auto [length, number, whole] = headOf(in.shortestVarint(0, UINT64_MAX), stream);
    const uint64_t track = namesTracks(stream, number) ? in.shortestVarint(0, UINT32_MAX) : 0;
    in.byte();  // quality
    if (in.outcome() == Outcome::kTruncated) break;
    const bool listed = number < stream.components.size();
    const int role = listed ? stream.components[number].role : -1;
    const bool announced = listed && (role < 0 || track < stream.codewords[role].size());
    if (in.outcome() != Outcome::kDone || length == 0 || !announced) return Outcome::kCorrupt;
    if (whole && length > in.rest().size()) break;
    const auto bytes = in.take(std::min<uint64_t>(length, in.rest().size()));
    if (role < 0) continue;
    std::vector<uint8_t>& codeword = stream.codewords[role][track];
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
