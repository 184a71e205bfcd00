// SPDX-License-Identifier: Apache-2.0
// This file holds what one encoding is given, and translates its options for the codecs of the
// components.
#pragma once

#include <cstdint>
#include <span>

#include "base/status.hpp"
#include "base/texels.hpp"
#include "bitstream/stream/line_repeats.hpp"
#include "codec/geometry/geometry_encoder.hpp"
#include "tetrakis/tetrakis.h"
#include "texture_wavelet/texture_source.hpp"
#include "wavelet/filter_choice.hpp"
#include "wavelet/priority_map.hpp"

namespace tetrakis::inline encoder {

/// Heights of more samples are coded in regions unless the caller says otherwise.
constexpr uint64_t kOneRegionHeights = 1025 * 1025;

/// What comes earlier in each component; empty maps: nothing.
struct ViewPriorities {
  PriorityMap heights, texture;
};

/// The caller's heights, image and options, which outlive this. Exactly one of bytes, psnr,
/// max_error and lossless is set.
struct EncodeInputs {
  const tks_heights* heights;  ///< null: there are none
  const tks_image* image;      ///< null: there is none
  const tks_encode_options& options;
  const ViewPriorities* priorities = nullptr;  ///< null: none; else it outlives this as well
  /// The caller's heights, of which `heights` are the coded lines; null: they are the same.
  const tks_heights* whole = nullptr;
  const LineRepeats* repeats = nullptr;  ///< not null with `whole`
  /// How many times the mean squared error of the coded lines that of all lines may be.
  double heaviest = 1;
  /// How many samples of the whole heights show each coded one; empty: one.
  std::span<const uint32_t> shown = {};

  bool budgeted() const { return options.bytes != 0; }
};

/// What components are coded for unless they have reasons of their own.
Purpose purposeOf(const EncodeInputs& inputs);

/// inputs: with heights.
CoefficientOptions heightOptions(const EncodeInputs& inputs);

/// inputs: with an image, which is `texels`.
TextureOptions textureOptions(const EncodeInputs& inputs, const Texels& texels);

/// The mean squared error that is a PSNR in dB. peak: the range that it refers to.
double worstMeanSquare(double peak, double psnr);

/// done: from 0 to 1. TKS_USAGE if the caller wants no more.
Status reportProgress(const tks_encode_options& options, double done);

}  // namespace tetrakis::inline encoder
