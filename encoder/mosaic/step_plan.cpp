// SPDX-License-Identifier: Apache-2.0
// chooseSteps() chooses base, step, filters and the cut of a mosaic by nine fields of its source,
// which stand for all of it.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/portable_math.hpp"
#include "base/samples.hpp"
#include "codec/geometry/coding_choice/cuts.hpp"
#include "codec/geometry/heights_encoder.hpp"
#include "codec/geometry/quantiser/height_steps.hpp"
#include "codec/geometry/quantiser/step_choice.hpp"
#include "codec/wavelet/choice/filter_choice.hpp"
#include "codec/wavelet/choice/typical_plane.hpp"
#include "encoder/mosaic/block.hpp"
#include "encoder/mosaic/survey.hpp"
#include "ratecontrol/curves/component_curve.hpp"

namespace tetrakis::inline mosaic {

namespace {

/// The part of the error of a PSNR that the accounts of tracks come down to: they estimate, and
/// nobody decodes the plane. A larger part takes fewer bytes, and misses the PSNR of more heights.
constexpr double kPartOfError = 0.94;
/// Samples along a side of the fields by which ways are compared. Larger ones compare better, and
/// take time.
constexpr uint32_t kTrialSide = 256;
/// log2 of the distances of the largest floats in a step, where floats have no common step and
/// corrections restore the rest: as toSteps() has it. More of them leave more bits to corrections,
/// fewer make coefficients wider.
constexpr int kFloatsPerStepLog2 = 4;
/// The part of the mean squared error of a cut to which each field is coded: rough fields keep
/// more of it than others. A larger part misses slopes of flat fields; a smaller one takes time.
constexpr double kBeyond = 1. / 8;
/// The bytes for which coarse levels get the shortest filters. A larger factor gives more planes
/// windows that read little, and takes bytes.
constexpr double kMostForWindows = 1.01;
/// A largest error is divided into so many steps at least where nothing else gives a step.
constexpr double kStepsOfError = 64;
constexpr double kMostLargest = 1 << 20;  // of steps; correction_step has room for twice as many
constexpr double kSlack = 1e-9;           // a bound of whole steps is rounded by less

/// Nine fields of three rows, side by side, each from the middle of a ninth of the source, as
/// typicalParts() would take them.
struct Fields {
  static constexpr uint32_t kSide = 3;  ///< fields in a row or column

  Extent extent;
  HeightSteps heights;

