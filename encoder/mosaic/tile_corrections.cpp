// SPDX-License-Identifier: Apache-2.0
// codeCorrections() codes the corrections of a tile.
#include <atomic>
#include <cassert>
#include <cstddef>
#include <span>
#include <utility>

#include "base/parallel.hpp"
#include "base/samples.hpp"
#include "codec/geometry/coding_choice/cuts.hpp"
#include "codec/geometry/corrections/corrections_encoder.hpp"
#include "codec/geometry/plane_corrections.hpp"
#include "codec/geometry/quantiser/height_steps.hpp"
#include "encoder/mosaic/restored_plane.hpp"

namespace tetrakis::inline mosaic {

namespace {

/// The tile of a source beside what decoders have of it.
struct RestoredTile {
  const MosaicPlan& plan;
  Window window;
  tks_heights heights;
  HeightSteps steps;  ///< of the samples; where corrections are of samples, of the restored ones
  DecodedGeometry restored;
};

/// The corrections of a region, and the squared steps that they find and leave.
struct RegionCorrections {
  std::vector<uint8_t> codeword;
  double before = 0, after = 0;
};

RegionCorrections correctSteps(const RestoredTile& tile, const Window& region) {
  const auto largest = static_cast<int32_t>((tile.plan.header.layers.correction_step - 1) / 2);
  const Window whole{0, 0, tile.window.width, tile.window.height};
  Corrected corrected =
      correct(tile.steps, whole.width, {tile.restored, whole, {&region, 1}}, largest, 1);
  if (!corrected.any) return {{}, corrected.before, corrected.before};
  return {std::move(corrected.codewords.front()), corrected.before, corrected.after};
}

/// Nobody counts the squares: regions share by their bytes.
RegionCorrections correctSamples(const RestoredTile& tile, std::span<const int32_t> corrections,
                                 const Window& region) {
  const Extent extent = tile.window.extent();
  const DecodedGeometry& restored = tile.restored;
  const WindowValues<int32_t> heights(restored.heights, extent, region),
      numbers(corrections, extent, region);
  const WindowValues<uint8_t> valid(restored.valid, extent, region);
  const std::vector<uint8_t> hints =
      sampleHints(heights.values(), restored.fraction_bits, tile.plan.geometry());
  RegionCorrections out;
  out.codeword = encodeCorrections(numbers.values(), {hints, region.extent(), valid.values()});
  out.before = static_cast<double>(out.codeword.size());
  return out;
}

/// The regions of the tile, from its first sample on.
std::vector<Window> regionsIn(const TaskInputs& inputs, const Window& window) {
  std::vector<Window> regions;
  const GeometryHeader& header = inputs.plan.geometry();
  for (Window region : correctionParts(header)) {
    if (!region.meets(window)) continue;
    region.x -= window.x;
    region.y -= window.y;
    regions.push_back(region);
  }
  return regions;
}

std::vector<RegionCorrections> correctAll(const RestoredTile& tile,
                                          const std::vector<Window>& regions, uint32_t threads) {
  const bool of_samples = tile.plan.header.layers.restoresSamples();
  const std::vector<int32_t> corrections =
      of_samples ? sampleCorrections(tile.heights, tile.steps) : std::vector<int32_t>();
  std::vector<RegionCorrections> all(regions.size());
  parallelFor(threads, regions.size(), [&](size_t i) {
    all[i] =
        of_samples ? correctSamples(tile, corrections, regions[i]) : correctSteps(tile, regions[i]);
  });
  return all;
}

/// The samples that decoders make of the tile.
std::vector<std::byte> decodedSamples(const TaskInputs& inputs, const RestoredTile& tile,
                                      const std::vector<RegionCorrections>& corrections) {
  const GeometryHeader& header = inputs.plan.geometry();
  const uint32_t coefficient_tracks = static_cast<uint32_t>(inputs.grid.regions().size());
  TakenLayers taken{header, inputs.plan.header.layers};
  taken.corrections.resize(correctionTracks(header, inputs.plan.header.layers));
  const std::vector<uint32_t> numbers = inputs.grid.tracks(inputs.tile);
  for (size_t i = 0; i < numbers.size(); ++i)
    taken.corrections[numbers[i] - coefficient_tracks] = corrections[i].codeword;
  const DecodedHeights decoded =
      corrected({tile.restored, {}}, taken, {0, tile.window}, {inputs.threads, nullptr});
  std::vector<std::byte> samples(tile.window.extent().samples() *
                                 tks_sample_bytes(tile.heights.sample));
  fromSteps(decoded, header, inputs.plan.header.layers, samples.data());
  return samples;
}

/// Whether decoded samples keep what the plan promises.
bool isKept(const RestoredTile& tile, const std::vector<std::byte>& decoded) {
  const Promise promise(tile.plan);
  const Mask valid = tile.restored.valid;
  return withSampleType(tile.heights.sample, [&](auto type) {
    using T = decltype(type);
    const auto* samples = static_cast<const T*>(tile.heights.data);
    const auto* restored = reinterpret_cast<const T*>(decoded.data());
    for (size_t i = 0; i < tile.window.extent().samples(); ++i)
      if (valid[i] && !promise.isKept(samples[i], restored[i])) return false;
    return true;
  });
}

/// The steps that the samples are, or those that decoders have.
Result<HeightSteps> stepsFor(const TaskInputs& inputs, const tks_heights& heights,
                             const DecodedGeometry& restored) {
  HeightSteps steps;
  steps.valid = restored.valid;
  steps.base = inputs.plan.geometry().base;
  steps.step = inputs.plan.geometry().step;
  if (inputs.plan.header.layers.restoresSamples()) {
    steps.steps = wholeSteps(restored);
    return steps;
  }
  Result<std::vector<int32_t>> scaled =
      stepsOf(inputs.plan, heights, restored.valid, inputs.grid.samples(inputs.tile));
  if (!scaled.ok()) return scaled.status();
  steps.steps = *std::move(scaled);
  for (int32_t& q : steps.steps) q >>= restored.fraction_bits;
  return steps;
}

}  // namespace

Result<std::vector<EncodedTrack>> codeCorrections(const TaskInputs& inputs,
                                                  DecodedGeometry restored) {
  const Window window = inputs.grid.samples(inputs.tile);
  const Result<std::vector<std::byte>> samples = readWindow(inputs, window);
  if (!samples.ok()) return samples.status();
  const tks_heights heights = heightsOf(inputs.plan, window, samples->data());
  Result<HeightSteps> steps = stepsFor(inputs, heights, restored);
  if (!steps.ok()) return steps.status();
  const RestoredTile tile{inputs.plan, window, heights, *std::move(steps), std::move(restored)};
  const std::vector<Window> regions = regionsIn(inputs, window);
  std::vector<RegionCorrections> corrections = correctAll(tile, regions, inputs.threads);
  if (!isKept(tile, decodedSamples(inputs, tile, corrections)))
    return Status(TKS_MISMATCH, "A tile of the mosaic does not come back: a fault of the encoder.");
  std::vector<EncodedTrack> tracks;
  for (RegionCorrections& one : corrections) {
    EncodedTrack track{std::move(one.codeword), {{0, one.before}}, inputs.plan.geometry().planes};
    if (!track.codeword.empty()) track.points.push_back({track.codeword.size(), one.after});
    tracks.push_back(std::move(track));
  }
  return tracks;
}

}  // namespace tetrakis::inline mosaic
