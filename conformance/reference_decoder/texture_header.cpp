// SPDX-License-Identifier: Apache-2.0
// Reference decoder: what a header says of a texture (docs/FORMAT.md, section 2).
#include <vector>

#include "conformance/reference_decoder/layers.hpp"
#include "conformance/reference_decoder/parts.hpp"

namespace tetrakis::reference {
namespace {

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

/// Whether a texture may have what its parts say.
bool suits(const TextureHeader& t, const Domain& domain) {
  const bool large = domain.width > 1 << 15 || domain.height > 1 << 15;
  if ((large && domain.forest.isGrid()) || hasTooManyTiles(t)) return false;
  const bool cutout = t.alphaBytes > 0;
  if ((cutout || t.opaque) && (t.channels % 2 == 1 || (cutout && t.opaque))) return false;
  if (t.planes == kDrawnPlanes && (t.regions.log2 > 0 || t.priorities.tileLog2 > 0)) return false;
  if (!domain.forest.isGrid() && (t.hidden || t.overlayBytes > 0 || !suitsForest(t))) return false;
  return t.bridge == 0 || t.hidden || t.overlayBytes > 0;
}

}  // namespace

/// FORMAT 2, Texture.
void readTexture(Reader& in, const Domain& domain, RegionHeader regions, Stream& stream) {
  TextureHeader& t = stream.texture.emplace();
  t.width = domain.width;
  t.height = domain.height;
  t.regions = regions;
  t.channels = t.colourPlanes = in.u8(1, 4);
  t.sample = in.u8(0, 2);
  if (t.sample == kI8) in.fail(Outcome::kCorrupt);
  const int coding = in.u8(0, 2);
  const bool lifted = coding == 2;
  t.stored = coding == 0;
  t.white = t.sample == kU8 ? 255 : 65535;
  readWavelet(in, coding, t);
  Parts parts(in);
  readCoding(parts, t);
  parts.take(4, [&](Reader& p) { t.bridge = p.u8(1, 255); });
  parts.take(11, [&](Reader& p) { t.frames = readFrames(p, false); });
  parts.take(12, [&](Reader& p) { t.frames.reference = p.varint(1, INT64_MAX / 2); });
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
  t.wavelet.domain = domain;
  const bool opening = cutout || t.overlayBytes > 0;
  if (!lifted && (opening || tables || weights)) stream.suits = false;
  if (white && t.sample == kU8) stream.suits = false;
  if (!suits(t, domain)) stream.suits = false;
  const bool others = opening || tables || weights || t.bridge > 0 || t.shears.size() > 1;
  if (t.frames.count > 0 && (others || !suitsFrames(t))) stream.suits = false;
  if (!t.frames.suits()) stream.suits = false;
}

}  // namespace tetrakis::reference
