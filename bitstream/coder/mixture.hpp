// SPDX-License-Identifier: Apache-2.0
// Mixture joins the predictions of several models for one decision, each of which knows another
// side of it. It adds them as logarithms of odds, with weights that learn which models to believe
// (M. Mahoney, "Adaptive weighing of context models for lossless data compression", 2005). It
// computes with integers only, so that all decoders come to the same odds.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "bitstream/coder/adaptive_bit.hpp"

namespace tetrakis::inline coder {

/// The largest logarithm of odds, in multiples of 2^-8. Probabilities are multiples of 2^-12.
inline constexpr int kMostOdds = 2047;

/// The probability of the odds: 4096 / (1 + e^(-odds / 256)), linear between multiples of 128.
constexpr int32_t probabilityOf(int32_t odds) {
  constexpr int32_t kAt[] = {1,    2,    3,    6,    10,   16,   27,   45,   73,   120,  194,
                             310,  488,  747,  1101, 1546, 2047, 2549, 2994, 3348, 3607, 3785,
                             3901, 3975, 4022, 4050, 4068, 4079, 4085, 4089, 4092, 4093, 4094};
  const int32_t place = (odds >> 7) + 16, part = odds & 127;
  return (kAt[place] * (128 - part) + kAt[place + 1] * part + 64) >> 7;
}

/// For each probability, the least odds that have this probability or more.
using OddsTable = std::array<int16_t, 4096>;

/// Made at run time: as a constant it would be 3 kB of the compressed module for the web.
OddsTable makeOddsTable();

/// What each model of a kind of decision is believed, in units of 2^-16.
template <size_t kModels>
using MixtureWeights = std::array<int32_t, kModels>;

template <size_t kModels>
constexpr MixtureWeights<kModels> freshWeights() {
  MixtureWeights<kModels> weights{};
  for (int32_t& weight : weights) weight = 20000;
  return weights;
}

/// The models of one decision, of which each learns from it, and so do their weights.
template <size_t kModels>
class Mixture {
 public:
  Mixture(const std::array<AdaptiveBit*, kModels>& models, MixtureWeights<kModels>& weights,
          const OddsTable& odds)
      : models_(models), weights_(weights) {
    int64_t sum = 0;
    for (size_t i = 0; i < kModels; ++i) {
      odds_[i] = odds[models_[i]->zero() >> 4];
      sum += int64_t{odds_[i]} * weights_[i];
    }
    sum = std::clamp<int64_t>(sum >> 16, -kMostOdds, kMostOdds);
    zero_ = probabilityOf(static_cast<int32_t>(sum));
  }

  /// P(bit = 0) in units of 2^-16.
  uint32_t zero() const { return static_cast<uint32_t>(16 * zero_ + 8); }

  void learn(bool bit) {
    constexpr int32_t kRate = 16, kMostWeight = 1 << 20;
    const int32_t error = ((bit ? 0 : 4095) - zero_) * kRate;
    for (size_t i = 0; i < kModels; ++i) {
      const int32_t weight = weights_[i] + ((odds_[i] * error + 0x8000) >> 16);
      weights_[i] = std::clamp(weight, -kMostWeight, kMostWeight);
      models_[i]->update(bit);
    }
  }

 private:
  const std::array<AdaptiveBit*, kModels> models_;
  MixtureWeights<kModels>& weights_;
  std::array<int32_t, kModels> odds_;
  int32_t zero_;
};

}  // namespace tetrakis::inline coder
