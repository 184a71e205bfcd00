// SPDX-License-Identifier: Apache-2.0
// What JavaScript calls to encode meshes: tks_encode_object (apps/web/src/object_encoder.js).
#include <cstddef>
#include <cstdint>
#include <initializer_list>

#include "apps/web/module/encode_inputs.hpp"
#include "tetrakis/tetrakis.h"

namespace {

using tetrakis::web::Numbers;

/// Of the last mesh, in the order of web_encode_object_report_names().
double told[16];

void tell(const tks_object_report& report) {
  double* next = told;
  for (const uint32_t count : {report.triangles, report.dropped_triangles, report.cut_edges,
                               report.components, report.borders, report.patches, report.depth})
    *next++ = count;
  for (const double value :
       {report.diagonal, report.resampling_error, report.error, report.largest, report.psnr})
    *next++ = value;
  *next++ = report.texture_depth;
  *next++ = report.kind;
  *next++ = report.coded_triangles;
  *next++ = static_cast<double>(report.sketch_bytes);
}

tks_triangle_mesh meshOf(Numbers& numbers, const char* const* texts, const void* const* data) {
  tks_triangle_mesh mesh{};
  mesh.size = sizeof mesh;
  numbers.take(mesh.vertex_count);
  numbers.take(mesh.triangle_count);
  numbers.take(mesh.kind);
  double sketch = 0;
  numbers.take(sketch);
  mesh.sketch_bytes = sketch < 0 ? TKS_NO_SKETCH : static_cast<uint64_t>(sketch);
  mesh.positions = static_cast<const double*>(data[0]);
  mesh.triangles = static_cast<const uint32_t*>(data[1]);
  mesh.texcoords = static_cast<const float*>(data[2]);
  mesh.unit = texts[0];
  mesh.description = texts[1];
  mesh.material = texts[2];
  return mesh;
}

tks_image texelsOf(Numbers& numbers, const void* data) {
  tks_image image{};
  image.size = sizeof image;
  image.data = data;
  numbers.take(image.width);
  numbers.take(image.height);
  numbers.take(image.channels);
  numbers.take(image.sample);
  return image;
}

tks_image imageOf(Numbers& numbers, const void* data) {
  tks_image image = texelsOf(numbers, data);
  numbers.take(image.opaque);
  numbers.take(image.white_level);
  return image;
}

/// Images in the order of web_encode_object_names(), of which some are there.
struct Maps {
  static constexpr std::initializer_list<const char*> kNames = {"normal", "metallic_roughness",
                                                                "occlusion", "emissive"};

  Maps(Numbers& numbers, const void* const* data) {
    for (const char* name : kNames) {
      images[count] = texelsOf(numbers, *data);
      if (*data++ == nullptr) continue;
      maps[count] = {sizeof(tks_object_map), name, &images[count], 0};
      ++count;
    }
  }

  tks_image images[5];
  tks_object_map maps[4];
  uint32_t count = 0;
};

}  // namespace

extern "C" {

/// What the numbers of web_encode_object() are, by the names that JavaScript gives them.
const char* web_encode_object_names() {
  return "vertexCount triangleCount kind sketchBytes "
         "textureWidth textureHeight textureChannels textureSample textureOpaque "
         "textureWhiteLevel "
         "normalWidth normalHeight normalChannels normalSample "
         "metallic_roughnessWidth metallic_roughnessHeight metallic_roughnessChannels "
         "metallic_roughnessSample "
         "occlusionWidth occlusionHeight occlusionChannels occlusionSample "
         "emissiveWidth emissiveHeight emissiveChannels emissiveSample "
         "bytes psnr maxError index";
}

/// Likewise its texts.
const char* web_encode_object_texts() {
  return "unit description material";
}

/// Likewise the numbers of web_encode_object_report().
const char* web_encode_object_report_names() {
  return "triangles droppedTriangles cutEdges components borders patches depth diagonal "
         "resamplingError error largest psnr textureDepth kind codedTriangles sketchBytes";
}

/// Of the last mesh that was encoded.
const double* web_encode_object_report() {
  return told;
}

/// data: positions, triangles, texcoords, the texture and four maps, NULL where there is none.
/// texts: NULL where unknown.
tks_status web_encode_object(const double* numbers, const char* const* texts,
                             const void* const* data, tks_buffer* out, char* message,
                             size_t message_size) {
  Numbers left(numbers);
  tks_triangle_mesh mesh = meshOf(left, texts, data);
  const tks_image image = imageOf(left, data[3]);
  const Maps maps(left, data + 4);
  mesh.maps = maps.maps;
  mesh.map_count = maps.count;
  tks_encode_options o{};
  o.size = sizeof o;
  left.take(o.bytes);
  left.take(o.psnr);
  left.take(o.max_error);
  left.take(o.index);
  o.progress = tetrakis::web::tellProgress;
  tks_object_report report{};
  report.size = sizeof report;
  const tks_status status = tks_encode_object(&mesh, data[3] != nullptr ? &image : nullptr, &o,
                                              &report, out, message, message_size);
  tell(report);
  return status;
}

}  // extern "C"
