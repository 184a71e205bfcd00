// SPDX-License-Identifier: Apache-2.0
#include "encoder/mosaic/mosaic_plan.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "encoder/mosaic/part.hpp"

namespace tetrakis::inline mosaic {

namespace {

constexpr std::array<uint8_t, 4> kPlanMagic = {'T', 'K', 'M', 0x1a};
constexpr uint8_t kPlanVersion = 3;

}  // namespace

std::vector<uint8_t> writePlan(const MosaicPlan& plan) {
  ByteWriter out;
  out.append(kPlanMagic);
  out.number<uint8_t>(kPlanVersion);
  out.number(static_cast<uint8_t>(plan.tile_log2));
  out.number(plan.target.bytes);
  out.number(plan.target.mean_square);
  out.number<uint8_t>(plan.target.bounded);
  out.number(plan.cut_slope);
  out.append(writeHeader(plan.header));
  return std::move(out).sealed();
}

Result<MosaicPlan> readPlan(std::span<const uint8_t> bytes) {
  const Status corrupt(TKS_CORRUPT, "It is no plan of a mosaic, or damaged.");
  if (bytes.size() < kPlanMagic.size() + 1 ||
      !std::equal(kPlanMagic.begin(), kPlanMagic.end(), bytes.begin()))
    return corrupt;
  if (bytes[kPlanMagic.size()] != kPlanVersion)
    return Status(TKS_UNSUPPORTED, "It is the plan of a mosaic of another version.");
  ByteReader in = ByteReader::unsealed(bytes);
  MosaicPlan plan;
  in.take(kPlanMagic.size() + 1);
  plan.tile_log2 = in.number<uint8_t>();
  plan.target.bytes = in.number<uint64_t>();
  plan.target.mean_square = in.number<double>();
  plan.target.bounded = in.number<uint8_t>() != 0;
  plan.cut_slope = in.number<double>();
  if (!in.ok()) return corrupt;
  Result<ParsedHeader> header = readHeader(in.rest());
  if (!header.ok() || !header->header.geometry) return corrupt;
  plan.header = std::move(header->header);
  const int region_log2 = plan.geometry().regions.side_log2;
  const bool tiled = plan.tile_log2 >= std::max(region_log2, kLeastRegionLog2) &&
                     plan.tile_log2 <= kMostRegionLog2;
  const bool masked = plan.header.layers.region_masks == (plan.hasVoids() && region_log2 > 0);
  if (!tiled || !masked || plan.header.texture || plan.geometry().direct()) return corrupt;
  const bool followed = plan.cut_slope == 0 || plan.corrects();
  if (!followed || !(plan.cut_slope >= 0) || (plan.corrects() && region_log2 == 0)) return corrupt;
  return plan;
}

uint32_t hashOf(const MosaicPlan& plan) {
  // The seal: the checksum of all bytes, seal included, would be the same for every plan.
  const std::vector<uint8_t> bytes = writePlan(plan);
  return ByteReader(std::span(bytes).last(sizeof(uint32_t))).number<uint32_t>();
}

namespace {

std::string nameOf(const Tile& tile, const char* ending) {
  std::string name = "g";
  name += std::to_string(tile.group);
  name += "-x" + std::to_string(tile.column);
  name += "-y" + std::to_string(tile.row);
  return name + ending;
}

}  // namespace

std::string partName(const Tile& tile) {
  return nameOf(tile, ".part");
}

std::string lowName(const Tile& tile) {
  return nameOf(tile, ".low");
}

}  // namespace tetrakis::inline mosaic
