// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/coding_choice/tried_plane.hpp"

#include <cmath>
#include <span>
#include <utility>

#include "base/parallel.hpp"
#include "base/portable_math.hpp"
#include "codec/geometry/flat/flat_encoder.hpp"

namespace tetrakis::inline coding_choice {

namespace {

/// log2 of the coarsest step that is looked for; every plane fits it.
constexpr int kMostLog2 = 60;
/// The search for the step of a budget goes on by 2 to this power before it halves the interval. A
/// larger stride takes fewer trials of fine steps, and more halvings.
constexpr int kStrideLog2 = 4;

std::vector<int32_t> scaled(std::span<const int32_t> heights, const WaveletHeader& wavelet) {
  std::vector<int32_t> values(heights.begin(), heights.end());
  for (int32_t& h : values)
    h = static_cast<int32_t>(static_cast<uint32_t>(h) << wavelet.fraction_bits);
  return values;
}

}  // namespace

CopiedPart::CopiedPart(const PlaneView<const int32_t>& plane, Mask valid_samples,
                       const SampledPart& sampled)
    : place(sampled),
      heights(slice(plane.values(), plane.extent(), {0, sampled.window})),
      lifted(slice(plane.valid.bytes(), plane.extent(), {0, sampled.window})),
      valid(slice(valid_samples.bytes(), plane.extent(), {0, sampled.window})) {}

TriedPart::TriedPart(const CopiedPart& part, FlatAreas flat, const WaveletHeader& wavelet)
    : flat_(std::move(flat)),
      values_(scaled(part.heights, wavelet)),
      area_heights_(scaled(flat_.heights, wavelet)),
      layout_(specOf(wavelet),
              Pyramid(part.extent(), part.lifted, {flat_.numbers, area_heights_})) {
  clearUnmarked(std::span(values_), part.lifted);
  forwardWavelet(specOf(wavelet), layout_.pyramid(), values_, 1);
  if (!flat_.empty()) bytes_of_areas_ = encodeFlatAreas(flat_, part.extent(), part.valid).size();
}

PlaneCost TriedPart::cost(double step) {
  const auto [known, is_new] = costs_.try_emplace(step);
  if (is_new) known->second = costOf(layout_, values_, step);
  return known->second;
}

TriedPart& PartTrials::tried(FlatAreas flat, const WaveletHeader& wavelet) {
  for (const auto& before : tried_) {
    if (before->holds(flat)) return *before;
  }
  if (tried_.size() == kKept) tried_.pop_back();
  return *tried_.emplace_back(std::make_unique<TriedPart>(*part_, std::move(flat), wavelet));
}

TriedPlane::TriedPlane(std::vector<PartTrials>& trials, std::vector<FlatAreas> areas,
                       const WaveletHeader& wavelet, uint32_t threads)
    : parts_(trials.size()), threads_(threads) {
  parallelFor(threads_, parts_.size(), [&](size_t i) {
    parts_[i] = {&trials[i].tried(std::move(areas[i]), wavelet), trials[i].standsFor()};
  });
}

PlaneCost TriedPlane::cost(double step) const {
  std::vector<PlaneCost> costs(parts_.size());
  parallelFor(threads_, costs.size(), [&](size_t i) { costs[i] = parts_[i].tried->cost(step); });
  PlaneCost sum;
  for (size_t i = 0; i < costs.size(); ++i) {
    sum.bits += parts_[i].stands_for * costs[i].bits;
    sum.squares += parts_[i].stands_for * costs[i].squares;
  }
  return sum;
}

double TriedPlane::bitsOfAreas() const {
  double bits = 0;
  for (const Part& part : parts_)
    bits += part.stands_for * 8 * static_cast<double>(part.tried->bytesOfAreas());
  return bits;
}

double TriedPlane::step(double bits) const {
  const auto fits = [&](int log2) { return cost(portable::exp2(log2)).bits <= bits; };
  int too_fine = -1, enough = 0;
  for (; enough < kMostLog2 && !fits(enough); enough += kStrideLog2) too_fine = enough;
  while (enough - too_fine > 1) {
    const int middle = (enough + too_fine) / 2;
    (fits(middle) ? enough : too_fine) = middle;
  }
  return portable::exp2(enough);
}

}  // namespace tetrakis::inline coding_choice
