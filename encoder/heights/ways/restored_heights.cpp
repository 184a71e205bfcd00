// SPDX-License-Identifier: Apache-2.0
// codeRestored(), codeFacets() and codeRelative() cut the coefficients of heights and append
// corrections that restore every sample: from coarse steps, from facets, from multiples of a
// relative step.
#include "encoder/heights/ways/ways.hpp"

#include <algorithm>
#include <cassert>
#include <memory>
#include <utility>
#include <vector>

#include "codec/geometry/coding_choice/cuts.hpp"
#include "codec/geometry/facets/facets_encoder.hpp"
#include "codec/geometry/heights_decoder.hpp"
#include "codec/geometry/relative/relative_encoder.hpp"
#include "encoder/heights/coded_heights.hpp"

namespace tetrakis::inline ways {

namespace {

/// The whole steps that a decoder computes from all bytes.
HeightSteps shownSteps(const CodedHeights& heights, uint32_t threads) {
  DecodedHeights decoded = decodeHeights(heights.header, heights.layers,
                                         codewordsOf(heights.tracks), {}, {threads, nullptr});
  HeightSteps shown;
  shown.steps = wholeSteps(std::move(decoded.geometry));
  shown.valid = heights.quantised->steps.valid;
  shown.base = heights.quantised->steps.base;
  shown.step = heights.quantised->steps.step;
  return shown;
}

}  // namespace

bool canBeRestored(const CodedHeights& lossy) {
  const QuantisedHeights& quantised = *lossy.quantised;
  return !quantised.steps.exact && !quantised.restored() && quantised.steps.table.empty() &&
         !lossy.header.direct() && !lossy.hasCorrections() &&
         std::all_of(lossy.tracks.begin(), lossy.tracks.end(),
                     [](const EncodedTrack& track) { return track.complete; });
}

CodedHeights codeRestored(const EncodeInputs& inputs, const CodedHeights& lossy) {
  assert(canBeRestored(lossy));
  const uint32_t threads = inputs.options.threads;
  const HeightSteps shown = shownSteps(lossy, threads);
  const auto quantised = std::make_shared<const QuantisedHeights>(withCorrections(
      *lossy.quantised,
      correctionsBehind(*lossy.quantised, shown, lossy.header.regions.side_log2, threads)));
  GeometryLayers layers = lossy.layers;
  layers.corrections = CorrectionKind::kSamples;
  CodedHeights heights = lossy;
  heights.quantised = quantised;
  return restoredBy(std::move(heights), std::move(layers), quantised->corrections, quantised->left);
}

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

namespace {

/// How far predicted multiples are pulled to the sample, in quarters, in the two trials. The
/// quarter saves 3 to 15 % of the corrections, and takes 5 % more where offsets are floats; a third
/// trial would take the time of one more coding of the corrections.
constexpr uint8_t kWholePull = 4, kQuarterPull = 1;

/// The mean squared error of the cut, in steps.
double squaresOfCut(const HeightSteps& steps, double relative_step) {
  const double rmse = kRelativeCut * relative_step / steps.step;
  return rmse * rmse;
}

/// The corrections behind the coefficients that are left, and the pull that makes them short.
struct RelativeCorrections {
  RelativeSteps relative;
  PartCodewords codewords;
};

RelativeCorrections relativeCorrections(const CodedHeights& cut, double relative_step,
                                        uint32_t threads) {
  const HeightSteps shown = shownSteps(cut, threads);
  const auto pulled = [&](uint8_t quarters) {
    const RelativeSteps relative{relative_step, quarters};
    const PlaneView<const int32_t> steps(shown.steps, cut.header.extent(), shown.valid);
    return RelativeCorrections{relative, encodeParts(cut.header, threads, [&](const Window& part) {
                                 return encodeRelative(*cut.quantised->samples, steps, part,
                                                       cut.header, relative);
                               })};
  };
  RelativeCorrections all = pulled(kWholePull), quarter = pulled(kQuarterPull);
  const bool less = bytesOf(quarter.codewords) < bytesOf(all.codewords);
  return less ? std::move(quarter) : std::move(all);
}

CodedHeights followedByCorrections(CodedHeights cut, double relative_step, uint32_t threads) {
  const RelativeCorrections corrections = relativeCorrections(cut, relative_step, threads);
  GeometryLayers layers = cut.layers;
  layers.corrections = CorrectionKind::kRelative;
  layers.relative = corrections.relative;
  return restoredBy(std::move(cut), std::move(layers), corrections.codewords,
                    QuantisedHeights::kInexact);
}

}  // namespace

double relativeStepOf(const CodedHeights& lossy) {
  const QuantisedHeights& quantised = *lossy.quantised;
  const bool possible = !quantised.restored() && quantised.steps.table.empty() &&
                        !lossy.header.direct() && !lossy.hasCorrections();
  return possible ? relativeStepOf(quantised) : 0;
}

std::optional<CodedHeights> codeRelative(const CodedHeights& lossy, double relative_step,
                                         uint32_t threads) {
  std::optional<CodedHeights> cut =
      cutAt(lossy, squaresOfCut(lossy.quantised->steps, relative_step) * lossy.counted());
  if (!cut) return {};
  return followedByCorrections(*std::move(cut), relative_step, threads);
}

CodedHeights codeRelative(const EncodeInputs& inputs,
                          const std::shared_ptr<const QuantisedHeights>& quantised,
                          double relative_step) {
  CodedHeights cut = codeUpTo(inputs, quantised, squaresOfCut(quantised->steps, relative_step));
  return followedByCorrections(std::move(cut), relative_step, inputs.options.threads);
}

}  // namespace tetrakis::inline ways
