// SPDX-License-Identifier: Apache-2.0
// Objects through the C interface: a mesh of any triangles becomes heights over a base mesh, and
// these a stream. How many triangles the base has is found by trying: a fine base takes bytes, a
// coarse one leaves more to its heights, and loses thin parts.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "api/encoded_stream.hpp"
#include "api/guarded.hpp"
#include "base/forest.hpp"
#include "base/portable_math.hpp"
#include "base/watch.hpp"
#include "codec/remesh/mesh_colours.hpp"
#include "codec/remesh/mesh_distance.hpp"
#include "codec/remesh/mesh_topology.hpp"
#include "codec/remesh/object.hpp"

namespace tetrakis::inline api {
namespace {

constexpr uint32_t kMostElements = 1u << 26;  ///< points, and triangles

/// Base meshes are tried that have this many triangles, or 2^k times as many.
constexpr uint32_t kFewestTriangles = 125, kMostTriangles = 8000;

/// Bytes of a budget for each triangle of the base that is tried first.
constexpr double kBytesForTriangle = 5;

/// Most of a squared error comes from the coding, not from the resampling.
constexpr double kResamplingPart = 1.0 / 3;

Status misused(const std::string& sentence) {
  return {TKS_USAGE, sentence};
}

Result<TriangleMesh> meshOf(const tks_triangle_mesh& given) {
  if (given.vertex_count > kMostElements || given.triangle_count > kMostElements)
    return misused("A mesh has at most 67108864 vertices and triangles.");
  if (given.triangle_count == 0 || given.positions == nullptr || given.triangles == nullptr)
    return misused("The mesh has no triangles.");
  TriangleMesh mesh;
  mesh.points.resize(given.vertex_count);
  for (uint32_t v = 0; v < given.vertex_count; ++v) {
    std::copy_n(given.positions + 3 * size_t{v}, 3, mesh.points[v].begin());
    for (const double value : mesh.points[v]) {
      if (!(std::abs(value) <= 1e30))
        return misused("Vertex " + std::to_string(v) + " of the mesh lies at no finite place.");
    }
  }
  mesh.triangles.resize(given.triangle_count);
  for (uint32_t t = 0; t < given.triangle_count; ++t) {
    std::copy_n(given.triangles + 3 * size_t{t}, 3, mesh.triangles[t].begin());
    for (const uint32_t corner : mesh.triangles[t]) {
      if (corner >= given.vertex_count)
        return misused("Triangle " + std::to_string(t) + " of the mesh names vertex " +
                       std::to_string(corner) + ", which is not there.");
    }
  }
  return mesh;
}

/// Of a mesh with a texture, what its heights get while a base is sought, and no fewer bytes than
/// the least.
constexpr double kHeightsPart = 0.25;
constexpr uint64_t kLeastHeightBytes = 1000;

/// Places of either surface by which bases are compared; reports take more.
constexpr size_t kTrialPlaces = 6000;

/// Texels for each byte of a budget: more cannot be told from fewer.
constexpr double kTexelsForByte = 64;

Status checkImage(const tks_triangle_mesh& mesh, const tks_image* image) {
  if (image == nullptr) return {};
  if (mesh.texcoords == nullptr)
    return misused("The mesh has no texture coordinates for its image.");
  const bool sound = image->data != nullptr && image->channels >= 1 && image->channels <= 4 &&
                     image->width >= 1 && image->height >= 1 &&
                     (image->sample == TKS_U8 || image->sample == TKS_U16) &&
                     image->domain == TKS_DOMAIN_PLANE;
  return sound ? Status() : misused("The image of a mesh has 8 or 16 bits and 1 to 4 channels.");
}

MeshImage imageOf(const tks_image& image) {
  const size_t values = size_t{image.width} * image.height * image.channels;
  MeshImage out{image.width, image.height, image.channels, {}, {}};
  if (image.sample == TKS_U8)
    out.bytes = {static_cast<const uint8_t*>(image.data), values};
  else
    out.shorts = {static_cast<const uint16_t*>(image.data), values};
  return out;
}

/// A texture on the patches of an object.
struct PatchTexture {
  std::vector<uint8_t> bytes;
  std::vector<uint16_t> shorts;
  Forest forest;
};

/// A base that was tried, and the stream over it.
struct Trial {
  ResampledObject object;
  std::vector<uint8_t> stream;
  double resampling_error = 0;
  MeshDistance distance;
  uint32_t texture_depth = 0;
};

using SharedTrial = std::shared_ptr<const Trial>;

/// Samples for each patch: more show the mesh better, and take time.
constexpr int kDepth = 4;

/// Coarse bases need fewer bits: heights make up for what their corners are off.
int positionBits(uint32_t triangles) {
  return triangles <= 1000 ? 8 : triangles <= 4000 ? 9 : 10;
}

/// Tells the caller how far the search is. Nobody knows how many bases will be tried: each takes a
/// part of what is left.
class SearchProgress {
 public:
  explicit SearchProgress(const tks_encode_options& options) : options_(options) {}

