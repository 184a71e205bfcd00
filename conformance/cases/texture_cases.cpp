// SPDX-License-Identifier: Apache-2.0
// Textures: channels, filters, drawings, overlays, cut-outs.
#include <utility>

#include "conformance/cases/case_builders.hpp"
#include "conformance/cases/cases.hpp"

namespace tetrakis::conformance {

namespace {

/// Channels have few values.
VectorCase leveled(VectorCase vector_case, uint32_t levels, tks_sample of) {
  vector_case.levels = levels;
  vector_case.levels_of = of;
  return vector_case;
}

std::vector<VectorCase> fewTexelsCases() {
  const auto image = [](uint32_t width, uint32_t height, uint32_t channels) {
    return Recipe{Pattern::kRidges, width, height, channels, TKS_U8, 7};
  };
  return {
      leveled(textureCase("tables_rgb_50x37", "tables of the values of channels", image(50, 37, 3),
                          lossless()),
              90, TKS_U8),
      leveled(textureCase("tables_grey_alpha16_60x33", "tables of 16 bits, of alpha too",
                          image(60, 33, 2), lossless()),
              200, TKS_U16),
      leveled(textureCase("tables_regions_rgb16_70x50", "tables of 16 bits, regions, index",
                          image(70, 50, 3), inRegions(indexed(lossless()), 16)),
              150, TKS_U16),
      asCutout(drawnOver(leveled(textureCase("tables_overlay_80x60",
                                             "tables beside a mask and an overlay",
                                             image(80, 60, 4), lossless()),
                                 100, TKS_U8),
                         samples::VoidShape::kCoast),
               samples::VoidShape::kFrame),
  };
}

/// The last of 2 or 4 channels is a further colour.
VectorCase opaque(VectorCase vector_case) {
  vector_case.opaque = true;
  return vector_case;
}

std::vector<VectorCase> furtherColourCases() {
  const auto image = [](Pattern pattern, uint32_t channels, tks_sample sample) {
    return Recipe{pattern, 53, 38, channels, sample, 7};
  };
  return {
      opaque(textureCase("further_rgb16_53x38", "a fourth colour that follows the others, lossless",
                         image(Pattern::kRidges, 4, TKS_U16), lossless())),
      opaque(textureCase("further_rgb_regions_53x38", "a fourth colour by a byte budget, regions",
                         image(Pattern::kRidges, 4, TKS_U8), inRegions(budget(1500), 16))),
      opaque(textureCase("further_grey_53x38", "a second colour, no alpha",
                         image(Pattern::kRidges, 2, TKS_U8), budget(900))),
      opaque(leveled(textureCase("further_tables_rgb_53x38", "a fourth colour in tables of values",
                                 image(Pattern::kRidges, 4, TKS_U8), lossless()),
                     90, TKS_U8)),
      opaque(leveled(textureCase("further_drawn_53x38", "a drawing of four colours",
                                 image(Pattern::kRidges, 4, TKS_U8), lossless()),
                     3, TKS_U8)),
  };
}

VectorCase copied(VectorCase vector_case, uint32_t across, uint32_t down) {
  vector_case.texel_copies[0] = across;
  vector_case.texel_copies[1] = down;
  return vector_case;
}

/// Of 16 bits, of which the pictures show a part.
VectorCase shownFrom(VectorCase vector_case, uint32_t white_level) {
  vector_case.white_level = white_level;
  return vector_case;
}

std::vector<VectorCase> whiteLevelCases() {
  const auto image = [](Pattern pattern, uint32_t channels) {
    return Recipe{pattern, 31, 27, channels, TKS_U16, 7};
  };
  return {
      shownFrom(textureCase("white_rgb16_budget_31x27", "a white level, cut by a byte budget",
                            image(Pattern::kRidges, 3), budget(900)),
                4095),
      shownFrom(
          copied(textureCase("white_copied_grey16_31x27", "a white level beside repeated lines",
                             image(Pattern::kRidges, 1), lossless()),
                 2, 1),
          3000),
      shownFrom(textureCase("white_stored_rgb16_31x27",
                            "stored samples, of which the unknown are half of the white level",
                            image(Pattern::kNoise, 3), lossless()),
                1000),
  };
}

std::vector<VectorCase> copiedTexelsCases() {
  const auto image = [](Pattern pattern, uint32_t channels, tks_sample sample) {
    return Recipe{pattern, 33, 26, channels, sample, 7};
  };
  return {
      copied(textureCase("texel_copies_2x2_65x51", "texels copied to a larger grid, lossless",
                         image(Pattern::kRidges, 3, TKS_U8), lossless()),
             2, 2),
      copied(leveled(textureCase("texel_copies_3x1_regions_97x26",
                                 "copies in tables of values, in regions",
                                 image(Pattern::kRidges, 3, TKS_U8), inRegions(lossless(), 16)),
                     150, TKS_U16),
             3, 1),
      asCutout(
          copied(textureCase("texel_copies_cutout_33x101", "copies beside a mask, by a byte budget",
                             image(Pattern::kRidges, 4, TKS_U8), budget(900)),
                 1, 4),
          samples::VoidShape::kCoast),
      copied(textureCase("drawn_copies_rgb_97x76", "a drawing whose lines repeat",
                         image(Pattern::kSteps, 3, TKS_U8), lossless()),
             3, 3),
  };
}

}  // namespace

std::vector<VectorCase> textureCases() {
  const auto image = [](Pattern pattern, uint32_t width, uint32_t height, uint32_t channels,
                        tks_sample sample) {
    return Recipe{pattern, width, height, channels, sample, 7};
  };
  std::vector<VectorCase> cases = {
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
      textureCase("checker_rgb_16x16", "drawn: the highest frequency",
                  image(Pattern::kChecker, 16, 16, 3, TKS_U8), lossless()),
      textureCase("ramp_129x96", "another filter from level 3 on",
                  image(Pattern::kRamp, 129, 96, 1, TKS_U8), quality(58)),
      textureCase("ramp_90x40", "another filter from level 2 on",
                  image(Pattern::kRamp, 90, 40, 1, TKS_U8), quality(58)),
      textureCase("drawn_grey_70x33", "drawn: one channel",
                  image(Pattern::kSteps, 70, 33, 1, TKS_U8), lossless()),
      leveled(textureCase("drawn_rgba16_45x60", "drawn: four channels of 16 bits",
                          image(Pattern::kRidges, 45, 60, 4, TKS_U8), lossless()),
              3, TKS_U16),
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
  for (auto some : {fewTexelsCases(), copiedTexelsCases(), furtherColourCases(), whiteLevelCases()})
    for (VectorCase& each : some) cases.push_back(std::move(each));
  return cases;
}

/// Texels that are hidden or drawn over, where the wavelet goes on.
std::vector<VectorCase> bridgedTextureCases() {
  using samples::VoidShape;
  const auto ridges = [](uint32_t width, uint32_t height, uint32_t channels,
                         tks_sample sample = TKS_U8) {
    return Recipe{Pattern::kRidges, width, height, channels, sample, 7};
  };
  VectorCase regions =
      textureCase("bridged_overlay_regions_120x90", "a bridged overlay, in regions",
                  ridges(120, 90, 3), budget(5000));
  regions.options.regions = 32;
  return {
      drawnOver(textureCase("bridged_overlay_80x60", "the wavelet goes on below thin lines",
                            ridges(80, 60, 3), budget(2500)),
                VoidShape::kLines),
      drawnOver(regions, VoidShape::kLines),
      asCutout(textureCase("bridged_cutout_70x50", "single holes are bridged, and a coast is not",
                           ridges(70, 50, 4), budget(2000)),
               VoidShape::kHoles),
      asCutout(textureCase("bridged_cutout_grey16_45x64", "all holes are bridged, 16 bits",
                           ridges(45, 64, 2, TKS_U16), budget(2500)),
               VoidShape::kSpeckle),
      asCutout(
          drawnOver(textureCase("bridged_overlay_cutout_90x60", "holes and lines, bridged together",
                                ridges(90, 60, 4), budget(3000)),
                    VoidShape::kLines),
          VoidShape::kHoles),
  };
}

}  // namespace tetrakis::conformance
