// SPDX-License-Identifier: Apache-2.0
// encodeResampled() codes an object as heights over a base mesh. A coarse base takes few bytes and
// leaves more of them to the heights, but loses thin parts: so bases of several sizes are tried.
#include "api/object_inputs.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "api/object_maps.hpp"
#include "api/object_pictures.hpp"
#include "base/forest.hpp"
#include "base/portable_math.hpp"

namespace tetrakis::inline api {
namespace {

/// Base meshes are tried that have this many triangles, or 2^k times as many.
constexpr uint32_t kCoarsestBase = 125, kFinestBase = 8000;

/// The same of a mesh with a texture. Finer bases cut the texture in more pieces: pictures of their
/// atlas mix texels of neighbours, and all takes longer.
constexpr uint32_t kFinestTexturedBase = 2000;

/// Bytes of a budget for each triangle of the base that is tried first.
constexpr double kBytesForTriangle = 5;

/// Most of a squared error comes from the coding, not from the resampling.
constexpr double kResamplingPart = 1.0 / 3;

/// Of a mesh with a texture, the part that its heights get while a base is sought, and no fewer
/// bytes than the least.
constexpr double kHeightsPart = 0.4;
constexpr uint64_t kLeastHeightBytes = 1000;

/// Texels for each byte of a budget: more cannot be told from fewer.
constexpr double kTexelsForByte = 64;

/// A base that was tried, and the stream over it.
struct Trial {
  std::shared_ptr<const ResampledObject> object;
  CodedObject coded;
  std::vector<float> heights;  ///< as decoders have them
};

using SharedTrial = std::shared_ptr<const Trial>;

/// Samples for each patch: more show the mesh better, and take time.
constexpr int kDepth = 4;

/// The same of a mesh most of whose triangles do not hold together, such as a soup: its patches are
/// of a triangle or two, and there are as many patches as triangles.
constexpr int kDepthOfParts = 1;

/// Coarse bases need fewer bits: heights make up for what their corners are off.
int positionBits(uint32_t triangles) {
  return triangles <= 1000 ? 8 : triangles <= 4000 ? 9 : 10;
}

class ResampledSearch {
 public:
  explicit ResampledSearch(GivenObject& given) : given_(given) {}

  Result<CodedObject> run() {
    if (given_.source.fewestTriangles() > 2 * Forest::kMostPatches)
      return misusedObject("The smallest base mesh has " +
                           std::to_string(given_.source.fewestTriangles()) +
                           " triangles; a stream takes at most " +
                           std::to_string(2 * Forest::kMostPatches) + ". Leave small parts out.");
    Result<SharedTrial> taken = given_.options.bytes > 0 ? withinBytes() : withinError();
    if (taken.ok() && given_.image != nullptr) taken = withTexture(**taken);
    if (!taken.ok()) return taken.status();
    CodedObject measured = (*taken)->coded;
    const ResampledObject& object = *(*taken)->object;
    measured.resampling_error = distanceOf(object, object.surface.heights, kDistanceSamples).error;
    measured.distance = distanceOf(object, (*taken)->heights, kDistanceSamples);
    measured.patches = object.base.forest->patches();
    measured.depth = static_cast<uint32_t>(object.base.forest->depth());
    measured.object = (*taken)->object;
    return measured;
  }

