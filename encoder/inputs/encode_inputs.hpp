// SPDX-License-Identifier: Apache-2.0
// EncodeInputs is the input of one encoding (heights, image, options, priorities) as all stages of
// the encoder see it. The functions of this file derive from it what both components need alike:
// the lines that are coded, the regions, and the bytes that are worth coding.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/plane.hpp"
#include "bitstream/stream/line_repeats.hpp"
#include "codec/basemesh/base_mesh.hpp"
#include "codec/wavelet/choice/filter_choice.hpp"
#include "codec/wavelet/priority_map.hpp"
#include "encoder/plans/plan.hpp"
#include "tetrakis/result.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::inline inputs {

// CodedLines is the part of heights, or of an image, that is coded where columns and rows repeat
// the one before them: the other lines, and the map of repeats (bitstream/stream/line_repeats.hpp).
// Rasters that were enlarged by copying samples, or warped to the nearest one, have such lines.

/// Heights, or an image, without the lines that repeat others.
struct CodedLines {
  LineRepeats repeats;             ///< none: it does not pay
  std::vector<std::byte> samples;  ///< of the lines that are coded
  Extent extent = {0, 0};          ///< of these
  /// A coded sample counts as often as it is shown. This is the weight of the sample that is shown
  /// most often, divided by the mean weight: the mean squared error of all samples is at most as
  /// many times that of the coded ones.
  double heaviest = 1;
  /// `heaviest` up to which a PSNR is met on coded samples. A larger number drops lines of more
  /// files, and asks coded samples for an error that much smaller.
  static constexpr double kNearlyAlike = 1.1;
  std::vector<uint32_t> shown_by;  ///< how many samples each coded one stands for

  /// The coded part of `whole`. Its data is `samples`, which outlives the result.
  tks_heights of(const tks_heights& whole) const;
  tks_image of(const tks_image& whole) const;
};

// EncodeInputs is the input of one encoding (heights, image, options, priorities), with the lines
// of both components that are coded, and the place for notes of what is weighed. The functions
// derive from it what both components need alike.

/// The coefficients that come earlier in each component; empty maps: none do.
struct Priorities {
  PriorityMap heights, texture;
};

/// The caller's heights, image and options, which outlive this. Exactly one of bytes, psnr,
/// max_error and lossless is set.
struct EncodeInputs {
  const tks_heights* heights;  ///< null: there are none
  const tks_image* image;      ///< null: there is none
  const tks_encode_options& options;
  const Priorities* priorities = nullptr;  ///< null: none; else it outlives this as well
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
  EncodeInputs with(const tks_encode_options& other, const Priorities* others) const {
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

/// The forest that a raster lies on (tks_heights, tks_image), or null.
template <class Raster>
SharedForest forestOf(const Raster& raster) {
  if (raster.domain != TKS_DOMAIN_FOREST) return nullptr;
  const tks_forest& given = raster.forest;
  return std::make_shared<const Forest>(
      static_cast<int>(given.depth),
      std::vector<uint32_t>(given.sides, given.sides + size_t{Forest::kSides} * given.patches));
}

/// How many patches a raster has; a grid is one.
template <class Raster>
uint32_t patchesOf(const Raster& raster) {
  return raster.domain == TKS_DOMAIN_FOREST ? raster.forest.patches : 1;
}

/// The base mesh of heights that have one, which lie on a forest.
inline BaseMesh baseMeshOf(const tks_heights& heights) {
  const tks_base_mesh& given = heights.base_mesh;
  BaseMesh mesh{forestOf(heights), static_cast<int>(given.position_bits), {}, {}, given.cell};
  std::copy_n(given.origin, mesh.origin.size(), mesh.origin.begin());
  const size_t corners = size_t{Forest::kSides} * heights.forest.patches;
  for (const int32_t* at = given.corners; mesh.corners.size() < corners; at += 3)
    mesh.corners.push_back({at[0], at[1], at[2]});
  return mesh;
}

/// The purpose of a component that has no reason for another one.
Purpose purposeOf(const EncodeInputs& inputs);

/// Bytes worth coding of a component. They reach beyond the budget, because the slopes of the last
/// packets within it depend on the points that follow, and the order should hardly depend on the
/// budget. Two components share the budget: each gets less of it, and codes as much more behind it.
uint64_t limitOf(const EncodeInputs& inputs);

/// The mean squared error that is a PSNR in dB. peak: the range that it refers to.
double worstMeanSquare(double peak, double psnr);

// chooseRegions() decides whether a component is coded in regions (bitstream/track/track.hpp),
// and how large they are, from its size and the caller's options.

/// The largest number of heights in one region; more lie in several regions unless the caller says
/// otherwise. A larger number saves more planes the bytes that regions cost, and their windows take
/// the whole plane.
inline constexpr uint64_t kOneRegionHeights = 1025 * 1025;

struct RegionChoice {
  int side_log2 = 0;     ///< 0: one region
  bool windows = false;  ///< the stream is made to be read by windows of it
};

/// large: planes of the size of this one are coded in regions unless the caller says otherwise; for
/// windows all planes are.
/// Each of the patches has regions of its own.
RegionChoice chooseRegions(const tks_encode_options& options, Extent plane, bool large,
                           uint32_t patches);

// findRepeatedLines() finds the columns and rows of heights, or of an image, that repeat the one
// before them. They are left out before anything else looks at the samples, so that every target
// profits from the smaller grid; decoders copy them at the end.

/// Samples of `sample_bytes` bytes each, row by row; of an image these are texels.
struct SampleGrid {
  const void* data;
  Extent extent;
  size_t sample_bytes;
};

/// The lines to code in an encoding. All lines are coded for a judge of pictures, who takes whole
/// inputs, and for budgets of which the map of lines would take too much.
CodedLines linesThatPay(const tks_encode_options& options, const SampleGrid& grid, uint32_t least);

// areaPriorities() makes a map of priorities for heights whose rows have latitudes. An error counts
// by the area of its sample, which falls towards the poles as the cosine of the latitude does: on a
// globe half of the samples lie on 29 % of the ground.

/// The map has no tiles if the heights have no latitudes, if the areas of their rows differ so
/// little that errors over the ground would hardly fall, or if it takes too many bytes.
PriorityMap areaPriorities(const EncodeInputs& inputs);

}  // namespace tetrakis::inline inputs
