// SPDX-License-Identifier: Apache-2.0
// Reference decoder: header and packets (docs/FORMAT.md, sections 2, 3 and 12).
#include "conformance/reference_decoder/stream.hpp"

#include "conformance/reference_decoder/base_mesh.hpp"
#include "conformance/reference_decoder/glue.hpp"
#include "conformance/reference_decoder/metadata.hpp"
#include "conformance/reference_decoder/parts.hpp"
#include "conformance/reference_decoder/regions.hpp"
#include "conformance/reference_decoder/triangles.hpp"

#include <algorithm>
#include <utility>

namespace tetrakis::reference {
namespace {

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
  for (uint64_t left = in.varint(1, 1 << 25); left > 0; --left) {
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
    if (c.domain.known()) most = std::max(most, uint64_t(c.domain.width) * c.domain.height);
  int level = 0;
  while (most > uint64_t{1} << (2 * (level + 8))) ++level;
  return level;
}

/// FORMAT 2, domain_kind 2 and 3.
Domain readForest(Reader& in, int kind, const std::vector<Domain>& known) {
  const int depth = in.u8(1, 18), side = (1 << depth) + 1, most = std::min(4096, (1 << 20) / side);
  std::vector<int> glued;
  if (kind == 3) {
    const uint64_t alike = in.varint(0, UINT64_MAX);
    if (alike >= known.size() || known[alike].forest.isGrid()) in.fail(Outcome::kCorrupt);
    if (in.outcome() == Outcome::kDone) glued = known[alike].forest.glued();
  } else {
    const int patches = static_cast<int>(in.varint(1, most));
    const auto codeword = in.take(in.varint(0, UINT64_MAX));
    if (in.outcome() != Outcome::kDone) return {};
    RangeDecoder decoder(codeword);
    const auto read = readGlue(decoder, patches, 4);
    if (read) glued = *read;
    if (!read) in.fail(Outcome::kCorrupt);
  }
  const int patches = static_cast<int>(glued.size() / 4);
  if (patches > most) in.fail(Outcome::kCorrupt);
  if (in.outcome() != Outcome::kDone) return {};
  return {2, side, patches * side, Forest(depth, std::move(glued))};
}

/// FORMAT 2, Domain: one of the known ones, or the next.
Domain readDomain(Reader& in, std::vector<Domain>& known) {
  const uint64_t number = in.varint(0, known.size());
  if (number < known.size()) return known[number];
  Domain domain;
  domain.kind = in.byte();
  if (domain.kind == 2 || domain.kind == 3) {
    domain = readForest(in, domain.kind, known);
  } else if (domain.known()) {
    domain.width = static_cast<int>(in.varint(1, 1 << 20));
    domain.height = static_cast<int>(in.varint(1, 1 << 20));
  }
  known.push_back(domain);
  return domain;
}

/// FORMAT 2, Component.
void readComponent(Reader& in, std::vector<Domain>& domains, Stream& stream) {
  const int kind = in.byte();
  RegionHeader regions{in.u8(0, 20)};
  const Domain domain = readDomain(in, domains);
  if (in.outcome() != Outcome::kDone) return;
  Component component{kind, -1, regions.log2 > 0, domain};
  const auto taken = [&](const std::optional<size_t>& asked, bool first) {
    return domain.known() && (asked ? *asked == stream.components.size() : first);
  };
  if (kind == 0 && taken(stream.choice.heights, !stream.geometry)) component.role = 0;
  if (kind == 1 && taken(stream.choice.texture, !stream.texture)) component.role = 1;
  if (component.role >= 0 && regions.log2 > 0 && regions.log2 < 4) in.fail(Outcome::kCorrupt);
  if (component.role == 0) readHeights(in, component.domain, regions, stream);
  if (component.role == 1) readTexture(in, component.domain, regions, stream);
  if (component.role < 0) restOf(in);
  stream.components.push_back(component);
}

/// FORMAT 2, what may stand beside a triangle mesh.
bool suits(const Stream& stream) {
  if (stream.geometry) return false;
  return !stream.texture ||
         (stream.triangles->texcoordBits > 0 && stream.texture->wavelet.domain.kind == 0);
}

/// FORMAT 2, parts 64 to 76 of the body, but for the sketch.
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
  parts.take(73, [](Reader& p) {  // source grid
    for (int side = 0; side < 2; ++side) p.varint(1, 1 << 20);
  });
  parts.take(74, [&](Reader& p) { places.skipDetails(p); });
  parts.take(76, [](Reader& p) { restOf(p); });  // material, likewise
}

/// FORMAT 2, Body. Returns `payload_bytes`.
uint64_t readBody(std::span<const uint8_t> body, Stream& stream) {
  Reader in(body);
  const uint64_t payloadBytes = in.varint(0, INT64_MAX);
  Parts parts(in);
  parts.passFirst(75);
  std::vector<Domain> domains;
  while (stream.components.size() < 16 &&
         parts.take(0, [&](Reader& p) { readComponent(p, domains, stream); })) {
  }
  parts.take(1, [&](Reader& p) { stream.triangles = readTriangleMesh(p); });
  skipInformation(parts, stream);
  parts.end();
  if (stream.components.empty() && !stream.triangles) in.fail(Outcome::kCorrupt);
  if (!stream.geometry && !stream.texture && !stream.triangles) in.fail(Outcome::kUnsupported);
  if (stream.triangles && !suits(stream)) stream.suits = false;
  if (stream.geometry && stream.texture &&
      stream.geometry->frames.shown() != stream.texture->frames.shown())
    stream.suits = false;
  if (!stream.suits) in.fail(Outcome::kCorrupt);
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
  const auto body = in.take(in.varint(0, 1 << 26));
  const auto sealed = prefix.first(prefix.size() - in.rest().size());
  const uint64_t crc = in.littleEndian(4);
  stream.outcome = in.outcome();
  if (stream.outcome != Outcome::kDone) return {};
  const uint64_t payloadBytes = readBody(body, stream);
  const bool sound = stream.outcome != Outcome::kDone || level == levelOf(stream);
  if (crc != crc32(sealed) || !sound) stream.outcome = Outcome::kCorrupt;
  return in.rest().first(std::min<uint64_t>(payloadBytes, in.rest().size()));
}

/// FORMAT 10, Sketch: the bytes that there are of it, of a prefix that ends inside the header.
std::optional<std::span<const uint8_t>> sketchIn(std::span<const uint8_t> prefix) {
  Reader in(prefix);
  in.take(7);  // magic, version, profile, level
  const uint64_t bodyBytes = in.varint(0, 1 << 26);
  const size_t before = in.rest().size();
  in.varint(0, UINT64_MAX);  // payload_bytes
  const uint64_t kind = in.varint(0, UINT64_MAX);
  const uint64_t bytes = kind == 75 ? in.varint(0, UINT64_MAX) : 0;
  const uint64_t told = before - in.rest().size();
  if (in.outcome() != Outcome::kDone || bytes == 0) return {};
  if (told > bodyBytes || bytes > bodyBytes - told) return {};
  return in.rest().first(std::min<uint64_t>(bytes, in.rest().size()));
}

/// One codeword for each track of either component.
void makeCodewords(Stream& stream) {
  const auto count = [](const auto& c) {
    return c ? regionsOf(c->width, c->height, c->regions.log2, c->wavelet.domain.forest.patches())
                   .size()
             : 0;
  };
  const auto corrections = [&](const GeometryHeader& g) {
    if (stream.layers.corrections == 0) return size_t{0};
    return finestRegionsOf(g.width, g.height, g.regions.log2, g.wavelet.domain.forest.patches())
        .size();
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

}  // namespace

Stream readStream(std::span<const uint8_t> prefix, uint64_t maxSamples, const Choice& choice) {
  Stream stream;
  stream.choice = choice;
  auto payload = readHeader(prefix, stream);
  if (stream.outcome == Outcome::kTruncated) {
    const auto sketch = sketchIn(prefix);
    if (!sketch) return stream;
    stream = {};
    stream.choice = choice;
    payload = readHeader(*sketch, stream);
  }
  if (stream.outcome != Outcome::kDone) return stream;
  const bool tooLarge = samplesOf(stream) > maxSamples;
  stream.outcome = tooLarge ? Outcome::kTooLarge : readPackets(payload, stream);
  return stream;
}

Decoded decode(std::span<const uint8_t> prefix, uint64_t maxSamples, Levels levels,
               const Choice& choice) {
  return decode(readStream(prefix, maxSamples, choice), levels);
}

Decoded decode(const Stream& stream, Levels levels) {
  Decoded decoded;
  decoded.outcome = stream.outcome;
  const auto unknown = [](const auto& c) {
    return c && c->frames.reference > 0 && c->frames.before.empty();
  };
  if (decoded.outcome == Outcome::kDone && (unknown(stream.geometry) || unknown(stream.texture)))
    decoded.outcome = Outcome::kUnsupported;
  if (decoded.outcome != Outcome::kDone) return decoded;
  const auto level = [](const Forest& forest, int of) {
    return forest.isGrid() ? of : std::min(of, forest.coarsestLevel());
  };
  if (const auto& g = stream.geometry) {
    const Forest& forest = g->wavelet.domain.forest;
    const int at = level(forest, levels.heights);
    forest.atLevel(at).share(
        decoded.heights.emplace(decodeShownHeights(*g, stream.layers, stream.codewords[0], at)));
  }
  if (const auto& t = stream.texture) {
    const Forest& forest = t->wavelet.domain.forest;
    const int at = level(forest, levels.texture);
    forest.atLevel(at).share(
        decoded.texture.emplace(decodeShownTexture(*t, stream.codewords[1], at)));
  }
  return decoded;
}

std::optional<Object> decodeObject(std::span<const uint8_t> prefix, uint64_t maxSamples) {
  const Stream stream = readStream(prefix, maxSamples);
  if (stream.outcome != Outcome::kDone || !stream.geometry) return {};
  const BaseMeshHeader& mesh = stream.geometry->baseMesh;
  const Forest& forest = stream.geometry->wavelet.domain.forest;
  if (mesh.bits == 0) return {};
  std::vector<Vector> corners = readCorners(mesh.corners, mesh.bits, forest);
  std::vector<BasePoint> points = bentBase(corners, forest);
  return Object{mesh.bits, mesh.cell, mesh.origin, std::move(corners), std::move(points)};
}

std::optional<Triangles> decodeTriangles(std::span<const uint8_t> prefix, uint64_t maxSamples) {
  const Stream stream = readStream(prefix, maxSamples);
  if (stream.outcome != Outcome::kDone || !stream.triangles) return {};
  return readTriangles(*stream.triangles);
}

}  // namespace tetrakis::reference
