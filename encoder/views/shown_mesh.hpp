// SPDX-License-Identifier: Apache-2.0
// ShownMesh draws the mesh that decoders will make of a prefix as heights of all samples, for the
// cameras to look at. With a triangle budget viewers see that mesh and not the heights (thesis 6.1:
// D(M_i, T_j)): an error that the triangles cannot show costs nothing, so bytes that lower it are
// better spent on the texture. If the caller names cameras the mesh is made for them, else for a
// map.
#pragma once

#include <optional>

#include "base/texels.hpp"
#include "base/view.hpp"
#include "codec/geometry/steps/decoded_heights.hpp"
#include "codec/mesh/screen/surface_picture.hpp"
#include "codec/mesh/surface/coarse_surface.hpp"
#include "codec/mesh/topology/lattice.hpp"
#include "codec/mesh/topology/lattice_mesh.hpp"
#include "encoder/heights/coded_heights.hpp"
#include "encoder/inputs/encode_inputs.hpp"
#include "ratecontrol/pictures/ground_rays.hpp"

namespace tetrakis::inline views {

/// Whether cameras look at meshes: there is a triangle budget, and there are neither voids nor a
/// table of values. The caller's renderer looks at full grids.
bool looksAtMeshes(const EncodeInputs& inputs, const QuantisedHeights& heights);

class ShownMesh {
 public:
  /// looksAtMeshes() holds. The inputs, the heights and the texels outlive this object.
  ShownMesh(const EncodeInputs& inputs, const QuantisedHeights& heights, const Texels& texels);

  /// The view of the heights that ofDecoded() takes.
  View view() const { return {static_cast<int>(level_), {}}; }

  /// The mesh as heights in metres at all samples; none if no mesh can be made.
  std::optional<Relief> ofDecoded(const DecodedGeometry& decoded) const;
  std::optional<Relief> ofOriginal() const;

 private:
  std::optional<Relief> forMap(CoarseSurface surface, uint32_t quiet, int fraction_bits) const;
  std::optional<Relief> forCameras(std::span<const int32_t> heights, int fraction_bits) const;
  Relief drawn(const LatticeMesh& mesh, std::span<const double> heights, int fraction_bits) const;

  /// Metres of a height in 2^-fraction_bits steps: at + by * height.
  struct Metres {
    double at, by;
  };
  Metres metresOf(int fraction_bits) const;

  const EncodeInputs& inputs_;
  const QuantisedHeights& heights_;
  GroundFrame frame_;
  std::optional<Lattice> lattice_;  ///< of all samples
  uint32_t level_ = 0;              ///< of the heights that meshes are made of
  GroundImage image_;               ///< for meshes for cameras
};

}  // namespace tetrakis::inline views
