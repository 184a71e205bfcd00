// SPDX-License-Identifier: Apache-2.0
// Which filters suit a plane. Encoder only: the choice stands in the stream header.
#pragma once

#include <cstdint>
#include <span>

#include "bitstream/stream/header.hpp"
#include "wavelet/masked_lifting.hpp"

namespace tetrakis {

/// What a plane is coded for.
enum class Purpose : uint8_t {
  kLossless,  ///< the last bit: no fraction bits
  kLossy      ///< something short of it: as many fraction bits as rounding noise asks for
};

/// plane: width * height samples of `bits` bits; valid: which of them exist, empty: all. Filters
/// are tried on typical parts of the plane and compared by an estimate of the bits that their
/// coefficients take.
WaveletHeader chooseWavelet(std::span<const int32_t> plane, Validity valid, uint32_t width,
                            uint32_t height, int bits, Purpose purpose);

/// The same for several planes, which share one answer.
WaveletHeader chooseWavelet(std::span<const std::span<const int32_t>> planes, Validity valid,
                            uint32_t width, uint32_t height, int bits, Purpose purpose);

/// About how many bits the coefficients of a plane take that is coded to the last bit.
double losslessBits(std::span<const int32_t> plane, Validity valid, uint32_t width,
                    uint32_t height, int bits);

}  // namespace tetrakis
