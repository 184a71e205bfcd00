// SPDX-License-Identifier: Apache-2.0
#include "wavelet/band_plan.hpp"

#include <algorithm>

#include "bitstream/reconstruction.hpp"

namespace tetrakis {

namespace {

/// The finest levels hold most coefficients and get contexts of their own. Orientations share
/// theirs: neighbours are named along and across the direction of the band, so that all look alike.
uint32_t modelsOf(const Subband& subband) {
  constexpr int kOwnLevels = kPlaneModels - 1;
  if (subband.orientation == Orientation::kLL) return kOwnLevels;
  return static_cast<uint32_t>(std::clamp(subband.level, 1, kOwnLevels) - 1);
}

}  // namespace

BandShape shapeOf(const Subband& subband) {
  return {subband.height, subband.width};
}

PlaneLayout::PlaneLayout(const WaveletSpec& spec, uint32_t width, uint32_t height)
    : subbands_(subbandsOf(width, height)), norms_(spec, subbands_.front().level) {}

std::vector<BandPlan> PlaneLayout::plan(int first, int priority, uint32_t models) const {
  std::vector<BandPlan> bands;
  for (size_t i = 0; i < subbands_.size(); ++i) {
    const Subband& subband = subbands_[i];
    BandPlan band;
    band.shape = shapeOf(subband);
    band.orientation = subband.orientation;
    band.log_norm = norms_.log16(subband) + priority;
    band.models = models + modelsOf(subband);
    const bool has_parent = i > kBandsPerLevel && !shapeOf(subbands_[i - kBandsPerLevel]).empty();
    if (has_parent) band.parent = first + static_cast<int>(i - kBandsPerLevel);
    bands.push_back(band);
  }
  return bands;
}

void markAbsent(const PlaneLayout& layout, Validity valid, uint32_t width,
                std::span<BandPlan> bands) {
  if (valid.empty()) return;
  for (size_t i = 0; i < bands.size(); ++i) {
    const Subband& subband = layout.subbands()[i];
    const BandShape& shape = bands[i].shape;
    bands[i].absent.assign(shape.wordCells(), 0);
    for (uint32_t row = 0; row < subband.height; ++row) {
      const uint8_t* samples = valid.data() + size_t{subband.planeRow(row)} * width;
      for (uint32_t column = 0; column < subband.width; ++column) {
        const uint32_t absent = samples[subband.sampleColumn(column)] == 0;
        bands[i].absent[shape.word(row, column / 32)] |= absent << column % 32;
      }
    }
  }
}

std::vector<int32_t> gather(std::span<const int32_t> plane, uint32_t width,
                            const Subband& subband) {
  const BandShape shape = shapeOf(subband);
  std::vector<int32_t> values(shape.cells(), 0);
  for (uint32_t row = 0; row < subband.height; ++row) {
    const int32_t* from = plane.data() + size_t{subband.planeRow(row)} * width + subband.x;
    std::copy_n(from, subband.width, values.data() + shape.cell(row, 0));
  }
  return values;
}

void scatter(const Band& band, int fraction_bits, const Subband& subband, std::span<int32_t> plane,
             uint32_t width) {
  const Reconstruction values(band, fraction_bits);
  for (uint32_t row = 0; row < subband.height; ++row) {
    values.row(row, plane.data() + size_t{subband.planeRow(row)} * width + subband.x);
  }
}

}  // namespace tetrakis