  /// A base is tried by an encoding under these options.
  void attend(tks_encode_options& options) {
    begin_ = done_;
    options.progress = options_.progress != nullptr ? &SearchProgress::told : nullptr;
    options.user = this;
  }
  bool isStopped() const { return stopped_; }

 private:
  static int told(void* user, double done) {
    constexpr double kOfTheRest = 0.4;
    auto& self = *static_cast<SearchProgress*>(user);
    self.done_ = self.begin_ + done * kOfTheRest * (1 - self.begin_);
    self.stopped_ = self.options_.progress(self.options_.user, self.done_) != 0;
    return self.stopped_;
  }

  const tks_encode_options& options_;
  double begin_ = 0, done_ = 0;
  bool stopped_ = false;
};

class ObjectEncoder {
 public:
  /// image: null, or checked.
  ObjectEncoder(const tks_triangle_mesh& given, const TriangleMesh& mesh, const tks_image* image,
                const tks_encode_options& options)
      : given_(given),
        image_(image),
        options_(options),
        source_(mesh, kFewestTriangles),
        progress_(options) {}

  const ObjectSource& source() const { return source_; }

  Result<SharedTrial> encode() {
    if (source_.cleaned().mesh.triangles.empty())
      return misused("No triangle of the mesh is left: all have corners at equal places.");
    if (source_.fewestTriangles() > 2 * Forest::kMostPatches)
      return misused("The smallest base mesh has " + std::to_string(source_.fewestTriangles()) +
                     " triangles; a stream takes at most " +
                     std::to_string(2 * Forest::kMostPatches) + ". Leave small parts out.");
    Result<SharedTrial> taken = options_.bytes > 0 ? withinBytes() : withinError();
    if (taken.ok() && image_ != nullptr) taken = withTexture(**taken);
    if (!taken.ok()) return taken;
    Trial measured = **taken;
    measured.resampling_error =
        distanceOf(measured.object, measured.object.surface.heights, kDistanceSamples).error;
    std::vector<float> heights(measured.object.surface.heights.size());
    if (Status decoded = decode(measured.stream, heights); !decoded.ok()) return decoded;
    measured.distance = distanceOf(measured.object, heights, kDistanceSamples);
    return std::make_shared<const Trial>(std::move(measured));
  }

 private:
  /// The base with the least error within the budget: from the one tried first to finer or coarser
  /// ones, as long as they are better.
  Result<SharedTrial> withinBytes() {
    const double wished = static_cast<double>(heightBytes()) / kBytesForTriangle;
    uint32_t triangles = kFewestTriangles;
    while (triangles < mostTriangles() && triangles * std::sqrt(2.0) < wished) triangles *= 2;
    Result<SharedTrial> best = inBudget(triangles);
    const auto better = [&](const Result<SharedTrial>& trial) {
      return trial.ok() && (!best.ok() || (*trial)->distance.error < (*best)->distance.error);
    };
    bool found_finer = false;
    for (uint32_t finer = 2 * triangles; finer <= mostTriangles() && best.ok(); finer *= 2) {
      Result<SharedTrial> trial = inBudget(finer);
      if (!better(trial)) break;
      best = std::move(trial);
      found_finer = true;
    }
    for (uint32_t coarser = triangles / 2; !found_finer && coarser >= kFewestTriangles;
         coarser /= 2) {
      Result<SharedTrial> trial = inBudget(coarser);
      const bool unmet = !best.ok();
      if (better(trial))
        best = std::move(trial);
      else if (!unmet)
        break;
    }
    return best;
  }

