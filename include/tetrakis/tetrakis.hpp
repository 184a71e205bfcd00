// SPDX-License-Identifier: Apache-2.0
// Tetrakis for C++20: owning types and spans over the C interface of tetrakis.h. Header only;
// throws nothing but std::bad_alloc. The trust contract is that of tetrakis.h.
#pragma once

#if __cplusplus < 202002L
#error "tetrakis.hpp takes C++20 (-std=c++20); tetrakis.h takes C99 or any C++."
#endif

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "tetrakis/components.h"
#include "tetrakis/result.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis {
// Inline: users write tetrakis::Decoder, while the symbols stay apart from the library's own
// classes.
inline namespace v0 {

/// A stream as the encoder returned it. Move only.
class Buffer {
 public:
  explicit Buffer(tks_buffer buffer) : buffer_(buffer) {}
  Buffer(Buffer&& other) noexcept : buffer_(std::exchange(other.buffer_, {})) {}
  Buffer& operator=(Buffer&& other) noexcept {
    std::swap(buffer_, other.buffer_);
    return *this;
  }
  ~Buffer() { tks_free_buffer(&buffer_); }

  std::span<const uint8_t> bytes() const { return {buffer_.data, buffer_.size}; }

 private:
  tks_buffer buffer_{};
};

/// What meshes of the C interface have in common: their arrays are freed with them. Move only.
template <class M, void (*Free)(M*)>
class OwnedMesh {
 public:
  explicit OwnedMesh(M mesh) : mesh_(mesh) {}
  OwnedMesh(OwnedMesh&& other) noexcept : mesh_(std::exchange(other.mesh_, {})) {}
  OwnedMesh& operator=(OwnedMesh&& other) noexcept {
    std::swap(mesh_, other.mesh_);
    return *this;
  }
  ~OwnedMesh() { Free(&mesh_); }

  /// Height of each vertex, in the unit of the stream.
  std::span<const float> heights() const { return {mesh_.height, mesh_.vertex_count}; }
  /// Three vertex indices a triangle, counter-clockwise seen from above, or from outside.
  std::span<const uint32_t> triangles() const {
    return {mesh_.triangles, size_t{3} * mesh_.triangle_count};
  }
  uint32_t vertexCount() const { return mesh_.vertex_count; }
  uint32_t triangleCount() const { return mesh_.triangle_count; }

 protected:
  M mesh_{};
};

/// A conforming 4-8 mesh (tks_mesh says what its arrays promise).
class Mesh : public OwnedMesh<tks_mesh, tks_free_mesh> {
 public:
  using OwnedMesh::OwnedMesh;

  /// y * width + x of the sample under each vertex.
  std::span<const uint32_t> gridIndices() const { return {mesh_.grid_index, mesh_.vertex_count}; }
};

/// A mesh round a globe (tks_globe_mesh says what its arrays promise).
class GlobeMesh : public OwnedMesh<tks_globe_mesh, tks_free_globe_mesh> {
 public:
  using OwnedMesh::OwnedMesh;

  /// x, y, z of each vertex, in metres from the centre.
  std::span<const double> positions() const {
    return {mesh_.position, size_t{3} * mesh_.vertex_count};
  }
  /// Column and row of each vertex, as in tks_pixel.
  std::span<const double> pixels() const { return {mesh_.pixel, size_t{2} * mesh_.vertex_count}; }
};

/// The mesh of an object (tks_object_mesh says what its arrays promise). Positions are in the unit
/// of the stream, in the axes of the mesh that was encoded.
class ObjectMesh : public OwnedMesh<tks_object_mesh, tks_free_object_mesh> {
 public:
  using OwnedMesh::OwnedMesh;

  std::span<const double> positions() const {
    return {mesh_.position, size_t{3} * mesh_.vertex_count};
  }
  /// Empty where there is no base mesh, as the heights are.
  std::span<const double> pixels() const { return pairsOf(mesh_.pixel); }
  std::span<const float> heights() const {
    return {mesh_.height, mesh_.height == nullptr ? 0 : mesh_.vertex_count};
  }
  /// Empty where there is no texture.
  std::span<const double> texcoords() const { return pairsOf(mesh_.texcoord); }

 private:
  std::span<const double> pairsOf(const double* pairs) const {
    return {pairs, pairs == nullptr ? 0 : size_t{2} * mesh_.vertex_count};
  }
};

/// A mesh kept for many views (tks_mesh_tree). Move only; outlives its decoder.
class MeshTree {
 public:
  explicit MeshTree(tks_mesh_tree* tree) : tree_(tree) {}

  /// What a camera may see: tks_view_mesh says what `clip` is.
  Result<Mesh> view(std::span<const double, 16> clip) const {
    tks_mesh mesh{};
    const tks_status status = tks_view_mesh(tree_.get(), clip.data(), &mesh);
    if (status == TKS_USAGE) return Status(status, "The matrix of a view must be finite.");
    if (status != TKS_OK) return Status(status, "Not enough memory.");
    return Mesh(mesh);
  }

 private:
  struct Free {
    void operator()(tks_mesh_tree* tree) const { tks_free_mesh_tree(tree); }
  };
  std::unique_ptr<tks_mesh_tree, Free> tree_;
};

/// The `size` members set, everything else zero: fill in the rest.
inline tks_heights makeHeights() {
  tks_heights heights{};
  heights.size = sizeof heights;
  heights.scale = 1;
  return heights;
}
inline tks_screen_camera makeScreenCamera() {
  tks_screen_camera camera{};
  camera.size = sizeof camera;
  return camera;
}
inline tks_image makeImage() {
  tks_image image{};
  image.size = sizeof image;
  return image;
}
inline tks_encode_options makeEncodeOptions() {
  tks_encode_options options{};
  options.size = sizeof options;
  return options;
}
inline tks_triangle_mesh makeTriangleMesh() {
  tks_triangle_mesh mesh{};
  mesh.size = sizeof mesh;
  return mesh;
}
inline tks_ground makeGround() {
  tks_ground ground{};
  ground.size = sizeof ground;
  return ground;
}
inline tks_limits makeLimits() {
  tks_limits limits{};
  limits.size = sizeof limits;
  return limits;
}

/// Encodes heights, an image, or both (a null pointer leaves one out). Errors: see tks_encode.
inline Result<Buffer> encode(const tks_heights* heights, const tks_image* image,
                             const tks_encode_options& options) {
  char message[512] = "";
  tks_buffer buffer{};
  const tks_status status = tks_encode(heights, image, &options, &buffer, message, sizeof message);
  if (status != TKS_OK) return Status(status, message);
  return Buffer(buffer);
}

/// One stream of the components of several (tks_combine).
inline Result<Buffer> combine(std::span<const tks_combined> streams,
                              const tks_combine_options& options = {sizeof(tks_combine_options), 0,
                                                                    nullptr}) {
  char message[512] = "";
  tks_buffer buffer{};
  const tks_status status = tks_combine(streams.data(), static_cast<uint32_t>(streams.size()),
                                        &options, &buffer, message, sizeof message);
  if (status != TKS_OK) return Status(status, message);
  return Buffer(buffer);
}

/// Encodes a mesh of triangles as an object, with its image unless that is null. report, unless
/// null: becomes what became of the mesh. Errors: see tks_encode_object.
inline Result<Buffer> encodeObject(const tks_triangle_mesh& mesh, const tks_image* image,
                                   const tks_encode_options& options,
                                   tks_object_report* report = nullptr) {
  char message[512] = "";
  tks_buffer buffer{};
  if (report != nullptr) report->size = sizeof *report;
  const tks_status status =
      tks_encode_object(&mesh, image, &options, report, &buffer, message, sizeof message);
  if (status != TKS_OK) return Status(status, message);
  return Buffer(buffer);
}

/// Positions of a raster for tks_heights and tks_image. Errors: see tks_fit_positions.
inline Result<Buffer> fitPositions(const tks_ground& ground) {
  tks_buffer buffer{};
  const tks_status status = tks_fit_positions(&ground, &buffer);
  if (status != TKS_OK)
    return Status(status, "No positions of so few bytes are as good as the tolerance asks.");
  return Buffer(buffer);
}

/// How many bytes the header of a stream takes, as far as `bytes` tell (tks_header_bytes): more
/// than bytes.size() unless the header is whole.
inline Result<uint64_t> headerBytes(std::span<const uint8_t> bytes) {
  uint64_t needed = 0;
  const tks_status status = tks_header_bytes(bytes.data(), bytes.size(), &needed);
  if (needed == 0) return Status(status, "This is no stream that the library knows.");
  return needed;
}

/// Decodes a stream or any prefix of one. Move only; one decoder serves one thread at a time.
class Decoder {
 public:
  /// `bytes` are borrowed and must outlive the decoder, or its first append(). TKS_TRUNCATED: too
  /// short for the header.
  static Result<Decoder> open(std::span<const uint8_t> bytes,
                              const tks_limits& limits = makeLimits()) {
    char message[512] = "";
    tks_decoder* decoder = nullptr;
    const tks_status status =
        tks_open(bytes.data(), bytes.size(), &limits, &decoder, message, sizeof message);
    if (status != TKS_OK) return Status(status, message);
    return withInfo(Decoder(decoder, Close{true}));
  }
  /// A decoder that somebody else closes.
  static Result<Decoder> borrow(tks_decoder* decoder) {
    return withInfo(Decoder(decoder, Close{false}));
  }

  /// Sizes, types and metadata; its strings live as long as the decoder.
  const tks_info& info() const { return info_; }

  /// Longitude and latitude of a pixel, in degrees (tks_locate). TKS_UNSUPPORTED: the stream holds
  /// no positions of this part.
  Result<std::array<double, 2>> locate(const tks_pixel& pixel) {
    std::array<double, 2> place{};
    if (const tks_status got = tks_locate(decoder_.get(), &pixel, &place[0], &place[1]);
        got != TKS_OK)
      return failure(got);
    return place;
  }

  /// More bytes of the stream, which are copied: those behind the ones that are there
  /// (tks_append), from an offset on (tks_put), or many runs at once (tks_put_ranges; data: the
  /// bytes of each range). info() follows.
  Status append(std::span<const uint8_t> bytes) {
    return taken(tks_append(decoder_.get(), bytes.data(), bytes.size()));
  }
  Status put(uint64_t offset, std::span<const uint8_t> bytes) {
    return taken(tks_put(decoder_.get(), offset, bytes.data(), bytes.size()));
  }
  Status put(std::span<const tks_range> ranges, std::span<const uint8_t* const> data) {
    if (data.size() != ranges.size()) return Status(TKS_USAGE, "Each range has its bytes.");
    return taken(tks_put_ranges(decoder_.get(), ranges.data(), data.data(), ranges.size()));
  }

  /// Which bytes such a call needs for what it would decode of the complete stream, which has a
  /// front index (tks_needed_ranges).
  Result<std::vector<tks_range>> neededRanges(tks_part part, const tks_window* window = nullptr) {
    tks_ranges ranges{};
    const tks_status status = tks_needed_ranges(decoder_.get(), part, window, &ranges);
    if (status != TKS_OK) return failure(status);
    std::vector<tks_range> result(ranges.ranges, ranges.ranges + ranges.count);
    tks_free_ranges(&ranges);
    return result;
  }

  /// Mip levels of heights and texture, 0 the whole image: tks_set_levels says what they are.
  /// info() follows.
  Status setLevels(uint32_t heights, uint32_t texture) {
    return taken(tks_set_levels(decoder_.get(), heights, texture));
  }

  /// One of info().components components (tks_get_component); its name lives until another
  /// component is chosen.
  Result<tks_component> component(uint32_t number) const {
    tks_component component{};
    component.size = sizeof component;
    const tks_status status = tks_get_component(decoder_.get(), number, &component);
    if (status != TKS_OK) return Status(status, "The stream has no such component.");
    return component;
  }
  /// Takes a component for the heights, or for the texture (tks_choose_component). info() follows.
  Status choose(uint32_t number) { return taken(tks_choose_component(decoder_.get(), number)); }

  /// The frame that is shown from now on, of a stream of several (tks_set_frame). info() follows.
  Status setFrame(uint32_t frame) { return taken(tks_set_frame(decoder_.get(), frame)); }

  /// Whether such a call stays within tks_limits.max_memory with `beside` more bytes: what the call
  /// takes, or TKS_LIMIT (tks_check_memory). The calls below check the same with the array that
  /// they return, before there is one.
  Result<uint64_t> checkMemory(tks_part part, const tks_window* window = nullptr,
                               uint32_t max_triangles = 0, uint64_t beside = 0) {
    uint64_t bytes = 0;
    const tks_status status =
        tks_check_memory(decoder_.get(), part, window, max_triangles, beside, &bytes);
    if (status != TKS_OK) return failure(status);
    return bytes;
  }

  /// width * height samples of info().sample, host byte order, row by row.
  Result<std::vector<std::byte>> heights() {
    return whole<std::byte>(TKS_PART_HEIGHTS, heightCount() * tks_sample_bytes(info_.sample),
                            tks_decode_heights);
  }

  /// width * height bytes, 1 where a sample is valid, 0 where it is void.
  Result<std::vector<uint8_t>> validity() {
    return whole<uint8_t>(TKS_PART_VALIDITY, heightCount(), tks_decode_validity);
  }

  /// width * height heights in info().unit, also between the steps of the sample type: for drawing.
  Result<std::vector<float>> surface() {
    return whole<float>(TKS_PART_HEIGHTS, heightCount(), tks_decode_surface);
  }

  /// texture_width * texture_height * texture_channels samples of info().texture_sample.
  Result<std::vector<std::byte>> texture() {
    return whole<std::byte>(TKS_PART_TEXTURE,
                            size_t{info_.texture_width} * info_.texture_height * texelBytes(),
                            tks_decode_texture);
  }

  /// The same in a window: tks_decode_heights_window and its siblings say what it may be.
  Result<std::vector<std::byte>> heights(const tks_window& window) {
    return part<std::byte>(TKS_PART_HEIGHTS, window, tks_sample_bytes(info_.sample),
                           tks_decode_heights_window);
  }
  Result<std::vector<float>> surface(const tks_window& window) {
    return part<float>(TKS_PART_HEIGHTS, window, 1, tks_decode_surface_window);
  }
  /// In a window of a grid that heights on a cube were made of: tks_decode_grid.
  Result<std::vector<float>> grid(const tks_geographic_grid& grid, const tks_window& window) {
    if (window.width > grid.width || window.height > grid.height)
      return Status(TKS_USAGE, "The window does not lie in the grid.");
    std::vector<float> out(size_t{window.width} * window.height);
    const tks_status status =
        tks_decode_grid(decoder_.get(), &grid, &window, out.data(), out.size());
    if (status != TKS_OK) return failure(status);
    return out;
  }
  Result<std::vector<uint8_t>> validity(const tks_window& window) {
    return part<uint8_t>(TKS_PART_VALIDITY, window, 1, tks_decode_validity_window);
  }
  Result<std::vector<std::byte>> texture(const tks_window& window) {
    return part<std::byte>(TKS_PART_TEXTURE, window, texelBytes(), tks_decode_texture_window);
  }

  /// Threads that decoding may use; the result does not depend on them.
  void setThreads(uint32_t threads) { tks_set_threads(decoder_.get(), threads); }

  /// The mesh that the stream itself codes: closure of its significant vertices.
  Result<Mesh> codedMesh() { return mesh(TKS_MESH_CODED, 0); }

  /// The best mesh of the decoded surface with at most max_triangles; 0: every sample.
  Result<Mesh> budgetMesh(uint32_t max_triangles) { return mesh(TKS_MESH_BUDGET, max_triangles); }

  /// The best mesh for cameras with at most max_triangles (tks_decode_screen_mesh). texture: what
  /// covers the ground; null: unknown.
  Result<Mesh> screenMesh(std::span<const tks_screen_camera> cameras, uint32_t max_triangles,
                          const tks_image* texture = nullptr) {
    const tks_screen screen = {sizeof screen, cameras.data(), static_cast<uint32_t>(cameras.size()),
                               texture};
    tks_mesh result{};
    const tks_status status =
        tks_decode_screen_mesh(decoder_.get(), &screen, max_triangles, &result);
    if (status != TKS_OK) return failure(status);
    return Mesh(result);
  }

  /// The first two, closed and bent round a globe (tks_decode_globe).
  Result<GlobeMesh> codedGlobe(const tks_globe& on) { return globe(TKS_MESH_CODED, 0, on); }
  Result<GlobeMesh> budgetGlobe(const tks_globe& on, uint32_t max_triangles) {
    return globe(TKS_MESH_BUDGET, max_triangles, on);
  }

  /// The mesh of an object (tks_decode_object); max_triangles of TKS_MESH_BUDGET, 0: every sample.
  Result<ObjectMesh> objectMesh(tks_mesh_kind kind, uint32_t max_triangles = 0) {
    tks_object_mesh result{};
    const tks_status status = tks_decode_object(decoder_.get(), kind, max_triangles, &result);
    if (status != TKS_OK) return failure(status);
    return ObjectMesh(result);
  }

  /// The first two, kept in a tree that gives the part that a view sees.
  Result<MeshTree> codedMeshTree() { return meshTree(TKS_MESH_CODED, 0); }
  Result<MeshTree> budgetMeshTree(uint32_t max_triangles) {
    return meshTree(TKS_MESH_BUDGET, max_triangles);
  }

  /// What to fetch next for a view (null: all ground alike): tks_plan says what comes first.
  Result<std::vector<tks_range>> plan(const tks_screen_camera* view, uint64_t bytes,
                                      uint32_t triangles = 0, uint64_t request_bytes = 0) {
    const tks_fetch fetch = {sizeof fetch, bytes, triangles, request_bytes};
    tks_ranges ranges{};
    const tks_status status = tks_plan(decoder_.get(), view, &fetch, &ranges);
    if (status != TKS_OK) return failure(status);
    std::vector<tks_range> result(ranges.ranges, ranges.ranges + ranges.count);
    tks_free_ranges(&ranges);
    return result;
  }

  /// The same packets in the order that helps cameras most (tks_reorder).
  Result<Buffer> reordered(std::span<const tks_screen_camera> cameras) {
    tks_buffer buffer{};
    const tks_status status =
        tks_reorder(decoder_.get(), cameras.data(), static_cast<uint32_t>(cameras.size()), &buffer);
    if (status != TKS_OK) return failure(status);
    return Buffer(buffer);
  }

  /// Checks the syntax of the whole stream. TKS_TRUNCATED if it ends early.
  Status verify() {
    const tks_status status = tks_verify(decoder_.get());
    if (status != TKS_OK) return failure(status);
    return {};
  }

 private:
  struct Close {
    bool owns = true;
    void operator()(tks_decoder* decoder) const {
      if (owns) tks_close(decoder);
    }
  };
  Decoder(tks_decoder* decoder, Close close) : decoder_(decoder, close) {}

  static Result<Decoder> withInfo(Decoder decoder) {
    decoder.info_.size = sizeof(tks_info);
    if (const tks_status got = tks_get_info(decoder.decoder_.get(), &decoder.info_); got != TKS_OK)
      return decoder.failure(got);
    return decoder;
  }

  /// status: not TKS_OK.
  Status failure(tks_status status) const { return {status, tks_message(decoder_.get())}; }

  /// info() follows what a call has changed.
  Status taken(tks_status status) {
    if (status != TKS_OK) return failure(status);
    if (const tks_status got = tks_get_info(decoder_.get(), &info_); got != TKS_OK)
      return failure(got);
    return {};
  }

  size_t heightCount() const { return size_t{info_.width} * info_.height; }
  size_t texelBytes() const {
    return tks_sample_bytes(info_.texture_sample) * info_.texture_channels;
  }

  template <class T, class Decode>
  Result<std::vector<T>> whole(tks_part what, size_t count, Decode* decode) {
    if (const auto fits = checkMemory(what, nullptr, 0, count * sizeof(T)); !fits)
      return fits.status();
    std::vector<T> out(count);
    const tks_status status = decode(decoder_.get(), out.data(), out.size());
    if (status != TKS_OK) return failure(status);
    return out;
  }

  /// items: of each place of the window.
  template <class T, class Decode>
  Result<std::vector<T>> part(tks_part what, const tks_window& window, size_t items,
                              Decode* decode) {
    // A window that cannot be is refused before there is an array for it.
    const uint64_t count = uint64_t{window.width} * window.height * items;
    if (const auto fits = checkMemory(what, &window, 0, count * sizeof(T)); !fits)
      return fits.status();
    std::vector<T> out(static_cast<size_t>(count));
    const tks_status status = decode(decoder_.get(), &window, out.data(), out.size());
    if (status != TKS_OK) return failure(status);
    return out;
  }

  Result<Mesh> mesh(tks_mesh_kind kind, uint32_t max_triangles) {
    tks_mesh result{};
    const tks_status status = tks_decode_mesh(decoder_.get(), kind, max_triangles, &result);
    if (status != TKS_OK) return failure(status);
    return Mesh(result);
  }

  Result<GlobeMesh> globe(tks_mesh_kind kind, uint32_t max_triangles, const tks_globe& on) {
    tks_globe_mesh result{};
    const tks_status status = tks_decode_globe(decoder_.get(), kind, max_triangles, &on, &result);
    if (status != TKS_OK) return failure(status);
    return GlobeMesh(result);
  }

  Result<MeshTree> meshTree(tks_mesh_kind kind, uint32_t max_triangles) {
    tks_mesh_tree* tree = nullptr;
    const tks_status status = tks_decode_mesh_tree(decoder_.get(), kind, max_triangles, &tree);
    if (status != TKS_OK) return failure(status);
    return MeshTree(tree);
  }

  std::unique_ptr<tks_decoder, Close> decoder_;
  tks_info info_{};
};

}  // namespace v0
}  // namespace tetrakis
