// SPDX-License-Identifier: Apache-2.0
// Streams as later versions may make them: domains, components and parts that this one does not
// know, which a decoder passes over or refuses. And lists that no version makes.
#include <functional>

#include "conformance/cases/cases.hpp"
#include "conformance/cases/crafted_streams.hpp"
#include "conformance/samples/header_parts.hpp"

namespace tetrakis::conformance {
namespace {

using test::HeaderParts;

constexpr uint64_t kLaterPart = 40, kLaterNote = 90;  // kinds that nobody knows yet

/// Of a kind that nobody knows yet, or of a known one on such a domain.
ListedComponent later(uint8_t kind, const Domain& domain, uint8_t region_log2,
                      const std::string& rest) {
  return {Component::kOther, kind, domain, region_log2, rest};
}

ListedComponent known(Component component) {
  ListedComponent one;
  one.component = component;
  return one;
}

const Domain& sphere() {
  static const Domain domain{7, {0, 0}};
  return domain;
}

/// A run of bytes of a component's track.
struct Run {
  uint8_t number;
  uint32_t track;
  Bytes bytes;
  bool whole = false;
};

Bytes streamOfRuns(StreamHeader header, const std::vector<Run>& runs) {
  const TrackCounts counts = trackCounts(header);
  Bytes payload;
  for (const Run& run : runs) {
    append(payload, headBytes({run.bytes.size(), run.track, 70, run.whole, run.number}, counts));
    append(payload, run.bytes);
  }
  header.payload_bytes = payload.size();
  Bytes stream = writeHeader(header);
  append(stream, payload);
  return stream;
}

/// Heights and a texture between what nobody knows yet.
StreamHeader manyComponents() {
  StreamHeader header = heightsHeader(9, 9, TKS_I16, 8);
  header.texture = textureHeader(11, 7, 1, TKS_U8, 8).texture;
  header.geometry->regions.side_log2 = 4;
  header.components = {later(9, sphere(), 2, "later"), known(Component::kTexture),
                       later(9, {Domain::kGrid, {400, 300}}, 0, ""),
                       later(ListedComponent::kHeights, sphere(), 5, "heights of a sphere"),
                       known(Component::kGeometry)};
  return header;
}

std::vector<VectorCase> passedOver() {
  StreamHeader other = heightsHeader(9, 9, TKS_I16, 8);
  other.components = {later(200, sphere(), 0, "later"), known(Component::kGeometry)};
  StreamHeader second = other;
  second.components = {known(Component::kGeometry),
                       later(ListedComponent::kHeights, {Domain::kGrid, {9, 9}}, 1, "second")};
  StreamHeader index = manyComponents();
  const std::vector<Run> runs = {{0, 4000000000u, noise(17, 201)},
                                 {4, 0, noise(20, 202)},
                                 {3, 1, noise(5, 203), true},
                                 {1, 0, noise(30, 204)},
                                 {2, 0, noise(150, 205)},
                                 {4, 0, noise(40, 206), true},
                                 {0, 3, noise(9, 207)},
                                 {1, 0, noise(21, 208)}};
  for (const Run& run : runs)
    index.index.push_back({{run.bytes.size(), run.track, 70, run.whole, run.number}, 255});
  return {crafted("list_other_9x9", "a component of an unknown kind before heights",
                  streamOfRuns(other, {{0, 0, noise(30, 209)},
                                       {1, 0, noise(30, 210)},
                                       {0, 0, noise(200, 211), true},
                                       {1, 0, noise(30, 212)}})),
          crafted("list_second_9x9", "second heights, which are passed over whatever they say",
                  streamOfRuns(second, {{1, 77, noise(30, 213)}, {0, 0, noise(60, 214)}})),
          crafted("list_five_11x7", "five components, of which two are known",
                  streamOfRuns(manyComponents(), runs)),
          crafted("list_index_11x7", "an index of five components", streamOfRuns(index, runs))};
}

/// A stream of heights whose list of parts is changed.
VectorCase changed(const std::string& name, const std::string& purpose,
                   const std::function<void(HeaderParts&)>& change) {
  const Bytes stream = streamOf(heightsHeader(9, 9, TKS_I16, 8), noise(60, 215));
  HeaderParts body = test::bodyOf(stream);
  change(body);
  return crafted(name, purpose, test::withBody(stream, body));
}

/// Likewise the parts of the heights.
VectorCase changedHeights(const std::string& name, const std::string& purpose,
                          const std::function<void(HeaderParts&)>& change) {
  return changed(name, purpose, [&](HeaderParts& body) {
    Bytes& bytes = body.find(test::kComponentKind)->bytes;
    HeaderParts component = test::componentOf(bytes);
    change(component);
    bytes = component.bytes();
  });
}

std::vector<VectorCase> unknownParts() {
  return {
      changedHeights("part_of_heights_9x9",
                     "parts of heights that nobody knows yet and all may skip",
                     [](HeaderParts& heights) {
                       heights.add(kLaterNote, {1, 2, 3});
                       heights.add(kLaterNote + 300, {});
                     }),
      changed("refused_part", "a part of a kind that a decoder has to know",
              [](HeaderParts& body) { body.add(kLaterPart, {7}); }),
      changedHeights("refused_part_of_heights", "likewise of heights",
                     [](HeaderParts& heights) { heights.add(kLaterPart, {7}); }),
      changedHeights("refused_cut_out_heights", "heights with a part that textures have",
                     [](HeaderParts& heights) {
                       heights.add(16, {9, 0});
                     }),
      changedHeights("refused_part_before_sense",
                     "such a part beside bridges over voids that there are not",
                     [](HeaderParts& heights) {
                       heights.add(4, {1});
                       heights.add(kLaterPart, {7});
                     }),
      changedHeights("refused_field_before_part", "such a part behind bridges of no reach",
                     [](HeaderParts& heights) {
                       heights.add(4, {0});
                       heights.add(kLaterPart, {7});
                     }),
      changed("refused_nothing_known", "heights over a domain of an unknown kind, and nothing else",
              [](HeaderParts& body) {
                body.find(test::kComponentKind)->bytes[test::kDomainByte + 1] = 7;
              })};
}

std::vector<VectorCase> refusedLists() {
  const auto twice = [](HeaderParts& of, uint64_t kind, const Bytes& bytes) {
    of.add(kind, bytes);
    of.add(kind, bytes);
  };
  return {changed("refused_part_twice", "a part twice",
                  [&](HeaderParts& body) { twice(body, 66, {5}); }),
          changed("refused_skipped_twice", "a part twice that nobody knows yet",
                  [&](HeaderParts& body) { twice(body, kLaterNote, {5}); }),
          changedHeights("refused_layer_twice", "a part of heights twice",
                         [&](HeaderParts& heights) { twice(heights, 64, {1}); }),
          changed("refused_part_order", "a part behind one of a higher kind",
                  [](HeaderParts& body) {
                    body.add(kLaterNote, {});
                    body.parts.push_back({66, {5}});
                  }),
          changed("refused_part_longer", "a part of more bytes than its fields",
                  [](HeaderParts& body) {
                    body.add(66, {5, 0});
                  }),
          changed("refused_part_shorter", "a part that ends inside a field",
                  [](HeaderParts& body) { body.add(66, {0x85}); }),
          changed("refused_part_beyond", "a part that reaches past the end of the body",
                  [](HeaderParts& body) {
                    body.fields.insert(body.fields.end(), {0, 127});
                  }),
          changed("refused_no_component", "no component",
                  [](HeaderParts& body) { body.parts.clear(); }),
          changed("refused_no_domain", "a component on a domain that there is not",
                  [](HeaderParts& body) {
                    body.find(test::kComponentKind)->bytes[test::kDomainByte] = 1;
                  }),
          changed("refused_components", "seventeen components, of which one is known",
                  [](HeaderParts& body) {
                    for (int i = 0; i < 16; ++i) body.add(test::kComponentKind, {7, 0, 0});
                  }),
          changedHeights("refused_no_wavelet", "heights by a wavelet without one",
                         [](HeaderParts& heights) {
                           heights.wavelet.clear();
                           heights.parts.clear();
                         }),
          changedHeights("refused_stored_wavelet", "stored heights with a wavelet",
                         [](HeaderParts& heights) {
                           heights.fields[test::codingByte(heights.fields, true)] = 0;
                         })};
}

}  // namespace

std::vector<VectorCase> listCases() {
  std::vector<VectorCase> all = passedOver();
  for (const auto& cases : {unknownParts(), refusedLists()})
    all.insert(all.end(), cases.begin(), cases.end());
  return all;
}

}  // namespace tetrakis::conformance
