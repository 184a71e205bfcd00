// SPDX-License-Identifier: Apache-2.0
// The functions here are kinds of terrain whose ground is that of the mountains, and whose samples
// show the traces of surveys, programs and formats.
#pragma once

#include "apps/tools/synth/kind_task.hpp"

namespace tetrakis::tools::synth {

/// Whole tens of feet, in metres.
Storage quantise(const KindTask& task);

/// Layers of equal height, as maps tint them.
Storage layer(const KindTask& task);

/// Whole metres above the sea, which someone has moved to heights above the ellipsoid.
Storage raise(const KindTask& task);

/// Patches of two surveys: one in whole metres, one that knows more.
Storage join(const KindTask& task);

/// What is left of a map of 8 bits, stretched to its range and then to metres with three decimals;
/// the samples that an editor has interpolated lie between its values.
Storage rescale(const KindTask& task);

/// A scene that a satellite took at an angle, with clouds and with shadows of the radar on slopes.
Storage pierce(const KindTask& task);

/// Nearest neighbours of a coarser grid that lies at an angle: what warping a map without
/// interpolation leaves.
Storage turn(const KindTask& task);

/// Triangles between the points of a coarse grid that does not meet the samples.
Storage triangulate(const KindTask& task);

/// What a wide filter leaves of the mountains, in centimetres: means of means of means.
Storage smoothen(const KindTask& task);

}  // namespace tetrakis::tools::synth
