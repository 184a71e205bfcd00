// SPDX-License-Identifier: Apache-2.0
// encodeTriangles() codes an object as triangles. Many triangles on a coarse grid take as many
// bytes as few triangles on a fine grid: so it tries several numbers of triangles, and for each of
// them several grids.
#include "api/object_inputs.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "api/object_pictures.hpp"
#include "base/portable_math.hpp"
#include "bitstream/stream/header.hpp"
#include "codec/remesh/half_edges.hpp"
#include "codec/remesh/mapped_decimation.hpp"
#include "codec/trianglemesh/triangle_encoder.hpp"

namespace tetrakis::inline api {
namespace {

/// Grids are numbered: four steps double the places along a side, of which there are 2^(step / 4).
constexpr int kSteps = 4;
constexpr int kCoarsest = 5 * kSteps, kFinest = kSteps * TriangleMeshHeader::kMostPlaceBits;
constexpr int kTriedFirst = 11 * kSteps;

uint32_t placesOf(int grid) {
  return static_cast<uint32_t>(portable::pow(2.0, grid / double{kSteps}) + 0.5);
}

/// A budget is not tried with so many triangles that each gets fewer bits than this.
constexpr double kLeastTriangleBits = 2;

/// Each number of triangles that is tried is the one before it divided by this.
constexpr double kFewer = 1.41421356;

/// Beside a texture triangles get at most this part of the budget, and grids from this one on,
/// which are tried so many steps apart.
constexpr double kMostTrianglesPart = 0.75;
constexpr int kFinestBesideTexture = 13 * kSteps, kTexturedSteps = kSteps / 2;

/// Texture coordinates are rounded to halves of texels.
uint8_t texcoordFraction(const GivenObject& given) {
  if (given.image == nullptr) return 0;
  const uint32_t later = std::min(given.mesh.texels, kMaxSide);
  uint32_t side = std::max({given.image->width, given.image->height, later});
  for (const GivenMap& map : given.maps) side = std::max({side, map.image.width, map.image.height});
  return static_cast<uint8_t>(std::bit_width(side - 1) + 1);
}

std::span<const std::array<float, 2>> pairs(const tks_triangle_mesh& mesh) {
  static_assert(sizeof(std::array<float, 2>) == 2 * sizeof(float));
  return {reinterpret_cast<const std::array<float, 2>*>(mesh.texcoords),
          3 * size_t{mesh.triangle_count}};
}

/// Tries a number of triangles on several grids.
class TriangleTrial {
 public:
  TriangleTrial(const GivenObject& given, TriangleMesh mesh)
      : given_(given),
        mesh_(std::move(mesh)),
        texcoords_(texcoordsOf(given)),
        encoder_({mesh_.points, mesh_.triangles, gluedSides(mesh_.triangles).opposite, texcoords_},
                 texcoordFraction(given)) {}

  /// The stream of the triangles without a texture. Nothing if its header is too long for decoders.
  std::optional<std::vector<uint8_t>> streamOf(int grid) const {
    StreamHeader header;
    addTo(header, grid);
    std::vector<uint8_t> stream = writeHeader(header);
    if (stream.size() > kMaxHeaderBytes) return {};
    return stream;
  }

  void addTo(StreamHeader& header, int grid) const {
    header.triangle_mesh = encoder_.encode(placesOf(grid));
    if (given_.mesh.unit != nullptr) header.metadata.unit = given_.mesh.unit;
    if (given_.mesh.description != nullptr)
      header.georeference.description = given_.mesh.description;
    if (given_.mesh.material != nullptr) header.material = given_.mesh.material;
  }

  MeshDistance distanceOf(const std::vector<uint8_t>& stream, size_t places) const {
    const TriangleMesh mesh = decoded(stream);
    return meshDistance(given_.source.tree(), TriangleTree(mesh), places);
  }

  /// That of its triangles before they are put on a grid.
  double distance() const {
    return meshDistance(given_.source.tree(), TriangleTree(mesh_), kTrialPlaces).error;
  }

