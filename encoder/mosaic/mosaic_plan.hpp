// SPDX-License-Identifier: Apache-2.0
// MosaicPlan is all that the tasks of a mosaic agree on before the first of them runs: the header
// of the stream to come, the size of the tiles, and the target. MosaicFiles is the storage that
// tasks exchange parts by.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "bitstream/stream/header.hpp"
#include "encoder/mosaic/mosaic_grid.hpp"
#include "tetrakis/result.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::inline mosaic {

/// How much of the coded heights the stream will hold.
struct MosaicTarget {
  uint64_t bytes = UINT64_MAX;  ///< of the whole stream, at most
  double mean_square = 0;       ///< > 0: error, in squared steps, that is enough
  bool bounded = false;         ///< every sample is within GeometryHeader::max_error; 0: exact

  bool operator==(const MosaicTarget&) const = default;
};

struct MosaicPlan {
  /// That of the stream, but for the bytes of what the tasks will code. Of heights with voids
  /// layers.validity_bytes is not 0, and if there are regions they have masks.
  StreamHeader header;
  int tile_log2 = kUsualTileLog2;
  MosaicTarget target;
  /// The squared steps that a byte takes off at least; coefficients are cut where it would take off
  /// fewer. All tasks have the same, so that none has to know of the others. 0: there is no cut.
  double cut_slope = 0;

  const GeometryHeader& geometry() const { return *header.geometry; }
  bool hasVoids() const { return header.layers.validity_bytes > 0; }
  /// Corrections follow the coefficients.
  bool corrects() const { return header.layers.corrections != CorrectionKind::kNone; }
  MosaicGrid grid() const {
    return {geometry().extent(), geometry().regions.side_log2, tile_log2, corrects()};
  }
};

/// The bytes that tasks read a plan from. Two plans with the same bytes make the same stream of one
/// source.
std::vector<uint8_t> writePlan(const MosaicPlan& plan);

/// TKS_CORRUPT: they are no plan, or damaged. TKS_UNSUPPORTED: a plan of another version.
Result<MosaicPlan> readPlan(std::span<const uint8_t> bytes);

/// By which parts are told from those of other plans.
uint32_t hashOf(const MosaicPlan& plan);

/// The place that tasks exchange parts by, each under a name. The functions are called on the
/// thread of the task and answer TKS_IO if they fail.
struct MosaicFiles {
  /// Bytes of a file from an offset on: all that are asked for, or as many as there are.
  std::function<Result<std::vector<uint8_t>>(const std::string& name, uint64_t offset,
                                             uint64_t bytes)>
      read;
  /// Makes a file of these bytes. Others never see a part of it.
  std::function<Status(const std::string& name, std::span<const uint8_t> bytes)> write;
};

/// Reads samples of the heights into an array, row by row, of the type that the plan states.
using ReadSamples = std::function<Status(const Window& window, void* samples)>;

/// Names of what the task of a tile leaves: its tracks, and the low band for the next group.
std::string partName(const Tile& tile);
std::string lowName(const Tile& tile);

}  // namespace tetrakis::inline mosaic
