// SPDX-License-Identifier: Apache-2.0
// The judge of benches that draw terrain: what the original looks like to three cameras (oblique,
// low, top), and how far from it the picture of any mesh and texture is.
#pragma once

#include <memory>
#include <vector>

#include "apps/tools/render/render.hpp"
#include "apps/tools/report/scene.hpp"
#include "bench/meshes/decimation_mesh.hpp"

namespace tetrakis::bench {

class Screen {
 public:
  /// frame: of the surface's values. texture: outlives this.
  static Result<Screen> create(const tools::Surface& surface, const GroundFrame& frame,
                               const tools::ImageFile& texture);

  const std::vector<Camera>& cameras() const { return cameras_; }
  /// As meshes are told of them.
  std::vector<tks_screen_camera> meshCameras() const { return told(cameras_); }
  /// Those of a viewer of whom nothing is known.
  std::vector<tks_screen_camera> anyCameras() const { return told(any_); }

  /// PSNR of all cameras, then of each. texture: null is the original's.
  Result<std::vector<double>> score(tools::MeshFile mesh,
                                    const tools::ImageFile* texture = nullptr);

 private:
  Screen(const GroundFrame& frame, const tools::ImageFile& texture)
      : frame_(frame), texture_(&texture) {}

  std::vector<tks_screen_camera> told(const std::vector<Camera>& cameras) const;

  GroundFrame frame_;
  const tools::ImageFile* texture_;
  std::unique_ptr<tools::Renderer> renderer_;
  std::vector<Camera> cameras_, any_;
  std::vector<tools::Picture> reference_;
};

/// A peer's mesh in space. frame: of its steps. offset: of its heights, in steps.
tools::MeshFile placed(const PlanMesh& mesh, const GroundFrame& frame, double offset = 0);

}  // namespace tetrakis::bench
