// SPDX-License-Identifier: Apache-2.0
// Tasks that restore planes and correct them: decoders of the whole plane get the samples that the
// plan promises.
#include <gtest/gtest.h>

#include <cstdlib>
#include <vector>

#include "codec/geometry/heights_decoder.hpp"
#include "codec/wavelet/lifting/lifting_kernel.hpp"
#include "encoder/mosaic/merge.hpp"
#include "encoder/mosaic/tile.hpp"
#include "tests/support/mosaic_memory.hpp"
#include "tests/support/mosaic_plane.hpp"

namespace tetrakis::test {
namespace {

/// How a plan cuts and corrects.
struct CutCase {
  double slope;
  CorrectionKind kind = CorrectionKind::kSteps;
  int32_t largest = 0;
};

MosaicPlan planOf(const WholePlane& whole, const CutCase& cut) {
  MosaicPlan plan = whole.plan();
  plan.cut_slope = cut.slope;
  plan.header.geometry->planes = 26;
  plan.header.layers.corrections = cut.kind;
  if (cut.kind == CorrectionKind::kSteps)
    plan.header.layers.correction_step = static_cast<uint32_t>(2 * cut.largest + 1);
  if (cut.largest == 0) return plan;
  plan.header.lossless = 0;
  plan.target.bounded = true;
  plan.header.geometry->max_error = cut.largest;
  return plan;
}

struct MadeTracks {
  std::vector<std::vector<uint8_t>> codewords;
  uint64_t mask_bytes = 0;  ///< of the first
};

/// The codewords of all tracks, as the merge lays them out.
MadeTracks runAll(const MosaicPlan& plan, const WholePlane& whole, MosaicMemory& memory) {
  const MosaicGrid grid = plan.grid();
  const MosaicFiles files = memory.storage();
  MadeTracks made;
  made.codewords.resize(grid.regions().size() +
                        correctionTracks(plan.geometry(), plan.header.layers));
  for (const Tile& tile : grid.tiles()) {
    const Status status = runTask(plan, tile, whole.reader(), files, 2);
    EXPECT_TRUE(status.ok()) << status.message();
    const Result<PartTable> table = readTable(files, hashOf(plan), tile);
    EXPECT_TRUE(table.ok());
    if (!table.ok()) return made;
    if (grid.isBase(tile)) made.mask_bytes = table->tracks.front().opening;
    const std::vector<uint32_t> tracks = grid.tracks(tile);
    for (size_t i = 0; i < tracks.size(); ++i)
      made.codewords[tracks[i]] = *readCodeword(files, tile, table->tracks[i]);
  }
  return made;
}

/// The whole steps that a decoder has.
std::vector<int32_t> decoded(const MosaicPlan& plan, const MadeTracks& made, const View& view) {
  GeometryHeader header = plan.geometry();
  GeometryLayers layers = plan.header.layers;
  layers.validity_bytes = made.mask_bytes;
  layers.coefficient_bytes = made.codewords.front().size() - made.mask_bytes;
  Codewords spans(made.codewords.begin(), made.codewords.end());
  const DecodedHeights heights = decodeHeights(header, layers, spans, view);
  std::vector<int32_t> steps = wholeSteps(heights.geometry);
  for (size_t i = 0; i < heights.corrections.size(); ++i) steps[i] += heights.corrections[i];
  return steps;
}

void expectKept(const TileCase& given, const CutCase& cut) {
  const WholePlane whole(given);
  const MosaicPlan plan = planOf(whole, cut);
  MosaicMemory memory;
  const std::vector<int32_t> steps = decoded(plan, runAll(plan, whole, memory), {});
  const Mask valid = whole.valid();
  ASSERT_EQ(steps.size(), whole.values().size());
  for (size_t i = 0; i < steps.size(); ++i) {
    if (!valid[i]) continue;
    ASSERT_LE(std::abs(steps[i] - whole.values()[i]), cut.largest)
        << "filter " << +given.filter << ", sample " << i << " of " << given.plane.width << " x "
        << given.plane.height << ", slope " << cut.slope;
  }
}

TEST(MosaicCorrections, RestoreAllStepsOfAllFilters) {
  for (uint8_t filter = 0; filter < kFilters; ++filter) {
    for (const bool voids : {false, true}) {
      for (const double slope : {voids ? 1e4 : 1e-3, 2.}) {
        expectKept({.plane = {270, 310},
                    .region_log2 = 5,
                    .tile_log2 = 7,
                    .filter = filter,
                    .fraction_bits = 3,
                    .voids = voids},
                   {slope});
      }
    }
  }
}

TEST(MosaicCorrections, KeepALargestErrorOfAllFilters) {
  for (uint8_t filter = 0; filter < kFilters; ++filter) {
    for (const bool voids : {false, true}) {
      expectKept({.plane = {431, 300},
                  .region_log2 = 5,
                  .tile_log2 = 7,
                  .filter = filter,
                  .fraction_bits = 4,
                  .voids = voids},
                 {3., CorrectionKind::kSteps, 1 + filter});
    }
  }
}

TEST(MosaicCorrections, RestoreWildValuesWithoutFractions) {
  for (uint8_t filter = 0; filter < kFilters; ++filter) {
    for (const double slope : {0., 1e9}) {
      expectKept({.plane = {300, 233},
                  .region_log2 = 5,
                  .tile_log2 = 7,
                  .filter = filter,
                  .low = -(1 << 20),
                  .high = 1 << 20,
                  .wild = true},
                 {slope, slope == 0 ? CorrectionKind::kSamples : CorrectionKind::kSteps});
    }
  }
}

TEST(MosaicCorrections, RestorePlanesOfAnySize) {
  for (const Extent plane : {Extent{5, 600}, Extent{600, 2}, Extent{33, 33}, Extent{700, 40},
                             Extent{257, 255}, Extent{520, 300}}) {
    for (const bool voids : {false, true}) {
      expectKept({.plane = plane,
                  .region_log2 = 4,
                  .tile_log2 = 7,
                  .filter = 3,
                  .fraction_bits = 2,
                  .voids = voids},
                 {5.});
    }
  }
}

TEST(MosaicCorrections, NeedWhatTheyRead) {
  const WholePlane whole({.plane = {600, 420}, .region_log2 = 5, .tile_log2 = 7, .voids = true});
  const MosaicPlan plan = planOf(whole, {4.});
  const MosaicGrid grid = plan.grid();
  MosaicMemory all;
  runAll(plan, whole, all);
  for (const Tile& tile : grid.tiles()) {
    if (!grid.isRestoring(tile)) continue;
    // The masks of low bands are read as well, which all coded tiles have left.
    MosaicMemory some;
    for (const auto& [name, bytes] : all.files)
      if (name.ends_with(".low")) some.files[name] = bytes;
    for (const Tile& before : grid.tiles())
      if (grid.isRestoring(before) && grid.leavesLow(before)) some.files.erase(lowName(before));
    for (const Tile& needed : grid.needs(tile)) {
      some.files[partName(needed)] = all.files[partName(needed)];
      if (grid.leavesLow(needed)) some.files[lowName(needed)] = all.files[lowName(needed)];
    }
    ASSERT_TRUE(runTask(plan, tile, whole.reader(), some.storage(), 1).ok());
    ASSERT_EQ(some.files[partName(tile)], all.files[partName(tile)]);
    for (const Tile& needed : grid.needs(tile)) {
      MosaicMemory fewer = some;
      fewer.files.erase(grid.isRestoring(needed) ? lowName(needed) : partName(needed));
      const Status status = runTask(plan, tile, whole.reader(), fewer.storage(), 1);
      ASSERT_EQ(status.code(), TKS_IO);
    }
  }
}

TEST(MosaicCorrections, PlansWithoutThemHaveNoCut) {
  const WholePlane whole({.plane = {700, 420}, .region_log2 = 5, .tile_log2 = 6});
  MosaicPlan plan = whole.plan();
  EXPECT_TRUE(readPlan(writePlan(plan)).ok());
  plan.cut_slope = 1;
  EXPECT_EQ(readPlan(writePlan(plan)).status().code(), TKS_CORRUPT);
  const MosaicPlan cut = planOf(whole, {1.5});
  const Result<MosaicPlan> read = readPlan(writePlan(cut));
  ASSERT_TRUE(read.ok());
  EXPECT_EQ(read->cut_slope, 1.5);
  EXPECT_TRUE(read->corrects());
}

}  // namespace
}  // namespace tetrakis::test
