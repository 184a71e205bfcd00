// SPDX-License-Identifier: Apache-2.0
// synthesizeSurface() makes sample meshes of any shape with their textures, as scanners make them:
// what is no terrain.
#pragma once

#include <array>
#include <cstdint>

#include "apps/tools/files/files.hpp"

namespace tetrakis::tools {

/// A smooth ball with bumps; the tube of a knot; a scan with limbs, holes and noise (docs/CLI.md).
enum class SynthSurfaceKind { kBlob, kKnot, kScan };

/// Their names, in order.
inline constexpr std::array<const char*, 3> kSynthSurfaces = {"blob", "knot", "scan"};

struct SynthSurfaceOptions {
  SynthSurfaceKind kind = SynthSurfaceKind::kBlob;
  uint32_t triangles = 20000;  ///< at least 20; about so many come, of a scan 13 000 or more
  uint64_t seed = 1;
};

/// The texture is RGB8 and square, of several charts; vertices on their borders come once for each.
/// The mesh does not name it.
struct SynthSurface {
  MeshFile mesh;
  ImageFile texture;
};

/// The same bytes from every compiler and machine with IEEE arithmetic. Oriented and manifold; a
/// blob is closed and of genus 0, a knot closed and of genus 1, a scan of genus `seed` mod 4 with
/// two holes or more.
SynthSurface synthesizeSurface(const SynthSurfaceOptions& options);

}  // namespace tetrakis::tools