  /// The first size of a base that all triangles of the mesh fit in, or the largest one.
  uint32_t mostTriangles() const {
    uint32_t most = kFewestTriangles;
    while (most < kMostTriangles && most < source_.cleaned().mesh.triangles.size()) most *= 2;
    return most;
  }

  /// Of a budget, while a base is sought.
  uint64_t heightBytes() const {
    if (image_ == nullptr) return options_.bytes;
    const double part = kHeightsPart * static_cast<double>(options_.bytes);
    return std::min(options_.bytes, std::max(kLeastHeightBytes, static_cast<uint64_t>(part)));
  }

  Result<SharedTrial> inBudget(uint32_t triangles) {
    tks_encode_options options = options_;
    options.psnr = options.max_error = 0;
    options.bytes = heightBytes();
    return coded({resampled(triangles), {}, 0, {}}, options, nullptr);
  }

  /// The heights of a trial beside the texture, which the target is of as well.
  Result<SharedTrial> withTexture(const Trial& trial) {
    const PatchTexture texture = textureOn(trial.object);
    tks_image image = *image_;
    const Extent raster = texture.forest.raster();
    image.width = raster.width;
    image.height = raster.height;
    image.data = texture.bytes.empty() ? static_cast<const void*>(texture.shorts.data())
                                       : static_cast<const void*>(texture.bytes.data());
    image.has_geotransform = 0;
    image.domain = TKS_DOMAIN_FOREST;
    image.forest = {static_cast<uint32_t>(texture.forest.depth()), texture.forest.patches(),
                    texture.forest.sides().data()};
    Trial both = trial;
    both.texture_depth = image.forest.depth;
    return coded(std::move(both), options_, &image);
  }

  /// As many texels as the mesh shows of the image, unless the budget is too small for them.
  PatchTexture textureOn(const ResampledObject& object) const {
    const MeshColours texels(
        source_.cleaned(), {given_.texcoords, 6 * size_t{given_.triangle_count}}, imageOf(*image_));
    double wanted = texels.shown();
    if (options_.bytes > 0)
      wanted = std::min(wanted, kTexelsForByte * static_cast<double>(options_.bytes));
    int depth = 1;
    const double patches = object.base.forest->patches();
    while (depth < TKS_MOST_OBJECT_DEPTH && patches * std::ldexp(1.0, 2 * depth) < wanted &&
           object.base.forest->patches() < Forest::mostPatches(depth + 1))
      ++depth;
    PatchTexture out{{}, {}, Forest(depth, object.base.forest->sides())};
    out.shorts = texels.at(source_.placesOn(object, depth));
    if (image_->sample == TKS_U8) {
      out.bytes.assign(out.shorts.begin(), out.shorts.end());
      out.shorts.clear();
    }
    return out;
  }

  /// The fewest bytes over bases whose resampling leaves room for errors.
  Result<SharedTrial> withinError() {
    const double error = options_.max_error > 0
                             ? options_.max_error
                             : source_.diagonal() * portable::pow(10.0, -options_.psnr / 20);
    Result<SharedTrial> best =
        misused("No base mesh of up to " + std::to_string(kMostTriangles) +
                " triangles comes as near to the mesh as asked for: ask for a larger error.");
    for (uint32_t triangles = kFewestTriangles; triangles <= mostTriangles(); triangles *= 2) {
      Trial trial{resampled(triangles), {}, 0, {}};
      trial.resampling_error =
          distanceOf(trial.object, trial.object.surface.heights, kTrialPlaces).error;
      if (trial.resampling_error > kResamplingPart * error) continue;
      Result<SharedTrial> made = options_.max_error > 0 ? coded(std::move(trial), options_, nullptr)
                                                        : toPsnr(std::move(trial), error);
      if (!made.ok()) return made;
      if (best.ok() && (*made)->stream.size() >= (*best)->stream.size()) break;
      best = std::move(made);
    }
    return best;
  }

