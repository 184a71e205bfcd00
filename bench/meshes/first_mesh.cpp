// SPDX-License-Identifier: Apache-2.0
#include "bench/meshes/first_mesh.hpp"

#include <algorithm>
#include <array>
#include <ctime>
#include <functional>
#include <span>
#include <vector>

#include "bench/harness/averages.hpp"
#include "bench/peers/openjpeg_peer.hpp"
#include "bench/peers/tetrakis_peer.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::bench {

namespace {

Status decodeMesh(std::span<const uint8_t> prefix) {
  tks_decoder* decoder = nullptr;
  tks_status status = tks_open(prefix.data(), prefix.size(), nullptr, &decoder, nullptr, 0);
  tks_mesh mesh = {};
  if (status == TKS_OK) status = tks_decode_mesh(decoder, TKS_MESH_BUDGET, kFirstTriangles, &mesh);
  tks_free_mesh(&mesh);
  tks_close(decoder);
  return status == TKS_OK ? Status() : Status(status, "The first bytes make no mesh.");
}

}  // namespace

Result<FirstMeshTimes> timeFirstMesh(const Raster& raster, int runs) {
  const auto stream = encodeTetrakis({&raster, nullptr}, kMoreBytes);
  if (!stream.ok()) return stream.status();
  const auto codestream = encodeOpenJpeg(raster, {raster.pixels() / 8, 6});
  if (!codestream.ok()) return codestream.status();
  const std::span<const uint8_t> bytes = *stream;
  const std::array<std::function<Status()>, 3> tasks = {
      [&] { return decodeMesh(bytes.first(std::min(kFirstBytes, bytes.size()))); },
      [&] { return decodeMesh(bytes); }, [&] { return decodeOpenJpeg(*codestream).status(); }};
  std::array<std::vector<double>, 3> milliseconds;
  for (int run = 0; run < runs; ++run)
    for (size_t i = 0; i < tasks.size(); ++i) {
      const std::clock_t start = std::clock();
      const Status status = tasks[i]();
      if (!status.ok()) return status;
      milliseconds[i].push_back(1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    }
  return FirstMeshTimes{median(milliseconds[0]), median(milliseconds[1]), median(milliseconds[2])};
}

}  // namespace tetrakis::bench
