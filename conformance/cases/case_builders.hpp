// SPDX-License-Identifier: Apache-2.0
// The functions here are parts from which cases are made: options of the encoder for each target,
// and inputs that differ in one point.
#pragma once

#include <string>

#include "conformance/cases/vector_cases.hpp"
#include "tetrakis/tetrakis.hpp"

namespace tetrakis::conformance {

using samples::Pattern;
using samples::Recipe;

tks_encode_options lossless();
tks_encode_options budget(uint64_t bytes);
tks_encode_options maxError(double bound);
tks_encode_options quality(double psnr);
tks_encode_options inRegions(tks_encode_options options, uint32_t side);
tks_encode_options indexed(tks_encode_options options);

VectorCase heightsCase(const std::string& name, const std::string& purpose, const Recipe& heights,
                       const tks_encode_options& options);
VectorCase textureCase(const std::string& name, const std::string& purpose, const Recipe& image,
                       const tks_encode_options& options);

VectorCase weighted(VectorCase vector_case);
VectorCase withVoids(VectorCase vector_case, samples::VoidShape shape, double nodata);
VectorCase withWater(VectorCase vector_case, samples::VoidShape shape);
VectorCase drawnOver(VectorCase vector_case, samples::VoidShape shape);
VectorCase asCutout(VectorCase vector_case, samples::VoidShape shape);

}  // namespace tetrakis::conformance
