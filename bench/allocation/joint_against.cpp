// SPDX-License-Identifier: Apache-2.0
// One stream of ours beside pairs of files that are made for every length, and beside streams of
// our own that are made for every length.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
#include <utility>

#include "apps/tools/files/stream.hpp"
#include "apps/tools/report/viewed_mesh.hpp"
#include "bench/allocation/joint_peers.hpp"
#include "bench/allocation/joint_studies.hpp"

namespace tetrakis::bench {
namespace {

constexpr uint64_t kLeastBytes = 4096, kMostBytes = 262144;

/// What is drawn of a stream.
enum class Drawn { kGrid, kBudgetMesh, kTurnedEdges, kForCameras };

/// A terrain and its judge.
class Study {
 public:
  static Result<Study> create(const Terrain& terrain) {
    const tools::HeightFile& heights = *terrain.original.heights;
    auto screen =
        Screen::create(tools::heightsOf(heights), tools::frameOf(heights), *terrain.original.image);
    if (!screen.ok()) return screen.status();
    return Study(terrain, std::move(*screen));
  }

  Screen& screen() { return screen_; }

  /// PSNR of a prefix. triangles: of meshes.
  Result<double> psnrOf(std::span<const uint8_t> stream, Drawn drawn = Drawn::kGrid,
                        uint32_t triangles = 0) {
    Result<Decoder> decoder = tools::openDecoder(stream);
    if (!decoder) return decoder.status();
    const Result<tools::ImageFile> image = tools::decodeImage(*decoder, {}, 0);
    if (!image.ok()) return image.status();
    const auto mesh = meshOf(*decoder, *image, drawn, triangles);
    if (!mesh.ok()) return mesh.status();
    const auto score = screen_.score(*mesh, &*image);
    if (!score.ok()) return score.status();
    return score->front();
  }

 private:
  Study(const Terrain& terrain, Screen screen)
      : frame_(tools::frameOf(*terrain.original.heights)), screen_(std::move(screen)) {}

  Result<tools::MeshFile> meshOf(Decoder& decoder, const tools::ImageFile& image, Drawn drawn,
                                 uint32_t triangles) const {
    if (drawn == Drawn::kGrid) {
      const Result<std::vector<float>> heights = decoder.surface();
      if (!heights) return heights.status();
      return tools::fullGrid({frame_.width, frame_.height, {heights->begin(), heights->end()}},
                             frame_);
    }
    const tks_image texture = tools::asImage(image);
    std::vector<tks_screen_camera> cameras;
    if (drawn == Drawn::kForCameras) cameras = screen_.meshCameras();
    const Result<Mesh> mesh =
        drawn == Drawn::kBudgetMesh
            ? decoder.budgetMesh(triangles)
            : decoder.screenMesh(cameras, triangles, cameras.empty() ? nullptr : &texture);
    if (!mesh) return mesh.status();
    return tools::placeMesh(*mesh, frame_);
  }

  GroundFrame frame_;
  Screen screen_;
};

/// Adds a row, and gives the value back.
double noted(const Terrain& terrain, const std::string& codec, const std::string& quantity,
             double value, std::vector<ResultRow>& rows) {
  rows.push_back({terrain.name, codec, quantity, value});
  return value;
}

/// Heights without loss and, in the bytes that they leave, the texture alone.
class ExactHeights {
 public:
  static Result<ExactHeights> create(const Terrain& terrain) {
    const tks_heights heights = tools::asHeights(*terrain.original.heights);
    const tks_image image = tools::asImage(*terrain.original.image);
    tks_encode_options options = makeEncodeOptions();
    options.lossless = options.regions = 1;
    const Result<Buffer> exact = tetrakis::encode(&heights, nullptr, options);
    if (!exact) return exact.status();
    options.lossless = 0;
    options.bytes = kMostBytes;
    Result<Buffer> texture = tetrakis::encode(nullptr, &image, options);
    if (!texture) return texture.status();
    return ExactHeights(terrain, exact->bytes().size(), std::move(*texture));
  }

  uint64_t heightBytes() const { return height_bytes_; }

  /// Nothing where the heights leave too little.
  Result<std::optional<double>> psnrOf(uint64_t bytes, Screen& screen) const {
    constexpr uint64_t kLeast = 512;
    if (bytes < height_bytes_ + kLeast) return std::optional<double>();
    const size_t rest = std::min<size_t>(bytes - height_bytes_, texture_.bytes().size());
    Result<Decoder> decoder = tools::openDecoder(texture_.bytes().first(rest));
    if (!decoder) return decoder.status();
    const Result<tools::ImageFile> image = tools::decodeImage(*decoder, {}, 0);
    if (!image.ok()) return image.status();
    const tools::HeightFile& heights = *terrain_->original.heights;
    const auto score =
        screen.score(tools::fullGrid(tools::heightsOf(heights), tools::frameOf(heights)), &*image);
    if (!score.ok()) return score.status();
    return std::optional<double>(score->front());
  }

