// SPDX-License-Identifier: Apache-2.0
// libFuzzer target: everything a reader does with bytes from a stranger, and in planes that are too
// large for all of it, how long that takes. Seeds: conformance/vectors.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <span>
#include <string>

#include "conformance/samples/header_seal.hpp"
#include "tests/pace/pace.hpp"
#include "tetrakis/sequence.hpp"

extern "C" size_t LLVMFuzzerMutate(uint8_t* data, size_t size, size_t max_size);

namespace {

tks_limits limitsOf(uint64_t samples, uint64_t memory) {
  tks_limits limits = tetrakis::makeLimits();
  limits.max_samples = limits.max_texels = samples;
  limits.max_memory = memory;
  return limits;
}

/// Small enough that an input costs milliseconds, large enough for several levels.
tks_limits fuzzLimits() {
  return limitsOf(1 << 13, 64 << 20);
}

/// Larger planes are only timed: a fault that costs time for each sample hides in small ones.
void checkPace(std::span<const uint8_t> bytes) {
  if (!tetrakis::Decoder::open(bytes, limitsOf(1 << 17, 256 << 20))) return;
  constexpr double kUneven = 4;  // sanitizers slow some work more than the calibrating stream
  static const double slow = kUneven * tetrakis::test::slowness();
  const std::string call = tetrakis::test::slowCall(bytes, slow);
  if (call.empty()) return;
  std::fprintf(stderr, "%s\n", call.c_str());
  std::abort();
}

/// The promise of tks_mesh: indices stay inside.
void checkMesh(const tetrakis::Result<tetrakis::Mesh>& mesh, const tks_info& info) {
  if (!mesh) return;
  const uint64_t samples = uint64_t{info.width} * info.height;
  for (const uint32_t index : mesh->gridIndices()) {
    if (index >= samples) std::abort();
  }
  for (const uint32_t index : mesh->triangles()) {
    if (index >= mesh->vertexCount()) std::abort();
  }
}

/// A window of one column holds what the whole holds there.
void checkWindow(const tetrakis::Result<std::vector<std::byte>>& window,
                 const std::vector<std::byte>& whole, const tks_info& info) {
  if (!window) std::abort();
  const size_t sample = tks_sample_bytes(info.sample), row_bytes = info.width * sample;
  for (size_t i = 0; i < window->size(); ++i) {
    const size_t row = info.height / 2 + i / sample;
    const size_t at = row * row_bytes + info.width / 3 * sample + i % sample;
    if ((*window)[i] != whole[at]) std::abort();
  }
}

/// What the heights look like from above.
tks_screen_camera mapOf(const tks_info& info) {
  tks_screen_camera camera = tetrakis::makeScreenCamera();
  camera.width = camera.height = 40;
  camera.clip[0] = camera.clip[5] = 2.0 / info.width;
  camera.clip[6] = 0.01;
  camera.clip[3] = camera.clip[7] = -1;
  camera.clip[15] = 1;
  return camera;
}

constexpr tks_globe kMoon = {sizeof kMoon, 1737400, 1737400, 0, 0};

/// From 4 000 km above longitude and latitude 0.
tks_screen_camera aboveGlobe() {
  tks_screen_camera camera = tetrakis::makeScreenCamera();
  camera.width = camera.height = 40;
  camera.clip[1] = camera.clip[6] = 1;
  camera.clip[12] = -1;
  camera.clip[15] = 5737400;
  camera.globe = &kMoon;
  return camera;
}

/// What a viewer asks before it fetches.
void planAndMeasure(tetrakis::Decoder& decoder) {
  const tks_info& info = decoder.info();
  const tks_screen_camera camera = mapOf(info), globe = aboveGlobe();
  static_cast<void>(decoder.plan(info.has_heights ? &camera : nullptr, 1000));
  static_cast<void>(decoder.plan(&globe, 1000));
  for (const tks_part part : {TKS_PART_HEIGHTS, TKS_PART_TEXTURE, TKS_PART_BUDGET_MESH}) {
    static_cast<void>(decoder.neededRanges(part));
    static_cast<void>(decoder.checkMemory(part));
  }
}

/// Where the heights lie round a globe.
void makeGlobes(tetrakis::Decoder& decoder) {
  const auto coded = decoder.codedGlobe(kMoon), budget = decoder.budgetGlobe(kMoon, 100);
  for (const auto* const mesh : {&coded, &budget}) {
    if (!*mesh) continue;
    for (const uint32_t corner : (*mesh)->triangles())
      if (corner >= (*mesh)->vertexCount()) std::abort();
  }
}

void makeMeshes(tetrakis::Decoder& decoder) {
  makeGlobes(decoder);
  const tks_info& info = decoder.info();
  checkMesh(decoder.codedMesh(), info);
  checkMesh(decoder.budgetMesh(100), info);
  const tks_screen_camera camera = mapOf(info);
  checkMesh(decoder.screenMesh({&camera, 1}, 100), info);
  const auto tree = decoder.budgetMeshTree(100);
  if (tree) checkMesh(tree->view(std::span<const double, 16>(camera.clip)), info);
}

/// Of streams that hold an object.
void makeObjects(tetrakis::Decoder& decoder) {
  const uint32_t coded = decoder.info().object_triangles;
  for (const uint32_t most : {0u, 1 + coded / 2, 1 + coded / 20}) {
    for (const tks_mesh_kind kind : {TKS_MESH_BUDGET, TKS_MESH_CODED}) {
      const auto mesh = decoder.objectMesh(kind, most);
      if (!mesh) continue;
      if (coded > 0 && most > 0 && kind == TKS_MESH_BUDGET && mesh->triangleCount() > most)
        std::abort();
      for (const uint32_t corner : mesh->triangles())
        if (corner >= mesh->vertexCount()) std::abort();
    }
  }
}

/// Bytes that come in three pieces, or the last before the middle one, and are decoded in between.
void growAndDecode(std::span<const uint8_t> bytes) {
  const auto header = tetrakis::headerBytes(bytes);
  if (!header || *header > bytes.size()) std::abort();
  const size_t first = *header + (bytes.size() - *header) / 3, second = (first + bytes.size()) / 2;
  auto decoder = tetrakis::Decoder::open(bytes.first(first), fuzzLimits());
  if (!decoder) return;
  const auto decode = [&] {
    if (decoder->info().has_heights) static_cast<void>(decoder->heights());
    if (decoder->info().has_texture) static_cast<void>(decoder->texture());
  };
  decode();
  if (bytes.size() % 2 == 0) static_cast<void>(decoder->put(second, bytes.subspan(second)));
  decode();
  planAndMeasure(*decoder);
  static_cast<void>(decoder->append(bytes.subspan(first, second - first)));
  decode();
  static_cast<void>(decoder->put(first, bytes.subspan(first)));
  decode();
}

/// The last frame, and the first one again.
void showFrames(tetrakis::Decoder& decoder) {
  const uint32_t last = decoder.info().frames - 1;
  for (const uint32_t frame : {last, 0u}) {
    if (!decoder.setFrame(frame).ok()) std::abort();
    if (decoder.info().has_heights) static_cast<void>(decoder.heights());
    if (decoder.info().has_texture) static_cast<void>(decoder.texture());
  }
}

/// Each component that is not the first of its kind, and the first ones of those kinds again.
void chooseComponents(std::span<const uint8_t> bytes) {
  auto decoder = tetrakis::Decoder::open(bytes, fuzzLimits());
  if (!decoder) return;
  for (uint32_t i = 0; i < decoder->info().components; ++i) {
    if (decoder->component(i)->is_taken || !decoder->choose(i).ok()) continue;
    if (!decoder->component(i)->is_taken) std::abort();
    if (decoder->info().has_heights) static_cast<void>(decoder->heights());
    if (decoder->info().has_texture) static_cast<void>(decoder->texture());
  }
  for (uint32_t i = decoder->info().components; i-- > 0;) static_cast<void>(decoder->choose(i));
}

/// The bytes as a sequence, or the end of one.
void passGroups(std::span<const uint8_t> bytes) {
  if (auto sequence = tetrakis::Sequence::open({}, fuzzLimits())) {
    static_cast<void>(sequence->append(bytes));
    const tks_sequence_info info = sequence->info();
    const uint64_t last = info.end_frame - std::min<uint64_t>(info.end_frame, 1);
    for (const uint64_t frame : {last, info.first_frame}) {
      auto decoder = sequence->decoder(frame);
      if (!decoder) continue;
      if (decoder->info().has_heights) static_cast<void>(decoder->heights());
      if (decoder->info().has_texture) static_cast<void>(decoder->texture());
    }
  }
  tks_range range = {};
  int found = 0;
  for (const int by_time : {0, 1})
    tks_sequence_locate(bytes.data(), bytes.size(), bytes.size(), by_time, 7, &range, &found);
}

}  // namespace

