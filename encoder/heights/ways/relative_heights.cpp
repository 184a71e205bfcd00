// SPDX-License-Identifier: Apache-2.0
#include "encoder/heights/ways/relative_heights.hpp"

#include <utility>
#include <vector>

#include "codec/geometry/relative/relative_encoder.hpp"
#include "encoder/heights/followed_heights.hpp"
#include "encoder/heights/ways/cut_heights.hpp"
#include "encoder/heights/ways/restored_heights.hpp"

namespace tetrakis::inline ways {

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