 private:
  ExactHeights(const Terrain& terrain, uint64_t height_bytes, Buffer texture)
      : terrain_(&terrain), height_bytes_(height_bytes), texture_(std::move(texture)) {}

  const Terrain* terrain_;
  uint64_t height_bytes_;
  Buffer texture_;
};

/// Means over the numbers of bytes.
class Means {
 public:
  void add(double lead) {
    sum_ += lead;
    least_ = std::min(least_, lead);
    ++count_;
  }
  double mean() const { return sum_ / std::max(1, count_); }
  double least() const { return least_; }

 private:
  double sum_ = 0, least_ = INFINITY;
  int count_ = 0;
};

std::string at(const char* quantity, uint64_t bytes) {
  return quantity + std::string("_at_") + std::to_string(bytes);
}

}  // namespace

Status studyPeers(const Terrain& terrain, uint32_t speed, std::vector<ResultRow>& rows) {
  Result<Study> study = Study::create(terrain);
  if (!study.ok()) return study.status();
  Result<JointPeers> peers = JointPeers::create(terrain, study->screen(), kMostBytes, speed);
  if (!peers.ok()) return peers.status();
  const auto plain = encodeTerrain(terrain.original, {kMostBytes, Knows::kNothing, 0, "all"});
  if (!plain.ok()) return plain.status();
  const auto told = encodeTerrain(terrain.original, {kMostBytes, Knows::kCameras, 0, "all"});
  if (!told.ok()) return told.status();
  const Result<ExactHeights> exact = ExactHeights::create(terrain);
  if (!exact.ok()) return exact.status();
  std::printf(
      "  dB on the screen; exact: heights without loss (%llu bytes), the rest for texture\n"
      "  %7s %8s %8s %8s   %-26s %s\n",
      static_cast<unsigned long long>(exact->heightBytes()), "bytes", "default", "told", "exact",
      "JPEG 2000 + AVIF (heights)", "meshoptimizer + Draco + AVIF (heights)");
  Means grid_default, grid_told, mesh_default, mesh_told;
  for (uint64_t bytes = kLeastBytes; bytes <= plain->stream.bytes().size(); bytes *= 2) {
    const auto ours = study->psnrOf(plain->stream.bytes().first(bytes));
    const size_t most = std::min<size_t>(bytes, told->stream.bytes().size());
    const auto ours_told = study->psnrOf(told->stream.bytes().first(most));
    const auto without_loss = exact->psnrOf(bytes, study->screen());
    const auto grid = peers->grid(bytes);
    const auto mesh = peers->mesh(bytes);
    for (const Status& status :
         {ours.status(), ours_told.status(), without_loss.status(), grid.status(), mesh.status()})
      if (!status.ok()) return status;
    const auto part = [bytes](const PeerPair& pair) {
      return 100.0 * static_cast<double>(pair.height_bytes) / static_cast<double>(bytes);
    };
    std::printf("  %7llu %8.2f %8.2f %8.2f   %8.2f (%4.1f%%) %10s %8.2f (%4.1f%%, %u triangles)\n",
                static_cast<unsigned long long>(bytes), *ours, *ours_told,
                without_loss->value_or(NAN), grid->psnr, part(*grid), "", mesh->psnr, part(*mesh),
                mesh->triangles);
    std::fflush(stdout);
    noted(terrain, "tetrakis", at("screen_psnr", bytes), *ours, rows);
    noted(terrain, "tetrakis_told", at("screen_psnr", bytes), *ours_told, rows);
    if (*without_loss)
      noted(terrain, "tetrakis_exact_heights", at("screen_psnr", bytes), **without_loss, rows);
    noted(terrain, "openjpeg97+avif", at("screen_psnr", bytes), grid->psnr, rows);
    noted(terrain, "meshoptimizer+draco+avif", at("screen_psnr", bytes), mesh->psnr, rows);
    grid_default.add(*ours - grid->psnr);
    grid_told.add(*ours_told - grid->psnr);
    mesh_default.add(*ours - mesh->psnr);
    mesh_told.add(*ours_told - mesh->psnr);
  }
  const auto lead = [&](const char* name, const char* codec, const Means& means) {
    std::printf("  %s: mean %+.2f dB, least %+.2f\n", name, means.mean(), means.least());
    noted(terrain, codec, "mean_lead_db", means.mean(), rows);
    noted(terrain, codec, "least_lead_db", means.least(), rows);
  };
  lead("default over JPEG 2000 + AVIF", "over_openjpeg97+avif", grid_default);
  lead("told    over JPEG 2000 + AVIF", "told_over_openjpeg97+avif", grid_told);
  lead("default over meshes", "over_meshoptimizer+draco+avif", mesh_default);
  lead("told    over meshes", "told_over_meshoptimizer+draco+avif", mesh_told);
  return {};
}

Status studyTriangles(const Terrain& terrain, uint32_t speed, std::vector<ResultRow>& rows) {
  Result<Study> study = Study::create(terrain);
  if (!study.ok()) return study.status();
  constexpr std::array<uint32_t, 3> kTriangles = {2000, 10000, 50000};
  constexpr std::array<uint64_t, 2> kBytes = {16384, 65536};
  Result<JointPeers> peers = JointPeers::create(terrain, study->screen(), kBytes.back(), speed);
  if (!peers.ok()) return peers.status();
  std::printf("  dB on the screen\n  %9s %7s %8s %8s %8s   %s\n", "triangles", "bytes", "budget",
              "turned", "told", "meshoptimizer + Draco + AVIF");
  for (const uint32_t triangles : kTriangles)
    for (const uint64_t bytes : kBytes) {
      const auto plain =
          encodeTerrain(terrain.original, {bytes, Knows::kNothing, triangles, "all"});
      if (!plain.ok()) return plain.status();
      const auto told = encodeTerrain(terrain.original, {bytes, Knows::kCameras, triangles, "all"});
      if (!told.ok()) return told.status();
      const auto budget = study->psnrOf(plain->stream.bytes(), Drawn::kBudgetMesh, triangles);
      const auto turned = study->psnrOf(plain->stream.bytes(), Drawn::kTurnedEdges, triangles);
      const auto cameras = study->psnrOf(told->stream.bytes(), Drawn::kForCameras, triangles);
      const auto peer = peers->mesh(bytes, triangles);
      for (const Status& status :
           {budget.status(), turned.status(), cameras.status(), peer.status()})
        if (!status.ok()) return status;
      std::printf("  %9u %7llu %8.2f %8.2f %8.2f   %8.2f (%u triangles, %.1f%% of the bytes)\n",
                  triangles, static_cast<unsigned long long>(bytes), *budget, *turned, *cameras,
                  peer->psnr, peer->triangles,
                  100.0 * static_cast<double>(peer->height_bytes) / static_cast<double>(bytes));
      std::fflush(stdout);
      const std::string quantity =
          "screen_psnr_of_" + std::to_string(triangles) + "_triangles_at_" + std::to_string(bytes);
      noted(terrain, "tetrakis", quantity, *budget, rows);
      noted(terrain, "tetrakis_turned", quantity, *turned, rows);
      noted(terrain, "tetrakis_told", quantity, *cameras, rows);
      noted(terrain, "meshoptimizer+draco+avif", quantity, peer->psnr, rows);
    }
  return {};
}

Status studyPrefixes(const Terrain& terrain, std::vector<ResultRow>& rows) {
  constexpr int kLengths = 30;
  Result<Study> study = Study::create(terrain);
  if (!study.ok()) return study.status();
  for (const Knows knows : {Knows::kNothing, Knows::kCameras}) {
    const char* name = knows == Knows::kNothing ? "default" : "told";
    const auto whole = encodeTerrain(terrain.original, {kMostBytes, knows, 0, "all"});
    if (!whole.ok()) return whole.status();
    const auto all = static_cast<double>(whole->stream.bytes().size());
    Means lead;
    for (int i = 0; i < kLengths; ++i) {
      const double part = std::pow(all / 2048, static_cast<double>(i) / kLengths);
      const auto bytes = static_cast<uint64_t>(2048 * part);
      const auto made = encodeTerrain(terrain.original, {bytes, knows, 0, "all"});
      if (!made.ok()) return made.status();
      const auto cut = study->psnrOf(whole->stream.bytes().first(bytes));
      const auto meant = study->psnrOf(made->stream.bytes());
      if (!cut.ok()) return cut.status();
      if (!meant.ok()) return meant.status();
      std::printf("  %7llu %-8s cut %8.2f, made for the length %8.2f: %+.3f\n",
                  static_cast<unsigned long long>(bytes), name, *cut, *meant, *cut - *meant);
      std::fflush(stdout);
      lead.add(*cut - *meant);
    }
    std::printf(
        "  %s: prefixes against streams made for their length: mean %+.3f dB, worst %+.3f\n", name,
        lead.mean(), lead.least());
    noted(terrain, std::string("prefixes_") + name, "mean_lead_db", lead.mean(), rows);
    noted(terrain, std::string("prefixes_") + name, "least_lead_db", lead.least(), rows);
  }
  return {};
}

}  // namespace tetrakis::bench
