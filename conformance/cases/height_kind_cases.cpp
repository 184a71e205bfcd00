// SPDX-License-Identifier: Apache-2.0
// Kinds of heights that have a tool of their own: tables of values, drawings, repeated lines, flat
// areas.
#include "conformance/cases/case_builders.hpp"
#include "conformance/cases/cases.hpp"

namespace tetrakis::conformance {

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

/// Heights in whole steps above something that is none.
std::vector<VectorCase> relativeCases() {
  using samples::OffsetKind;
  const auto above = [](OffsetKind offsets, VectorCase vector_case) {
    vector_case.offsets = offsets;
    return vector_case;
  };
  const Recipe ground{Pattern::kRidges, 75, 61, 1, TKS_U16, 3};
  return {
      above(OffsetKind::kGeoid, heightsCase("relative_geoid_75x61",
                                            "corrections from relative steps: metres above a geoid",
                                            ground, lossless())),
      withVoids(above(OffsetKind::kSquares,
                      heightsCase("relative_squares_75x61",
                                  "corrections from relative steps: squares with offsets, beside "
                                  "voids",
                                  ground, lossless())),
                samples::VoidShape::kCoast, -9999),
      above(OffsetKind::kSurveys,
            heightsCase("relative_surveys_75x61",
                        "corrections from relative steps: two surveys, in regions", ground,
                        inRegions(lossless(), 16))),
  };
}

/// Floats that are linear between points.
std::vector<VectorCase> facetCases() {
  const auto faceted = [](double spacing, VectorCase vector_case) {
    vector_case.facets = spacing;
    return vector_case;
  };
  const auto scaled = [](int exponent, VectorCase vector_case) {
    vector_case.exponent = exponent;
    return vector_case;
  };
  const auto ground = [](uint32_t width, uint32_t height) {
    return Recipe{Pattern::kRidges, width, height, 1, TKS_F32, 3};
  };
  return {
      faceted(9.7, heightsCase("facets_83x61", "corrections from facets: triangles between points",
                               ground(83, 61), lossless())),
      withVoids(faceted(6.3, heightsCase("facets_voids_64x75",
                                         "corrections from facets: triangles beside voids, in "
                                         "regions",
                                         ground(64, 75), inRegions(lossless(), 16))),
                samples::VoidShape::kCoast, -9999),
      scaled(-148, faceted(8.2, heightsCase("facets_denormal_50x40",
                                            "corrections from facets: floats without an exponent",
                                            ground(50, 40), lossless()))),
      faceted(31.4, heightsCase("facets_row_700x1", "corrections from facets: lines between points",
                                ground(700, 1), lossless())),
  };
}

/// Few values in large shapes, which take fewer bytes drawn than by wavelet.
std::vector<VectorCase> drawnHeightsCases() {
  const auto patches = [](const std::string& name, const std::string& purpose, uint32_t width,
                          uint32_t height) {
    VectorCase vector_case =
        heightsCase(name, purpose, {Pattern::kRidges, width, height, 1, TKS_U8, 3}, lossless());
    vector_case.patches = true;
    return vector_case;
  };
  VectorCase stretched = patches("drawn_table_u16_160x121",
                                 "drawn heights that count the values of a table", 160, 121);
  stretched.values = samples::FewValues::kStretched;
  VectorCase rare =
      patches("drawn_rare_f32_66x60", "drawn heights beside corrections of samples", 66, 60);
  rare.values = samples::FewValues::kRare;
  VectorCase joint =
      patches("drawn_joint_index_50x41_30x20", "drawn heights beside a texture, index", 50, 41);
  joint.texture = Recipe{Pattern::kRidges, 30, 20, 3, TKS_U8, 7};
  joint.options = indexed(lossless());
  VectorCase copied =
      patches("drawn_copies_u8_127x101", "drawn heights whose lines repeat", 64, 51);
  copied.copies[0] = copied.copies[1] = 2;
  return {patches("drawn_u8_70x53", "drawn heights", 70, 53),
          patches("drawn_long_u8_2x300", "drawn heights, two columns", 2, 300),
          withVoids(patches("drawn_coast_u8_64x51", "drawn heights beside voids", 64, 51),
                    samples::VoidShape::kCoast, 255),
          stretched,
          rare,
          joint,
          copied};
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
      heightsCase("water_corrected_f32_84x70", "flat areas beside corrections of samples",
                  {Pattern::kRidges, 84, 70, 1, TKS_F32}, lossless());
  tenths.gridless = true;
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

}  // namespace tetrakis::conformance
