// SPDX-License-Identifier: Apache-2.0
// codeCorrected() cuts coefficients where an error is reached and appends corrections of the
// samples that are still off; cutAt() and codeUpTo() make the cut alone.
#include "encoder/heights/ways/ways.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <span>
#include <utility>

#include "bitstream/stream/geometry_header.hpp"
#include "codec/geometry/coding_choice/cuts.hpp"
#include "codec/geometry/heights_decoder.hpp"
#include "codec/wavelet/choice/typical_plane.hpp"
#include "encoder/heights/coded_heights.hpp"
#include "encoder/heights/quantised_heights.hpp"
#include "ratecontrol/curves/component_curve.hpp"

namespace tetrakis::inline ways {

namespace {

/// The first bytes of a track: up to a point of its account.
EncodedTrack firstOf(const EncodedTrack& whole, uint64_t bytes) {
  EncodedTrack first = whole;
  first.codeword.resize(bytes);
  std::erase_if(first.points, [&](const RatePoint& point) { return point.bytes > bytes; });
  first.complete = whole.complete && bytes == whole.codeword.size();
  return first;
}

/// The fewest bytes of the first track that a cut keeps: the opening, and a late mask with the
/// coefficients before it.
uint64_t leastCut(const GeometryLayers& layers) {
  return std::max(layers.openingBytes(), layers.maskEnd());
}

}  // namespace

std::optional<CodedHeights> cutAt(const CodedHeights& whole, double squares) {
  const auto is_near = [&](const RatePoint& point) { return point.distortion <= squares; };
  CodedHeights cut = whole;
  if (whole.tracks.size() == 1) {  // its packets are longer than its passes
    const EncodedTrack& track = whole.tracks.front();
    const auto end = std::find_if(track.points.begin(), track.points.end(), is_near);
    if (end == track.points.end() || end->bytes < leastCut(whole.layers)) return {};
    cut.tracks.front() = firstOf(track, end->bytes);
    return cut;
  }
  const OrderedTracks order = orderTracks(whole.accounted(), TrackOrder::kSlopes);
  const auto end = std::find_if(order.points.begin(), order.points.end(), is_near);
  if (end == order.points.end()) return {};
  const Codewords kept = prefixAfter(whole.accounted(), order.packets, end->bytes);
  if (kept.front().size() < leastCut(whole.layers)) return {};
  for (size_t i = 0; i < kept.size(); ++i) cut.tracks[i] = firstOf(whole.tracks[i], kept[i].size());
  return cut;
}

/// Coding ends with a whole bit-plane of all tracks; the cut lies before its end.
CodedHeights codeUpTo(const EncodeInputs& inputs, std::shared_ptr<const QuantisedHeights> quantised,
                      double mean_square) {
  HeightTarget target(Purpose::kLossy);
  target.mean_square = mean_square;
  CoefficientOptions options = heightOptions(inputs);
  options.enough = mean_square * quantised->counted();
  CodedHeights coded = codeHeights(std::move(quantised), target, options);
  std::optional<CodedHeights> cut = cutAt(coded, options.enough);
  return cut ? *std::move(cut) : std::move(coded);
}

namespace {

/// A cut lies near the end of the coefficients if this many times its bytes reach beyond it: then
/// coding goes on. A larger factor has more heights coded twice; a smaller one misses later cuts.
constexpr double kNearEnd = 1.5;
/// Coding ends at this part of the squared error that cuts usually leave. Coding to a 32nd takes
/// two thirds of the time of coding to the end, with the same bytes; a smaller part takes longer.
constexpr double kEndOfCut = 1. / 32;
/// Samples of a window of regions that are corrected together, at least. A larger window takes more
/// memory; smaller ones decode the coefficients around them more often.
constexpr uint64_t kWindowSamples = 1 << 20;
/// A coarser cut is taken beside a budget if it is estimated at this share of the bytes or less. A
/// larger share saves bytes at the end of more streams, and their prefixes lose quality.
constexpr double kFarShorter = 0.8;

/// The first bytes of a track of coefficients.
EncodedTrack cutAt(const EncodedTrack& whole, uint64_t bytes) {
  assert(bytes <= whole.codeword.size());
  EncodedTrack cut = whole;
  cut.codeword.resize(bytes);
  std::erase_if(cut.points, [&](const RatePoint& p) { return p.bytes > 0 && p.bytes >= bytes; });
  cut.complete = false;
  if (bytes > 0) cut.points.push_back({bytes, distortionAt(whole.points, bytes)});
  return cut;
}

/// The purpose of coefficients that are cut before corrections: the error that cuts usually leave.
HeightPurpose cutPurpose(const Correctable& heights) {
  return {heights.quantised->steps.range_bits,
          heights.purpose,
          UINT64_MAX,
          usualCut(heights.largest),
          heights.options.threads,
          false,
          heights.quantised->forest};
}

/// One track of complete coefficients, and the layers around it.
struct UncutHeights {
  HeightLayers layers;
  EncodedTrack track;
  bool may_go_on;  ///< coding was to end at a small error, and did
};

/// Codes the heights in one track. enough: the mean squared error, in steps, at which coding ends;
/// 0: coding goes to the end.
UncutHeights codeUncut(const Correctable& heights, FlatChoice choice, double enough) {
  const QuantisedHeights& quantised = *heights.quantised;
  HeightLayers layers = layersAround(quantised, std::move(choice), heights.options.priorities);
  CoefficientOptions options = layers.flat.beside(heights.options);
  if (enough > 0) options.enough = enough * quantised.counted();
  EncodedTrack track = std::move(codeCoefficients(quantised, layers.wavelet, options).front());
  layers.wavelet.rounded_bytes = exactBytes(std::span(&track, 1));
  const bool may_go_on = enough > 0 && !track.complete;
  return {std::move(layers), std::move(track), may_go_on};
}

/// Appends corrections for a largest error to the heights, or returns the heights if no sample is
/// off. The error that corrections leave is stated in the account's own measure, which the audit
/// corrects later.
CodedHeights followedBy(CodedHeights cut, const Corrected& corrected, int32_t largest) {
  if (!corrected.any) return cut;
  const double of_steps = cut.quantised->left;
  double of_cut = -of_steps;
  for (const EncodedTrack& track : cut.tracks) of_cut += track.points.back().distortion;
  GeometryLayers layers = cut.layers;
  layers.corrections = CorrectionKind::kSteps;
  layers.correction_step = static_cast<uint32_t>(2 * largest + 1);
  return heights::followedBy(std::move(cut), std::move(layers), corrected.codewords,
                             of_steps + of_cut * corrected.after / corrected.before);
}

/// The heights with the best cut of the coefficients; nothing if the best cut lies near their end
/// while coding could go on.
std::optional<CodedHeights> codeCut(const Correctable& heights, const UncutHeights& uncut,
                                    const CutTarget& target) {
  const auto& [layers, track, may_go_on] = uncut;
  const QuantisedHeights& quantised = *heights.quantised;
  const GeometryHeader header = headerOf(quantised, layers, track.planes);
  CorrectedCut cut(quantised.steps, layers.flat.areas, header, track, heights.largest);
  const uint64_t bytes =
      target.mean_square ? cut.bytesFor(*target.mean_square) : cut.best(target.rival);
  const bool near =
      kNearEnd * static_cast<double>(bytes) > static_cast<double>(track.codeword.size());
  if (near && may_go_on) return {};
  CodedHeights coded =
      joinLayers(heights.quantised, layers, {cutAt(track, bytes)}, heights.options.region_log2);
  return followedBy(std::move(coded), cut.correct(bytes), heights.largest);
}

/// Codes the heights beside flat areas. Coding ends at a small part of the error that cuts usually
/// leave, unless the best cut lies near that end.
CodedHeights codeBeside(const FlatChoice& choice, const Correctable& heights,
                        const CutTarget& target) {
  assert(heights.quantised->corrections.empty());
  const double left = target.mean_square.value_or(usualCut(heights.largest));
  if (std::optional<CodedHeights> coded =
          codeCut(heights, codeUncut(heights, choice, left * kEndOfCut), target))
    return *std::move(coded);
  return *codeCut(heights, codeUncut(heights, choice, 0), target);
}

/// The parts grouped into windows of whole rows of regions, with kWindowSamples or more each:
/// the memory of decoding follows the window.
std::vector<std::vector<Window>> windowsOf(const std::vector<Window>& parts) {
  std::vector<std::vector<Window>> windows;
  uint64_t samples = kWindowSamples;
  for (const Window& part : parts) {
    const bool new_row = windows.empty() || part.y != windows.back().back().y;
    if (new_row && samples >= kWindowSamples) {
      windows.emplace_back();
      samples = 0;
    }
    windows.back().push_back(part);
    samples += part.extent().samples();
  }
  return windows;
}

Window around(const std::vector<Window>& parts) {
  const Window &first = parts.front(), &last = parts.back();
  return {first.x, first.y, last.x + last.width - first.x, last.y + last.height - first.y};
}

/// Appends corrections to heights in regions.
CodedHeights withCorrections(CodedHeights cut, int32_t largest, uint32_t threads) {
  const Codewords codewords = codewordsOf(cut.tracks);
  Corrected all;
  for (const std::vector<Window>& parts : windowsOf(correctionParts(cut.header))) {
    const View view = {0, around(parts)};
    const DecodedHeights decoded =
        decodeHeights(cut.header, cut.layers, codewords, view, {threads, nullptr});
    all.append(correct(cut.quantised->steps, cut.header.width,
                       {decoded.geometry, *view.window, parts}, largest, threads));
  }
  return followedBy(std::move(cut), all, largest);
}

/// Codes the heights in regions. It searches for no cut, but leaves the error that cuts usually
/// leave.
CodedHeights codeInRegions(const Correctable& heights, const CutTarget& target) {
  const QuantisedHeights& quantised = *heights.quantised;
  HeightTarget lossy(heights.purpose);
  lossy.mean_square = target.mean_square.value_or(usualCut(heights.largest));
  CoefficientOptions options = heights.options;
  options.enough = lossy.mean_square * quantised.counted();
  CodedHeights coded = codeHeights(heights.quantised, lossy, options);
  std::optional<CodedHeights> cut = cutAt(coded, options.enough);
  return withCorrections(cut ? *std::move(cut) : std::move(coded), heights.largest,
                         options.threads);
}

}  // namespace

CodedHeights codeCorrected(const Correctable& heights, const CutTarget& target) {
  if (heights.options.region_log2 > 0) return codeInRegions(heights, target);
  const HeightSteps& steps = heights.quantised->steps;
  const PlaneView<const int32_t> plane = steps.lifting(extentOf(*heights.quantised->samples));
  return codeBeside(chooseFlatAreas(plane, heights.quantised->mayBeFlat(), cutPurpose(heights)),
                    heights, target);
}

std::optional<CodedHeights> codeCorrected(const EncodeInputs& inputs, const CodedHeights& lossy,
                                          double rmse) {
  assert(lossy.quantised->steps.exact && lossy.quantised->table.empty());
  if (lossy.tracks.size() == 1) {
    const Correctable heights{lossy.quantised, Purpose::kLossy, heightOptions(inputs)};
    return codeBeside({lossy.flat, lossy.header.wavelet}, heights, {rmse * rmse});
  }
  std::optional<CodedHeights> cut = cutAt(lossy, rmse * rmse * lossy.counted());
  if (!cut) return {};
  return withCorrections(*std::move(cut), 0, inputs.options.threads);
}

std::optional<double> farShorterCut(const CodedHeights& lossy, uint64_t bytes) {
  const HeightSteps& steps = lossy.quantised->steps;
  const PlaneView<const int32_t> plane = steps.lifting(extentOf(*lossy.quantised->samples));
  const auto whole = static_cast<uint64_t>(typicalCost(plane, steps.range_bits, 0).bits / 8);
  const std::optional<ExactCut> cut = chooseExactCut(plane, steps.range_bits, whole);
  if (!cut || cut->bytes > kFarShorter * static_cast<double>(bytes)) return {};
  return std::sqrt(cut->mean_square);
}

}  // namespace tetrakis::inline ways
