// SPDX-License-Identifier: Apache-2.0
#include "encoder/views/rendered_pairs.hpp"

#include <algorithm>
#include <cstddef>

#include "base/samples.hpp"

namespace tetrakis::inline views {

namespace {

std::vector<std::byte> bytesOfTexels(const Texels& texels, tks_sample sample) {
  std::vector<std::byte> bytes(texels.samples.size() * tks_sample_bytes(sample));
  withSampleType(sample, [&](auto type) {
    auto* to = reinterpret_cast<decltype(type)*>(bytes.data());
    std::transform(texels.samples.begin(), texels.samples.end(), to,
                   [](uint16_t v) { return static_cast<decltype(type)>(v); });
  });
  return bytes;
}

}  // namespace

std::vector<double> renderedErrors(const EncodeInputs& inputs, DecodedNodes& decoded,
                                   const Nodes& nodes) {
  const tks_encode_options& options = inputs.options;
  std::vector<DecodedNodes::Samples> surfaces;
  for (const RatePoint& node : nodes.heights) surfaces.push_back(decoded.heightsAt(node.bytes, {}));
  const size_t rows = nodes.heights.size() + 1, columns = nodes.textures.size() + 1;
  std::vector<double> errors(rows * columns);
  for (size_t t = 0; t < columns; ++t) {
    std::vector<std::byte> texels;
    if (t + 1 < columns)
      texels = bytesOfTexels(decoded.texelsAt(nodes.textures[t].bytes, {}), inputs.image->sample);
    for (size_t g = 0; g < rows; ++g) {
      if (g + 1 == rows && t + 1 == columns) continue;  // the originals themselves
      const void* heights = g + 1 < rows ? surfaces[g].data.data() : inputs.heights->data;
      const void* texture = t + 1 < columns ? texels.data() : inputs.image->data;
      double squares = 0, values = 0;
      const int failed =
          options.picture_error(options.picture_user, heights, texture, &squares, &values);
      if (failed != 0 || !(squares >= 0) || !(values > 0)) return {};
      errors[g * columns + t] = squares / values;
    }
  }
  return errors;
}

}  // namespace tetrakis::inline views
