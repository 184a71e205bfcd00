// SPDX-License-Identifier: Apache-2.0
// Heights of all types and sizes, beside voids and corrections.
#include "conformance/cases/case_builders.hpp"
#include "conformance/cases/cases.hpp"

namespace tetrakis::conformance {

std::vector<VectorCase> geometryCases() {
  VectorCase fine = heightsCase("fine_i32_budget_60x45", "32-bit heights; three fraction bits",
                                {Pattern::kRidges, 60, 45, 1, TKS_I32}, budget(1500));
  fine.gridless = true;
  VectorCase negative = heightsCase(
      "negative_i16_48x31", "negative heights, scale and offset; rounded to a max-error bound",
      {Pattern::kRidges, 48, 31, 1, TKS_I16}, maxError(3));
  negative.scale = 0.1;
  negative.offset = -400;
  return {
      heightsCase("tiny_2x2", "smallest surface: one band", {Pattern::kRidges, 2, 2, 1, TKS_I16},
                  lossless()),
      heightsCase("row_300x1", "one row: levels that split one side alone, to the end",
                  {Pattern::kRidges, 300, 1, 1, TKS_I16}, lossless()),
      heightsCase("column_1x300", "one column of floats, cut by a byte budget",
                  {Pattern::kRidges, 1, 300, 1, TKS_F32}, budget(400)),
      heightsCase("odd_3x17", "odd sizes; a side that is never split",
                  {Pattern::kRidges, 3, 17, 1, TKS_U16}, lossless()),
      heightsCase("flat_33x33", "no detail at all: no bit-planes",
                  {Pattern::kFlat, 33, 33, 1, TKS_U16}, lossless()),
      heightsCase("extreme_i16_17x17", "noise over the whole range: every bit-plane is used",
                  {Pattern::kNoise, 17, 17, 1, TKS_I16}, budget(500)),
      heightsCase("extreme_u8_9x20", "8-bit heights; long coefficients",
                  {Pattern::kNoise, 9, 20, 1, TKS_U8}, budget(190)),
      heightsCase("ramp_i8_20x60", "signed 8-bit heights on a slope",
                  {Pattern::kRamp, 20, 60, 1, TKS_I8}, lossless()),
      heightsCase("wide_u32_20x12", "32-bit unsigned heights",
                  {Pattern::kRidges, 20, 12, 1, TKS_U32}, lossless()),
      heightsCase("long_160x5", "long side: levels that split one side alone",
                  {Pattern::kRidges, 160, 5, 1, TKS_U16}, lossless()),
      heightsCase("hills_u16_80x70", "smooth ground: a filter that leaves no detail of it",
                  {Pattern::kHills, 80, 70, 1, TKS_U16}, budget(900)),
      heightsCase("hills_lossless_64x50", "smooth ground, cut and corrected",
                  {Pattern::kHills, 64, 50, 1, TKS_I16}, lossless()),
      heightsCase("steps_40x48", "walls and terraces, whose lines repeat: abrupt signs",
                  {Pattern::kSteps, 40, 48, 1, TKS_I32}, maxError(0.25)),
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
  VectorCase gridless =
      heightsCase("float_gridless_31x33", "floats that no step restores: corrections of samples",
                  {Pattern::kRidges, 31, 33, 1, TKS_F32}, lossless());
  gridless.gridless = true;
  VectorCase extreme = heightsCase("extreme_u32_16x15",
                                   "noise over the whole range of 32 bits, cut by a byte budget",
                                   {Pattern::kNoise, 16, 15, 1, TKS_U32}, budget(700));
  VectorCase wide = heightsCase("extreme_float_14x19", "floats with wide sums and corrections",
                                {Pattern::kExtreme, 14, 19, 1, TKS_F32}, maxError(1e-9));
  wide.gridless = true;
  VectorCase both =
      heightsCase("coast_gridless_40x30", "NaN without a nodata value, and corrections of samples",
                  {Pattern::kRidges, 40, 30, 1, TKS_F32}, lossless());
  both.gridless = true;
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
                            {Pattern::kRidges, 18, 9, 1, TKS_I16}, maxError(0.25)),
                VoidShape::kChecker, -1),
      withVoids(heightsCase("nothing_valid_12x7", "voids only",
                            {Pattern::kRidges, 12, 7, 1, TKS_F32}, lossless()),
                VoidShape::kAll, NAN),
      withVoids(both, VoidShape::kCoast, NAN),
      gridless,
      extreme,
      wide,
      heightsCase("bounded_64x64", "corrections of steps within a max-error bound",
                  {Pattern::kRidges, 64, 64, 1, TKS_U16}, maxError(1500)),
      withVoids(
          heightsCase("coast_bounded_64x50", "validity, coefficients and corrections of steps",
                      {Pattern::kRidges, 64, 50, 1, TKS_I16}, maxError(1000)),
          VoidShape::kCoast, -32768),
      withVoids(heightsCase("coast_exact_64x50", "exact corrections behind a cut, beside voids",
                            {Pattern::kRidges, 64, 50, 1, TKS_I16}, budget(9000)),
                VoidShape::kCoast, -32768),
  };
}

