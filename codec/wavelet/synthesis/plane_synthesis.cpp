// SPDX-License-Identifier: Apache-2.0
#include "codec/wavelet/synthesis/view_synthesis.hpp"

#include <cassert>

#include "bitstream/track/reconstruction.hpp"
#include "codec/wavelet/forest_lifting.hpp"
#include "codec/wavelet/level_transform.hpp"

namespace tetrakis::inline synthesis {

PlaneSynthesis::PlaneSynthesis(const WaveletSpec& spec, const Pyramid& pyramid, int level)
    : spec_(spec), pyramid_(&pyramid), level_(level) {
  assert(level >= 0 && level <= pyramid.levels());
}

/// The mask of what the finest level puts together; of each row or column that is lifted, its
/// halves and their masks, on every thread.
uint64_t PlaneSynthesis::workBytes(uint32_t threads, bool masked) const {
  if (spec_.forest != nullptr) return ForestLifting::bytesOf(*spec_.forest, level_);
  return (masked ? coefficients() : 0) +
         kLiftingBytes * pyramid_->plane().width * std::max(threads, 1u);
}

std::span<int32_t> PlaneSynthesis::row(const Subband& subband, uint32_t row) {
  const size_t first = pyramid_->indexOf(subband, row, level_);
  return std::span(values_).subspan(first, subband.width);
}

void PlaneSynthesis::put(const Band& band, int fraction_bits, const BandPart& part) {
  if (!needs(part) || !band.hasCells()) return;
  assert(values_.size() == coefficients());
  const Subband& subband = pyramid_->subbands()[part.subband];
  const Reconstruction values(band, fraction_bits);
  for (uint32_t y = 0; y < part.rows; ++y)
    values.row(y, row(subband, part.row + y).subspan(part.column, part.columns).data());
}

std::vector<int32_t> PlaneSynthesis::run(uint32_t threads) {
  inverseWavelet(spec_, *pyramid_, values_, {level_, threads});
  takeOutGain(spec_, *pyramid_, level_, values_);
  values_.resize(thin(*pyramid_, level_, std::span(values_)));
  return std::move(values_);
}

std::vector<int32_t> PlaneSynthesis::run(uint32_t threads, SynthesisMemory& memory) {
  if (memory.coefficients != values_) {
    memory.coefficients = values_;
    memory.samples = run(threads);
  }
  return memory.samples;
}

void takeOutGain(const WaveletSpec& spec, const Pyramid& pyramid, int level,
                 std::span<int32_t> values) {
  constexpr int kShift = 30;
  int64_t weight = int64_t{1} << kShift;
  int halvings = 0;
  for (int l = 1; l <= level; ++l) {
    const int splits = pyramid.splitsX(l) + pyramid.splitsY(l);
    for (int i = 0; i < splits; ++i) {
      weight = (weight * inverseGain(spec.filter(l)) + (int64_t{1} << (kShift - 1))) >> kShift;
    }
    halvings += spec.doubles(l);
  }
  const int shift = kShift + halvings;
  if (weight == int64_t{1} << shift) return;
  const int64_t half = int64_t{1} << (shift - 1);
  for (int32_t& v : values) v = static_cast<int32_t>((v * weight + half) >> shift);
}

}  // namespace tetrakis::inline synthesis
