// SPDX-License-Identifier: Apache-2.0
#include "tests/awkward/surface_promises.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "tests/awkward/shared_samples.hpp"

namespace tetrakis::test {

namespace {

using Samples = std::vector<std::byte>;

tks_info infoOf(const tks_decoder* decoder) {
  tks_info info = {};
  info.size = sizeof info;
  tks_get_info(decoder, &info);
  return info;
}

/// Decodes all of the heights, the surface and the texture, and a window of each.
class Parts {
 public:
  explicit Parts(tks_decoder* decoder) : decoder_(decoder), info_(infoOf(decoder)) {
    sample_bytes_ = tks_sample_bytes(info_.sample);
    texel_bytes_ = info_.texture_channels * tks_sample_bytes(info_.texture_sample);
    const size_t count = size_t{info_.width} * info_.height;
    heights_.resize(count * sample_bytes_);
    surface_.resize(count * sizeof(float));
    texture_.resize(size_t{info_.texture_width} * info_.texture_height * texel_bytes_);
  }

  bool decode() {
    return tks_decode_heights(decoder_, heights_.data(), heights_.size()) == TKS_OK &&
           tks_decode_surface(decoder_, floats(surface_), surface_.size() / sizeof(float)) ==
               TKS_OK &&
           (texture_.empty() ||
            tks_decode_texture(decoder_, texture_.data(), texture_.size()) == TKS_OK);
  }

  std::string brokenWindow() const {
    const tks_window w = {info_.width / 3, info_.height / 2, 1 + info_.width / 4,
                          1 + info_.height / 3};
    const size_t count = size_t{w.width} * w.height;
    Samples seen(count * sample_bytes_), heights(count * sizeof(float));
    if (tks_decode_heights_window(decoder_, &w, seen.data(), seen.size()) != TKS_OK ||
        tks_decode_surface_window(decoder_, &w, floats(heights), count) != TKS_OK)
      return std::string("a window fails: ") + tks_message(decoder_);
    if (!isPart(seen, w, heights_, info_.width, sample_bytes_)) return "a window differs";
    if (!isPart(heights, w, surface_, info_.width, sizeof(float)))
      return "a window of the surface differs";
    return {};
  }

  std::string brokenTextureWindow() const {
    if (texture_.empty()) return {};
    const tks_window w = {info_.texture_width / 3, info_.texture_height / 2,
                          1 + info_.texture_width / 4, 1 + info_.texture_height / 3};
    Samples seen(size_t{w.width} * w.height * texel_bytes_);
    if (tks_decode_texture_window(decoder_, &w, seen.data(), seen.size()) != TKS_OK)
      return std::string("a window of the texture fails: ") + tks_message(decoder_);
    if (isPart(seen, w, texture_, info_.texture_width, texel_bytes_)) return {};
    return "a window of the texture differs";
  }

  std::string tornSamples(const AwkwardCase& c, const SharedSamples& shared) const {
    const auto told = [](const char* what, size_t at) {
      return std::string(what) + " " + std::to_string(at) + " differs from what it shares";
    };
    if (const auto at = shared.torn(heights_, sample_bytes_)) return told("sample", *at);
    if (const auto at = shared.torn(surface_, sizeof(float))) return told("height", *at);
    if (texture_.empty()) return {};
    const auto at = SharedSamples(c.texture_depth, c.sides).torn(texture_, texel_bytes_);
    return at ? told("texel", *at) : "";
  }

  float heightAt(size_t sample) const {
    float height = 0;
    std::memcpy(&height, surface_.data() + sample * sizeof height, sizeof height);
    return height;
  }
  const tks_info& info() const { return info_; }

 private:
  static float* floats(Samples& bytes) { return reinterpret_cast<float*>(bytes.data()); }

  static bool isPart(const Samples& part, const tks_window& w, const Samples& all, size_t width,
                     size_t bytes) {
    for (size_t row = 0; row < w.height; ++row) {
      const std::byte* const there = all.data() + ((w.y + row) * width + w.x) * bytes;
      if (!std::equal(there, there + w.width * bytes, part.data() + row * w.width * bytes))
        return false;
    }
    return true;
  }

  tks_decoder* decoder_;
  tks_info info_;
  size_t sample_bytes_, texel_bytes_;
  Samples heights_, surface_, texture_;
};

/// The corners of triangles, as places that are one where they are equal.
template <class Key>
class Edges {
 public:
  Edges(std::span<const uint32_t> triangles, const std::vector<Key>& keys) {
    for (size_t i = 0; i < triangles.size(); ++i) {
      const Key& a = keys[triangles[i]];
      const Key& b = keys[triangles[i % 3 == 2 ? i - 2 : i + 1]];
      if (a != b) balance_[std::minmax(a, b)] += a < b ? 1 : -1;
    }
  }

  /// An edge that does not run as often one way as the other.
  template <class Excuse>
  bool open(const Excuse& excused) const {
    return std::any_of(balance_.begin(), balance_.end(), [&](const auto& edge) {
      return edge.second != 0 && !(excused(edge.first.first) && excused(edge.first.second));
    });
  }

