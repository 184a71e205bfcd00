// SPDX-License-Identifier: Apache-2.0
// What a stream as a whole may hold: both components, stored samples, regions, priorities, a place
// on the ground; and damage.
#include "conformance/cases/case_builders.hpp"
#include "conformance/cases/cases.hpp"

namespace tetrakis::conformance {

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

/// Noise, which takes fewer bytes stored than coded.
std::vector<VectorCase> storedCases() {
  VectorCase gridless = heightsCase(
      "wide_f32_voids_20x21", "noise of floats beside voids: wide sums, corrections of samples",
      {Pattern::kNoise, 20, 21, 1, TKS_F32}, lossless());
  gridless.gridless = true;
  return {heightsCase("stored_i16_17x19", "heights that are stored",
                      {Pattern::kNoise, 17, 19, 1, TKS_I16}, maxError(0.25)),
          withVoids(gridless, samples::VoidShape::kSpeckle, NAN),
          textureCase("stored_rgb_15x13", "a texture that is stored",
                      {Pattern::kNoise, 15, 13, 3, TKS_U8}, lossless()),
          textureCase("stored_grey_alpha16_14x15", "samples of two bytes, stored",
                      {Pattern::kNoise, 14, 15, 2, TKS_U16}, lossless())};
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
      heightsCase("regions_coast_gridless_60x41", "regions beside validity and corrections",
                  {Pattern::kRidges, 60, 41, 1, TKS_F32}, inRegions(lossless(), 16));
  corrected.gridless = true;
  return {
      heightsCase("regions_groups_200x70", "two groups of regions below the base",
                  {Pattern::kSteps, 200, 70, 1, TKS_U8}, inRegions(budget(1500), 16)),
      heightsCase("regions_long_150x9", "regions side by side; a last one that is longer",
                  {Pattern::kRidges, 150, 9, 1, TKS_I16}, inRegions(lossless(), 32)),
      joint,
      budgeted,
      withVoids(corrected, samples::VoidShape::kCoast, NAN),
      withVoids(heightsCase("regions_coast_bounded_64x50", "corrections of steps, of regions",
                            {Pattern::kRidges, 64, 50, 1, TKS_I16}, inRegions(maxError(1000), 16)),
                samples::VoidShape::kCoast, -32768)};
}

/// Columns that go round: an even number of them at several levels, and odd ones.
std::vector<VectorCase> cylinderCases() {
  const auto round = [](VectorCase vector_case) {
    vector_case.ring = true;
    return vector_case;
  };
  VectorCase joint =
      heightsCase("cylinder_joint_70x33_61x40", "cylinders of heights and texture, in regions",
                  {Pattern::kRidges, 70, 33, 1, TKS_I16}, indexed(inRegions(lossless(), 16)));
  joint.texture = Recipe{Pattern::kRidges, 61, 40, 3, TKS_U8, 7};
  return {round(heightsCase("cylinder_80x45", "a cylinder: 80, 40, 20, 10, 5 and 3 columns",
                            {Pattern::kRidges, 80, 45, 1, TKS_I16}, lossless())),
          round(heightsCase("cylinder_odd_75x38", "a cylinder: 75, 38, 19 and 10 columns",
                            {Pattern::kRidges, 75, 38, 1, TKS_I16, 5}, budget(1500))),
          round(heightsCase("cylinder_smooth_61x40", "a cylinder of smooth ground",
                            {Pattern::kHills, 61, 40, 1, TKS_U16}, lossless())),
          round(withVoids(heightsCase("cylinder_coast_53x40", "a cylinder with voids at its seam",
                                      {Pattern::kRidges, 53, 40, 1, TKS_I16}, lossless()),
                          samples::VoidShape::kCoast, -32768)),
          round(withWater(heightsCase("cylinder_water_117x80", "a cylinder with flat areas",
                                      {Pattern::kRidges, 117, 80, 1, TKS_I16}, lossless()),
                          samples::VoidShape::kCoast)),
          round(textureCase("cylinder_texture_77x50", "a cylinder of a texture alone",
                            {Pattern::kRidges, 77, 50, 3, TKS_U8, 7}, budget(2500))),
          round(joint)};
}

/// Patches that have regions of their own.
std::vector<VectorCase> dividedForestCases() {
  const std::vector<uint32_t> cube(tks_cube_sides(), tks_cube_sides() + 24),
      octahedron = {5, 4, 7, 6, 1, 0, 3, 2}, torus = {2, 3, 0, 1};
  const auto on = [](const std::vector<uint32_t>& sides, VectorCase vector_case) {
    vector_case.sides = sides;
    return vector_case;
  };
  VectorCase joint =
      heightsCase("forest_regions_joint_33x66_65x130", "regions of heights and texture, index",
                  {Pattern::kRidges, 33, 66, 1, TKS_I16}, indexed(inRegions(budget(9000), 16)));
  joint.texture = Recipe{Pattern::kRidges, 65, 130, 3, TKS_U8, 7};
  return {on(cube, heightsCase("forest_regions_cube_33x198", "regions of the patches of a cube",
                               {Pattern::kRidges, 33, 198, 1, TKS_I16}, inRegions(lossless(), 16))),
          on(octahedron,
             heightsCase("forest_regions_bounded_65x130",
                         "corrections of steps, of the regions of patches",
                         {Pattern::kRidges, 65, 130, 1, TKS_I16}, inRegions(maxError(900), 32))),
          on(torus,
             heightsCase("forest_regions_groups_257x257", "two groups of regions of a patch",
                         {Pattern::kRidges, 257, 257, 1, TKS_U8, 40}, inRegions(budget(2500), 16))),
          on(octahedron, joint)};
}

/// Patches whose sides are glued: with turned sides, corners of one to five patches, borders.
std::vector<VectorCase> forestCases() {
  constexpr uint32_t kNone = TKS_BORDER;
  const std::vector<uint32_t> cube(tks_cube_sides(), tks_cube_sides() + 24),
      octahedron = {5, 4, 7, 6, 1, 0, 3, 2}, torus = {2, 3, 0, 1}, cone = {3, kNone, kNone, 0},
      star = {19,    kNone, kNone, 4,     3,     kNone, kNone, 8,     7,     kNone,
              kNone, 12,    11,    kNone, kNone, 16,    15,    kNone, kNone, 0};
  const auto on = [](const std::vector<uint32_t>& sides, VectorCase vector_case) {
    vector_case.sides = sides;
    return vector_case;
  };
  VectorCase joint = heightsCase("forest_joint_9x54_17x102", "a cube of heights and of texture",
                                 {Pattern::kRidges, 9, 54, 1, TKS_I16}, lossless());
  joint.texture = Recipe{Pattern::kRidges, 17, 102, 3, TKS_U8, 7};
  return {
      on(cube, heightsCase("forest_cube_17x102", "a cube: six of its twelve sides are turned",
                           {Pattern::kRidges, 17, 102, 1, TKS_I16}, lossless())),
      on(octahedron, heightsCase("forest_octahedron_33x66", "corners of two patches; fraction bits",
                                 {Pattern::kRidges, 33, 66, 1, TKS_I16}, budget(1500))),
      on(torus, heightsCase("forest_torus_33x33", "one patch beside itself; smooth ground",
                            {Pattern::kHills, 33, 33, 1, TKS_U16}, lossless())),
      on(cone, heightsCase("forest_cone_33x33", "one corner of a patch; corrections of steps",
                           {Pattern::kRidges, 33, 33, 1, TKS_I16, 5}, maxError(900))),
      on(star, heightsCase("forest_star_17x85", "five patches round a corner, and borders",
                           {Pattern::kRidges, 17, 85, 1, TKS_U8}, lossless())),
      on(cube, heightsCase("forest_smallest_3x18", "patches of nine samples",
                           {Pattern::kRidges, 3, 18, 1, TKS_I16}, lossless())),
      on(cube, withWater(heightsCase("forest_water_33x198", "a cube with flat areas across sides",
                                     {Pattern::kRidges, 33, 198, 1, TKS_I16}, lossless()),
                         samples::VoidShape::kCoast)),
      on(octahedron, withWater(heightsCase("forest_lake_65x130", "flat areas; fraction bits",
                                           {Pattern::kRidges, 65, 130, 1, TKS_I16}, budget(3000)),
                               samples::VoidShape::kCoast)),
      on(octahedron, textureCase("forest_texture_33x66", "a forest of a texture alone",
                                 {Pattern::kRidges, 33, 66, 3, TKS_U8, 7}, lossless())),
      on(cube, joint)};
}

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

/// The part of the header that says where things lie.
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

}  // namespace tetrakis::conformance
