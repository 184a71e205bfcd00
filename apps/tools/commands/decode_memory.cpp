// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/commands/decode_memory.hpp"

#include <algorithm>

#include "apps/tools/commands/decode_windows.hpp"
#include "apps/tools/files/cube_heights.hpp"

namespace tetrakis::tools {

Status DecodeMemory::check() {
  Status status;
  if (!arguments_.height.empty() && info_.has_heights) status = checkHeights();
  if (status.ok() && wantsTexture(arguments_) && info_.has_texture)
    status = check(TKS_PART_TEXTURE, textureWindow(arguments_, info_), texture());
  if (status.ok() && !arguments_.mesh.empty() && info_.has_heights) status = checkMesh();
  return status;
}

Status DecodeMemory::checkHeights(uint64_t beside) {
  const std::optional<tks_window> window = heightWindow(arguments_);
  if (window && isGridOnCube(info_)) return {};  // its parts of the cube are checked one by one
  return check(TKS_PART_HEIGHTS, window, heights() + beside);
}

Status DecodeMemory::checkMesh(uint64_t beside) {
  if (info_.object_triangles > 0) return checkMemoryFor("a mesh of triangles", mesh() + beside);
  const tks_part part = arguments_.coded_mesh ? TKS_PART_CODED_MESH : TKS_PART_BUDGET_MESH;
  return check(part, std::nullopt, mesh() + beside);
}

std::optional<uint64_t> DecodeMemory::textureBeside() {
  const std::optional<tks_window> texels = textureWindow(arguments_, info_);
  const Result<uint64_t> decoding =
      stream_.decoder.checkMemory(TKS_PART_TEXTURE, texels ? &*texels : nullptr);
  if (!decoding) return std::nullopt;
  // Its decoder takes the packets apart once more.
  const uint64_t bytes = *decoding + texture() + 4 * stream_.bytes.size();
  const bool fits = (arguments_.height.empty() || checkHeights(bytes).ok()) &&
                    (arguments_.mesh.empty() || checkMesh(bytes).ok());
  return fits ? std::optional(bytes) : std::nullopt;
}

uint64_t DecodeMemory::heights() const {
  return stream_.bytes.size() + 2 * heightsBytes(info_, heightWindow(arguments_));
}

uint64_t DecodeMemory::texture() const {
  const uint64_t in_mesh = arguments_.mesh.empty() ? 0 : 1;
  const uint64_t turned = arguments_.size.empty() ? 0 : 1;
  const uint64_t atlas = isObject(info_) ? 2 : 0;  // gutters make small patches larger
  return stream_.bytes.size() +
         (3 + in_mesh + turned + atlas) * imageBytes(info_, textureWindow(arguments_, info_));
}

uint64_t DecodeMemory::mesh() const {
  constexpr uint64_t kTriangle = 64;  // in space with half a vertex, and in the file's order
  constexpr uint64_t kDecodedTriangle = 300;
  constexpr uint64_t kSample = 16;  // of the surface that a camera is placed over
  const uint64_t samples = uint64_t{info_.width} * info_.height;
  if (info_.object_triangles > 0)
    return stream_.bytes.size() + (kDecodedTriangle + kTriangle) * info_.object_triangles;
  const bool all = arguments_.coded_mesh || arguments_.triangles == 0;
  const uint64_t triangles =
      all ? 2 * samples : std::min<uint64_t>(arguments_.triangles, 2 * samples);
  return stream_.bytes.size() + kTriangle * triangles +
         (arguments_.camera.isDefault() ? 0 : kSample * samples) +
         (info_.has_texture ? 3 * imageBytes(info_) : 0);
}

Status DecodeMemory::check(tks_part part, const std::optional<tks_window>& window,
                           uint64_t copies) {
  return stream_.decoder
      .checkMemory(part, window ? &*window : nullptr, arguments_.triangles, copies)
      .status();
}

}  // namespace tetrakis::tools