 private:
  std::map<std::pair<Key, Key>, int> balance_;
};

std::string brokenMesh(const Parts& parts, const SharedSamples& shared, const tks_mesh& mesh,
                       bool all) {
  const std::span<const uint32_t> triangles(mesh.triangles, 3 * size_t{mesh.triangle_count});
  std::vector<uint32_t> keys;
  for (uint32_t v = 0; v < mesh.vertex_count; ++v) {
    const uint32_t sample = mesh.grid_index[v];
    if (sample >= parts.info().width * parts.info().height) return "a vertex lies nowhere";
    keys.push_back(shared.firstOf(sample));
    if (all && mesh.height[v] != parts.heightAt(sample)) return "a vertex lies off the surface";
  }
  for (const uint32_t corner : triangles)
    if (corner >= mesh.vertex_count) return "a triangle has a corner that is no vertex";
  const Edges<uint32_t> edges(triangles, keys);
  return edges.open([&](uint32_t sample) { return shared.onBorder(sample); })
             ? "a mesh has an open edge"
             : "";
}

std::string brokenMeshes(tks_decoder* decoder, const Parts& parts, const SharedSamples& shared) {
  const uint32_t base = 2 * parts.info().forest.patches;
  for (const uint32_t triangles : {0u, 1u, 40u, 700u}) {
    for (const tks_mesh_kind kind : {TKS_MESH_BUDGET, TKS_MESH_CODED}) {
      const bool budget = kind == TKS_MESH_BUDGET;
      if (!budget && triangles > 0) continue;
      tks_mesh mesh = {};
      if (tks_decode_mesh(decoder, kind, triangles, &mesh) != TKS_OK)
        return std::string("a mesh fails: ") + tks_message(decoder);
      const bool many = triangles > 0 && mesh.triangle_count > std::max(triangles, base);
      std::string found = brokenMesh(parts, shared, mesh, budget && triangles == 0);
      tks_free_mesh(&mesh);
      if (many) return "a mesh has more triangles than asked for";
      if (!found.empty()) return found + ", of " + std::to_string(triangles) + " triangles";
    }
  }
  return {};
}

/// Whether the middles of the outer rows of a grid lie less than a row before the poles.
bool reachesPoles(const tks_geographic_grid& grid) {
  const double first = grid.geotransform[3], row = grid.geotransform[5];
  const double ends[] = {first + row / 2, first + row * (grid.height - 0.5)};
  return 90 - std::max(ends[0], ends[1]) < std::abs(row) &&
         90 + std::min(ends[0], ends[1]) < std::abs(row);
}

std::string brokenGlobe(tks_decoder* decoder, uint32_t triangles, bool closed) {
  const tks_globe globe = {sizeof globe, 6378137, 6356752.314245, 1, 1};
  tks_globe_mesh mesh = {};
  if (tks_decode_globe(decoder, TKS_MESH_BUDGET, triangles, &globe, &mesh) != TKS_OK)
    return std::string("a globe fails: ") + tks_message(decoder);
  std::vector<std::array<double, 3>> places(mesh.vertex_count);
  for (size_t v = 0; v < places.size(); ++v) std::copy_n(mesh.position + 3 * v, 3, &places[v][0]);
  const std::span<const uint32_t> corners(mesh.triangles, 3 * size_t{mesh.triangle_count});
  std::string found;
  for (const auto& place : places)
    if (!std::isfinite(place[0] + place[1] + place[2])) found = "a vertex of a globe lies nowhere";
  for (const uint32_t corner : corners)
    if (corner >= places.size()) found = "a triangle of a globe has a corner that is no vertex";
  const auto nowhere = [](const auto&) { return false; };
  if (found.empty() && closed && Edges<std::array<double, 3>>(corners, places).open(nowhere))
    found = "a globe of " + std::to_string(triangles) + " triangles has an open edge";
  tks_free_globe_mesh(&mesh);
  return found;
}

}  // namespace

std::string brokenSurface(const AwkwardCase& c, tks_decoder* decoder) {
  Parts parts(decoder);
  if (!parts.decode()) return std::string("decoding fails: ") + tks_message(decoder);
  std::string found = parts.brokenWindow();
  if (found.empty()) found = parts.brokenTextureWindow();
  if (found.empty() && !c.sides.empty()) {
    const SharedSamples shared(c.depth, c.sides);
    found = parts.tornSamples(c, shared);
    if (found.empty()) found = brokenMeshes(decoder, parts, shared);
  }
  if (!found.empty() || !c.grid) return found;
  const bool cube = !c.sides.empty();
  const bool closed = cube || (!parts.info().has_voids && reachesPoles(*c.grid));
  for (const uint32_t triangles : {0u, 40u, 900u}) {
    found = brokenGlobe(decoder, triangles, closed);
    if (!found.empty()) return found;
  }
  return {};
}

}  // namespace tetrakis::test
