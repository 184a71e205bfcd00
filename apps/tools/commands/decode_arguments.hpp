// SPDX-License-Identifier: Apache-2.0
// DecodeArguments holds the arguments of `tetrakis decode`, and checkArguments() refuses arguments
// that contradict each other.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/tools/commands/options.hpp"

namespace tetrakis::tools {

struct DecodeArguments {
  StreamSource source;
  std::string height, texture, mesh, normal_map;
  std::string size;  ///< of heights for an engine (engine_heights.hpp); empty: as encoded
  bool json = false;
  uint32_t triangles = 0, level = 0;
  bool coded_mesh = false, turn_edges = false, globe = false;
  double exaggeration = 1;  ///< of heights on a globe
  MeshOptions mesh_options;
  CameraChoice camera;           ///< default: the whole mesh, for a map
  std::vector<uint32_t> window;  ///< x, y, width, height; empty: everything
  uint32_t threads = hardwareThreads();
  bool force = false;
};

/// For a file of its own, or on the mesh.
inline bool wantsTexture(const DecodeArguments& arguments) {
  return !arguments.texture.empty() || !arguments.mesh.empty();
}

void addArguments(CLI::App& verb, DecodeArguments& arguments);

/// TKS_USAGE if the outputs do not go together, or there is none.
Status checkArguments(const DecodeArguments& arguments);

}  // namespace tetrakis::tools
