// SPDX-License-Identifier: Apache-2.0
// The studies of bench_surface: each measures one model beside its peers, prints lines and keeps
// its ratios.
#pragma once

#include "bench/meshes/surface_figures.hpp"
#include "bench/meshes/surface_model.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::bench {

struct SurfaceStudyOptions {
  uint32_t sizes = 10;  ///< that meshoptimizer simplifies to
  bool points = false;  ///< prints each coding that was tried
};

/// Bytes of the surface at errors, which are the columns: whole streams beside meshoptimizer's
/// meshes in Draco.
Status studyBytes(const SurfaceModel& model, const SurfaceStudyOptions& options,
                  SurfaceFigures& figures);

/// Triangles at equal error: meshes of at most so many triangles as a column says, of a stream of
/// 64 kB, beside meshoptimizer's. Fails if one of ours has another topology than the model.
Status studyTriangles(const SurfaceModel& model, const SurfaceStudyOptions& options,
                      SurfaceFigures& figures);

/// Errors at equal triangles, and triangles at equal error, of meshes of at most so many triangles
/// as a column says, of a stream that keeps all triangles of the model, beside meshoptimizer's.
/// Says so if one of ours has another topology than the model.
Status studyKept(const SurfaceModel& model, const SurfaceStudyOptions& options,
                 SurfaceFigures& figures);

/// The same of a resampled stream of 64 kB, whose patches are more than such meshes have triangles.
Status studyFew(const SurfaceModel& model, const SurfaceStudyOptions& options,
                SurfaceFigures& figures);

/// Errors of prefixes of a stream of 64 kB, of as many kB as a column says, beside streams made for
/// their length, with any base and with the same base.
Status studyPrefixes(const SurfaceModel& model, SurfaceFigures& figures);

/// Bytes of a texture, and of a textured model in all, in streams of as many kB as a column says,
/// beside its atlas by the same codec and beside Draco with AVIF, at equal errors. Prints the bytes
/// of the first stream that has 69 dB of its surface and 35 dB of its colours. Models without a
/// texture are left out.
Status studyTexture(const SurfaceModel& model, const SurfaceStudyOptions& options,
                    SurfaceFigures& figures);

}  // namespace tetrakis::bench
