// SPDX-License-Identifier: Apache-2.0
// SynthesisNorms gives the weight of an error in a wavelet coefficient of each band: the L2 norm of
// the synthesis function of the band.
#pragma once

#include <array>

#include "codec/wavelet/wavelet.hpp"

namespace tetrakis::inline wavelet {

/// The norms of a transform. It is separable, so a band's norm is the product of two norms of the
/// one-dimensional synthesis, over the factor of two for each doubling of the low band. Integer
/// only: the order of the bit-planes depends on them.
class SynthesisNorms {
 public:
  /// levels: the most splits that will be asked for. The work doubles with each.
  SynthesisNorms(const WaveletSpec& spec, int levels);

  /// 16 log2 of the band's norm, rounded.
  int log16(const Subband& band) const { return (fine(band) + 8) >> 4; }

  /// The band's squared norm, for rate-distortion weights.
  double energy(const Subband& band) const;

 private:
  static constexpr int kFineSteps = 256;
  using Table = std::array<int, kMaxLevels + 1>;

  int fine(const Subband& band) const;

  WaveletSpec spec_;
  Table low_{}, high_{};  ///< kFineSteps log2 of the norm after so many splits
};

}  // namespace tetrakis::inline wavelet
