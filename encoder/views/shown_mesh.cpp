// SPDX-License-Identifier: Apache-2.0
#include "encoder/views/decoded_nodes.hpp"

#include <array>
#include <cassert>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

#include "base/portable_math.hpp"
#include "base/samples.hpp"
#include "codec/mesh/meshes.hpp"
#include "codec/mesh/screen/surface_picture.hpp"
#include "codec/mesh/topology/lattice_mesh.hpp"
#include "encoder/views/view_inputs.hpp"

namespace tetrakis::inline views {

namespace {

/// A view that takes columns, rows and heights to the camera's picture. metres of a height: at + by
/// * height.
ScreenView screenViewOf(const Camera& camera, const GroundFrame& frame, double at, double by) {
  const ViewAxes axes = viewAxes(camera.eye, camera.target, camera.up);
  const double tan_y = portable::tan(camera.fov_y * std::numbers::pi / 360);
  const double tan_x = tan_y * camera.width / camera.height;
  const Vec3 corner = {-(frame.width - 1.0) / 2 * frame.spacing_x - camera.eye[0],
                       at - camera.eye[1],
                       -(frame.height - 1.0) / 2 * frame.spacing_y - camera.eye[2]};
  ScreenView view{camera.width, camera.height, {}, camera.weight};
  const std::array<std::pair<size_t, Vec3>, 3> rows = {
      {{0, scale(axes.right, 1 / tan_x)}, {1, scale(axes.up, 1 / tan_y)}, {3, axes.forward}}};
  for (const auto& [row, axis] : rows) {
    double* to = &view.clip[4 * row];
    to[0] = axis[0] * frame.spacing_x;
    to[1] = axis[2] * frame.spacing_y;
    to[2] = axis[1] * by;
    to[3] = dot(axis, corner);
  }
  return view;
}

}  // namespace

bool looksAtMeshes(const EncodeInputs& inputs, const QuantisedHeights& heights) {
  const tks_encode_options& options = inputs.options;
  return options.triangles > 0 && options.picture_error == nullptr && inputs.image != nullptr &&
         heights.steps.valid.empty() && heights.steps.table.empty() && heights.forest == nullptr;
}

ShownMesh::ShownMesh(const EncodeInputs& inputs, const QuantisedHeights& heights,
                     const Texels& texels)
    : inputs_(inputs), heights_(heights), frame_(frameOf(*inputs.heights)) {
  assert(looksAtMeshes(inputs, heights));
  Result<Lattice> lattice = Lattice::make(frame_.width, frame_.height);
  if (!lattice.ok()) return;
  if (inputs.options.camera_count == 0) {
    level_ = budgetMeshLevel(*lattice, inputs.options.triangles);
  } else {
    const uint32_t white = texels.white();
    image_ = GroundImage::of(texels.width, texels.height, texels.channels,
                             [&](size_t i) { return shownIn8Bits(texels.samples[i], white); });
  }
  lattice_.emplace(std::move(*lattice));
}

ShownMesh::Metres ShownMesh::metresOf(int fraction_bits) const {
  const tks_heights& samples = *inputs_.heights;
  const double metres = frame_.metres_per_unit;
  return {(heights_.steps.base * samples.scale + samples.offset) * metres,
          std::ldexp(heights_.steps.step, -fraction_bits) * samples.scale * metres};
}

std::optional<Relief> ShownMesh::ofDecoded(const DecodedGeometry& decoded) const {
  if (!lattice_) return {};
  if (inputs_.options.camera_count > 0) return forCameras(decoded.heights, decoded.fraction_bits);
  return forMap(ofMipLevel(decoded.heights, frame_.width, frame_.height, level_),
                decoded.quiet_levels, decoded.fraction_bits);
}

std::optional<Relief> ShownMesh::ofOriginal() const {
  if (!lattice_) return {};
  const std::vector<int32_t>& steps = heights_.steps.steps;
  if (inputs_.options.camera_count > 0) return forCameras(steps, 0);
  CoarseSurface surface{frame_.width, frame_.height, steps};
  for (uint32_t k = 0; k < level_; ++k) surface = smoothed(surface.view());
  return forMap(std::move(surface), 0, 0);
}

std::optional<Relief> ShownMesh::forMap(CoarseSurface surface, uint32_t quiet,
                                        int fraction_bits) const {
  const Result<BudgetMesh> mesh = budgetMesh(
      *lattice_, {std::move(surface), level_, level_ + quiet}, inputs_.options.triangles);
  if (!mesh.ok()) return {};
  return drawn(mesh->mesh, mesh->heights, fraction_bits);
}

std::optional<Relief> ShownMesh::forCameras(std::span<const int32_t> heights,
                                            int fraction_bits) const {
  const auto [at, by] = metresOf(fraction_bits);
  std::vector<ScreenView> views;
  for (const Camera& camera : givenCameras(inputs_.options))
    if (camera.weight > 0) views.push_back(screenViewOf(camera, frame_, at, by));
  for (const ScreenView& view : views)
    for (const double number : view.clip)
      if (!std::isfinite(number)) return {};
  WeightedSurface surface{{frame_.width, frame_.height, heights}};
  const std::vector<float> weights = screenWeights(surface, views, image_);
  surface.view.weights = weights;
  const auto admits = [](uint64_t) { return Status(); };
  const Result<FittedMesh> mesh = screenMesh(*lattice_, surface, inputs_.options.triangles, admits);
  if (!mesh.ok()) return {};
  return drawn(mesh->mesh, mesh->heights, fraction_bits);
}

Relief ShownMesh::drawn(const LatticeMesh& mesh, std::span<const double> heights,
                        int fraction_bits) const {
  const auto [at, by] = metresOf(fraction_bits);
  Relief relief{frame_, std::vector<float>(size_t{frame_.width} * frame_.height)};
  for (size_t t = 0; t < mesh.triangles.size(); t += 3) {
    std::array<GridPoint, 3> corners;
    std::array<double, 3> metres;
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t vertex = mesh.triangles[t + k], sample = mesh.vertices[vertex];
      corners[k] = {sample % frame_.width, sample / frame_.width};
      metres[k] = at + by * heights[vertex];
    }
    const TriangleSamples samples(corners);
    const auto area = static_cast<double>(samples.doubledArea());
    samples.forEach([&](uint32_t x, uint32_t y, const TriangleSamples::Edges& e) {
      double height = 0;
      for (size_t k = 0; k < 3; ++k) height += metres[k] * static_cast<double>(e[k]) / area;
      relief.heights[size_t{y} * frame_.width + x] = static_cast<float>(height);
    });
  }
  return relief;
}

}  // namespace tetrakis::inline views
