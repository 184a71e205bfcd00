// SPDX-License-Identifier: Apache-2.0
// synthesize() makes sample terrain of several kinds, by default eroded mountains with a lake, a
// farmed plain and a coast, and its aerial photograph and map.
#pragma once

#include <array>
#include <cstdint>

#include "apps/tools/files/files.hpp"

namespace tetrakis::tools {

/// What terrain models are like that give codecs something to do (docs/CLI.md).
enum class SynthKind {
  kMountains,
  kCoast,
  kLakes,
  kSteps,
  kVoids,
  kPlain,
  kCity,
  kRescaled,
  kBands,
  kGeoid,
  kMosaic,
  kTurned,
  kFacets,
  kSmooth
};

/// Their names, in order.
inline constexpr std::array<const char*, 14> kSynthKinds = {
    "mountains", "coast", "lakes", "steps",  "voids",  "plain",  "city",
    "rescaled",  "bands", "geoid", "mosaic", "turned", "facets", "smooth"};

struct SynthOptions {
  uint32_t size = 513;  ///< samples along a side, at least 2
  uint64_t seed = 1;
  SynthKind kind = SynthKind::kMountains;
};

/// heights: size x size samples, 30 m apart (a city's 1 m): TKS_U16 in steps of 0.1 m (a plain's of
/// 0.01 m, turned ones of 1 m), steps, voids, rescaled, geoid, mosaic, facets and smooth TKS_F32 in
/// metres; the sea is 0 and each lake one level.
/// texture and map: RGB8 of 2 (size - 1) texels a side over the same footprint.
struct SynthTerrain {
  HeightFile heights;
  ImageFile texture, map;
};

/// The same bytes from every compiler and machine with IEEE arithmetic. Needs about 100 bytes of
/// memory a sample while it works, and all processors.
SynthTerrain synthesize(const SynthOptions& options);

}  // namespace tetrakis::tools