  /// Heights whose error makes up the rest of the surface's; a little less where that is too much.
  Result<SharedTrial> toPsnr(Trial trial, double error) {
    constexpr int kTries = 6;
    constexpr double kLess = 0.97;
    const auto [low, high] = std::minmax_element(trial.object.surface.heights.begin(),
                                                 trial.object.surface.heights.end());
    const double range = double{*high} - double{*low};
    double of_heights = std::sqrt(error * error - trial.resampling_error * trial.resampling_error);
    Result<SharedTrial> made = misused("The error that is asked for cannot be met.");
    for (int attempt = 0; attempt < kTries; ++attempt) {
      tks_encode_options options = options_;
      options.psnr = std::max(1.0, 20 * portable::log10(range / of_heights));
      made = coded(trial, options, nullptr);
      if (!made.ok() || (*made)->distance.error <= error) return made;
      of_heights *= kLess * std::min(1.0, error / (*made)->distance.error);
    }
    return misused("The error that is asked for cannot be met.");
  }

  ResampledObject resampled(uint32_t triangles) const {
    return source_.resampled({triangles, kDepth, positionBits(triangles)});
  }

  MeshDistance distanceOf(const ResampledObject& object, const std::vector<float>& heights,
                          size_t places) const {
    const TriangleMesh mesh = meshOfSamples(object.base, heights);
    return meshDistance(source_.tree(), TriangleTree(mesh), places);
  }

  Result<SharedTrial> coded(Trial trial, tks_encode_options options, const tks_image* image) {
    options.explain = nullptr;
    progress_.attend(options);
    const tks_heights heights = heightsOf(trial.object);
    tks_buffer buffer{};
    std::string message(300, '\0');
    const tks_status status =
        tks_encode(&heights, image, &options, &buffer, message.data(), message.size());
    if (progress_.isStopped()) throw Stopped();
    if (status != TKS_OK) return Status(status, message.c_str());
    trial.stream.assign(buffer.data, buffer.data + buffer.size);
    tks_free_buffer(&buffer);
    std::vector<float> decoded(trial.object.surface.heights.size());
    if (Status opened = decode(trial.stream, decoded); !opened.ok()) return opened;
    trial.distance = distanceOf(trial.object, decoded, kTrialPlaces);
    return std::make_shared<const Trial>(std::move(trial));
  }

  static Status decode(const std::vector<uint8_t>& stream, std::vector<float>& heights) {
    tks_decoder* decoder = nullptr;
    tks_status status = tks_open(stream.data(), stream.size(), nullptr, &decoder, nullptr, 0);
    if (status == TKS_OK) status = tks_decode_surface(decoder, heights.data(), heights.size());
    tks_close(decoder);
    return status == TKS_OK ? Status() : Status(status, "The stream of the object is not sound.");
  }

  tks_heights heightsOf(const ResampledObject& object) const {
    const BaseMesh& base = object.base;
    tks_heights heights{};
    heights.size = sizeof heights;
    heights.width = base.forest->raster().width;
    heights.height = base.forest->raster().height;
    heights.sample = TKS_F32;
    heights.data = object.surface.heights.data();
    heights.scale = 1;
    heights.unit = given_.unit;
    heights.description = given_.description;
    heights.domain = TKS_DOMAIN_FOREST;
    heights.forest = {static_cast<uint32_t>(base.forest->depth()), base.forest->patches(),
                      base.forest->sides().data()};
    heights.base_mesh.position_bits = static_cast<uint32_t>(base.bits);
    heights.base_mesh.cell = base.cell;
    std::copy(base.origin.begin(), base.origin.end(), heights.base_mesh.origin);
    heights.base_mesh.corners = base.corners[0].data();
    return heights;
  }

