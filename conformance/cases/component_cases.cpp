// SPDX-License-Identifier: Apache-2.0
// Streams of more components than a decoder takes by itself: combined ones, and crafted details.
#include <functional>
#include <optional>
#include <utility>

#include "bitstream/stream/component_list.hpp"
#include "conformance/cases/case_builders.hpp"
#include "conformance/cases/cases.hpp"
#include "conformance/cases/crafted_streams.hpp"
#include "conformance/samples/header_parts.hpp"
#include "tetrakis/components.h"

namespace tetrakis::conformance {
namespace {

using test::HeaderParts;

constexpr uint64_t kDetailsKind = 74;

struct NamedCase {
  const char* name;
  VectorCase input;
};

Bytes combined(const std::vector<NamedCase>& cases, uint64_t bytes) {
  std::vector<Bytes> streams;
  for (const NamedCase& one : cases) {
    Result<Bytes> stream = encodeCase(one.input);
    streams.push_back(stream.ok() ? *std::move(stream) : Bytes());
  }
  std::vector<tks_combined> inputs;
  for (size_t i = 0; i < cases.size(); ++i)
    inputs.push_back(
        {sizeof(tks_combined), streams[i].data(), streams[i].size(), cases[i].name, 0});
  const Result<Buffer> made = combine(inputs, {sizeof(tks_combine_options), bytes, nullptr});
  if (!made) return {};
  return {made->bytes().begin(), made->bytes().end()};
}

VectorCase placed(VectorCase input) {
  input.placed = true;
  return input;
}

std::vector<VectorCase> combinedCases() {
  VectorCase both = heightsCase("", "", {Pattern::kRidges, 40, 30, 1, TKS_I16}, lossless());
  both.texture = Recipe{Pattern::kRidges, 61, 47, 3, TKS_U8, 7};
  const VectorCase later =
      withVoids(heightsCase("", "", {Pattern::kRidges, 40, 30, 1, TKS_I16, 9}, lossless()),
                samples::VoidShape::kCoast, -9999);
  const VectorCase classes =
      textureCase("", "", {Pattern::kChecker, 40, 30, 1, TKS_U8}, lossless());
  const VectorCase normals =
      textureCase("", "", {Pattern::kRidges, 33, 20, 3, TKS_U8, 3}, budget(900));
  const std::vector<NamedCase> all = {{nullptr, placed(both)},
                                      {"later", placed(later)},
                                      {"classes", placed(classes)},
                                      {"normals", normals}};
  const std::vector<NamedCase> indexed_ones = {
      {"dem", heightsCase("", "", {Pattern::kRidges, 70, 60, 1, TKS_U16},
                          indexed(inRegions(lossless(), 16)))},
      {"dsm", heightsCase("", "", {Pattern::kRidges, 70, 60, 1, TKS_U16, 5},
                          indexed(inRegions(budget(1500), 16)))}};
  return {crafted("components_40x30", "five components, of which three are asked for",
                  combined(all, 0)),
          crafted("components_cut_40x30", "the same, cut by a byte budget", combined(all, 3000)),
          crafted("components_index_70x60", "two heights in regions, with an index",
                  combined(indexed_ones, 0))};
}

/// A component as others stand in a list.
ListedComponent asOther(StreamHeader header, Component component) {
  ListedComponent one = listed(header, component);
  FieldWriter fields;
  visitKnown(fields, header, one);
  one.rest.assign(fields.bytes.begin(), fields.bytes.end());
  one.component = Component::kOther;
  return one;
}

/// Heights that lie somewhere, then others and a texture, before noise.
StreamHeader withDetails() {
  StreamHeader header = heightsHeader(9, 9, TKS_I16, 8);
  header.georeference.heights = {true, {500, 10, 0, 900, 0, -10}, 1, "1024=1 3072=32632"};
  header.metadata.crs = "EPSG:32632";
  ListedComponent first;
  first.component = Component::kGeometry;
  first.details.name = "first";
  ListedComponent heights = asOther(heightsHeader(18, 9, TKS_F32, 9), Component::kGeometry);
  heights.details.name = "sc\xc3\xa8ne\n";
  heights.details.metadata.unit = "ft";
  heights.details.metadata.scale = 0.5;
  heights.details.metadata.crs = header.metadata.crs;
  heights.details.place.heights = {
      true, {500, 5, 0, 900, 0, -10}, 2, header.georeference.heights.geo_keys};
  heights.details.lossless = 1;
  ListedComponent texture = asOther(textureHeader(7, 11, 3, TKS_U8, 8), Component::kTexture);
  texture.details.place.texture = {true, {1, 2, 3, 4, 5, 6}, 0, ""};
  texture.details.place.texture_crs = "EPSG:4326";
  ListedComponent unknown;
  unknown.kind = 9;
  unknown.domain.grid = {3, 3};
  unknown.rest = "later";
  unknown.details.name = "unknown";
  header.components = {first, heights, unknown, texture,
                       asOther(textureHeader(5, 6, 1, TKS_U8, 7), Component::kTexture)};
  return header;
}

Bytes noisy(StreamHeader header) {
  const TrackCounts counts = trackCounts(header);
  Bytes payload;
  for (uint8_t number = 0; number < header.components.size(); ++number) {
    const Bytes bytes = noise(40 + 9 * number, 301 + number);
    append(payload, headBytes({bytes.size(), 0, 70, false, number}, counts));
    append(payload, bytes);
  }
  header.payload_bytes = payload.size();
  Bytes stream = writeHeader(header);
  append(stream, payload);
  return stream;
}

/// Two heights of 9 x 9, with details of these bytes.
VectorCase detailed(const std::string& name, const std::string& purpose, bool placed_heights,
                    const std::function<void(HeaderParts&)>& change) {
  StreamHeader header = heightsHeader(9, 9, TKS_I16, 8);
  if (placed_heights) header.georeference.heights = {true, {0, 1, 0, 0, 0, -1}, 0, ""};
  ListedComponent first;
  first.component = Component::kGeometry;
  header.components = {first, asOther(heightsHeader(9, 9, TKS_I16, 8), Component::kGeometry)};
  const Bytes stream = noisy(header);
  HeaderParts body = test::bodyOf(stream);
  HeaderParts details;
  change(details);
  body.add(kDetailsKind, details.bytes());
  return crafted(name, purpose, test::withBody(stream, body));
}

Bytes partsOf(const std::function<void(HeaderParts&)>& change) {
  HeaderParts parts;
  change(parts);
  return parts.bytes();
}

std::vector<VectorCase> craftedDetails() {
  const auto second = [](uint64_t kind, const Bytes& bytes) {
    return [=](HeaderParts& details) {
      details.add(1, partsOf([&](HeaderParts& parts) { parts.add(kind, bytes); }));
    };
  };
  return {crafted("details_18x11", "names, places and promises of five components",
                  noisy(withDetails())),
          detailed("details_later_9x9",
                   "parts of details that nobody knows yet, and nothing of one", false,
                   [](HeaderParts& details) {
                     details.add(0, {});
                     details.add(1, partsOf([](HeaderParts& parts) { parts.add(90, {1, 2}); }));
                     details.add(64, {7});
                   }),
          detailed("details_over_9x9", "heights on the ground of the first ones", true,
                   second(66, {5, 1})),
          detailed("refused_details_over", "the same where the first ones lie nowhere", false,
                   second(66, {5, 1})),
          detailed("refused_details_number", "details of a component that there is not", false,
                   [](HeaderParts& details) { details.add(2, {}); }),
          detailed("refused_details_own", "first heights on the ground of themselves", true,
                   [](HeaderParts& details) {
                     details.add(0, partsOf([](HeaderParts& parts) { parts.add(66, {5, 1}); }));
                   }),
          detailed("refused_details_scale", "metadata with a scale of 0", false,
                   second(65, {0, 0, 0, 0, 0, 0})),
          detailed("refused_details_lossless", "a promise with a field", false, second(67, {1})),
          detailed("refused_details_part", "a part of details that a decoder has to know", false,
                   second(40, {1}))};
}

/// An object with a texture, and on the same patches a map of its material, whose factors the
/// header says.
VectorCase mappedCase() {
  VectorCase object;
  for (VectorCase& one : objectCases())
    if (one.texture && !one.corners.empty()) object = std::move(one);
  VectorCase shade = textureCase(
      "", "", {Pattern::kChecker, object.texture->width, object.texture->height, 1, TKS_U8, 5},
      budget(700));
  shade.sides = object.sides;
  const Bytes stream = combined({{nullptr, object}, {"occlusion", shade}}, 0);
  const Result<ParsedHeader> parsed = readHeader(stream);
  if (!parsed.ok()) return crafted("material_9x54_17x102", "", {});
  StreamHeader header = parsed->header;
  header.material = R"({"occlusionTexture":{"strength":0.5}})";
  Bytes made = writeHeader(header);
  made.insert(made.end(), stream.begin() + static_cast<ptrdiff_t>(parsed->bytes), stream.end());
  return crafted("material_9x54_17x102", "a map on the patches of an object, and its factors",
                 made);
}

}  // namespace

std::vector<VectorCase> componentCases() {
  std::vector<VectorCase> all = combinedCases();
  all.push_back(mappedCase());
  for (VectorCase& next : craftedDetails()) all.push_back(std::move(next));
  return all;
}

}  // namespace tetrakis::conformance