 private:
  /// The base with the least error within the budget: from the one tried first to finer or coarser
  /// ones, as long as they are better.
  Result<SharedTrial> withinBytes() {
    const double wished = static_cast<double>(heightBytes()) / kBytesForTriangle;
    uint32_t triangles = leastTriangles();
    while (triangles < mostTriangles() && triangles * std::sqrt(2.0) < wished) triangles *= 2;
    Result<SharedTrial> best = inBudget(triangles);
    const auto better = [&](const Result<SharedTrial>& trial) {
      return trial.ok() &&
             (!best.ok() || (*trial)->coded.distance.error < (*best)->coded.distance.error);
    };
    bool found_finer = false;
    for (uint32_t finer = 2 * triangles; finer <= mostTriangles() && best.ok(); finer *= 2) {
      Result<SharedTrial> trial = inBudget(finer);
      if (!better(trial)) break;
      best = std::move(trial);
      found_finer = true;
    }
    for (uint32_t coarser = triangles / 2; !found_finer && coarser >= leastTriangles();
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

  /// The last size of a base that gives the smallest one there is.
  uint32_t leastTriangles() const {
    uint32_t least = kCoarsestBase;
    while (2 * least <= std::min(given_.source.fewestTriangles(), mostTriangles())) least *= 2;
    return least;
  }

  /// The first size of a base that all triangles of the mesh fit in, or the largest one.
  uint32_t mostTriangles() const {
    const uint32_t finest = given_.image != nullptr ? kFinestTexturedBase : kFinestBase;
    uint32_t most = kCoarsestBase;
    while (most < finest && most < given_.source.cleaned().mesh.triangles.size()) most *= 2;
    return most;
  }

  /// Of a budget, while a base is sought.
  uint64_t heightBytes() const {
    if (given_.image == nullptr) return given_.options.bytes;
    const double part = kHeightsPart * static_cast<double>(given_.options.bytes);
    return std::min(given_.options.bytes, std::max(kLeastHeightBytes, static_cast<uint64_t>(part)));
  }

  Result<SharedTrial> inBudget(uint32_t triangles) {
    tks_encode_options options = given_.options;
    options.psnr = options.max_error = 0;
    options.bytes = heightBytes();
    options.camera_count = 0;
    return coded({resampled(triangles), {}, {}}, options, nullptr);
  }

  /// The heights of a trial beside the texture, which the target is of as well.
  Result<SharedTrial> withTexture(const Trial& trial) {
    const int depth = texelDepth(*trial.object);
    const PatchTexels texels(given_, *given_.image, *trial.object, depth);
    Result<SharedTrial> made = coded(trial, given_.options, &texels.image());
    if (!made.ok()) return made;
    const Result<double> error = given_.pictures->errorOf((*made)->coded.stream);
    if (!error.ok()) return error.status();
    Trial both = **made;
    both.coded.texture_depth = static_cast<uint32_t>(depth);
    both.coded.picture_error = *error;
    return std::make_shared<const Trial>(std::move(both));
  }

  /// For as many texels as the mesh shows of its images, unless the budget is too small for them.
  int texelDepth(const ResampledObject& object) const {
    const double wanted =
        std::min(shownTexels(given_), kTexelsForByte * static_cast<double>(given_.options.bytes));
    int depth = 1;
    const double patches = object.base.forest->patches();
    while (depth < TKS_MOST_OBJECT_DEPTH && patches * std::ldexp(1.0, 2 * depth) < wanted &&
           object.base.forest->patches() < Forest::mostPatches(depth + 1))
      ++depth;
    return depth;
  }

  /// The fewest bytes over bases whose resampling leaves room for errors.
  Result<SharedTrial> withinError() {
    const double error = given_.wantedError();
    Result<SharedTrial> best =
        misusedObject("No base mesh of up to " + std::to_string(kFinestBase) +
                      " triangles comes as near to the mesh as asked for: ask for a larger error.");
    for (uint32_t triangles = leastTriangles(); triangles <= mostTriangles(); triangles *= 2) {
      Trial trial{resampled(triangles), {}, {}};
      trial.coded.resampling_error =
          distanceOf(*trial.object, trial.object->surface.heights, kTrialPlaces).error;
      if (trial.coded.resampling_error > kResamplingPart * error) continue;
      Result<SharedTrial> made = given_.options.max_error > 0
                                     ? coded(std::move(trial), given_.options, nullptr)
                                     : toPsnr(std::move(trial), error);
      if (!made.ok()) return made;
      if (best.ok() && (*made)->coded.stream.size() >= (*best)->coded.stream.size()) break;
      best = std::move(made);
    }
    return best;
  }

  /// Heights whose error makes up the rest of the surface's; a little less where that is too much.
  Result<SharedTrial> toPsnr(Trial trial, double error) {
    constexpr int kTries = 6;
    constexpr double kLess = 0.97;
    const std::vector<float>& heights = trial.object->surface.heights;
    const auto [low, high] = std::minmax_element(heights.begin(), heights.end());
    const double range = double{*high} - double{*low};
    double of_heights =
        std::sqrt(error * error - trial.coded.resampling_error * trial.coded.resampling_error);
    Result<SharedTrial> made = misusedObject("The error that is asked for cannot be met.");
    for (int attempt = 0; attempt < kTries; ++attempt) {
      tks_encode_options options = given_.options;
      options.psnr = std::max(1.0, 20 * portable::log10(range / of_heights));
      made = coded(trial, options, nullptr);
      if (!made.ok() || (*made)->coded.distance.error <= error) return made;
      of_heights *= kLess * std::min(1.0, error / (*made)->coded.distance.error);
    }
    return misusedObject("The error that is asked for cannot be met.");
  }

  std::shared_ptr<const ResampledObject> resampled(uint32_t triangles) {
    const bool is_of_parts =
        2 * size_t{given_.source.fewestTriangles()} > given_.source.cleaned().mesh.triangles.size();
    const int depth = is_of_parts ? kDepthOfParts : kDepth;
    return std::make_shared<const ResampledObject>(
        given_.source.resampled({triangles, depth, positionBits(triangles)}));
  }

  MeshDistance distanceOf(const ResampledObject& object, const std::vector<float>& heights,
                          size_t places) const {
    const TriangleMesh mesh = meshOfSamples(object.base, heights);
    return meshDistance(given_.source.tree(), TriangleTree(mesh, kSampleTriangles), places);
  }

  Result<SharedTrial> coded(Trial trial, const tks_encode_options& options,
                            const tks_image* image) {
    const tks_heights heights = heightsOf(*trial.object);
    Result<std::vector<uint8_t>> stream = encodedTrial(given_, options, &heights, image);
    if (!stream.ok()) return stream.status();
    trial.coded.stream = std::move(*stream);
    Result<std::vector<float>> decoded = decode(trial.coded.stream, *trial.object);
    if (!decoded.ok()) return decoded.status();
    trial.heights = std::move(*decoded);
    trial.coded.distance = distanceOf(*trial.object, trial.heights, kTrialPlaces);
    return std::make_shared<const Trial>(std::move(trial));
  }

  static Result<std::vector<float>> decode(const std::vector<uint8_t>& stream,
                                           const ResampledObject& object) {
    std::vector<float> heights(object.surface.heights.size());
    tks_decoder* decoder = nullptr;
    tks_status status = tks_open(stream.data(), stream.size(), nullptr, &decoder, nullptr, 0);
    if (status == TKS_OK) status = tks_decode_surface(decoder, heights.data(), heights.size());
    tks_close(decoder);
    if (status != TKS_OK) return Status(status, "The stream of the object is not sound.");
    return heights;
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
    heights.unit = given_.mesh.unit;
    heights.description = given_.mesh.description;
    heights.domain = TKS_DOMAIN_FOREST;
    heights.forest = {static_cast<uint32_t>(base.forest->depth()), base.forest->patches(),
                      base.forest->sides().data()};
    heights.base_mesh.position_bits = static_cast<uint32_t>(base.bits);
    heights.base_mesh.cell = base.cell;
    std::copy(base.origin.begin(), base.origin.end(), heights.base_mesh.origin);
    heights.base_mesh.corners = base.corners[0].data();
    return heights;
  }

  GivenObject& given_;
};

}  // namespace

Result<CodedObject> encodeResampled(GivenObject& given) {
  return ResampledSearch(given).run();
}

}  // namespace tetrakis::inline api
