// SPDX-License-Identifier: Apache-2.0
#include "encoder/mosaic/survey.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <string>
#include <type_traits>
#include <vector>

#include "base/samples.hpp"
#include "codec/geometry/quantiser/height_steps.hpp"
#include "encoder/mosaic/block.hpp"
#include "encoder/selection/write_stream.hpp"

namespace tetrakis::inline mosaic {

namespace {

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
  negative_zeros_ = negative_zeros_ || (sample == 0 && std::signbit(sample));
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

/// Regions of narrow planes with voids become longer, until each can have a mask of its own.
void chooseRegions(int region_log2, bool voids, MosaicPlan& plan) {
  GeometryHeader& header = *plan.header.geometry;
  const auto count = [&] { return regionCount(header.width, header.height, region_log2); };
  while (voids && count() > 1 && !takesRegionMasks(header.extent(), region_log2)) ++region_log2;
  const bool one = count() <= 1;
  header.regions.side_log2 = static_cast<uint8_t>(one ? 0 : region_log2);
  plan.tile_log2 = std::max<int>(plan.tile_log2, header.regions.side_log2);
  plan.header.layers.validity_bytes = voids ? 1 : 0;
  plan.header.layers.region_masks = voids && !one;
}

}  // namespace

Result<MosaicPlan> makePlan(const tks_heights& source, const MosaicOptions& options,
                            const ReadSamples& read) {
  if (Status status = checkOptions(options); !status.ok()) return status;
  if (std::max(source.width, source.height) > kMaxSide)
    return Status(TKS_USAGE, "A mosaic has at most 2^20 columns and 2^20 rows.");
  MosaicPlan plan;
  plan.tile_log2 = options.tile_log2;
  plan.target.bounded = options.max_error > 0;
  plan.header.lossless = options.lossless;
  describePlace(&source, nullptr, plan.header);
  GeometryHeader& header = plan.header.geometry.emplace();
  header.width = source.width;
  header.height = source.height;
  header.sample = static_cast<uint8_t>(source.sample);
  if (options.max_error > 0) header.max_error = options.max_error;
  if (options.lossless) header.max_error = 0;
  plan.header.layers.has_nodata = statesNodata(source);
  if (plan.header.layers.has_nodata) plan.header.layers.nodata = source.nodata;
  const Result<Survey> survey = surveyOf(plan, read);
  if (!survey.ok()) return survey.status();
  chooseRegions(options.region_log2, survey->voids(), plan);
  if (Status status = chooseSteps(*survey, options, read, plan); !status.ok()) return status;
  header.exact = options.lossless && !plan.header.layers.restoresSamples();
  return plan;
}

}  // namespace tetrakis::inline mosaic