/// Random bytes never pass the header's checksum: every other mutant gets the right one.
extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t max_size,
                                          unsigned int seed) {
  const size_t mutated = LLVMFuzzerMutate(data, size, max_size);
  if (seed & 1u) tetrakis::test::sealHeader({data, mutated});
  return mutated;
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  passGroups({data, size});
  auto decoder = tetrakis::Decoder::open({data, size}, fuzzLimits());
  if (!decoder) {
    checkPace({data, size});
    return 0;
  }
  const tks_info& info = decoder->info();
  if (info.has_heights) {
    const auto first = decoder->heights();
    const auto second = decoder->heights();
    if (static_cast<bool>(first) != static_cast<bool>(second)) std::abort();
    if (first && *first != *second) std::abort();
    const tks_window column = {info.width / 3, info.height / 2, 1, 1 + info.height / 3};
    if (first) checkWindow(decoder->heights(column), *first, info);
    makeMeshes(*decoder);
  }
  makeObjects(*decoder);
  planAndMeasure(*decoder);
  if (info.frames > 1) showFrames(*decoder);
  if (info.has_texture) static_cast<void>(decoder->texture());
  const auto coarser = [size](uint32_t coarsest) {
    return static_cast<uint32_t>(size) % (coarsest + 1);
  };
  if (!decoder->setLevels(coarser(info.coarsest_level), coarser(info.texture_coarsest_level)).ok())
    std::abort();
  if (info.has_heights) static_cast<void>(decoder->heights());
  if (info.has_texture) static_cast<void>(decoder->texture());
  static_cast<void>(decoder->verify());
  if (info.components > 1) chooseComponents({data, size});
  growAndDecode({data, size});
  return 0;
}
