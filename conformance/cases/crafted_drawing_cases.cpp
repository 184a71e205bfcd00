// SPDX-License-Identifier: Apache-2.0
// Drawings of noise: values and indices that nothing foretells.
#include "codec/drawing/drawing_encoding.hpp"
#include "codec/drawing/drawing_pass.hpp"
#include "codec/geometry/drawn_heights/drawn_heights_decoder.hpp"
#include "codec/lattice/levels.hpp"
#include "conformance/cases/cases.hpp"
#include "conformance/cases/crafted_streams.hpp"
#include "texture_wavelet/drawn/drawn_decoder.hpp"

namespace tetrakis::conformance {
namespace {

/// A drawing of no image, made while it is coded: its first `fresh` vertices take new values, all
/// others values of random numbers in the list. An encoder would never write such a one.
template <class Value>
class MadeDrawing : public DrawingDecisions {
 public:
  /// make: a value of 32 random bits.
  MadeDrawing(uint32_t fresh, Value (*make)(uint32_t)) : fresh_(fresh), make_(make) {}

  DrawnIndex target(size_t) {
    const uint32_t h = samples::hash(++count_, 0, 44);
    value_ = make_(h);
    return count_ <= fresh_ ? kNoIndex : static_cast<DrawnIndex>(h >> 8 & 4095);
  }
  const Value& value(size_t) const { return value_; }

 private:
  uint32_t fresh_, count_ = 0;
  Value (*make_)(uint32_t);
  Value value_{};
};

Bytes drawnStream(uint32_t width, uint32_t height, uint32_t fresh) {
  const Texels format{width, height, 1, 8, {}};
  std::vector<KeptIndex> indices(size_t{width} * height);
  DrawnColours colours(format);
  MadeDrawing<DrawnColour> io(
      fresh, [](uint32_t h) { return DrawnColour{static_cast<uint16_t>(h & 255)}; });
  DrawingPass(PlaneView<KeptIndex>(indices, {width, height}), nullptr, colours, io)
      .run(levelsOf(width, height));
  return streamOf(textureHeader(width, height, 1, TKS_U8, kDrawnPlanes), io.finish());
}

StreamHeader drawnHeightsHeader(uint32_t width, uint32_t height, tks_sample sample) {
  StreamHeader header = heightsHeader(width, height, sample, GeometryHeader::kDirectPlanes);
  header.geometry->drawn = true;
  return header;
}

/// Steps over all of 32 bits.
Bytes drawnHeightsStream(uint32_t width, uint32_t height, uint32_t fresh) {
  std::vector<KeptIndex> indices(size_t{width} * height);
  DrawnSteps steps;
  MadeDrawing<int32_t> io(fresh, [](uint32_t h) { return static_cast<int32_t>(h); });
  DrawingPass(PlaneView<KeptIndex>(indices, {width, height}), nullptr, steps, io)
      .run(levelsOf(width, height));
  return streamOf(drawnHeightsHeader(width, height, TKS_F32), io.finish());
}

}  // namespace

std::vector<VectorCase> drawnCases() {
  StreamHeader kind = textureHeader(21, 20, 2, TKS_U16, kDrawnPlanes);
  StreamHeader over = textureHeader(40, 30, 3, TKS_U8, 6);
  StreamHeader holed = drawnHeightsHeader(33, 25, TKS_I16);
  holed.layers.validity_bytes = 120;
  holed.layers.has_nodata = 1;
  holed.layers.nodata = 7;
  over.texture->overlay_bytes = 150;
  return {crafted("colours_4096_67x65", "drawn: more texels than the list of colours holds",
                  drawnStream(67, 65, 4200)),
          crafted("colours_beyond_30x25", "drawn: indices beyond the list of colours",
                  drawnStream(30, 25, 40)),
          crafted("steps_4096_67x65", "drawn heights: more values than the list holds",
                  drawnHeightsStream(67, 65, 4200)),
          crafted("noise_drawn_heights_30x21", "drawn heights: noise",
                  streamOf(drawnHeightsHeader(30, 21, TKS_I16), noise(600, 33))),
          crafted("noise_drawn_voids_33x25", "drawn heights: noise, beside voids of noise",
                  streamOf(holed, noise(500, 34))),
          crafted("zeros_drawn_200x150", "drawn: one way in all decisions",
                  streamOf(textureHeader(200, 150, 1, TKS_U8, kDrawnPlanes), Bytes(900, 0))),
          crafted("noise_drawn_21x20", "drawn: noise", streamOf(kind, noise(500, 31))),
          crafted("noise_overlay_40x30", "noise: an overlay before coefficients",
                  streamOf(over, noise(700, 32)))};
}

}  // namespace tetrakis::conformance
