// SPDX-License-Identifier: Apache-2.0
// EncodeInputs is the input of one encoding (heights, image, options, priorities), with the lines
// of both components that are coded, and the place for notes of what is weighed. The functions
// derive from it what both components need alike.
#pragma once

#include <cstdint>
#include <span>

#include "base/status.hpp"
#include "codec/wavelet/choice/filter_choice.hpp"
#include "codec/wavelet/priority_map.hpp"
#include "encoder/inputs/coded_lines.hpp"
#include "encoder/plans/plan_notes.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::inline inputs {

/// The coefficients that come earlier in each component; empty maps: none do.
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
  /// The caller's heights, of which `heights` are some lines; null: they are all lines.
  const tks_heights* whole = nullptr;
  const CodedLines* lines = nullptr;
  /// The same of the caller's image.
  const tks_image* whole_image = nullptr;
  const CodedLines* texel_lines = nullptr;
  PlanNotes* notes = nullptr;  ///< of the plans that are weighed; null: nobody asked for them

  bool budgeted() const { return options.bytes != 0; }
  /// The caller's heights with all their lines.
  const tks_heights* allHeights() const { return lines != nullptr ? whole : heights; }
  /// The mean squared error of all lines is at most as many times that of the coded lines.
  double heaviest() const { return lines != nullptr ? lines->heaviest : 1; }
  /// How many samples of all lines show each coded sample; empty: one.
  std::span<const uint32_t> shownBy() const {
    return lines != nullptr ? std::span(lines->shown_by) : std::span<const uint32_t>();
  }
  /// The caller's image with all its lines.
  const tks_image* allTexels() const { return texel_lines != nullptr ? whole_image : image; }
  /// The mean squared error of all texels is at most as many times that of the coded ones.
  double heaviestTexel() const { return texel_lines != nullptr ? texel_lines->heaviest : 1; }
  /// The same inputs without the lines of the heights that repeat others, if any do. The heights
  /// that remain are put to `coded`, which outlives the result as the lines do.
  EncodeInputs ofLines(const CodedLines& some, tks_heights& coded) const {
    EncodeInputs inputs = *this;
    if (some.repeats.none()) return inputs;
    coded = some.of(*heights);
    inputs.whole = heights;
    inputs.heights = &coded;
    inputs.lines = &some;
    return inputs;
  }
  /// The same of the image.
  EncodeInputs ofLines(const CodedLines& some, tks_image& coded) const {
    EncodeInputs inputs = *this;
    if (some.repeats.none()) return inputs;
    coded = some.of(*image);
    inputs.whole_image = image;
    inputs.image = &coded;
    inputs.texel_lines = &some;
    return inputs;
  }
  /// The same inputs under other options, which outlive the result, and with other priorities.
  EncodeInputs with(const tks_encode_options& other, const ViewPriorities* others) const {
    return {.heights = heights,
            .image = image,
            .options = other,
            .priorities = others,
            .whole = whole,
            .lines = lines,
            .whole_image = whole_image,
            .texel_lines = texel_lines,
            .notes = notes};
  }
};

/// The purpose of a component that has no reason for another one.
Purpose purposeOf(const EncodeInputs& inputs);

/// Bytes worth coding of a component. They reach beyond the budget, because the slopes of the last
/// packets within it depend on the points that follow, and the order should hardly depend on the
/// budget. Two components share the budget: each gets less of it, and codes as much more behind it.
uint64_t limitOf(const EncodeInputs& inputs);

/// The mean squared error that is a PSNR in dB. peak: the range that it refers to.
double worstMeanSquare(double peak, double psnr);

}  // namespace tetrakis::inline inputs
