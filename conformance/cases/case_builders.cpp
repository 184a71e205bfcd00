// SPDX-License-Identifier: Apache-2.0
#include "conformance/cases/case_builders.hpp"

namespace tetrakis::conformance {

tks_encode_options lossless() {
  tks_encode_options options = makeEncodeOptions();
  options.lossless = 1;
  return options;
}

tks_encode_options budget(uint64_t bytes) {
  tks_encode_options options = makeEncodeOptions();
  options.bytes = bytes;
  return options;
}

tks_encode_options maxError(double bound) {
  tks_encode_options options = makeEncodeOptions();
  options.max_error = bound;
  return options;
}

tks_encode_options quality(double psnr) {
  tks_encode_options options = makeEncodeOptions();
  options.psnr = psnr;
  return options;
}

tks_encode_options inRegions(tks_encode_options options, uint32_t side) {
  options.regions = side;
  return options;
}

tks_encode_options indexed(tks_encode_options options) {
  options.index = 1;
  return options;
}

VectorCase heightsCase(const std::string& name, const std::string& purpose, const Recipe& heights,
                       const tks_encode_options& options) {
  VectorCase vector_case;
  vector_case.name = name;
  vector_case.purpose = purpose;
  vector_case.heights = heights;
  vector_case.options = options;
  return vector_case;
}

VectorCase textureCase(const std::string& name, const std::string& purpose, const Recipe& image,
                       const tks_encode_options& options) {
  VectorCase vector_case;
  vector_case.name = name;
  vector_case.purpose = purpose;
  vector_case.texture = image;
  vector_case.options = options;
  return vector_case;
}

VectorCase weighted(VectorCase vector_case) {
  vector_case.options.weights = TKS_WEIGHTS_VISUAL;
  return vector_case;
}

VectorCase withVoids(VectorCase vector_case, samples::VoidShape shape, double nodata) {
  vector_case.voids = shape;
  vector_case.nodata = nodata;
  return vector_case;
}

VectorCase withWater(VectorCase vector_case, samples::VoidShape shape) {
  vector_case.water = shape;
  return vector_case;
}

VectorCase drawnOver(VectorCase vector_case, samples::VoidShape shape) {
  vector_case.overlay = shape;
  return vector_case;
}

VectorCase asCutout(VectorCase vector_case, samples::VoidShape shape) {
  vector_case.cutout = shape;
  return vector_case;
}

}  // namespace tetrakis::conformance