  /// The largest distance between a corner of the stream and its place in the mesh, for a stream
  /// of all triangles.
  double farthestCorner(const std::vector<uint8_t>& stream) const {
    const TriangleMesh mesh = decoded(stream);
    const std::vector<uint32_t> given = encoder_.givenCorners();
    double farthest = 0;
    for (size_t corner = 0; corner < given.size(); ++corner) {
      const auto at = [](const TriangleMesh& of, size_t c) {
        return of.points[of.triangles[c / 3][c % 3]];
      };
      farthest = std::max(farthest, length(at(mesh, corner) - at(mesh_, given[corner])));
    }
    return farthest;
  }

  uint32_t triangles() const { return static_cast<uint32_t>(mesh_.triangles.size()); }

 private:
  static TriangleMesh decoded(const std::vector<uint8_t>& stream) {
    const TriangleMeshHeader header = readHeader(stream)->header.triangle_mesh;
    const CodedTriangles coded = *decodeTriangles(header);
    TriangleMesh mesh;
    for (const Place& place : coded.places) {
      Point& point = mesh.points.emplace_back();
      for (size_t axis = 0; axis < 3; ++axis)
        point[axis] = header.cell * static_cast<double>(header.origin[axis] + place[axis]);
    }
    for (size_t corner = 0; corner < coded.vertices.size(); corner += 3)
      mesh.triangles.push_back(
          {coded.vertices[corner], coded.vertices[corner + 1], coded.vertices[corner + 2]});
    return mesh;
  }

  /// Three places on the image for each triangle that is left after cleaning.
  static std::vector<std::array<std::array<float, 2>, 3>> texcoordsOf(const GivenObject& given) {
    std::vector<std::array<std::array<float, 2>, 3>> out;
    if (given.image == nullptr) return out;
    const auto all = pairs(given.mesh);
    for (const TriangleSource& source : given.source.cleaned().sources) {
      auto& corners = out.emplace_back();
      for (size_t k = 0; k < 3; ++k)
        corners[k] = all[3 * size_t{source.triangle} + source.corners[k]];
    }
    return out;
  }

  const GivenObject& given_;
  TriangleMesh mesh_;
  std::vector<std::array<std::array<float, 2>, 3>> texcoords_;
  TriangleEncoder encoder_;
};

struct Found {
  std::vector<uint8_t> stream;
  double error = 0;
  uint32_t triangles = 0;
};

class TrianglesSearch {
 public:
  explicit TrianglesSearch(GivenObject& given)
      : given_(given), all_(static_cast<uint32_t>(given.source.cleaned().mesh.triangles.size())) {}

  Result<CodedObject> run() {
    if (all_ > TriangleMeshHeader::kMostTriangles && keepsAll())
      return misusedObject("The mesh has " + std::to_string(all_) + " triangles; at most " +
                           std::to_string(TriangleMeshHeader::kMostTriangles) + " are coded.");
    if (given_.image != nullptr) return withTexture();
    if (isBound()) return withinBound();
    return given_.options.bytes > 0 ? nearest() : shortest();
  }

 private:
  bool isBound() const { return given_.options.max_error > 0; }
  bool keepsAll() const { return given_.image != nullptr || isBound(); }

  /// Of a budget: tries ever fewer triangles, from the most that it may hold on, until a trial is
  /// worse than the best one so far.
  Result<CodedObject> nearest() {
    const double bits = 8 * static_cast<double>(given_.options.bytes);
    MappedDecimation decimation(given_.source.cleaned().mesh, all_, DecimationAim::kNear);
    std::optional<Found> found;
    for (double count = std::min(mostTriangles(), bits / kLeastTriangleBits);; count /= kFewer) {
      given_.progress.tell();
      decimation.goOn(std::max(static_cast<uint32_t>(count), kFewestTriangles));
      const TriangleTrial trial(given_, decimation.base(static_cast<uint32_t>(count)).mesh);
      if (trial.triangles() > count) break;  // the mesh cannot have fewer
      std::optional<Found> made = finestWithinBytes(trial);
      if (found && (!made || made->error >= found->error)) break;
      if (made) found = std::move(made);
    }
    if (!found) return misusedObject("No mesh of triangles fits in so few bytes.");
    return codedAs(decimation, std::move(*found));
  }

