// SPDX-License-Identifier: Apache-2.0
#include "encoder/mosaic/survey.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <string>
#include <type_traits>
#include <vector>

#include "base/portable_math.hpp"
#include "base/samples.hpp"
#include "codec/geometry/quantiser/height_steps.hpp"
#include "codec/wavelet/choice/filter_choice.hpp"
#include "codec/wavelet/choice/typical_plane.hpp"
#include "encoder/mosaic/block.hpp"
#include "encoder/selection/write_stream.hpp"

namespace tetrakis::inline mosaic {

namespace {

/// The part of the error of a PSNR that the accounts of tracks come down to: they estimate, and
/// nobody decodes the plane. A larger part takes fewer bytes, and misses the PSNR of more heights.
constexpr double kPartOfError = 0.94;
/// More are in no stream that programs open.
constexpr uint64_t kMostSamples = uint64_t{1} << 32;
/// Sides of the windows that a survey reads. Larger ones take memory.
constexpr uint32_t kWindowSide = 2048;

}  // namespace

Status Survey::add(const tks_heights& heights) {
  const Result<std::vector<uint8_t>> valid = findVoids(heights);
  if (!valid.ok()) return valid.status();
  voids_ = voids_ || !valid->empty();
  withSampleType(heights.sample, [&](auto type) {
    const auto* samples = static_cast<const decltype(type)*>(heights.data);
    addValid(samples, size_t{heights.width} * heights.height, *valid);
  });
  return {};
}

template <class T>
void Survey::addValid(const T* samples, size_t count, Mask valid) {
  floats_ = std::is_floating_point_v<T>;
  for (size_t i = 0; i < count; ++i) {
    if (!valid[i]) continue;
    const auto value = static_cast<double>(samples[i]);
    if (!any_) low_ = high_ = first_ = value;
    any_ = true;
    low_ = std::min(low_, value);
    high_ = std::max(high_, value);
    if constexpr (std::is_floating_point_v<T>) {
      addFloat(samples[i]);
    } else if (divisor_ != 1) {
      divisor_ = std::gcd(divisor_, static_cast<uint64_t>(std::abs(value - first_)));
    }
  }
}

void Survey::addFloat(float sample) {
  if (sample == 0) return;
  for (size_t i = 0; i < kDecimalSteps.size(); ++i) {
    if (decimals_[i] == kNone) continue;
    constexpr double kExact = 0x1p53;
    const double step = kDecimalSteps[i], count = std::round(static_cast<double>(sample) / step);
    const bool is_multiple = static_cast<float>(count * step) == sample && std::abs(count) < kExact;
    decimals_[i] =
        is_multiple ? std::gcd(decimals_[i], static_cast<uint64_t>(std::abs(count))) : kNone;
  }
  int exponent = 0;
  const double fraction = std::frexp(static_cast<double>(sample), &exponent);
  const auto mantissa = static_cast<uint32_t>(std::ldexp(std::abs(fraction), 24));
  lowest_bit_ = std::min(lowest_bit_, exponent - 24 + std::countr_zero(mantissa));
}

double Survey::exactStep() const {
  const auto fits = [&](double step) { return range() / step < kMostSteps; };
  if (range() == 0) return 1;
  if (!floats_) return fits(static_cast<double>(divisor_)) ? static_cast<double>(divisor_) : 0;
  for (size_t i = 0; i < kDecimalSteps.size(); ++i) {
    const double step = kDecimalSteps[i] * static_cast<double>(decimals_[i]);
    if (decimals_[i] != kNone && fits(step)) return step;
  }
  const double binary = std::ldexp(1.0, lowest_bit_);
  return fits(binary) ? binary : 0;
}

namespace {

Result<Survey> surveyOf(const MosaicPlan& plan, const ReadSamples& read) {
  Survey survey;
  const Extent plane = plan.geometry().extent();
  const size_t sample_bytes = tks_sample_bytes(static_cast<tks_sample>(plan.geometry().sample));
  std::vector<std::byte> samples;
  for (uint32_t y = 0; y < plane.height; y += kWindowSide) {
    for (uint32_t x = 0; x < plane.width; x += kWindowSide) {
      const Window window{x, y, std::min(kWindowSide, plane.width - x),
                          std::min(kWindowSide, plane.height - y)};
      samples.resize(window.extent().samples() * sample_bytes);
      if (Status status = read(window, samples.data()); !status.ok()) return status;
      if (Status status = survey.add(heightsOf(plan, window, samples.data())); !status.ok())
        return status;
    }
  }
  return survey;
}

/// A step on the grid of an exact step, or beside it, that keeps a largest error.
Result<double> boundedStep(const Survey& survey, double exact, double error) {
  if (exact > 0) return exact * (2 * std::floor(error / exact) + 1);
  const double largest = std::max(std::abs(survey.low()), std::abs(survey.high()));
  const double rounding = std::ldexp(1.0, std::ilogb(std::max(largest, 1e-30)) - 22);
  const double step = 2 * (error - rounding);
  if (step > 0 && survey.range() / step < kMostSteps) return step;
  return Status(TKS_USAGE,
                "That largest error is smaller than a mosaic of these floats can "
                "promise: give a larger one.");
}

Result<double> stepFor(const Survey& survey, const MosaicOptions& options, double scale) {
  if (options.step > 0) {
    if (survey.range() / options.step < kMostSteps) return options.step;
    return Status(TKS_USAGE,
                  "That step divides the range of the heights into more than 2^26 "
                  "parts; give a larger one.");
  }
  const double exact = survey.exactStep();
  if (options.max_error > 0) return boundedStep(survey, exact, options.max_error / scale);
  if (exact > 0 && (options.lossless || survey.range() / exact <= kLossySteps)) return exact;
  if (options.lossless) {
    return Status(TKS_USAGE,
                  "The samples have no common step that divides their range into 2^26 "
                  "parts or fewer: a mosaic cannot restore every bit of them; give a "
                  "largest error.");
  }
  return portable::exp2(std::ceil(portable::log2(survey.range() / kLossySteps)));
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

/// The parts of the source by which filters are chosen, side by side: nine fields of three rows,
/// each from the middle of a ninth of the source, as typicalParts() would take them.
Result<WaveletHeader> waveletFor(const MosaicPlan& plan, int bits, Purpose purpose,
                                 const ReadSamples& read) {
  constexpr uint32_t kFields = 3;
  const Extent plane = plan.geometry().extent();
  const uint32_t width = std::min(kUsualSide, std::max(1u, plane.width / kFields)),
                 height = std::min(kUsualSide, std::max(1u, plane.height / kFields));
  const Extent whole{kFields * width, kFields * height};
  std::vector<int32_t> values(whole.samples());
  std::vector<uint8_t> marks(whole.samples(), 1);
  std::vector<std::byte> samples(size_t{width} * height *
                                 tks_sample_bytes(static_cast<tks_sample>(plan.geometry().sample)));
  for (uint32_t field = 0; field < kFields * kFields; ++field) {
    const uint32_t column = field % kFields, row = field / kFields;
    const auto middle = [](uint32_t at, uint32_t side, uint32_t part) {
      return static_cast<uint32_t>(uint64_t{side} * (2 * at + 1) / (2 * kFields)) - part / 2;
    };
    const Window window{middle(column, plane.width, width), middle(row, plane.height, height),
                        width, height};
    if (Status status = read(window, samples.data()); !status.ok()) return status;
    const tks_heights heights = heightsOf(plan, window, samples.data());
    const Result<std::vector<uint8_t>> valid = findVoids(heights);
    if (!valid.ok()) return valid.status();
    const Result<std::vector<int32_t>> steps = stepsOf(plan, heights, *valid, window);
    if (!steps.ok()) return steps.status();
    for (uint32_t y = 0; y < height; ++y) {
      const size_t from = size_t{y} * width;
      const size_t to = (size_t{row} * height + y) * whole.width + size_t{column} * width;
      std::copy_n(steps->begin() + static_cast<ptrdiff_t>(from), width,
                  values.begin() + static_cast<ptrdiff_t>(to));
      for (uint32_t x = 0; x < width; ++x) marks[to + x] = Mask(*valid)[from + x];
    }
  }
  const bool all = std::all_of(marks.begin(), marks.end(), [](uint8_t mark) { return mark != 0; });
  const Mask valid = all ? Mask() : Mask(marks);
  return chooseWavelet(PlaneView<const int32_t>(values, whole, valid), bits, purpose);
}

/// Base, step and filters, and what they promise.
Status settle(const Survey& survey, const MosaicOptions& options, const ReadSamples& read,
              MosaicPlan& plan) {
  GeometryHeader& header = *plan.header.geometry;
  const double scale = std::abs(plan.header.metadata.scale);
  const Result<double> step = stepFor(survey, options, scale);
  if (!step.ok()) return step.status();
  header.step = *step;
  header.base = survey.low() + *step * std::floor(survey.range() / 2 / *step);
  if (survey.floats() && survey.range() > 0) header.base = *step * std::round(header.base / *step);
  const int bits = std::bit_width(static_cast<uint32_t>(survey.range() / *step) + 1u);
  const bool every_step = options.lossless || options.max_error > 0;
  header.wavelet.bits = static_cast<uint8_t>(bits);  // stepsOf() looks at it
  Result<WaveletHeader> wavelet =
      waveletFor(plan, bits, every_step ? Purpose::kLossless : Purpose::kLossy, read);
  if (!wavelet.ok()) return wavelet.status();
  // Windows of large planes are what most readers want: they need the regions that filters reach.
  header.wavelet = every_step ? withShortReach(*wavelet) : *wavelet;
  header.planes = planesFor(header.wavelet, coarsestLevel(header.extent()));
  if (options.bytes > 0) plan.target.bytes = options.bytes;
  if (options.psnr > 0) {
    const double rmse = survey.range() * portable::exp2(-options.psnr / 20 * portable::log2(10.));
    plan.target.mean_square = kPartOfError * rmse * rmse / (*step * *step);
  }
  return {};
}

Status checkOptions(const MosaicOptions& options) {
  const int targets = (options.bytes > 0) + (options.psnr > 0) + (options.max_error > 0) +
                      (options.lossless ? 1 : 0);
  if (targets != 1)
    return {TKS_USAGE, "Give one target: bytes, PSNR, a largest error, or lossless."};
  if (options.region_log2 < kLeastRegionLog2 || options.tile_log2 < options.region_log2 ||
      options.tile_log2 > kUsualTileLog2 + 2) {
    return {TKS_USAGE,
            "Regions have sides of 16 samples or more, and tiles of as many as a region "
            "or more, up to 16384, all powers of two."};
  }
  return {};
}

}  // namespace

Result<MosaicPlan> makePlan(const tks_heights& source, const MosaicOptions& options,
                            const ReadSamples& read) {
  if (Status status = checkOptions(options); !status.ok()) return status;
  if (uint64_t{source.width} * source.height > kMostSamples)
    return Status(TKS_USAGE, "A mosaic has at most 2^32 samples.");
  MosaicPlan plan;
  plan.tile_log2 = options.tile_log2;
  plan.target.bounded = options.max_error > 0;
  plan.header.lossless = options.lossless;
  describePlace(&source, nullptr, plan.header);
  GeometryHeader& header = plan.header.geometry.emplace();
  header.width = source.width;
  header.height = source.height;
  header.sample = static_cast<uint8_t>(source.sample);
  const bool one = regionCount(source.width, source.height, options.region_log2) <= 1;
  header.regions.side_log2 = static_cast<uint8_t>(one ? 0 : options.region_log2);
  if (options.max_error > 0) header.max_error = options.max_error;
  if (options.lossless) header.max_error = 0;
  plan.header.layers.has_nodata = statesNodata(source);
  if (plan.header.layers.has_nodata) plan.header.layers.nodata = source.nodata;
  const Result<Survey> survey = surveyOf(plan, read);
  if (!survey.ok()) return survey.status();
  plan.header.layers.validity_bytes = survey->voids() ? 1 : 0;
  if (Status status = settle(*survey, options, read, plan); !status.ok()) return status;
  header.exact = options.lossless;
  return plan;
}

}  // namespace tetrakis::inline mosaic