  PlaneView<const int32_t> view() const { return heights.lifting(extent); }
  double samples() const { return static_cast<double>(heights.validCount()); }
};

Status addField(const MosaicPlan& plan, const ReadSamples& read, const Window& window,
                const Window& to, Fields& fields) {
  std::vector<std::byte> samples(window.extent().samples() *
                                 tks_sample_bytes(static_cast<tks_sample>(plan.geometry().sample)));
  if (Status status = read(window, samples.data()); !status.ok()) return status;
  const tks_heights heights = heightsOf(plan, window, samples.data());
  const Result<std::vector<uint8_t>> valid = findVoids(heights);
  if (!valid.ok()) return valid.status();
  const Result<std::vector<int32_t>> steps = stepsOf(plan, heights, *valid, window);
  if (!steps.ok()) return steps.status();
  const Window all{0, 0, fields.extent.width, fields.extent.height};
  copyShared<int32_t>(to, *steps, all, fields.heights.steps);
  if (!valid->empty()) copyShared<uint8_t>(to, *valid, all, fields.heights.valid);
  return {};
}

/// The fields in the steps of a plan whose wavelet has no fraction bits yet.
Result<Fields> readFields(const MosaicPlan& plan, uint32_t side, const ReadSamples& read) {
  constexpr uint32_t kFields = Fields::kSide;
  const Extent plane = plan.geometry().extent();
  const uint32_t width = std::min(side, std::max(1u, plane.width / kFields)),
                 height = std::min(side, std::max(1u, plane.height / kFields));
  Fields fields{{kFields * width, kFields * height}, {}};
  fields.heights.steps.resize(fields.extent.samples());
  fields.heights.valid.assign(fields.extent.samples(), 1);
  fields.heights.range_bits = plan.geometry().wavelet.bits;
  for (uint32_t row = 0; row < kFields; ++row) {
    for (uint32_t column = 0; column < kFields; ++column) {
      const auto middle = [](uint32_t at, uint32_t along, uint32_t part) {
        return static_cast<uint32_t>(uint64_t{along} * (2 * at + 1) / (2 * kFields)) - part / 2;
      };
      const Window window{middle(column, plane.width, width), middle(row, plane.height, height),
                          width, height};
      const Window to{column * width, row * height, width, height};
      if (Status status = addField(plan, read, window, to, fields); !status.ok()) return status;
    }
  }
  std::vector<uint8_t>& valid = fields.heights.valid;
  if (std::all_of(valid.begin(), valid.end(), [](uint8_t mark) { return mark != 0; }))
    valid.clear();
  return fields;
}

void setStep(const Survey& survey, double step, MosaicPlan& plan) {
  GeometryHeader& header = *plan.header.geometry;
  header.step = step;
  header.base = survey.low() + step * std::floor(survey.range() / 2 / step);
  if (survey.floats() && survey.range() > 0) header.base = step * std::round(header.base / step);
  const int bits = std::bit_width(static_cast<uint32_t>(survey.range() / step) + 1u);
  header.wavelet = {};
  header.wavelet.bits = static_cast<uint8_t>(bits);  // stepsOf() looks at it
}

/// Bit-planes that no coefficient passes: those of the samples, of three doublings, of the sums of
/// a filter, and of means that two of the filters multiply by 1.7 or less at every level.
uint8_t planesFor(const WaveletHeader& wavelet, int levels) {
  constexpr int kDoublings = 3, kSums = 2;
  const auto grows = [](uint8_t id) {
    return static_cast<FilterId>(id) == FilterId::kQuiet ||
           static_cast<FilterId>(id) == FilterId::kOrthogonal;
  };
  const bool growing = std::any_of(wavelet.filters.begin(), wavelet.filters.end(), grows);
  const int planes = wavelet.bits + kDoublings + kSums + (growing ? levels : 0);
  return static_cast<uint8_t>(std::min(planes, kMostPlanes));
}

void setWavelet(const WaveletHeader& wavelet, MosaicPlan& plan) {
  GeometryHeader& header = *plan.header.geometry;
  header.wavelet = wavelet;
  header.planes = planesFor(wavelet, coarsestLevel(header.extent()));
}

/// A track of coefficients of each field, which is a plane of its own: fields do not go on in one
/// another. mean_square: the error at which coding may end.
std::vector<EncodedTrack> codeFields(const Fields& fields, const WaveletHeader& wavelet,
                                     double mean_square) {
  const uint32_t width = fields.extent.width / Fields::kSide,
                 height = fields.extent.height / Fields::kSide;
  std::vector<EncodedTrack> tracks;
  for (uint32_t i = 0; i < Fields::kSide * Fields::kSide; ++i) {
    const View field{0,
                     Window{i % Fields::kSide * width, i / Fields::kSide * height, width, height}};
    const auto values = slice(std::span<const int32_t>(fields.heights.steps), fields.extent, field);
    const auto valid = slice(std::span<const uint8_t>(fields.heights.valid), fields.extent, field);
    CoefficientOptions options;
    if (mean_square > 0) options.enough = kBeyond * mean_square * width * height;
    tracks.push_back(
        std::move(encodeCoefficients({values, {width, height}, valid}, wavelet, options).front()));
  }
  return tracks;
}

/// Windows of large planes are what most readers want: they need the regions that filters reach, so
/// that the shortest filters serve coarse levels wherever they take few more bytes.
WaveletHeader forWindows(const Fields& fields, const WaveletHeader& wavelet, double mean_square) {
  const WaveletHeader short_reach = withShortReach(wavelet);
  const auto bytes = [&](const WaveletHeader& tried) {
    return static_cast<double>(bytesOf(codeFields(fields, tried, mean_square)));
  };
  return bytes(short_reach) < kMostForWindows * bytes(wavelet) ? short_reach : wavelet;
}

/// Filters for every step.
void setExactWavelet(const Fields& fields, MosaicPlan& plan) {
  const WaveletHeader wavelet =
      chooseWavelet(fields.view(), fields.heights.range_bits, Purpose::kLossless);
  setWavelet(forWindows(fields, wavelet, 0), plan);
}

/// The squared steps that a byte takes off where the coefficients of all fields together leave an
/// error: the marginal allocation among their tracks. Where the fields say nothing it is that of
/// noise: an error D falls by D log 4 a bit.
double slopeAt(const Fields& fields, const WaveletHeader& wavelet, double mean_square) {
  struct Edge {
    double slope, removed;
  };
  std::vector<Edge> edges;
  double left = 0;
  for (const EncodedTrack& track : codeFields(fields, wavelet, mean_square)) {
    const std::vector<RatePoint> hull = lowerHull(track.points, 0);
    left += hull.front().distortion;
    for (size_t i = 1; i < hull.size(); ++i) {
      const double removed = hull[i - 1].distortion - hull[i].distortion;
      edges.push_back({removed / static_cast<double>(hull[i].bytes - hull[i - 1].bytes), removed});
    }
  }
  std::sort(edges.begin(), edges.end(),
            [](const Edge& a, const Edge& b) { return a.slope > b.slope; });
  const double squares = mean_square * fields.samples();
  for (const Edge& edge : edges) {
    left -= edge.removed;
    if (left <= squares) return edge.slope;
  }
  return 16 * std::numbers::ln2 * mean_square;
}

/// Plans a cut that leaves an error, with corrections behind it that leave a largest one.
void setCut(const Fields& fields, double mean_square, int32_t largest, MosaicPlan& plan) {
  const WaveletHeader chosen = chooseWavelet(fields.view(), fields.heights.range_bits,
                                             Purpose::kLossy, {.mean_square = mean_square});
  const WaveletHeader wavelet = forWindows(fields, chosen, mean_square);
  setWavelet(wavelet, plan);
  plan.cut_slope = slopeAt(fields, wavelet, mean_square);
  plan.header.layers.corrections = CorrectionKind::kSteps;
  plan.header.layers.correction_step = static_cast<uint32_t>(2 * largest + 1);
}

bool hasRegions(const MosaicPlan& plan) {
  return plan.geometry().regions.side_log2 > 0;
}

/// Plans that every step comes back: by all coefficients, or by corrections behind a cut where that
/// takes fewer bytes.
Status keepSteps(double step, const Survey& survey, const ReadSamples& read, MosaicPlan& plan) {
  setStep(survey, step, plan);
  const Result<Fields> fields = readFields(plan, hasRegions(plan) ? kTrialSide : kUsualSide, read);
  if (!fields.ok()) return fields.status();
  setExactWavelet(*fields, plan);
  if (!hasRegions(plan)) return {};
  const uint64_t whole = bytesOf(codeFields(*fields, plan.geometry().wavelet, 0));
  const std::optional<ExactCut> cut =
      chooseExactCut(fields->view(), fields->heights.range_bits, whole);
  if (cut) setCut(*fields, cut->mean_square, 0, plan);
  return {};
}

/// The step of floats that have no common one.
double coarseStep(const Survey& survey) {
  const double largest = std::max(std::abs(survey.low()), std::abs(survey.high()));
  return std::ldexp(1.0, spacingExponent(static_cast<float>(largest)) + kFloatsPerStepLog2);
}

/// Plans that samples come back which no steps restore: all coefficients of steps near them, and
/// corrections of the samples. A cut at 1, 64 and 4096 squared steps takes 3 to 60 % more bytes.
Status keepSamples(double step, const Survey& survey, const ReadSamples& read, MosaicPlan& plan) {
  setStep(survey, step, plan);
  plan.header.layers.corrections = CorrectionKind::kSamples;
  const Result<Fields> fields = readFields(plan, kUsualSide, read);
  if (!fields.ok()) return fields.status();
  setExactWavelet(*fields, plan);
  return {};
}

/// The rounding of the largest floats; 0 of integers.
double roundingOf(const Survey& survey) {
  if (!survey.floats()) return 0;
  const double largest = std::max(std::abs(survey.low()), std::abs(survey.high()));
  return std::ldexp(1.0, std::ilogb(std::max(largest, 1e-30)) - 22);
}

/// By how much decoders move a height that would be the nodata value; 0: none can be.
double besideNodata(const Survey& survey, const MosaicPlan& plan, double error) {
  const double nodata = plan.header.layers.nodata;
  const bool is_near = nodata >= survey.low() - error && nodata <= survey.high() + error;
  if (!plan.header.layers.has_nodata || !is_near) return 0;
  return survey.floats() ? roundingOf(survey) : 1;
}

/// The step of corrected heights: the exact one, or one that a largest error has many of.
double fineStep(const Survey& survey, double error) {
  if (const double exact = survey.exactStep(); exact > 0) return exact;
  const double of_range = portable::exp2(std::ceil(portable::log2(survey.range() / kLossySteps)));
  const double of_error = portable::exp2(std::floor(portable::log2(error / kStepsOfError)));
  const double least = portable::exp2(std::ceil(portable::log2(survey.range() / kMostSteps)) + 1);
  return std::max(std::min(of_range, of_error), least);
}

/// A step on the grid of an exact step, or beside it, that keeps a largest error when heights are
/// rounded to it; 0: there is none.
double roundedStep(const Survey& survey, double error) {
  const double exact = survey.exactStep();
  if (exact > 0) return exact * (2 * std::floor(error / exact + kSlack) + 1);
  const double step = 2 * (error - roundingOf(survey));
  return step > 0 && survey.range() / step < kMostSteps ? step : 0;
}

/// The largest error that corrections may leave, in steps of fineStep(); 0: nobody corrects.
double roomFor(double error, double fine, const Survey& survey, const MosaicPlan& plan) {
  if (!hasRegions(plan)) return 0;
  const double own = survey.exactStep() > 0 ? 0 : fine / 2 + roundingOf(survey);
  return std::min(std::floor((error - own) / fine + kSlack), kMostLargest);
}

/// Plans a largest error, in sample units: heights are rounded and then kept, or cut and corrected.
Status keepWithin(double error, const Survey& survey, const ReadSamples& read, MosaicPlan& plan) {
  const double rounded = roundedStep(survey, error);
  const double fine = survey.range() > 0 && error > 0 ? fineStep(survey, error) : 1;
  const double room = roomFor(error, fine, survey, plan);
  if (survey.range() > error && room >= 1) {
    const auto largest = static_cast<int32_t>(room);
    setStep(survey, fine, plan);
    const Result<Fields> fields = readFields(plan, kTrialSide, read);
    if (!fields.ok()) return fields.status();
    const WaveletHeader wavelet =
        chooseWavelet(fields->view(), fields->heights.range_bits, Purpose::kLossy);
    const BoundWays ways = boundWaysByParts(fields->heights, fields->extent, wavelet, largest);
    if (ways.correct || rounded == 0) {
      setCut(*fields, ways.mean_square.value_or(usualCut(largest)), largest, plan);
      return {};
    }
  }
  if (rounded > 0) return keepSteps(rounded, survey, read, plan);
  // Whatever the error, exact samples are within it.
  if (hasRegions(plan)) return keepSamples(coarseStep(survey), survey, read, plan);
  return {TKS_USAGE,
          "That largest error is smaller than a mosaic of one region of these floats can promise: "
          "give a larger one."};
}

/// The step of heights that a target of bytes or of a PSNR cuts.
double lossyStep(const MosaicOptions& options, const Survey& survey) {
  if (options.step > 0) return options.step;
  const double exact = survey.exactStep();
  if (exact > 0 && survey.range() / exact <= kLossySteps) return exact;
  return portable::exp2(std::ceil(portable::log2(survey.range() / kLossySteps)));
}

/// Plans coefficients that a target of bytes or of a PSNR cuts.
Status keepMost(const MosaicOptions& options, const Survey& survey, const ReadSamples& read,
                MosaicPlan& plan) {
  const double step = lossyStep(options, survey);
  setStep(survey, step, plan);
  const Result<Fields> fields = readFields(plan, kUsualSide, read);
  if (!fields.ok()) return fields.status();
  setWavelet(chooseWavelet(fields->view(), fields->heights.range_bits, Purpose::kLossy), plan);
  if (options.bytes > 0) plan.target.bytes = options.bytes;
  if (options.psnr > 0) {
    const double rmse = survey.range() * portable::exp2(-options.psnr / 20 * portable::log2(10.));
    plan.target.mean_square = kPartOfError * rmse * rmse / (step * step);
  }
  return {};
}

}  // namespace

Status chooseSteps(const Survey& survey, const MosaicOptions& options, const ReadSamples& read,
                   MosaicPlan& plan) {
  if (options.step > 0 && survey.range() / options.step >= kMostSteps) {
    return {TKS_USAGE,
            "That step divides the range of the heights into more than 2^26 parts; give a larger "
            "one."};
  }
  if (options.bytes > 0 || options.psnr > 0) return keepMost(options, survey, read, plan);
  if (options.step > 0) return keepSteps(options.step, survey, read, plan);
  if (options.max_error > 0) {
    const double error = options.max_error / std::abs(plan.header.metadata.scale);
    const double left = std::max(error - besideNodata(survey, plan, error), 0.);
    return keepWithin(left, survey, read, plan);
  }
  const double exact = survey.exactStep();
  if (exact > 0 && !survey.negativeZeros()) return keepSteps(exact, survey, read, plan);
  if (hasRegions(plan))
    return keepSamples(exact > 0 ? exact : coarseStep(survey), survey, read, plan);
  return {TKS_USAGE,
          "The samples have no common step that divides their range into 2^26 parts or fewer, or "
          "negative zeros: a mosaic of one region cannot restore every bit of them; give a largest "
          "error."};
}

}  // namespace tetrakis::inline mosaic
