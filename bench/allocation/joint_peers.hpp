// SPDX-License-Identifier: Apache-2.0
// What a user would send instead of one stream: heights and texture as two files of other codecs,
// their bytes shared by an oracle that has seen the pictures of all splits.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "bench/allocation/joint_terrain.hpp"
#include "bench/meshes/decimation_peers.hpp"
#include "bench/meshes/screen.hpp"

namespace tetrakis::bench {

/// A texture of another codec, as decoded.
struct CodedTexels {
  uint64_t bytes = 0;
  tools::ImageFile image;
};

/// The best pair of files within some bytes.
struct PeerPair {
  double psnr = -std::numeric_limits<double>::infinity();
  uint64_t height_bytes = 0, texture_bytes = 0;
  uint32_t triangles = 0;
};

/// The files of one terrain; which terrain and screen outlive.
class JointPeers {
 public:
  /// Codes the texture as AVIF at rising qualities up to `most` bytes: in full, half and quarter
  /// size, of which those are kept whose pictures are the best of their bytes. speed: avifenc's.
  static Result<JointPeers> create(const Terrain& terrain, Screen& screen, uint64_t most,
                                   uint32_t speed);

  /// Heights as JPEG 2000 (OpenJPEG, 9/7) in what the texture leaves of the bytes.
  Result<PeerPair> grid(uint64_t bytes);

  /// Heights as a mesh of at most so many triangles: meshoptimizer, then Draco.
  Result<PeerPair> mesh(uint64_t bytes, uint32_t triangles = UINT32_MAX);

 private:
  JointPeers(const Terrain& terrain, Screen& screen, Raster raster)
      : terrain_(&terrain), screen_(&screen), raster_(std::move(raster)) {}

  Status codeTextures(uint64_t most, uint32_t speed);
  Status codeMeshes(uint32_t triangles);
  Result<double> psnrOfGrid(uint64_t bytes, const tools::ImageFile& texture, PeerPair& pair);

  const Terrain* terrain_;
  Screen* screen_;
  Raster raster_;
  GroundFrame steps_{};  ///< frame of the raster's steps
  double lowest_ = 0;    ///< height of the raster's step 0
  std::vector<CodedTexels> textures_;
  std::vector<uint32_t> coded_;    ///< numbers of triangles of which meshes_ has codings
  std::vector<CodedMesh> meshes_;  ///< none is worse than another in bytes, error and triangles
};

}  // namespace tetrakis::bench
