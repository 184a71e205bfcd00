// SPDX-License-Identifier: Apache-2.0
// The table of conformance vectors: small inputs that together visit every tool of the format.
#include "conformance/vector_cases.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <type_traits>

#include "base/samples.hpp"
#include "conformance/crafted_cases.hpp"
#include "tetrakis/tetrakis.hpp"

namespace tetrakis::conformance {
namespace {

using samples::Pattern;
using samples::Recipe;

tks_encode_options lossless() {
  tks_encode_options options = makeEncodeOptions();
  options.lossless = 1;
  return options;
}

tks_encode_options budget(uint64_t bytes) {
  tks_encode_options options = makeEncodeOptions();
  options.bytes = bytes;
  return options;
}

tks_encode_options maxError(double bound) {
  tks_encode_options options = makeEncodeOptions();
  options.max_error = bound;
  return options;
}

tks_encode_options quality(double psnr) {
  tks_encode_options options = makeEncodeOptions();
  options.psnr = psnr;
  return options;
}

tks_encode_options inRegions(tks_encode_options options, uint32_t side) {
  options.regions = side;
  return options;
}

tks_encode_options indexed(tks_encode_options options) {
  options.index = 1;
  return options;
}

VectorCase heightsCase(const std::string& name, const std::string& purpose, const Recipe& heights,
                       const tks_encode_options& options) {
  VectorCase vector_case;
  vector_case.name = name;
  vector_case.purpose = purpose;
  vector_case.heights = heights;
  vector_case.options = options;
  return vector_case;
}

VectorCase textureCase(const std::string& name, const std::string& purpose, const Recipe& image,
                       const tks_encode_options& options) {
  VectorCase vector_case;
  vector_case.name = name;
  vector_case.purpose = purpose;
  vector_case.texture = image;
  vector_case.options = options;
  return vector_case;
}

VectorCase weighted(VectorCase vector_case) {
  vector_case.options.weights = TKS_WEIGHTS_VISUAL;
  return vector_case;
}

VectorCase withVoids(VectorCase vector_case, samples::VoidShape shape, double nodata) {
  vector_case.voids = shape;
  vector_case.nodata = nodata;
  return vector_case;
}

VectorCase withWater(VectorCase vector_case, samples::VoidShape shape) {
  vector_case.water = shape;
  return vector_case;
}

VectorCase drawnOver(VectorCase vector_case, samples::VoidShape shape) {
  vector_case.overlay = shape;
  return vector_case;
}

VectorCase asCutout(VectorCase vector_case, samples::VoidShape shape) {
  vector_case.cutout = shape;
  return vector_case;
}

std::vector<VectorCase> geometryCases() {
  VectorCase fine = heightsCase("fine_i32_budget_60x45", "32-bit heights; three fraction bits",
                                {Pattern::kRidges, 60, 45, 1, TKS_I32}, budget(1500));
  fine.thirds = true;
  VectorCase negative = heightsCase(
      "negative_i16_48x31", "negative heights, scale and offset; rounded to a max-error bound",
      {Pattern::kRidges, 48, 31, 1, TKS_I16}, maxError(3));
  negative.scale = 0.1;
  negative.offset = -400;
  return {
      heightsCase("tiny_2x2", "smallest surface: one band", {Pattern::kRidges, 2, 2, 1, TKS_I16},
                  lossless()),
      heightsCase("odd_3x17", "odd sizes; a side that is never split",
                  {Pattern::kRidges, 3, 17, 1, TKS_U16}, lossless()),
      heightsCase("flat_33x33", "no detail at all: no bit-planes",
                  {Pattern::kFlat, 33, 33, 1, TKS_U16}, lossless()),
      heightsCase("extreme_i16_17x17",
                  "lowest and highest values side by side: every bit-plane is used",
                  {Pattern::kExtreme, 17, 17, 1, TKS_I16}, budget(4096)),
      heightsCase("extreme_u8_9x20", "8-bit heights; long coefficients",
                  {Pattern::kExtreme, 9, 20, 1, TKS_U8}, budget(4096)),
      heightsCase("ramp_i8_20x60", "signed 8-bit heights on a slope",
                  {Pattern::kRamp, 20, 60, 1, TKS_I8}, lossless()),
      heightsCase("wide_u32_20x12", "32-bit unsigned heights",
                  {Pattern::kRidges, 20, 12, 1, TKS_U32}, lossless()),
      heightsCase("long_160x5", "long side: levels that split one side alone",
                  {Pattern::kRidges, 160, 5, 1, TKS_U16}, lossless()),
      heightsCase("steps_40x40", "walls and terraces, whose lines repeat: abrupt signs",
                  {Pattern::kSteps, 40, 40, 1, TKS_I32}, maxError(0.25)),
      negative,
      heightsCase("float_65x65", "32-bit float heights on an exact step",
                  {Pattern::kRidges, 65, 65, 1, TKS_F32}, lossless()),
      fine,
      heightsCase("geometry_budget_129x97",
                  "fraction bits; cut by a byte budget in the middle of a packet",
                  {Pattern::kRidges, 129, 97, 1, TKS_U16}, budget(6000)),
  };
}

/// Validity and corrections.
std::vector<VectorCase> layerCases() {
  using samples::VoidShape;
  VectorCase thirds =
      heightsCase("float_thirds_31x33", "floats that no step restores: corrections of samples",
                  {Pattern::kRidges, 31, 33, 1, TKS_F32}, lossless());
  thirds.thirds = true;
  VectorCase extreme = heightsCase(
      "extreme_u32_16x15", "the whole range of 32 bits: wide sums, corrections of integer samples",
      {Pattern::kExtreme, 16, 15, 1, TKS_U32}, maxError(0.25));
  extreme.thirds = true;
  VectorCase wide = heightsCase("extreme_float_14x19", "floats with wide sums and corrections",
                                {Pattern::kExtreme, 14, 19, 1, TKS_F32}, maxError(1e-9));
  wide.thirds = true;
  VectorCase both =
      heightsCase("coast_thirds_40x30", "NaN without a nodata value, and corrections of samples",
                  {Pattern::kRidges, 40, 30, 1, TKS_F32}, lossless());
  both.thirds = true;
  const Recipe small{Pattern::kRidges, 45, 38, 1, TKS_I16};
  return {
      withVoids(heightsCase("coast_lossless_45x38", "bays and islands: masked lifting", small,
                            lossless()),
                VoidShape::kCoast, -9999),
      withVoids(heightsCase("coast_budget_90x70", "a coast and fraction bits, cut by a byte budget",
                            {Pattern::kRidges, 90, 70, 1, TKS_U16}, budget(2500)),
                VoidShape::kCoast, 0),
      withVoids(heightsCase("speckle_u8_21x34", "single voids everywhere; nodata among the heights",
                            {Pattern::kRidges, 21, 34, 1, TKS_U8}, lossless()),
                VoidShape::kSpeckle, 100),
      withVoids(heightsCase("checker_voids_18x9", "every other sample is void",
                            {Pattern::kSteps, 18, 9, 1, TKS_I16}, maxError(0.25)),
                VoidShape::kChecker, -1),
      withVoids(heightsCase("nothing_valid_12x7", "voids only",
                            {Pattern::kRidges, 12, 7, 1, TKS_F32}, lossless()),
                VoidShape::kAll, NAN),
      withVoids(both, VoidShape::kCoast, NAN),
      thirds,
      extreme,
      wide,
      heightsCase("bounded_64x64", "corrections of steps within a max-error bound",
                  {Pattern::kRidges, 64, 64, 1, TKS_U16}, maxError(1500)),
      withVoids(
          heightsCase("coast_bounded_64x50", "validity, coefficients and corrections of steps",
                      {Pattern::kRidges, 64, 50, 1, TKS_I16}, maxError(1500)),
          VoidShape::kCoast, -32768),
  };
}

std::vector<VectorCase> textureCases() {
  const auto image = [](Pattern pattern, uint32_t width, uint32_t height, uint32_t channels,
                        tks_sample sample) {
    return Recipe{pattern, width, height, channels, sample, 7};
  };
  return {
      textureCase("texture_1x1", "smallest texture: no wavelet step",
                  image(Pattern::kRidges, 1, 1, 3, TKS_U8), lossless()),
      textureCase("texture_1x23", "one column", image(Pattern::kRidges, 1, 23, 1, TKS_U8),
                  lossless()),
      textureCase("grey_61x40", "one channel", image(Pattern::kRidges, 61, 40, 1, TKS_U8),
                  lossless()),
      textureCase("grey_alpha_24x25", "two channels: grey and alpha",
                  image(Pattern::kRidges, 24, 25, 2, TKS_U8), lossless()),
      textureCase("grey_alpha_budget_70x50", "alpha with fraction bits, cut by a byte budget",
                  image(Pattern::kRidges, 70, 50, 2, TKS_U8), budget(1200)),
      textureCase("rgb_50x37", "three channels: colour transform",
                  image(Pattern::kRidges, 50, 37, 3, TKS_U8), lossless()),
      textureCase("rgba_32x32", "four channels: alpha beside the colour transform",
                  image(Pattern::kRidges, 32, 32, 4, TKS_U8), lossless()),
      textureCase("rgb16_21x30", "16-bit texture", image(Pattern::kRidges, 21, 30, 3, TKS_U16),
                  lossless()),
      textureCase("rgba16_budget_60x40", "16-bit texture with fraction bits: wide sums",
                  image(Pattern::kRidges, 60, 40, 4, TKS_U16), budget(2500)),
      asCutout(textureCase("cutout_rgb_40x33", "alpha as a mask; colours that it hides are coded",
                           image(Pattern::kRidges, 40, 33, 4, TKS_U8), lossless()),
               samples::VoidShape::kCoast),
      asCutout(
          textureCase("cutout_rgb_budget_70x45", "hidden colours are void; cut by a byte budget",
                      image(Pattern::kRidges, 70, 45, 4, TKS_U8), budget(1500)),
          samples::VoidShape::kCoast),
      asCutout(textureCase("cutout_grey16_1x41", "cut-out of 16-bit grey, one column",
                           image(Pattern::kRidges, 1, 41, 2, TKS_U16), quality(40)),
               samples::VoidShape::kSpeckle),
      textureCase("checker_rgb_16x16", "highest frequency at full range: every bit-plane is used",
                  image(Pattern::kChecker, 16, 16, 3, TKS_U8), lossless()),
      textureCase("ramp_129x96", "another filter from level 3 on",
                  image(Pattern::kRamp, 129, 96, 1, TKS_U8), quality(58)),
      textureCase("ramp_90x40", "another filter from level 2 on",
                  image(Pattern::kRamp, 90, 40, 1, TKS_U8), quality(58)),
      textureCase("drawn_grey_70x33", "drawn: one channel",
                  image(Pattern::kSteps, 70, 33, 1, TKS_U8), lossless()),
      textureCase("drawn_rgba16_45x60", "drawn: four channels of 16 bits",
                  image(Pattern::kSteps, 45, 60, 4, TKS_U16), lossless()),
      drawnOver(textureCase("overlay_rgb_64x50", "drawn over an image: its wavelet stops there",
                            image(Pattern::kRidges, 64, 50, 3, TKS_U8), lossless()),
                samples::VoidShape::kCoast),
      drawnOver(textureCase("overlay_rgba16_budget_90x40",
                            "drawn over four channels of 16 bits, cut by a byte budget",
                            image(Pattern::kRidges, 90, 40, 4, TKS_U16), budget(3000)),
                samples::VoidShape::kCoast),
      asCutout(drawnOver(textureCase("overlay_cutout_budget_80x60",
                                     "a mask, then an overlay; hidden colours are void",
                                     image(Pattern::kRidges, 80, 60, 4, TKS_U8), budget(2000)),
                         samples::VoidShape::kCoast),
               samples::VoidShape::kFrame),
      asCutout(drawnOver(textureCase("overlay_cutout_64x50", "a mask, then an overlay, lossless",
                                     image(Pattern::kRidges, 64, 50, 4, TKS_U8), lossless()),
                         samples::VoidShape::kCoast),
               samples::VoidShape::kFrame),
      asCutout(textureCase("cutout_all_hidden_33x20", "nothing is seen",
                           image(Pattern::kRidges, 33, 20, 4, TKS_U8), budget(300)),
               samples::VoidShape::kAll),
      textureCase("texture_budget_128x128", "texture alone, cut by a byte budget",
                  image(Pattern::kRidges, 128, 128, 3, TKS_U8), budget(8000)),
      weighted(textureCase("weights_rgba_70x40", "bands of each component have priorities",
                           image(Pattern::kRidges, 70, 40, 4, TKS_U8), budget(1500))),
  };
}

std::vector<VectorCase> jointCases() {
  const auto joint = [](const std::string& name, const std::string& purpose, const Recipe& heights,
                        const Recipe& image, const tks_encode_options& options) {
    VectorCase vector_case = heightsCase(name, purpose, heights, options);
    vector_case.texture = image;
    return vector_case;
  };
  const Recipe heights{Pattern::kRidges, 97, 97, 1, TKS_U16};
  const Recipe image{Pattern::kRidges, 128, 128, 3, TKS_U8, 7};
  const Recipe small_heights{Pattern::kRidges, 33, 33, 1, TKS_I16};
  const Recipe small_image{Pattern::kRidges, 40, 40, 3, TKS_U8, 7};
  return {
      joint("joint_budget_97x97_128x128", "geometry and texture packets in one order, byte budget",
            heights, image, budget(12000)),
      joint("joint_lossless_33x33_40x40", "geometry and texture to the last bit", small_heights,
            small_image, lossless()),
      joint("joint_index_33x33_40x40", "front index before the packets", small_heights, small_image,
            indexed(lossless())),
  };
}

/// Heights that count the values of a table.
std::vector<VectorCase> tableCases() {
  using samples::FewValues;
  const auto valued = [](FewValues values, VectorCase vector_case) {
    vector_case.values = values;
    return vector_case;
  };
  const Recipe small{Pattern::kRidges, 48, 40, 1, TKS_U8, 3};
  return {
      valued(FewValues::kFeet,
             heightsCase("table_feet_f32_48x40", "a table of values: feet written as metres", small,
                         lossless())),
      valued(FewValues::kRare, heightsCase("table_rare_f32_48x40",
                                           "corrections of samples whose values are not in the "
                                           "table",
                                           small, lossless())),
      withVoids(valued(FewValues::kStretched,
                       heightsCase("table_coast_u16_48x40",
                                   "a table of integers behind a mask of voids, in regions", small,
                                   inRegions(lossless(), 16))),
                samples::VoidShape::kCoast, 7),
  };
}

/// Few values in large shapes, which take fewer bytes drawn than by wavelet.
std::vector<VectorCase> drawnHeightsCases() {
  const auto classes = [](const std::string& name, const std::string& purpose, uint32_t width,
                          uint32_t height) {
    VectorCase vector_case =
        heightsCase(name, purpose, {Pattern::kRidges, width, height, 1, TKS_U8, 3}, lossless());
    vector_case.classes = 5;
    return vector_case;
  };
  VectorCase rescaled =
      classes("drawn_table_f32_60x47", "drawn heights that count the values of a table", 60, 47);
  rescaled.values = samples::FewValues::kRescaled;
  VectorCase rare =
      classes("drawn_rare_f32_52x44", "drawn heights beside corrections of samples", 52, 44);
  rare.values = samples::FewValues::kRare;
  VectorCase joint =
      classes("drawn_joint_index_50x41_30x20", "drawn heights beside a texture, index", 50, 41);
  joint.texture = Recipe{Pattern::kRidges, 30, 20, 3, TKS_U8, 7};
  joint.options = indexed(lossless());
  VectorCase copied = classes("drawn_copies_u8_75x62", "drawn heights whose lines repeat", 38, 31);
  copied.copies[0] = copied.copies[1] = 2;
  return {classes("drawn_u8_70x53", "drawn heights", 70, 53),
          classes("drawn_long_u8_2x300", "drawn heights, two columns", 2, 300),
          withVoids(classes("drawn_coast_u8_64x51", "drawn heights beside voids", 64, 51),
                    samples::VoidShape::kCoast, 255),
          rescaled,
          rare,
          joint,
          copied};
}

/// Noise, which takes fewer bytes stored than coded.
std::vector<VectorCase> storedCases() {
  VectorCase thirds = heightsCase("stored_f32_20x21", "floats that are stored, beside voids",
                                  {Pattern::kExtreme, 20, 21, 1, TKS_F32}, maxError(1e-9));
  thirds.thirds = true;
  return {heightsCase("stored_i16_17x19", "heights that are stored",
                      {Pattern::kExtreme, 17, 19, 1, TKS_I16}, maxError(0.25)),
          withVoids(thirds, samples::VoidShape::kSpeckle, NAN),
          textureCase("stored_rgb_15x13", "a texture that is stored",
                      {Pattern::kExtreme, 15, 13, 3, TKS_U8}, lossless()),
          textureCase("stored_grey_alpha16_14x15", "samples of two bytes, stored",
                      {Pattern::kExtreme, 14, 15, 2, TKS_U16}, lossless())};
}

/// Spatial regions, and several groups of them.
std::vector<VectorCase> regionCases() {
  VectorCase joint =
      heightsCase("regions_joint_index_40x33_50x47", "regions of heights and texture, index",
                  {Pattern::kRidges, 40, 33, 1, TKS_I16}, indexed(inRegions(lossless(), 16)));
  joint.texture = Recipe{Pattern::kRidges, 50, 47, 3, TKS_U8, 7};
  VectorCase budgeted = heightsCase(
      "regions_budget_97x97_128x128", "regions with fraction bits; cut by a byte budget",
      {Pattern::kRidges, 97, 97, 1, TKS_U16}, inRegions(budget(9000), 32));
  budgeted.texture = Recipe{Pattern::kRidges, 128, 128, 3, TKS_U8, 7};
  VectorCase corrected =
      heightsCase("regions_coast_thirds_60x41", "regions beside validity and corrections",
                  {Pattern::kRidges, 60, 41, 1, TKS_F32}, inRegions(lossless(), 16));
  corrected.thirds = true;
  return {heightsCase("regions_groups_200x70", "two groups of regions below the base",
                      {Pattern::kSteps, 200, 70, 1, TKS_U8}, inRegions(budget(1500), 16)),
          heightsCase("regions_long_150x9", "regions side by side; a last one that is longer",
                      {Pattern::kRidges, 150, 9, 1, TKS_I16}, inRegions(lossless(), 32)),
          joint, budgeted, withVoids(corrected, samples::VoidShape::kCoast, NAN)};
}

/// Voids, values declared for them, and planes of which most is empty.
std::vector<VectorCase> sparseCases() {
  using samples::VoidShape;
  const auto declared = [](VectorCase vector_case, double nodata) {
    vector_case.nodata = nodata;
    vector_case.apart = true;
    return vector_case;
  };
  VectorCase tiny = heightsCase("tiny_float_24x40", "floats around the smallest normal one",
                                {Pattern::kRidges, 24, 40, 1, TKS_F32}, lossless());
  tiny.exponent = -131;
  tiny.thirds = true;
  VectorCase spikes = heightsCase("spikes_300x300", "a large plain with few spikes: header level 1",
                                  {Pattern::kFlat, 300, 300, 1, TKS_I16}, budget(4096));
  spikes.spikes = 9001;
  return {
      declared(heightsCase("nodata_unused_u8_64x48", "a nodata value is declared, nothing is void",
                           {Pattern::kRidges, 64, 48, 1, TKS_U8}, budget(900)),
               175),
      declared(heightsCase("nodata_beyond_u8_20x20", "a nodata value that the type does not have",
                           {Pattern::kExtreme, 20, 20, 1, TKS_U8}, budget(4096)),
               -9999),
      withVoids(
          declared(heightsCase("nodata_most_u8_40x30", "voids of the largest value of the type",
                               {Pattern::kExtreme, 40, 30, 1, TKS_U8}, budget(700)),
                   255),
          VoidShape::kCoast, 255),
      withVoids(heightsCase("half_void_i16_256x40", "blocks without a coefficient that exists",
                            {Pattern::kRidges, 256, 40, 1, TKS_I16}, budget(6000)),
                VoidShape::kHalf, -1),
      heightsCase("long_i16_9000x4", "twelve levels of one side: more than ten splits",
                  {Pattern::kRidges, 9000, 4, 1, TKS_I16}, budget(500)),
      tiny,
      spikes,
  };
}

/// Samples that were copied to a larger grid.
std::vector<VectorCase> copiedCases() {
  const auto copied = [](VectorCase vector_case, uint32_t across, uint32_t down) {
    vector_case.copies[0] = across;
    vector_case.copies[1] = down;
    return vector_case;
  };
  return {
      copied(heightsCase("copies_3x3_i16_88x73", "samples copied to a larger grid, lossless",
                         {Pattern::kRidges, 30, 25, 1, TKS_I16}, lossless()),
             3, 3),
      copied(withVoids(heightsCase("copies_2x4_u16_79x77", "copies beside voids, by a byte budget",
                                   {Pattern::kRidges, 40, 20, 1, TKS_U16}, budget(700)),
                       samples::VoidShape::kCoast, 3),
             2, 4),
      copied(heightsCase("copies_1x5_f32_36x96", "rows of floats that are copies, in regions",
                         {Pattern::kRidges, 36, 20, 1, TKS_F32}, inRegions(lossless(), 16)),
             1, 5),
  };
}

/// Flat areas.
std::vector<VectorCase> waterCases() {
  using samples::VoidShape;
  VectorCase tenths =
      heightsCase("water_corrected_f32_96x80", "flat areas beside corrections of samples",
                  {Pattern::kRidges, 96, 80, 1, TKS_F32}, lossless());
  tenths.thirds = true;
  return {
      withWater(heightsCase("water_i16_120x90", "flat areas, lossless",
                            {Pattern::kRidges, 120, 90, 1, TKS_I16}, lossless()),
                VoidShape::kCoast),
      withWater(heightsCase("water_budget_u16_128x101", "flat areas with fraction bits",
                            {Pattern::kRidges, 128, 101, 1, TKS_U16}, budget(8000)),
                VoidShape::kHalf),
      withVoids(withWater(heightsCase("water_voids_i16_100x100", "flat areas beside voids",
                                      {Pattern::kRidges, 100, 100, 1, TKS_I16}, lossless()),
                          VoidShape::kHalf),
                VoidShape::kCoast, -32768),
      withWater(heightsCase("water_regions_i32_150x130", "flat areas, in regions",
                            {Pattern::kRidges, 150, 130, 1, TKS_I32}, inRegions(lossless(), 16)),
                VoidShape::kCoast),
      withWater(tenths, VoidShape::kCoast)};
}

/// The part of the header that says where things lie.
/// Coefficients have priorities, by what a camera sees.
std::vector<VectorCase> toldCases() {
  const auto told = [](const std::string& name, const std::string& purpose,
                       const tks_encode_options& options) {
    VectorCase both = heightsCase(name, purpose, {Pattern::kRidges, 90, 67, 1, TKS_I16}, options);
    both.texture = {Pattern::kRidges, 60, 80, 3, TKS_U8};
    both.told = true;
    return both;
  };
  VectorCase masked =
      asCutout(withVoids(told("told_masks_90x67_60x80",
                              "maps of priorities beside voids and a cut-out", budget(5000)),
                         samples::VoidShape::kCoast, -32768),
               samples::VoidShape::kCoast);
  masked.texture->channels = 4;
  return {told("told_90x67_60x80", "maps of priorities: heights and texture to the last bit",
               lossless()),
          told("told_regions_90x67_60x80", "maps of priorities over several tracks",
               inRegions(budget(7000), 32)),
          masked};
}

std::vector<VectorCase> placedCases() {
  VectorCase joint = heightsCase("placed_joint_20x15_40x31", "georeference of heights and texture",
                                 {Pattern::kRidges, 20, 15, 1, TKS_I16}, indexed(lossless()));
  joint.texture = Recipe{Pattern::kRidges, 40, 31, 1, TKS_U8, 7};
  VectorCase texture = textureCase("placed_texture_17x20", "georeference of a texture alone",
                                   {Pattern::kRidges, 17, 20, 3, TKS_U8, 7}, lossless());
  joint.placed = texture.placed = true;
  return {joint, texture};
}

/// Streams that a decoder must refuse, by the byte that is wrong (docs/FORMAT.md, section 2).
std::vector<VectorCase> damagedCases() {
  const Recipe heights{Pattern::kRidges, 9, 9, 1, TKS_I16};
  const auto damaged = [&](const std::string& name, const std::string& purpose, int byte) {
    VectorCase vector_case = heightsCase(name, purpose, heights, lossless());
    vector_case.damaged_byte = byte;
    return vector_case;
  };
  return {damaged("damaged_magic", "not a Tetrakis stream", 0),
          damaged("damaged_version", "a format version from the future", 4),
          damaged("damaged_header", "the header's checksum does not match", 12)};
}

/// Each height as often as the case says, the first ones of either side once less.
samples::Raster enlarged(const samples::Raster& of, const uint32_t (&copies)[2]) {
  samples::Raster raster = of;
  raster.width = of.width * copies[0] - (copies[0] - 1);
  raster.height = of.height * copies[1] - (copies[1] - 1);
  raster.data.clear();
  const size_t bytes = tks_sample_bytes(of.sample);
  for (uint32_t y = 0; y < raster.height; ++y) {
    const size_t row = (y + copies[1] - 1) / copies[1];
    for (uint32_t x = 0; x < raster.width; ++x) {
      const size_t column = (x + copies[0] - 1) / copies[0];
      const auto from = of.data.begin() + static_cast<ptrdiff_t>((row * of.width + column) * bytes);
      raster.data.insert(raster.data.end(), from, from + static_cast<ptrdiff_t>(bytes));
    }
  }
  return raster;
}

samples::Raster surfaceOf(const VectorCase& vector_case) {
  samples::Raster surface = samples::make(*vector_case.heights);
  for (std::byte& sample : surface.data) {
    if (vector_case.classes == 0) break;
    const uint32_t place = std::to_integer<uint32_t>(sample) * vector_case.classes / 256;
    sample = std::byte(place * (255 / vector_case.classes));
  }
  if (vector_case.values) surface = samples::withFewValues(surface, *vector_case.values);
  const uint32_t width = surface.width, height = surface.height;
  const std::vector<uint8_t> valid = vector_case.voids
                                         ? samples::validity(*vector_case.voids, width, height)
                                         : std::vector<uint8_t>(size_t{width} * height, 1);
  withSampleType(surface.sample, [&](auto sample) {
    for (size_t i = 0; i < valid.size(); ++i) {
      std::byte* at = surface.data.data() + i * sizeof sample;
      const bool left = 2 * (i % width) < width;
      const bool wet = vector_case.water && samples::isVoid(*vector_case.water, width, height,
                                                            static_cast<uint32_t>(i % width),
                                                            static_cast<uint32_t>(i / width));
      std::memcpy(&sample, wet ? surface.data.data() + (left ? 0 : width - 1) * sizeof sample : at,
                  sizeof sample);
      if (vector_case.thirds) sample = static_cast<decltype(sample)>(sample / 3);
      if constexpr (std::is_floating_point_v<decltype(sample)>)
        sample = std::ldexp(sample, vector_case.exponent);
      const auto number = static_cast<uint32_t>(i);
      if (vector_case.spikes > 0 && samples::hash(number, 0, 45) % vector_case.spikes == 0)
        sample = static_cast<decltype(sample)>(samples::hash(number, 1, 45));
      if (vector_case.apart && static_cast<double>(sample) == vector_case.nodata) ++sample;
      if (!valid[i]) sample = static_cast<decltype(sample)>(vector_case.nodata);
      std::memcpy(at, &sample, sizeof sample);
    }
  });
  return enlarged(surface, vector_case.copies);
}

template <class T>
void place(T& raster, const double (&transform)[6]) {
  std::copy(std::begin(transform), std::end(transform), raster.geotransform);
  raster.has_geotransform = 1;
  raster.registration = TKS_REGISTRATION_AREA;
}

/// Heights on a square grid; a texture over their ground, or turned if it is alone.
void placeBoth(bool has_heights, tks_heights& heights, tks_image& image) {
  place(heights, {399960, 30, 0, 5300040, 0, -30});
  heights.crs = "EPSG:32632";
  heights.description = "ridges";
  if (has_heights) {
    place(image, {399960, 15, 0, 5300040, 0, -30 * (15.0 / 31)});
    image.crs = heights.crs;
  } else {
    place(image, {100.25, 3, 8, 900, 4, -6});
    image.crs = "my \"grid\"";
    image.geo_keys = "1024=1 3072=32767 3073=\"my \"\"grid\"\"\" 3077=0.5";
  }
}

/// It sees a sixth of the ground on each side, and is above any 16-bit height. Samples of unknown
/// spacing are 30 m apart.
tks_camera cameraAbove(const tks_heights& heights) {
  const double x = -0.3 * 30 * heights.width, z = -0.3 * 30 * heights.height;
  tks_camera camera = {};
  const double eye[] = {x, 40000, z}, target[] = {x, 0, z}, up[] = {0, 0, -1};
  std::copy_n(eye, 3, camera.eye);
  std::copy_n(target, 3, camera.target);
  std::copy_n(up, 3, camera.up);
  camera.fov_y = 1;
  camera.width = camera.height = 128;
  camera.weight = 1;
  return camera;
}

}  // namespace

std::vector<VectorCase> vectorCases() {
  std::vector<VectorCase> all = geometryCases();
  for (VectorCase& next : layerCases()) all.push_back(std::move(next));
  for (VectorCase& next : textureCases()) all.push_back(std::move(next));
  for (VectorCase& next : tableCases()) all.push_back(std::move(next));
  for (VectorCase& next : drawnHeightsCases()) all.push_back(std::move(next));
  for (VectorCase& next : storedCases()) all.push_back(std::move(next));
  for (VectorCase& next : jointCases()) all.push_back(std::move(next));
  for (VectorCase& next : regionCases()) all.push_back(std::move(next));
  for (VectorCase& next : sparseCases()) all.push_back(std::move(next));
  for (VectorCase& next : copiedCases()) all.push_back(std::move(next));
  for (VectorCase& next : waterCases()) all.push_back(std::move(next));
  for (VectorCase& next : toldCases()) all.push_back(std::move(next));
  for (VectorCase& next : placedCases()) all.push_back(std::move(next));
  for (VectorCase& next : craftedCases()) all.push_back(std::move(next));
  for (VectorCase& next : unusualAndRefusedCases()) all.push_back(std::move(next));
  for (VectorCase& next : damagedCases()) all.push_back(std::move(next));
  return all;
}

Result<std::vector<uint8_t>> encodeCase(const VectorCase& vector_case) {
  if (!vector_case.stream.empty()) return vector_case.stream;
  samples::Raster surface, picture;
  tks_heights heights = {};
  tks_image image = {};
  if (vector_case.heights) {
    surface = surfaceOf(vector_case);
    heights = surface.heights();
    heights.scale = vector_case.scale;
    heights.offset = vector_case.offset;
    heights.unit = "m";
    heights.has_nodata = !std::isnan(vector_case.nodata);
    if (heights.has_nodata) heights.nodata = vector_case.nodata;
  }
  if (vector_case.texture) {
    picture = samples::make(*vector_case.texture);
    const auto mask = [&](samples::VoidShape shape) {
      return samples::validity(shape, picture.width, picture.height);
    };
    if (vector_case.overlay) samples::drawOver(picture, mask(*vector_case.overlay));
    if (vector_case.cutout) samples::cutOut(picture, mask(*vector_case.cutout));
    image = picture.image();
  }
  if (vector_case.placed) placeBoth(vector_case.heights.has_value(), heights, image);
  tks_encode_options options = vector_case.options;
  const tks_camera above = cameraAbove(heights);
  if (vector_case.told) {
    options.cameras = &above;
    options.camera_count = 1;
  }
  const auto stream = encode(vector_case.heights ? &heights : nullptr,
                             vector_case.texture ? &image : nullptr, options);
  if (!stream)
    return Status(stream.status().code(), vector_case.name + ": " + stream.status().message());
  std::vector<uint8_t> bytes(stream->bytes().begin(), stream->bytes().end());
  if (vector_case.damaged_byte >= 0) bytes[static_cast<size_t>(vector_case.damaged_byte)] ^= 0xff;
  return bytes;
}

}  // namespace tetrakis::conformance
