// SPDX-License-Identifier: Apache-2.0
// All that can be asked of a stream, and how much memory the answer takes. Executables that include
// this link tests/support/allocation_count.cpp.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/view.hpp"
#include "tests/support/allocation_count.hpp"
#include "tests/support/stream_fixture.hpp"

namespace tetrakis::test {

/// A call of the decoder, and what tks_check_memory is asked for it.
struct DecodeCall {
  std::string name;
  tks_part part;
  std::optional<tks_window> window;
  uint32_t max_triangles = 0;
  uint32_t level = 0;
  std::function<tks_status(tks_decoder*)> run;

  const tks_window* asked() const { return window ? &*window : nullptr; }
};

struct MeasuredCall {
  uint64_t bound = 0;  ///< what tks_check_memory says
  uint64_t limit = 0;  ///< what the decoder may take, the stream among it
  uint64_t peak = 0;   ///< what the call has allocated at a time
  tks_status status = TKS_OK;
};

/// What the call allocates in a decoder that has done nothing before, with no more memory than the
/// bound.
inline MeasuredCall measure(const Bytes& bytes, const DecodeCall& call, uint32_t threads = 1) {
  const auto set = [&](Stream& stream) {
    EXPECT_EQ(stream.status(), TKS_OK) << stream.message();
    EXPECT_EQ(tks_set_threads(stream.get(), threads), TKS_OK);
    const bool texture = call.part == TKS_PART_TEXTURE;
    EXPECT_EQ(tks_set_levels(stream.get(), texture ? 0 : call.level, texture ? call.level : 0),
              TKS_OK);
  };
  Stream unlimited(bytes);
  set(unlimited);
  MeasuredCall measured;
  EXPECT_EQ(tks_check_memory(unlimited.get(), call.part, call.asked(), call.max_triangles, 0,
                             &measured.bound),
            TKS_OK)
      << tks_message(unlimited.get());
  tks_limits limits = {};
  limits.size = sizeof limits;
  limits.max_memory = measured.limit = measured.bound + 4 * bytes.size() + (1 << 20);
  Stream stream(bytes, &limits);
  set(stream);
  // Of a lower limit the decoder keeps less of windows.
  EXPECT_EQ(tks_check_memory(stream.get(), call.part, call.asked(), call.max_triangles, 0,
                             &measured.bound),
            TKS_OK)
      << tks_message(stream.get());
  measured.peak = peakBytes([&] { measured.status = call.run(stream.get()); });
  return measured;
}

/// Samples of a level of a raster, or of as many patches, one below the other.
inline size_t samplesAt(Extent whole, uint32_t patches, uint32_t level) {
  const uint32_t rows = patches > 0 ? whole.height / patches : 0;
  return View{static_cast<int>(level), {}, 0, rows}.extentIn(whole).samples();
}

inline DecodeCall heightsOf(const tks_info& info, uint32_t level) {
  const size_t bytes = samplesAt({info.width, info.height}, info.forest.patches, level) *
                       tks_sample_bytes(info.sample);
  auto out = std::make_shared<std::vector<std::byte>>(bytes);
  return {"heights of level " + std::to_string(level),
          TKS_PART_HEIGHTS,
          {},
          0,
          level,
          [out](tks_decoder* d) { return tks_decode_heights(d, out->data(), out->size()); }};
}

inline DecodeCall validityOf(const tks_info& info) {
  auto out = std::make_shared<std::vector<uint8_t>>(size_t{info.width} * info.height);
  return {"validity",
          TKS_PART_VALIDITY,
          {},
          0,
          0,
          [out](tks_decoder* d) { return tks_decode_validity(d, out->data(), out->size()); }};
}

inline DecodeCall surfaceOf(const tks_info& info, const tks_window& window) {
  EXPECT_LE(window.x + window.width, info.width);
  auto out = std::make_shared<std::vector<float>>(size_t{window.width} * window.height);
  return {"a window of the surface", TKS_PART_HEIGHTS, window, 0, 0, [out, window](tks_decoder* d) {
            return tks_decode_surface_window(d, &window, out->data(), out->size());
          }};
}

/// A window of a level of either component.
inline DecodeCall windowOf(const tks_info& info, tks_part part, uint32_t level,
                           const tks_window& window) {
  const bool texture = part == TKS_PART_TEXTURE;
  const size_t place = texture ? info.texture_channels * tks_sample_bytes(info.texture_sample)
                       : part == TKS_PART_VALIDITY ? 1
                                                   : tks_sample_bytes(info.sample);
  auto out = std::make_shared<std::vector<uint8_t>>(size_t{window.width} * window.height * place);
  return {
      "a window of level " + std::to_string(level), part, window, 0, level, [=](tks_decoder* d) {
        if (part == TKS_PART_VALIDITY)
          return tks_decode_validity_window(d, &window, out->data(), out->size());
        return texture ? tks_decode_texture_window(d, &window, out->data(), out->size())
                       : tks_decode_heights_window(d, &window, out->data(), out->size());
      }};
}

inline DecodeCall textureOf(const tks_info& info, uint32_t level) {
  const size_t bytes =
      samplesAt({info.texture_width, info.texture_height}, info.texture_forest.patches, level) *
      info.texture_channels * tks_sample_bytes(info.texture_sample);
  auto out = std::make_shared<std::vector<std::byte>>(bytes);
  return {"texture of level " + std::to_string(level),
          TKS_PART_TEXTURE,
          {},
          0,
          level,
          [out](tks_decoder* d) { return tks_decode_texture(d, out->data(), out->size()); }};
}

inline DecodeCall textureOf(const tks_info& info, const tks_window& window) {
  auto out = std::make_shared<std::vector<std::byte>>(size_t{window.width} * window.height *
                                                      info.texture_channels *
                                                      tks_sample_bytes(info.texture_sample));
  return {"a window of the texture", TKS_PART_TEXTURE, window, 0, 0, [out, window](tks_decoder* d) {
            return tks_decode_texture_window(d, &window, out->data(), out->size());
          }};
}

inline DecodeCall meshOf(tks_mesh_kind kind, uint32_t triangles) {
  const auto decode = [kind, triangles](tks_decoder* decoder) {
    tks_mesh mesh = {};
    const tks_status status = tks_decode_mesh(decoder, kind, triangles, &mesh);
    tks_free_mesh(&mesh);
    return status;
  };
  return {"mesh of " + std::to_string(triangles),
          kind == TKS_MESH_CODED ? TKS_PART_CODED_MESH : TKS_PART_BUDGET_MESH,
          {},
          triangles,
          0,
          decode};
}

inline DecodeCall treeOf(tks_mesh_kind kind, uint32_t triangles) {
  DecodeCall call = meshOf(kind, triangles);
  call.name += " in a tree";
  call.run = [kind, triangles](tks_decoder* decoder) {
    tks_mesh_tree* tree = nullptr;
    const tks_status status = tks_decode_mesh_tree(decoder, kind, triangles, &tree);
    tks_free_mesh_tree(tree);
    return status;
  };
  return call;
}

/// The first three levels and the last one, each once.
inline std::set<uint32_t> levelsUpTo(uint32_t coarsest) {
  return {0, std::min(1u, coarsest), std::min(2u, coarsest), coarsest};
}

/// All that can be asked of a stream with such heights and such a texture.
/// A window in the middle of a level of so many samples, of some level and of level 0.
inline std::vector<DecodeCall> windowsOf(const tks_info& info, tks_part part) {
  const bool texture = part == TKS_PART_TEXTURE;
  const Extent whole =
      texture ? Extent{info.texture_width, info.texture_height} : Extent{info.width, info.height};
  const uint32_t patches = texture ? info.texture_forest.patches : info.forest.patches;
  const uint32_t coarsest = texture ? info.texture_coarsest_level : info.coarsest_level;
  std::vector<DecodeCall> calls;
  for (const uint32_t level : {0u, std::min(coarsest, 2u), std::min(coarsest, 4u)}) {
    const uint32_t rows = patches > 0 ? whole.height / patches : 0;
    const Extent at = View{static_cast<int>(level), {}, 0, rows}.extentIn(whole);
    const tks_window window{at.width / 3, at.height / 4, at.width / 5 + 1, at.height / 6 + 1};
    calls.push_back(windowOf(info, part, level, window));
  }
  return calls;
}

inline std::vector<DecodeCall> callsOn(const tks_info& info) {
  std::vector<DecodeCall> calls;
  if (info.has_heights) {
    const uint32_t w = info.width, h = info.height;
    for (const uint32_t level : levelsUpTo(info.coarsest_level))
      calls.push_back(heightsOf(info, level));
    calls.push_back(validityOf(info));
    for (const tks_window& window :
         {tks_window{0, 0, w, h}, {w / 3, h / 4, w / 5 + 1, h / 6 + 1}, {w - 1, h - 1, 1, 1}})
      calls.push_back(surfaceOf(info, window));
    for (const tks_part part : {TKS_PART_HEIGHTS, TKS_PART_VALIDITY})
      for (DecodeCall& call : windowsOf(info, part)) calls.push_back(std::move(call));
    calls.push_back(meshOf(TKS_MESH_CODED, 0));
    if (info.domain != TKS_DOMAIN_FOREST) {
      calls.push_back(treeOf(TKS_MESH_CODED, 0));
      calls.push_back(treeOf(TKS_MESH_BUDGET, 0));
    }
    for (const uint64_t sixtieths : {0, 1, 4, 8, 13, 25, 40, 70, 120})
      calls.push_back(
          meshOf(TKS_MESH_BUDGET, static_cast<uint32_t>(uint64_t{w} * h * sixtieths / 60)));
  }
  if (info.has_texture) {
    const uint32_t w = info.texture_width, h = info.texture_height;
    for (const uint32_t level : levelsUpTo(info.texture_coarsest_level))
      calls.push_back(textureOf(info, level));
    for (const tks_window& window :
         {tks_window{0, 0, w, h}, {w / 3, h / 4, w / 5 + 1, h / 6 + 1}, {w - 1, h - 1, 1, 1}})
      calls.push_back(textureOf(info, window));
    for (DecodeCall& call : windowsOf(info, TKS_PART_TEXTURE)) calls.push_back(std::move(call));
  }
  return calls;
}

}  // namespace tetrakis::test
