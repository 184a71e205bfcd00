// SPDX-License-Identifier: Apache-2.0
// forwardWavelet() and inverseWavelet() are the transform: a reversible integer wavelet of a plane.
// Heights and the colour planes of a texture share it.
//
// Every level rounds, and the rounding errors of coarse levels spread over the whole plane. Planes
// with fraction bits (lossy ones, shifted left by up to four bits) keep these errors below a step.
// Planes without them (lossless ones) round each coefficient once
// (codec/wavelet/lifting/joint_lifting.hpp). The low bands of three levels are doubled, so that
// coarser levels round half as much: prefixes get better, lossless streams a little longer
// (docs/EXPERIMENTS.md).
#pragma once

#include <cstdint>
#include <span>

#include "codec/wavelet/pyramid.hpp"
#include "codec/wavelet/wavelet_spec.hpp"

namespace tetrakis::inline wavelet {

/// Turns the samples of the plane of a pyramid into coefficients, in place, laid out as
/// codec/wavelet/pyramid.hpp says. inverseWavelet() with the same spec and an equal pyramid undoes
/// it exactly. Samples that do not exist are left alone; those that are held have their values, and
/// the places of their coefficients may be anything afterwards.
void forwardWavelet(const WaveletSpec& spec, const Pyramid& pyramid, std::span<int32_t> values,
                    uint32_t threads = 1);

/// How coefficients become samples.
struct InverseOptions {
  int level = 0;         ///< whose low band they become: the coarser levels alone are undone
  uint32_t threads = 1;  ///< nothing depends on them
};

/// Turns coefficients into the low band of a level, which is a plane of its own, in place; that of
/// level 0 are the samples. Defined for all values. low: the values of that low band. Where samples
/// are held any values will do.
void inverseWavelet(const WaveletSpec& spec, const Pyramid& pyramid, std::span<int32_t> low,
                    const InverseOptions& options = {});

}  // namespace tetrakis::inline wavelet
