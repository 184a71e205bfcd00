// SPDX-License-Identifier: Apache-2.0
// Headers and packets that are unusual and decode, and those that do not.
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "base/forest.hpp"
#include "bitstream/coder/range_encoder.hpp"
#include "conformance/cases/cases.hpp"
#include "conformance/cases/crafted_streams.hpp"
#include "conformance/samples/header_parts.hpp"
#include "conformance/samples/header_seal.hpp"

namespace tetrakis::conformance {
namespace {

/// `header` before a packet, its body changed, and sealed again.
Bytes withBody(const StreamHeader& header, const std::function<void(Bytes&)>& change) {
  const Bytes stream = streamOf(header, noise(60, 51));
  const size_t end = readHeader(stream)->bytes, start = 8;  // the body is short
  Bytes body(stream.begin() + start, stream.begin() + static_cast<ptrdiff_t>(end) - 4);
  change(body);
  Bytes out(stream.begin(), stream.begin() + 7);
  append(out, varint(body.size()));
  append(out, body);
  out.resize(out.size() + 4);
  append(out, Bytes(stream.begin() + static_cast<ptrdiff_t>(end), stream.end()));
  test::sealHeader(out);
  return out;
}

/// Heights in the Swiss grid with their longitudes and latitudes, before a part of a kind that
/// nobody knows yet.
VectorCase positionedCase() {
  StreamHeader header = heightsHeader(33, 17, TKS_I16, 8);
  header.metadata.crs = "EPSG:2056";
  header.georeference.heights = {true, {2600000, 1000, 0, 1200000, 0, -1000}, 0, ""};
  const Bytes positions = {0x10, 0x5e, 0x01, 0x11, 0xb5, 0x08, 0xa4,
                           0x05, 0x01, 0xbb, 0x04, 0x03, 0xdd, 0x02};
  header.height_positions.assign(positions.begin(), positions.end());
  return crafted("positions_33x17", "longitudes and latitudes before a part that nobody knows yet",
                 withBody(header, [&](Bytes& body) {
                   append(body, {99, 5, 'l', 'a', 't', 'e', 'r'});
                 }));
}

/// What is unusual and decodes.
std::vector<VectorCase> unusualCases() {
  const StreamHeader heights = heightsHeader(9, 9, TKS_I16, 8);
  StreamHeader text = heights;
  text.metadata.unit = "\xff\xfe";
  VectorCase tail =
      crafted("behind_end_9x9", "a packet behind payload_bytes is no part of the stream",
              streamOf(heights, noise(60, 52)));
  append(tail.stream, Bytes(tail.stream.end() - 62, tail.stream.end()));
  return {tail,
          crafted("part_skipped_9x9", "a part of a kind that nobody knows yet and all may skip",
                  withBody(heights,
                           [](Bytes& body) {
                             append(body, {99, 2, 7, 7});
                           })),
          crafted("varint_longer_9x9", "a varint of more bytes than it needs",
                  withBody(heights,
                           [](Bytes& body) { body[0] |= 128, body.insert(body.begin() + 1, 0); })),
          crafted("text_9x9", "text that is not UTF-8", streamOf(text, noise(60, 53))),
          positionedCase()};
}

/// Codewords of FF alone, which no encoder writes and which decide nothing, each before others.
std::vector<VectorCase> onesCases() {
  const Bytes ones(40, 255);
  StreamHeader layers = heightsHeader(20, 17, TKS_F32, 12);
  layers.layers.validity_bytes = layers.layers.flat_bytes = 40;
  layers.layers.flat_areas = 1;
  layers.layers.corrections = CorrectionKind::kSamples;
  layers.layers.table_bytes = 40;
  layers.layers.table_values = 9;
  layers.layers.table_after = 20;
  layers.layers.coefficient_bytes = 40;
  Bytes of_layers;
  for (int i = 0; i < 5; ++i) append(of_layers, ones);
  StreamHeader masked = layers;
  masked.layers = {.validity_bytes = 40};
  Bytes of_masked = ones;
  append(of_masked, noise(200, 55));
  return {crafted("ones_9x9", "a codeword of FF decides nothing",
                  streamOf(heightsHeader(9, 9, TKS_I16, 8), ones)),
          crafted("ones_layers_20x17", "codewords of FF: all layers of heights",
                  streamOf(layers, of_layers)),
          crafted("ones_mask_20x17", "a mask of FF decides nothing, coefficients do",
                  streamOf(masked, of_masked)),
          crafted("ones_texels_13x11", "a codeword of FF: texels",
                  streamOf(textureHeader(13, 11, 3, TKS_U8, 8), ones)),
          crafted("ones_drawn_13x11", "a codeword of FF: a drawing",
                  streamOf(textureHeader(13, 11, 3, TKS_U8, kDrawnPlanes), ones))};
}

/// An index that says something else than the packet does.
VectorCase lyingIndex(const std::string& name, const std::string& purpose, const PacketHead& told) {
  StreamHeader header = heightsHeader(9, 9, TKS_I16, 8);
  header.index = {{told, 255}};
  return crafted(name, purpose, streamOf(header, noise(60, 56)));
}

std::vector<VectorCase> indexCases() {
  return {
      lyingIndex("index_quality_9x9", "an index with another quality changes nothing", {60, 0, 7}),
      lyingIndex("index_head_9x9", "an index with another length changes nothing",
                 {41, 0, 0, true}),
      lyingIndex("index_component_9x9", "an index with a component that there is not",
                 {60, 0, 0, false, 1})};
}

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

void draw(StreamHeader& h) {
  h.geometry->planes = GeometryHeader::kDirectPlanes;
  h.geometry->drawn = true;
}

void correctRelatively(StreamHeader& h, double step) {
  h.layers.corrections = CorrectionKind::kRelative;
  h.layers.relative = {step, 4};
}

/// Heights on patches of nine samples, or more, none of which is glued to another.
void plant(StreamHeader& h, uint32_t patches, int depth = 1) {
  const auto forest =
      std::make_shared<const Forest>(depth, std::vector<uint32_t>(4 * patches, Forest::kBorder));
  h = heightsHeader(forest->raster().width, forest->raster().height, TKS_I16, 8);
  h.geometry->wavelet.forest = forest;
}

/// Heights with voids, whose regions of 16 samples have masks.
StreamHeader divided(uint32_t width, uint32_t height) {
  StreamHeader h = heightsHeader(width, height, TKS_F32, 8);
  h.geometry->regions.side_log2 = 4;
  h.layers.validity_bytes = 9;
  h.layers.region_masks = true;
  return h;
}

/// What makes a sound header of heights one that no decoder may take.
struct Refusal {
  const char* name;
  const char* purpose;
  void (*spoil)(StreamHeader&);
};

const Refusal kRefusals[] = {
    {"scale", "a scale of NaN", [](StreamHeader& h) { h.metadata.scale = kNaN; }},
    {"max_error", "a largest error of NaN",
     [](StreamHeader& h) {
       h.geometry->exact = 1;  // so that there is a bound
       h.geometry->max_error = kNaN;
     }},
    {"planes", "more bit-planes of heights than there may be",
     [](StreamHeader& h) { h.geometry->planes = 64; }},
    {"sample", "heights of a type that there is not",
     [](StreamHeader& h) { h.geometry->sample = 7; }},
    {"side", "heights of no column", [](StreamHeader& h) { h.geometry->width = 0; }},
    {"tiles", "a map of more than 65536 tiles",
     [](StreamHeader& h) {
       h = heightsHeader(4097, 4096, TKS_I16, 8);
       h.geometry->priorities = {4, "map"};
     }},
    {"drawn_priorities", "a drawn texture with a map of priorities",
     [](StreamHeader& h) {
       h = textureHeader(9, 9, 1, TKS_U8, kDrawnPlanes);
       h.texture->priorities = {4, "map"};
     }},
    {"stored_flat", "stored heights with flat areas",
     [](StreamHeader& h) {
       h.geometry->planes = GeometryHeader::kDirectPlanes;
       h.layers.flat_bytes = 5;
       h.layers.flat_areas = 1;
     }},
    {"bridges", "bridges over voids that there are not",
     [](StreamHeader& h) { h.layers.bridge = 1; }},
    {"texture_bridges", "bridges of a texture of which everything is coded",
     [](StreamHeader& h) {
       h = textureHeader(9, 9, 3, TKS_U8, 8);
       h.texture->bridge = 255;
     }},
    {"drawn_bridges", "a drawn texture with bridges",
     [](StreamHeader& h) {
       h = textureHeader(9, 9, 1, TKS_U8, kDrawnPlanes);
       h.texture->bridge = 1;
     }},
    {"drawn_heights_flat", "drawn heights with flat areas",
     [](StreamHeader& h) {
       draw(h);
       h.layers.flat_bytes = 5;
       h.layers.flat_areas = 1;
     }},
    {"drawn_heights_bridges", "drawn heights with bridges",
     [](StreamHeader& h) {
       draw(h);
       h.layers.validity_bytes = 3;
       h.layers.has_nodata = 1;
       h.layers.bridge = 255;
     }},
    {"drawn_heights_steps", "drawn heights with corrections of steps",
     [](StreamHeader& h) {
       draw(h);
       h.layers.corrections = CorrectionKind::kSteps;
       h.layers.correction_step = 1;
     }},
    {"drawn_heights_regions", "drawn heights in regions",
     [](StreamHeader& h) {
       draw(h);
       h.geometry->regions.side_log2 = 4;
     }},
    {"flat_areas", "more flat areas than there may be",
     [](StreamHeader& h) {
       h.layers.flat_bytes = 5;
       h.layers.flat_areas = 65536;
     }},
    {"stored_regions", "stored heights in regions",
     [](StreamHeader& h) {
       h.geometry->planes = GeometryHeader::kDirectPlanes;
       h.geometry->regions.side_log2 = 4;
     }},
    {"filter", "a filter that there is not",
     [](StreamHeader& h) { h.geometry->wavelet.filters[1] = 6; }},
    {"voids", "integer heights with voids and no value for them",
     [](StreamHeader& h) { h.layers.validity_bytes = 9; }},
    {"nodata", "voids of a value that the type has not",
     [](StreamHeader& h) { h.layers = {.validity_bytes = 9, .has_nodata = 1, .nodata = 0.5}; }},
    {"table_kinds", "a table of values beside corrections of steps",
     [](StreamHeader& h) {
       h.layers.corrections = CorrectionKind::kSteps;
       h.layers.correction_step = 1;
       h.layers.table_bytes = 9;
       h.layers.table_values = 2;
     }},
    {"relative_step", "a relative step of 0", [](StreamHeader& h) { correctRelatively(h, 0); }},
    {"relative_infinite", "an infinite relative step",
     [](StreamHeader& h) { correctRelatively(h, std::numeric_limits<double>::infinity()); }},
    {"relative_quarters", "a pull of five quarters",
     [](StreamHeader& h) {
       correctRelatively(h, 1);
       h.layers.relative.quarters = 5;
     }},
    {"facet_unit", "a unit of facets beyond all floats",
     [](StreamHeader& h) {
       h.geometry->sample = TKS_F32;
       h.layers.corrections = CorrectionKind::kFacets;
       h.layers.facet_unit = 255;
     }},
    {"facets_integer", "facets of integers",
     [](StreamHeader& h) {
       h.layers.corrections = CorrectionKind::kFacets;
       h.layers.facet_unit = 100;
     }},
    {"table_steps", "a table of values beside corrections of steps",
     [](StreamHeader& h) {
       h.layers.corrections = CorrectionKind::kSteps;
       h.layers.correction_step = 3;
       h.layers.table_bytes = 9;
       h.layers.table_values = 2;
     }},
    {"relative_drawn", "drawn heights with relative steps",
     [](StreamHeader& h) {
       draw(h);
       correctRelatively(h, 1);
     }},
    {"table_values", "a table of one value",
     [](StreamHeader& h) {
       h.layers.table_bytes = 9;
       h.layers.table_values = 1;
     }},
    {"table_knots", "a knot beyond the table",
     [](StreamHeader& h) {
       h.layers.table_bytes = 9;
       h.layers.table_values = 4;
       h.layers.table_knots = {{1, 5}, {4, 5}};
     }},
    {"table_rise", "a knot that rises too far",
     [](StreamHeader& h) {
       h.layers.table_bytes = 9;
       h.layers.table_values = 4;
       h.layers.table_knots = {{1, 1}, {2, GeometryLayers::kMostRise + 1}};
     }},
    {"table_after", "a table behind more coefficients than there are",
     [](StreamHeader& h) {
       h.layers.corrections = CorrectionKind::kSamples;
       h.layers.table_bytes = 9;
       h.layers.table_values = 4;
       h.layers.table_after = 7;
       h.layers.coefficient_bytes = 6;
     }},
    {"late_mask", "a late mask of voids that there are not",
     [](StreamHeader& h) { h.layers.late_mask = true; }},
    {"late_after", "a late mask behind more coefficients than there are",
     [](StreamHeader& h) {
       h.layers = {.validity_bytes = 9, .has_nodata = 1, .nodata = 5};
       h.layers.late_mask = true;
       h.layers.validity_after = 7;
       h.layers.corrections = CorrectionKind::kSamples;
       h.layers.coefficient_bytes = 6;
     }},
    {"drawn_heights_late", "drawn heights with a late mask",
     [](StreamHeader& h) {
       draw(h);
       h.layers.validity_bytes = 3;
       h.layers.has_nodata = 1;
       h.layers.late_mask = true;
     }},
    {"table_stored", "stored heights with a table of values",
     [](StreamHeader& h) {
       h.geometry->planes = GeometryHeader::kDirectPlanes;
       h.layers.table_bytes = 9;
       h.layers.table_values = 2;
     }},
    {"regions", "regions of 8 samples", [](StreamHeader& h) { h.geometry->regions.side_log2 = 3; }},
    {"drawn_regions", "a drawn texture in regions",
     [](StreamHeader& h) {
       h = textureHeader(9, 9, 1, TKS_U8, kDrawnPlanes);
       h.texture->regions.side_log2 = 4;
     }},
    {"geotransform", "a geotransform with a NaN",
     [](StreamHeader& h) {
       h.georeference.heights = {true, {0, 1, 0, 0, kNaN, -1}, 0, ""};
     }},
    {"huge_geotransform", "a geotransform whose sums may overflow",
     [](StreamHeader& h) {
       h.georeference.heights = {true, {0x1p512, 1, 0, 0, 0, -1}, 0, ""};
     }},
    {"registration", "a registration that there is not",
     [](StreamHeader& h) { h.georeference.heights.registration = 3; }},
    {"white_level", "a texture of 8 bits with a white level",
     [](StreamHeader& h) {
       h = textureHeader(9, 9, 1, TKS_U8, 8);
       h.texture->white_level = 200;
     }},
    {"drawn_tables", "a drawn texture with tables of values",
     [](StreamHeader& h) {
       h = textureHeader(9, 9, 1, TKS_U8, kDrawnPlanes);
       h.texture->tables.present = true;
     }},
    {"table_texels", "a table of more values than samples may have",
     [](StreamHeader& h) {
       h = textureHeader(9, 9, 1, TKS_U16, 8);
       h.texture->tables.present = true;
       h.texture->tables.values[0] = ChannelTablesHeader::kMostValues + 1;
     }},
    {"texels", "a texture of signed samples",
     [](StreamHeader& h) { h = textureHeader(9, 9, 1, TKS_I8, 8); }},
    {"forest_patches", "a forest of 4097 patches", [](StreamHeader& h) { plant(h, 4097); }},
    {"forest_flat", "a forest with flat areas beside a filter of four steps",
     [](StreamHeader& h) {
       plant(h, 2);
       h.geometry->wavelet.filters[1] = 5;
       h.layers.flat_bytes = 5;
       h.layers.flat_areas = 1;
     }},
    {"forest_voids", "a forest with voids that are not lifted",
     [](StreamHeader& h) {
       plant(h, 2);
       h.layers.validity_bytes = 9;
       h.layers.has_nodata = 1;
     }},
    {"region_masks", "masks of regions beside flat areas",
     [](StreamHeader& h) {
       h = divided(80, 70);
       h.layers.flat_bytes = h.layers.flat_areas = 5;
     }},
    {"region_masks_narrow", "masks of regions of a grid whose height is not halved three times",
     [](StreamHeader& h) { h = divided(200, 16); }},
    {"region_masks_one", "masks of regions where there are none",
     [](StreamHeader& h) { h = divided(20, 20); }},
    {"base_mesh_grid", "a grid over a base mesh",
     [](StreamHeader& h) { h.geometry->base_mesh.bits = 8; }},
    {"base_mesh_depth", "patches of 513 x 513 samples over a base mesh",
     [](StreamHeader& h) {
       plant(h, 1, BaseMeshHeader::kMostDepth + 1);
       h.geometry->base_mesh.bits = 8;
     }},
    {"base_mesh_bits", "corners of 21 bits",
     [](StreamHeader& h) {
       plant(h, 2);
       h.geometry->base_mesh.bits = 21;
     }},
    {"base_mesh_cell", "a base mesh of cells without a size", [](StreamHeader& h) {
       plant(h, 2);
       h.geometry->base_mesh.bits = 8;
       h.geometry->base_mesh.cell = 0;
     }}};

/// Header fields, each of them wrong, in front of a sound packet.
std::vector<VectorCase> refusedHeaders() {
  std::vector<VectorCase> cases;
  for (const Refusal& refusal : kRefusals) {
    StreamHeader header = heightsHeader(9, 9, TKS_I16, 8);
    refusal.spoil(header);
    cases.push_back(crafted(std::string("refused_") + refusal.name, refusal.purpose,
                            streamOf(header, noise(40, 54))));
  }
  return cases;
}

/// The codeword of a patch, the first side of which is a border, and another side glued to it.
Bytes gluedToBorder() {
  DecisionEncoding io;
  AdaptiveBit after, before, border;
  for (const bool is_border : {true, false}) {
    io.decide(after, false);
    io.decide(before, false);
    io.decide(border, is_border);
  }
  for (int bit = 0; bit < 2; ++bit) io.even(true);  // side 3
  return io.finish();
}

/// Forests whose patches are glued to none, with another glue.
std::vector<VectorCase> refusedGlue() {
  const auto refuse = [](const char* name, const char* purpose, uint32_t patches,
                         const std::function<void(Bytes&)>& change) {
    StreamHeader header;
    plant(header, patches);
    const Bytes stream = streamOf(header, noise(40, 54));
    test::HeaderParts body = test::bodyOf(stream);
    change(body.find(test::kComponentKind)->bytes);
    return crafted(name, purpose, test::withBody(stream, body));
  };
  constexpr ptrdiff_t kGlueBytes = test::kDomainByte + 4;  // behind domain_kind, depth, patches
  const auto withGlue = [](const Bytes& glue) {
    return [glue](Bytes& component) {
      const auto at = component.begin() + kGlueBytes;
      const auto behind = component.erase(at, at + 1 + *at);
      const auto put = component.insert(behind, glue.begin(), glue.end());
      component.insert(put, static_cast<uint8_t>(glue.size()));
    };
  };
  return {refuse("refused_glue_cut", "glue that ends early", 20,
                 [](Bytes& component) {
                   const auto at = component.begin() + kGlueBytes;
                   component.erase(at + 2, at + 1 + *at);
                   *at = 1;
                 }),
          refuse("refused_glue_side", "a side glued to a border", 1, withGlue(gluedToBorder())),
          refuse("refused_glue_patch", "glue of more patches than it tells of", 1,
                 [](Bytes& component) { component[kGlueBytes - 1] = 90; }),
          refuse("refused_glue_alike", "a forest glued like one that there is not", 1,
                 [](Bytes& component) {
                   const auto at = component.begin() + kGlueBytes - 1;
                   const auto behind = component.erase(at, at + 2 + at[1]);
                   component.insert(behind, uint8_t{0});
                   component[test::kDomainByte + 1] = Domain::kForestAlike;
                 })};
}

/// A sound header before a packet that is none.
std::vector<VectorCase> refusedPackets() {
  const auto refuse = [](const std::string& name, const std::string& purpose, const Bytes& packet) {
    StreamHeader header = heightsHeader(9, 9, TKS_I16, 8);
    header.payload_bytes = 40;
    Bytes stream = writeHeader(header);
    append(stream, packet);
    stream.resize(stream.size() + 12);
    return crafted("refused_" + name, purpose, stream);
  };
  return {refuse("empty_packet", "a packet of no bytes", {0, 7}),
          refuse("component", "a packet of a component that there is not", {1 << 2 | 1, 7}),
          refuse("long_head", "a packet's head of more bytes than it needs", {160, 1 | 128, 0, 7}),
          refuse("varint", "a varint of more than 64 bits",
                 {255, 255, 255, 255, 255, 255, 255, 255, 255, 2, 7})};
}

}  // namespace

std::vector<VectorCase> unusualAndRefusedCases() {
  std::vector<VectorCase> all;
  for (const auto& cases : {unusualCases(), onesCases(), indexCases(), refusedHeaders(),
                            refusedGlue(), refusedPackets()})
    all.insert(all.end(), cases.begin(), cases.end());
  return all;
}

}  // namespace tetrakis::conformance
