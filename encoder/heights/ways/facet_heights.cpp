// SPDX-License-Identifier: Apache-2.0
#include "encoder/heights/ways/facet_heights.hpp"

#include <memory>
#include <utility>

#include "codec/geometry/coding_choice/facet_cut.hpp"
#include "codec/geometry/facets/facets_encoder.hpp"
#include "encoder/heights/followed_heights.hpp"
#include "encoder/heights/ways/cut_heights.hpp"
#include "encoder/heights/ways/restored_heights.hpp"

namespace tetrakis::inline ways {

namespace {

CodedHeights followedByFacets(CodedHeights cut, int unit, uint32_t threads) {
  const HeightSteps shown = shownSteps(cut, threads);
  const PlaneView<const int32_t> steps(shown.steps, cut.header.extent(), shown.valid);
  const PartCodewords codewords = encodeParts(cut.header, threads, [&](const Window& part) {
    return encodeFacets(*cut.quantised->samples, steps, part, cut.header, unit);
  });
  GeometryLayers layers = cut.layers;
  layers.corrections = CorrectionKind::kFacets;
  layers.facet_unit = static_cast<uint8_t>(unit);
  CodedHeights followed = followedBy(std::move(cut), std::move(layers), codewords, 0);
  followed.left = QuantisedHeights::kInexact;
  return followed;
}

FacetCut cutOf(const CodedHeights& lossy, const FacetShare& facets, double room) {
  const QuantisedHeights& quantised = *lossy.quantised;
  return chooseFacetCut(quantised.steps, extentOf(*quantised.samples), facets, room);
}

}  // namespace

std::optional<FacetShare> facetsOf(const QuantisedHeights& heights) {
  constexpr double kMostBeyond = 0.75;
  constexpr int kFewBits = 20;  // of exact steps, which say more of their neighbours
  const HeightSteps& steps = heights.steps;
  if (heights.samples->sample != TKS_F32 || heights.samples->step > 0 || !steps.table.empty())
    return {};
  if (steps.exact && steps.range_bits <= kFewBits) return {};
  const FacetShare facets = findFacets(*heights.samples, steps.valid);
  if (facets.beyond > kMostBeyond) return {};
  return facets;
}

std::optional<CodedHeights> codeFacets(const EncodeInputs& inputs, const FacetShare& facets) {
  const std::shared_ptr<const QuantisedHeights> fine = quantiseForFacets(inputs);
  if (!fine) return {};
  const FacetCut cut = chooseFacetCut(fine->steps, extentOf(*fine->samples), facets, 0);
  return followedByFacets(codeUpTo(inputs, fine, cut.mean_square), facets.unit,
                          inputs.options.threads);
}

std::optional<FacetShare> facetsOf(const CodedHeights& lossy, uint64_t room) {
  constexpr double kPerhaps = 1.25;  // of what the estimate says
  if (lossy.quantised->restored() || lossy.header.direct() || lossy.hasCorrections()) return {};
  const std::optional<FacetShare> facets = facetsOf(*lossy.quantised);
  if (!facets || lossy.quantised->isSmall()) return facets;
  const bool fits = cutOf(lossy, *facets, 0).bytes <= kPerhaps * static_cast<double>(room);
  return fits ? facets : std::nullopt;
}

std::optional<CodedHeights> codeFacets(const CodedHeights& lossy, const FacetShare& facets,
                                       uint64_t room, uint32_t threads) {
  constexpr double kSurely = 0.9;
  for (const double most : {kSurely * static_cast<double>(room), 0.}) {
    const double mean_square = cutOf(lossy, facets, most).mean_square;
    std::optional<CodedHeights> cut = cutAt(lossy, mean_square * lossy.counted());
    if (!cut) continue;
    CodedHeights coded = followedByFacets(*std::move(cut), facets.unit, threads);
    if (bytesOf(coded.tracks) < room) return coded;
  }
  return {};
}

}  // namespace tetrakis::inline ways