  /// Of an error: tries ever more triangles, from the fewest that are near enough on, until a trial
  /// takes more bytes than the best one so far. Fewer triangles take less time.
  Result<CodedObject> shortest() {
    const MappedDecimation decimation(given_.source.cleaned().mesh, kFewestTriangles,
                                      DecimationAim::kNear);
    std::vector<double> counts{mostTriangles()};
    while (counts.back() / kFewer >= std::max(1u, decimation.fewest()))
      counts.push_back(counts.back() / kFewer);
    std::optional<Found> found;
    for (; !counts.empty(); counts.pop_back()) {
      given_.progress.tell();
      const TriangleTrial trial(given_, decimation.base(static_cast<uint32_t>(counts.back())).mesh);
      if (trial.distance() > given_.wantedError()) continue;
      std::optional<Found> made = coarsestWithinError(trial);
      if (found && (!made || made->stream.size() >= found->stream.size())) break;
      if (made) found = std::move(made);
    }
    if (!found)
      return misusedObject(
          "No mesh of triangles comes as near to the mesh as asked for: ask for a larger error.");
    return codedAs(decimation, std::move(*found));
  }

  double mostTriangles() const {
    return std::min<double>(all_, TriangleMeshHeader::kMostTriangles);
  }

  /// The finest grid of a budget.
  std::optional<Found> finestWithinBytes(const TriangleTrial& trial) {
    std::vector<uint8_t> fitting;
    int low = kCoarsest, high = kFinest;  // finer than high: too many bytes
    while (low <= high) {
      const bool is_first = low == kCoarsest && high == kFinest;
      const int grid = is_first ? kTriedFirst : (low + high) / 2;
      std::optional<std::vector<uint8_t>> stream = trial.streamOf(grid);
      if (!stream || stream->size() > given_.options.bytes) {
        high = grid - 1;
      } else {
        fitting = std::move(*stream);
        low = grid + 1;
      }
    }
    if (fitting.empty()) return {};
    const double error = trial.distanceOf(fitting, kTrialPlaces).error;
    return Found{std::move(fitting), error, trial.triangles()};
  }

  /// The coarsest grid that an error allows.
  std::optional<Found> coarsestWithinError(const TriangleTrial& trial) {
    const double error = given_.wantedError();
    std::optional<Found> met;
    int low = kCoarsest, high = kFinest;  // coarser than low: too large an error
    while (low <= high) {
      const int grid = (low + high) / 2;
      std::optional<std::vector<uint8_t>> stream = trial.streamOf(grid);
      if (!stream) break;
      const double reached = trial.distanceOf(*stream, kDistanceSamples).error;
      if (reached > error) {
        low = grid + 1;
      } else {
        met = Found{std::move(*stream), reached, trial.triangles()};
        high = grid - 1;
      }
    }
    return met;
  }

  /// All triangles, each of whose corners is rounded by no more than the bound.
  Result<CodedObject> withinBound() {
    const TriangleTrial trial(given_, given_.source.cleaned().mesh);
    for (int grid = kCoarsest; grid <= kFinest; ++grid) {
      std::optional<std::vector<uint8_t>> stream = trial.streamOf(grid);
      if (!stream) return tooMany();
      const double cell = readHeader(*stream)->header.triangle_mesh.cell;
      if (cell * std::sqrt(0.75) > given_.options.max_error) continue;
      if (trial.farthestCorner(*stream) > given_.options.max_error) continue;  // numbers round, too
      return codedAs(trial, std::move(*stream));
    }
    return misusedObject("No grid for triangles is as fine as asked for: ask for a larger error.");
  }

