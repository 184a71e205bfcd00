// SPDX-License-Identifier: Apache-2.0
// Prints digests of encoded streams, decoded samples and meshes, larger than the conformance
// vectors are. Two builds (compiler, optimisation, machine) agree when their outputs are equal:
// .ci/run.
#include <algorithm>
#include <cstdio>
#include <span>

#include "conformance/cases/vector_cases.hpp"
#include "conformance/digest.hpp"
#include "conformance/samples/terrain_samples.hpp"
#include "tetrakis/tetrakis.hpp"

namespace tetrakis {
namespace {

using conformance::sampleDigest;

template <class T>
void print(const std::string& name, std::span<const T> values, tks_sample sample) {
  std::printf("%s  %s\n", sampleDigest(std::as_bytes(values), sample).c_str(), name.c_str());
}

void printMesh(const std::string& name, const Result<Mesh>& mesh) {
  if (!mesh) return;
  print(name + ".vertices", mesh->gridIndices(), TKS_U32);
  print(name + ".heights", mesh->heights(), TKS_F32);
  print(name + ".triangles", mesh->triangles(), TKS_U32);
}

/// For a camera in the south, over heights of some hundreds.
void printScreenMesh(const std::string& name, Decoder& decoder) {
  const tks_info& info = decoder.info();
  if (!info.has_heights) return;
  tks_screen_camera camera = makeScreenCamera();
  camera.width = 300;
  camera.height = 200;
  const double clip[16] = {
      2.0 / info.width,   0, 0,  -1, 0, -1.0 / info.height, 3e-4, 0.5, 0, 0, 0, 0, 0,
      -0.3 / info.height, 0, 1.5};
  std::copy(clip, clip + 16, camera.clip);
  printMesh(name, decoder.screenMesh({&camera, 1}, 1000));
  if (!info.has_texture) return;
  const auto texels = decoder.texture();
  if (!texels) return;
  tks_image image = makeImage();
  image.width = info.texture_width;
  image.height = info.texture_height;
  image.channels = info.texture_channels;
  image.sample = info.texture_sample;
  image.data = texels->data();
  printMesh(name + ".textured", decoder.screenMesh({&camera, 1}, 1000, &image));
}

/// Of triangles that are coded as they are, with a part of them.
void printObject(const std::string& name, Decoder& decoder) {
  const uint32_t all = decoder.info().object_triangles;
  for (const uint32_t most : {all / 2, all / 8, all / 32}) {
    if (most == 0) continue;
    const auto mesh = decoder.objectMesh(TKS_MESH_BUDGET, most);
    if (mesh) std::printf("%s  %s\n", conformance::cornerDigest(*mesh).c_str(), name.c_str());
  }
}

void printPrefix(const std::string& name, std::span<const uint8_t> prefix) {
  auto decoder = Decoder::open(prefix);
  if (!decoder) return;
  if (const auto heights = decoder->heights()) {
    print(name + ".samples", std::span(*heights), decoder->info().sample);
  }
  if (const auto texture = decoder->texture()) {
    print(name + ".texels", std::span(*texture), decoder->info().texture_sample);
  }
  printMesh(name + ".coded", decoder->codedMesh());
  printMesh(name + ".budget", decoder->budgetMesh(1000));
  printScreenMesh(name + ".screen", *decoder);
  printObject(name + ".object", *decoder);
}

void printStream(const std::string& name, std::span<const uint8_t> stream) {
  print(name, stream, TKS_U8);
  printPrefix(name + ".half", stream.first(stream.size() / 2));
  printPrefix(name + ".whole", stream);
}

int printAll() {
  for (const auto& vector_case : conformance::vectorCases()) {
    const auto stream = conformance::encodeCase(vector_case);
    if (!stream.ok()) {
      std::fprintf(stderr, "%s\n", stream.status().message().c_str());
      return stream.status().code();
    }
    printStream(vector_case.name, *stream);
  }
  const auto heights = samples::make({samples::Pattern::kRidges, 385, 300, 1, TKS_U16});
  const auto image = samples::make({samples::Pattern::kRidges, 512, 400, 3, TKS_U8, 7});
  for (const uint32_t bytes : {4000u, 64000u}) {
    tks_encode_options options = makeEncodeOptions();
    options.bytes = bytes;
    options.threads = 2;
    const tks_heights h = heights.heights();
    const tks_image i = image.image();
    const auto stream = encode(&h, &i, options);
    if (!stream) return stream.status().code();
    printStream("joint_" + std::to_string(bytes), stream->bytes());
  }
  return TKS_OK;
}

}  // namespace
}  // namespace tetrakis

int main() {
  return tetrakis::printAll();
}