/// Holes of single samples, over which the transform goes on, beside voids that it stops at.
std::vector<VectorCase> bridgeCases() {
  using samples::VoidShape;
  const auto holes = [](VectorCase vector_case, double nodata) {
    return withVoids(std::move(vector_case), VoidShape::kHoles, nodata);
  };
  VectorCase regions = heightsCase("holes_regions_u16_120x90", "bridged voids, in regions",
                                   {Pattern::kRidges, 120, 90, 1, TKS_U16}, budget(5000));
  regions.options.regions = 32;
  return {
      holes(heightsCase("holes_i16_64x50", "bridged voids to the last bit",
                        {Pattern::kRidges, 64, 50, 1, TKS_I16}, lossless()),
            -32768),
      holes(heightsCase("holes_f32_91x70", "bridged voids and fraction bits",
                        {Pattern::kRidges, 91, 70, 1, TKS_F32}, budget(3000)),
            NAN),
      holes(heightsCase("holes_bounded_i16_64x50", "bridged voids and corrections of steps",
                        {Pattern::kRidges, 64, 50, 1, TKS_I16}, maxError(1500)),
            -32768),
      holes(regions, 0),
      withVoids(heightsCase("speckle_i16_60x44", "all voids are bridged: joint lifting",
                            {Pattern::kRidges, 60, 44, 1, TKS_I16}, lossless()),
                VoidShape::kSpeckle, -1),
      withVoids(heightsCase("late_u8_110x70", "a late mask to the last bit; all samples are lifted",
                            {Pattern::kRidges, 110, 70, 1, TKS_U8}, lossless()),
                VoidShape::kSpeckle, 3),
      withVoids(heightsCase("late_bounded_i16_110x70", "a late mask and corrections of steps",
                            {Pattern::kRidges, 110, 70, 1, TKS_I16}, maxError(900)),
                VoidShape::kSpeckle, -1),
      withVoids(heightsCase("late_budget_f32_110x70", "a late mask in a budget",
                            {Pattern::kRidges, 110, 70, 1, TKS_F32}, budget(2500)),
                VoidShape::kSpeckle, -1),
      withVoids(heightsCase("late_regions_u16_200x130", "a late mask, in regions",
                            {Pattern::kRidges, 200, 130, 1, TKS_U16}, inRegions(budget(9000), 32)),
                VoidShape::kSpeckle, 0),
  };
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
  tiny.gridless = true;
  VectorCase spikes = heightsCase("spikes_300x300", "a large plain with few spikes: header level 1",
                                  {Pattern::kFlat, 300, 300, 1, TKS_I16}, budget(4096));
  spikes.spikes = 6007;
  return {
      declared(heightsCase("nodata_unused_u8_64x48", "a nodata value is declared, nothing is void",
                           {Pattern::kRidges, 64, 48, 1, TKS_U8}, budget(900)),
               175),
      declared(heightsCase("nodata_beyond_u8_20x20", "a nodata value that the type does not have",
                           {Pattern::kRidges, 20, 20, 1, TKS_U8}, budget(4096)),
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

}  // namespace tetrakis::conformance