  /// All triangles, and the image for the rest of the budget: ever coarser grids, from the finest
  /// that leaves enough bytes, until the pictures of a trial are worse than those of the best one.
  Result<CodedObject> withTexture() {
    const TriangleTrial trial(given_, given_.source.cleaned().mesh);
    const double most = kMostTrianglesPart * static_cast<double>(given_.options.bytes);
    Result<CodedObject> best =
        misusedObject("The triangles of the mesh leave too few bytes to its texture.");
    const std::optional<std::vector<uint8_t>> coarsest = trial.streamOf(kCoarsest);
    if (!coarsest) return tooMany();
    if (static_cast<double>(coarsest->size()) > most) return best;
    for (int grid = kFinestBesideTexture; grid >= kCoarsest; grid -= kTexturedSteps) {
      const std::optional<std::vector<uint8_t>> alone = trial.streamOf(grid);
      if (!alone || static_cast<double>(alone->size()) > most) continue;
      Result<CodedObject> made = withTexture(trial, grid, alone->size());
      if (!made.ok()) return made;
      if (best.ok() && made->picture_error >= best->picture_error) break;
      best = std::move(made);
    }
    if (best.ok()) best = withRest(trial, *std::move(best));
    if (best.ok()) best->distance = trial.distanceOf(best->stream, kDistanceSamples);
    return best;
  }

  /// Where the image is there to its last bit, and bytes are left, corners get them.
  Result<CodedObject> withRest(const TriangleTrial& trial, CodedObject best) {
    const std::optional<std::vector<uint8_t>> tried = trial.streamOf(kFinestBesideTexture);
    const uint64_t budget = given_.options.bytes, used = best.stream.size();
    if (!tried || used >= budget) return best;
    for (int grid = kFinest; grid > kFinestBesideTexture; --grid) {
      const std::optional<std::vector<uint8_t>> alone = trial.streamOf(grid);
      if (!alone || used + alone->size() > budget + tried->size()) continue;
      Result<CodedObject> made = withTexture(trial, grid, alone->size());
      if (made.ok() && made->picture_error <= best.picture_error) return made;
      break;
    }
    return best;
  }

  /// bytes: of the triangles.
  Result<CodedObject> withTexture(const TriangleTrial& trial, int grid, uint64_t bytes) {
    tks_encode_options options = given_.options;
    options.bytes -= bytes;
    options.camera_count = 0;  // they see all of the image alike
    tks_image image = *given_.image;
    image.has_geotransform = 0;
    const Result<std::vector<uint8_t>> texture = encodedTrial(given_, options, nullptr, &image);
    if (!texture.ok()) return texture.status();
    Result<ParsedHeader> parsed = readHeader(*texture);
    if (!parsed.ok()) return parsed.status();
    trial.addTo(parsed->header, grid);
    parsed->header.lossless = 0;  // corners are rounded, even where the image is not
    std::vector<uint8_t> stream = writeHeader(parsed->header);
    stream.insert(stream.end(), texture->begin() + static_cast<ptrdiff_t>(parsed->bytes),
                  texture->end());
    if (stream.size() > given_.options.bytes)
      return Status(TKS_MISMATCH, "The stream of the object is longer than its budget.");
    const Result<double> error = given_.pictures->errorOf(stream);
    if (!error.ok()) return error.status();
    CodedObject coded;
    coded.stream = std::move(stream);
    coded.picture_error = *error;
    coded.kind = TKS_OBJECT_TRIANGLES;
    coded.coded_triangles = trial.triangles();
    return coded;
  }

  static Status tooMany() {
    return misusedObject("The triangles of the mesh take more than a megabyte.");
  }

  Result<CodedObject> codedAs(const MappedDecimation& decimation, Found found) const {
    return codedAs(TriangleTrial(given_, decimation.base(found.triangles).mesh),
                   std::move(found.stream));
  }

  Result<CodedObject> codedAs(const TriangleTrial& trial, std::vector<uint8_t> stream) const {
    if (!readHeader(stream).ok()) return tooMany();
    CodedObject coded;
    coded.distance = trial.distanceOf(stream, kDistanceSamples);
    coded.stream = std::move(stream);
    coded.kind = TKS_OBJECT_TRIANGLES;
    coded.coded_triangles = trial.triangles();
    return coded;
  }

  GivenObject& given_;
  uint32_t all_;
};

}  // namespace

Result<CodedObject> encodeTriangles(GivenObject& given) {
  return TrianglesSearch(given).run();
}

}  // namespace tetrakis::inline api
