// SPDX-License-Identifier: Apache-2.0
// DecodedNodes decodes prefixes of both components, at points of their curves, into the surfaces
// and texels that viewers will see of them. Errors of pictures are measured on these, because no
// account of coefficients foretells what a mesh or a camera shows.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/samples.hpp"
#include "base/view.hpp"
#include "bitstream/track/track_encoder.hpp"
#include "codec/geometry/heights_decoder.hpp"
#include "codec/geometry/steps/decoded_heights.hpp"
#include "codec/mesh/screen/surface_picture.hpp"
#include "codec/mesh/surface/surface.hpp"
#include "codec/mesh/topology/lattice.hpp"
#include "codec/mesh/topology/lattice_mesh.hpp"
#include "encoder/heights/coded_heights.hpp"
#include "encoder/inputs/encode_inputs.hpp"
#include "encoder/textures/coded_texture.hpp"
#include "ratecontrol/curves/component_curve.hpp"
#include "ratecontrol/pictures/ground_rays.hpp"
#include "ratecontrol/pictures/picture_point.hpp"

namespace tetrakis::inline views {

// ShownMesh draws the mesh that decoders will make of a prefix as heights of all samples, for the
// cameras to look at. With a triangle budget viewers see that mesh and not the heights (thesis 6.1:
// D(M_i, T_j)): an error that the triangles cannot show costs nothing, so bytes that lower it are
// better spent on the texture. If the caller names cameras the mesh is made for them, else for a
// map.

/// Whether cameras look at meshes: there is a triangle budget, and there are neither voids nor a
/// table of values. The caller's renderer looks at full grids, and so do cameras of forests, whose
/// raster is no plane of one mesh.
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

// DecodedNodes decodes some prefixes of both components for the cameras to look at. Each prefix is
// decoded from where the one before it ended, and to the end of a pass where there is one track, so
// that nothing has to be taken back. Prefixes that know only coarse levels are given to rays as
// coarse grids, which takes less time.

/// A component as it is coded, with the curve of its packets.
template <class Coded>
struct Rated {
  const Coded& coded;
  const ComponentCurve& curve;
};

/// Where the curve is one of whole passes these passes are decoded, else prefixes of any length.
template <class Coded>
bool endsWithPasses(const Rated<Coded>& rated) {
  return !rated.curve.passes.empty() && rated.coded.holdsCoefficientsAlone();
}

/// Decodes the inputs from the first bytes of either component. Calls must come with rising bytes,
/// and with ends of passes where the curve has them.
class DecodedNodes {
 public:
  DecodedNodes(const EncodeInputs& inputs, const Rated<CodedHeights>& heights,
               const Rated<CodedTexture>& texture);

  struct Samples {
    std::vector<std::byte> data;  ///< of the type of the inputs
    std::vector<uint8_t> valid;   ///< empty: all are
  };
  Samples heightsAt(uint64_t bytes, const View& view);
  /// The heights as viewers see them.
  Relief shownAt(uint64_t bytes);
  /// All heights as viewers see them, if viewers see a mesh.
  std::optional<Relief> meshOfAll() const { return mesh_ ? mesh_->ofOriginal() : std::nullopt; }
  Relief original() const;

  ScreenTexture textureAt(uint64_t bytes);
  const Texels& originalTexels() const { return texture_.coded.source->texels; }
  Texels texelsAt(uint64_t bytes, const View& view);

 private:
  DecodedHeights decodedAt(uint64_t bytes, const View& view);
  Relief reliefAt(uint64_t bytes);

  const EncodeInputs& inputs_;
  Rated<CodedHeights> heights_;
  Rated<CodedTexture> texture_;
  std::optional<ShownMesh> mesh_;  ///< null: viewers see the grid
  HeightsMemory heights_memory_;
  TextureMemory texture_memory_;
};

// Nodes are the prefixes of both components whose pairs an engine looks at.

/// Points of either curve, from the first to the last.
struct Nodes {
  std::vector<RatePoint> heights, textures;
};

}  // namespace tetrakis::inline views
