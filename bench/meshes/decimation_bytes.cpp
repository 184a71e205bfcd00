// SPDX-License-Identifier: Apache-2.0
// Streams cut to the error of the peers' meshes; see decimation_quality.hpp.
#include <algorithm>
#include <cmath>
#include <memory>
#include <span>

#include "bench/meshes/decimation_quality.hpp"
#include "bench/peers/tetrakis_peer.hpp"

namespace tetrakis::bench {
namespace {

using Bytes = std::vector<uint8_t>;

/// Part of the error that the cut alone may make: the rest is the mesh's.
constexpr double kShare = 0.995;

Result<std::vector<float>> surfaceOf(std::span<const uint8_t> prefix) {
  Result<DecodedStream> decoded = decodeTetrakis(prefix);
  if (!decoded.ok()) return decoded.status();
  return std::move(decoded->surface);
}

double surfaceRmse(const Raster& raster, const std::vector<float>& surface) {
  return std::sqrt(meanSquaredError(raster, surface)) * raster.unit;
}

/// The shortest prefix whose surface errs by at most `goal`, by halving.
Result<std::span<const uint8_t>> shortestPrefix(const Raster& raster, const Bytes& stream,
                                                double goal) {
  size_t low = 0, high = stream.size();  // too short, long enough
  while (high - low > 1 + high / 1000) {
    const size_t middle = (low + high) / 2;
    const Result<std::vector<float>> surface = surfaceOf(std::span(stream).first(middle));
    if (!surface.ok() && surface.status().code() != TKS_TRUNCATED) return surface.status();
    (surface.ok() && surfaceRmse(raster, *surface) <= goal ? high : low) = middle;
  }
  return std::span(stream).first(high);
}

/// What tks_decode_mesh gives.
Result<PlanMesh> budgetMesh(std::span<const uint8_t> prefix, uint32_t triangles, double unit) {
  tks_decoder* handle = nullptr;
  const tks_status opened = tks_open(prefix.data(), prefix.size(), nullptr, &handle, nullptr, 0);
  if (opened != TKS_OK) return Status(opened, "A prefix of a stream does not open.");
  const std::unique_ptr<tks_decoder, decltype(&tks_close)> decoder(handle, &tks_close);
  tks_info info{};
  info.size = sizeof(info);
  tks_mesh mesh{};
  tks_status code = tks_get_info(handle, &info);
  if (code == TKS_OK) code = tks_decode_mesh(handle, TKS_MESH_BUDGET, triangles, &mesh);
  if (code != TKS_OK) return Status(code, tks_message(handle));
  PlanMesh out;
  for (uint32_t i = 0; i < mesh.vertex_count; ++i)
    out.positions.push_back({static_cast<float>(mesh.grid_index[i] % info.width),
                             static_cast<float>(mesh.grid_index[i] / info.width),
                             static_cast<float>(mesh.height[i] / unit)});
  out.triangles.assign(mesh.triangles, mesh.triangles + size_t{3} * mesh.triangle_count);
  tks_free_mesh(&mesh);
  return out;
}

/// A budget mesh and what it errs by.
struct JudgedMesh {
  uint32_t triangles = 0;
  double rmse = 0;
};

/// The smallest budget, to 1 %, whose mesh errs by at most `goal`; all triangles if none does.
Result<JudgedMesh> smallestMesh(const Raster& raster, std::span<const uint8_t> prefix,
                                double goal) {
  const auto judge = [&](uint32_t budget) -> Result<JudgedMesh> {
    const auto mesh = budgetMesh(prefix, budget, raster.unit);
    if (!mesh.ok()) return mesh.status();
    return JudgedMesh{static_cast<uint32_t>(mesh->triangleCount()), rmse(*mesh, raster)};
  };
  auto low = 2u, high = 2 * (raster.width - 1) * (raster.height - 1);
  Result<JudgedMesh> best = judge(high);
  while (best.ok() && high - low > 1 + high / 100) {
    const auto middle = std::max(static_cast<uint32_t>(std::sqrt(double{1} * low * high)), low + 1);
    Result<JudgedMesh> tried = judge(middle);
    if (!tried.ok()) return tried;
    if (tried->rmse > goal) {
      low = middle;
      continue;
    }
    high = middle;
    best = std::move(tried);
  }
  return best;
}

/// The cheapest coding of any peer's mesh that errs by at most `goal`.
struct Cheapest {
  uint64_t bytes = 0;
  uint32_t triangles = 0;
};
using Codings = std::vector<std::pair<uint32_t, CodedMesh>>;  ///< with the triangles

Cheapest cheapest(const Codings& codings, double goal) {
  Cheapest best;
  for (const auto& [triangles, coded] : codings)
    if (coded.rmse <= goal && (best.bytes == 0 || coded.bytes < best.bytes))
      best = {coded.bytes, triangles};
  return best;
}

}  // namespace

Result<std::vector<BytePoint>> comparedBytes(const Raster& raster,
                                             const std::vector<PeerMesh>& peers) {
  Codings codings;
  for (const PeerMesh& peer : peers) {
    const auto coded = dracoCodings(peer.mesh, raster);
    if (!coded.ok()) return coded.status();
    for (const CodedMesh& coding : *coded)
      codings.emplace_back(static_cast<uint32_t>(peer.mesh.triangleCount()),
                           CodedMesh{coding.bytes, coding.rmse, {}});
  }
  // Made for half the bits of lossless, cut everywhere below.
  const StreamSource source{&raster, nullptr};
  const auto stream = encodeTetrakis(source, raster.pixels() / 2);
  if (!stream.ok()) return stream.status();
  std::vector<BytePoint> points;
  for (const PeerMesh& peer : peers) {
    if (peer.peer != "delatin") continue;
    BytePoint point;
    point.budget = peer.budget;
    point.goal = 1.001 * rmse(peer.mesh, raster);
    const Cheapest best = cheapest(codings, point.goal);
    if (best.bytes == 0) continue;
    const auto prefix = shortestPrefix(raster, *stream, kShare * point.goal);
    if (!prefix.ok()) return prefix.status();
    const auto mesh = smallestMesh(raster, *prefix, point.goal);
    if (!mesh.ok()) return mesh.status();
    point.rmse = mesh->rmse;
    point.peer_bytes = best.bytes;
    point.peer_triangles = best.triangles;
    point.bytes = prefix->size();
    point.triangles = mesh->triangles;
    points.push_back(point);
  }
  return points;
}

}  // namespace tetrakis::bench