  const tks_triangle_mesh& given_;
  const tks_image* image_;
  const tks_encode_options& options_;
  ObjectSource source_;
  SearchProgress progress_;
};

tks_object_report reportOf(const ObjectSource& source, const Trial& trial) {
  tks_object_report report{};
  report.size = sizeof report;
  const CleanedMesh& cleaned = source.cleaned();
  const Topology topology = topologyOf(cleaned.mesh);
  report.triangles = static_cast<uint32_t>(cleaned.mesh.triangles.size());
  report.dropped_triangles = cleaned.report.degenerate + cleaned.report.doubled;
  report.cut_edges = cleaned.report.cut_edges;
  report.components = topology.components;
  report.borders = topology.boundary_loops;
  report.patches = trial.object.base.forest->patches();
  report.depth = static_cast<uint32_t>(trial.object.base.forest->depth());
  report.diagonal = source.diagonal();
  report.resampling_error = trial.resampling_error;
  report.error = trial.distance.error;
  report.largest = std::max(trial.distance.to_first.largest, trial.distance.to_second.largest);
  report.psnr = trial.distance.psnr;
  report.texture_depth = trial.texture_depth;
  return report;
}

Status checkObjectOptions(const tks_encode_options& o) {
  if (o.lossless != 0)
    return misused(
        "An object is resampled, so that it cannot be lossless: give a number of bytes, "
        "a PSNR or a largest error.");
  if (!std::isfinite(o.psnr) || o.psnr < 0 || !std::isfinite(o.max_error) || o.max_error < 0 ||
      (o.bytes != 0) + (o.psnr != 0) + (o.max_error != 0) != 1)
    return misused("Give exactly one of bytes, psnr and max-error.");
  if (o.triangles > 0 || o.camera_count > 0 || o.picture_error != nullptr || o.regions > 1)
    return misused("Of an object there are no cameras, regions and budgets of triangles yet.");
  return {};
}

Status encodeObject(const tks_triangle_mesh* mesh, const tks_image* image,
                    const tks_encode_options* options, tks_object_report* report, tks_buffer& out) {
  if (mesh == nullptr) return misused("The mesh is missing.");
  if (options == nullptr) return misused("The encoding options are missing.");
  tks_triangle_mesh given{};
  Status status = takeSized("the mesh", *mesh, offsetof(tks_triangle_mesh, unit), given);
  if (!status.ok()) return status;
  tks_encode_options known{};
  status =
      takeSized("the encoding options", *options, offsetof(tks_encode_options, threads), known);
  if (status.ok()) status = checkObjectOptions(known);
  if (!status.ok()) return status;
  tks_image texture{};
  if (image != nullptr)
    status = takeSized("the texture", *image, offsetof(tks_image, geotransform), texture);
  if (status.ok() && image != nullptr && known.bytes == 0)
    status = misused("A mesh with an image takes a number of bytes as its target.");
  if (status.ok()) status = checkImage(given, image != nullptr ? &texture : nullptr);
  if (!status.ok()) return status;
  if (report != nullptr && (report->size < sizeof *report || report->size > kMostStructBytes))
    return misused("The struct of the report has a wrong size.");
  const Result<TriangleMesh> triangles = meshOf(given);
  if (!triangles.ok()) return triangles.status();
  ObjectEncoder encoder(given, *triangles, image != nullptr ? &texture : nullptr, known);
  const Result<SharedTrial> taken = encoder.encode();
  if (!taken.ok()) return taken.status();
  if (report != nullptr) giveSized(reportOf(encoder.source(), **taken), *report);
  giveBytes((*taken)->stream, out);
  return {};
}

}  // namespace
}  // namespace tetrakis::inline api

tks_status tks_encode_object(const tks_triangle_mesh* mesh, const tks_image* image,
                             const tks_encode_options* options, tks_object_report* report,
                             tks_buffer* out, char* message, size_t message_size) {
  if (out != nullptr) *out = {nullptr, 0};
  return tetrakis::reporting(message, message_size, [&]() -> tetrakis::Status {
    if (out == nullptr) return tetrakis::outputMissing();
    try {
      return tetrakis::encodeObject(mesh, image, options, report, *out);
    } catch (const tetrakis::Stopped&) {
      return tetrakis::misused("Encoding was stopped by the caller.");
    }
  });
}
