// SPDX-License-Identifier: Apache-2.0
#include "encoder/heights/ways/facet_heights.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include "codec/geometry/coding_choice/facet_cut.hpp"
#include "codec/geometry/facets/facets_encoder.hpp"
#include "encoder/heights/followed_heights.hpp"
#include "encoder/heights/ways/cut_heights.hpp"
#include "encoder/heights/ways/restored_heights.hpp"

namespace tetrakis::inline ways {

namespace {

/// The share of samples beyond facets up to which facets are tried, and the same beside a table of
/// values. Larger shares take the time of this way where steps or tables mostly predict better.
constexpr double kMostBeyond = 0.75, kMostBesideTable = 0.25;
/// Exact steps that are coarser than this many distances of floats leave no facets to be tried. A
/// larger number takes time where steps predict better.
constexpr double kCoarse = 8;
/// Bytes that a sample beyond facets takes at least. A larger number gives facets up more often
/// within small budgets.
constexpr double kBeyond = 1;
/// The squared error of the next finer cut over that of a cut, the growth of bytes up to which it
/// is taken, and the squared steps at which trials end. More growth and a finer end give prefixes
/// more coefficients, and take bytes and time; steps of a smaller part may pass over the shortest
/// cut.
constexpr double kFiner = 1. / 16, kLittle = 1.05, kFinest = 1. / 16;
/// Fields of more samples than these are cut once. A larger number takes time, and saves bytes of
/// smooth surfaces, for which estimates are too high.
constexpr uint64_t kMostTried = 1 << 20;
/// The share of the room that an estimated cut may take before the shortest cut is tried instead. A
/// larger share leaves finer prefixes, and more trials fail: the estimate is rarely off by more.
constexpr double kSurely = 0.9;

CodedHeights followedByFacets(CodedHeights cut, int unit, uint32_t threads) {
  const HeightSteps shown = shownSteps(cut, threads);
  const PlaneView<const int32_t> steps(shown.steps, cut.header.extent(), shown.valid);
  const PartCodewords codewords = encodeParts(cut.header, threads, [&](const Window& part) {
    return encodeFacets(*cut.quantised->samples, steps, part, cut.header, unit);
  });
  GeometryLayers layers = cut.layers;
  layers.corrections = CorrectionKind::kFacets;
  layers.facet_unit = static_cast<uint8_t>(unit);
  return restoredBy(std::move(cut), std::move(layers), codewords, QuantisedHeights::kInexact);
}

}  // namespace

/// Facets are not sought where steps are far coarser than floats are, or where few values have a
/// table: steps and tables then predict most samples better.
std::optional<FacetShare> facetsOf(const QuantisedHeights& heights) {
  const HeightSteps& steps = heights.steps;
  if (heights.samples->sample != TKS_F32 || heights.samples->step > 0) return {};
  const FacetShare facets = findFacets(*heights.samples, steps.valid);
  const bool table = !steps.table.empty();
  if (steps.exact && !table && steps.step > kCoarse * facets.spacing) return {};
  if (facets.beyond > (table ? kMostBesideTable : kMostBeyond)) return {};
  return facets;
}

bool mayFit(const FacetShare& facets, const QuantisedHeights& heights, uint64_t bytes) {
  return facets.beyond * heights.counted() * kBeyond <= static_cast<double>(bytes);
}

/// The estimate takes smooth surfaces for dearer than they are. So finer cuts are tried while they
/// cost little.
std::optional<CodedHeights> codeFacets(const EncodeInputs& inputs, const FacetShare& facets) {
  const std::shared_ptr<const QuantisedHeights> fine = quantiseForFacets(inputs);
  if (!fine) return {};
  const Extent extent = extentOf(*fine->samples);
  const auto coded = [&](double mean_square) {
    return followedByFacets(codeUpTo(inputs, fine, mean_square), facets.unit,
                            inputs.options.threads);
  };
  double mean_square = chooseFacetCut(fine->steps, extent, facets, 0);
  CodedHeights best = coded(mean_square);
  uint64_t least = bytesOf(best.tracks);
  while (extent.samples() <= kMostTried && (mean_square *= kFiner) > kFinest) {
    CodedHeights next = coded(mean_square);
    const uint64_t bytes = bytesOf(next.tracks);
    if (static_cast<double>(bytes) > kLittle * static_cast<double>(least)) break;
    least = std::min(least, bytes);
    best = std::move(next);
  }
  return best;
}

std::optional<FacetShare> facetsOf(const CodedHeights& lossy, uint64_t room) {
  const QuantisedHeights& quantised = *lossy.quantised;
  if (quantised.restored() || lossy.header.direct() || lossy.hasCorrections()) return {};
  const std::optional<FacetShare> facets = facetsOf(quantised);
  return facets && mayFit(*facets, quantised, room) ? facets : std::nullopt;
}

std::optional<CodedHeights> codeFacets(const CodedHeights& lossy, const FacetShare& facets,
                                       uint64_t room, uint32_t threads) {
  const HeightSteps& steps = lossy.quantised->steps;
  const Extent extent = extentOf(*lossy.quantised->samples);
  for (const double most : {kSurely * static_cast<double>(room), 0.}) {
    const double mean_square = chooseFacetCut(steps, extent, facets, most);
    std::optional<CodedHeights> cut = cutAt(lossy, mean_square * lossy.counted());
    if (!cut) continue;
    CodedHeights coded = followedByFacets(*std::move(cut), facets.unit, threads);
    if (bytesOf(coded.tracks) < room) return coded;
  }
  return {};
}

}  // namespace tetrakis::inline ways
