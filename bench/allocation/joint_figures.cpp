// SPDX-License-Identifier: Apache-2.0
// Figures 6.4 to 6.10 of the thesis, for any terrain: a page, the plates as pictures, and the
// numbers behind the charts.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <set>
#include <utility>

#include "apps/tools/files/stream.hpp"
#include "apps/tools/report/report.hpp"
#include "apps/tools/report/viewed_mesh.hpp"
#include "bench/allocation/joint_studies.hpp"

namespace tetrakis::bench {
namespace {

using tools::Gallery;
using tools::MeshPlan;
using tools::PairPlane;
using tools::SeenPair;
using tools::Split;
using tools::SplitStream;

constexpr uint64_t kBytes = 262144;
constexpr size_t kModels = 6;
constexpr size_t kOblique = 0, kLow = 1;  // places in the preset `all`

std::string decibels(double psnr) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.2f dB", psnr);
  return text;
}

/// A stream and its judge, and what is found.
struct Stage {
  const Terrain& terrain;
  tools::Comparer comparer;
  SplitStream tracks;
  std::vector<ResultRow>& rows;

  void record(const std::string& codec, const char* quantity, double value) const {
    rows.push_back({terrain.name, codec, quantity, value});
  }
};

std::string numberOf(const Gallery& gallery) {  // "Figure 6.10: ..." -> "6.10"
  return gallery.title.substr(7, gallery.title.find(':') - 7);
}

/// The name of the plate that comes next.
std::string nextPlate(const Gallery& gallery) {
  return numberOf(gallery) + static_cast<char>('a' + gallery.plates.size());
}

/// A plate of one pair; sets what it measures.
Result<Gallery::Plate> plateOf(Stage& stage, SeenPair& pair, char name) {
  auto seen = stage.comparer.measure(stage.tracks.cut(pair.split), 0);
  if (!seen.ok()) return seen.status();
  pair.psnr = seen->screen_psnr.value_or(0);
  return Gallery::Plate{std::move(seen->pictures[kOblique]),
                        std::string(1, name) + ": " + std::to_string(pair.split.heights) +
                            " bytes of heights, " + std::to_string(pair.split.texture) +
                            " of texture, " + decibels(pair.psnr)};
}

Result<Gallery> galleryOf(Stage& stage, std::vector<SeenPair>& pairs, Gallery gallery) {
  for (size_t i = 0; i < pairs.size(); ++i) {
    auto plate = plateOf(stage, pairs[i], static_cast<char>('a' + i));
    if (!plate.ok()) return plate.status();
    stage.record(nextPlate(gallery), "db", pairs[i].psnr);
    gallery.plates.push_back(std::move(*plate));
  }
  return gallery;
}

/// The texture that gives a row of the plane this PSNR, between its nodes; 0: none does.
uint64_t textureFor(const PairPlane& plane, size_t row, double psnr) {
  for (size_t t = 0; t + 1 < plane.textures.size(); ++t) {
    const double below = plane.at(row, t), above = plane.at(row, t + 1);
    if (!(below <= psnr && psnr < above)) continue;
    const double ratio =
        static_cast<double>(plane.textures[t + 1]) / static_cast<double>(plane.textures[t]);
    const double way = (psnr - below) / (above - below);
    return static_cast<uint64_t>(static_cast<double>(plane.textures[t]) * std::pow(ratio, way));
  }
  return 0;
}

/// Six models of one PSNR, from those of few heights on: that of a quarter of all bytes, less 2 dB.
std::vector<SeenPair> equalPsnr(const PairPlane& plane) {
  const uint64_t quarter = (plane.heights.back() + plane.textures.back()) / 4;
  double psnr = plane.hull.front().psnr;
  for (const SeenPair& pair : plane.hull)
    if (pair.split.total() <= quarter) psnr = pair.psnr;
  std::vector<SeenPair> reach;
  for (size_t h = 0; h < plane.heights.size(); ++h)
    if (const uint64_t texture = textureFor(plane, h, psnr - 2); texture > 0)
      reach.push_back({{plane.heights[h], texture}, 0});
  std::vector<SeenPair> models;
  const size_t count = std::min(kModels, reach.size());
  for (size_t i = 0; i < count; ++i)
    models.push_back(reach[count > 1 ? i * (reach.size() - 1) / (count - 1) : 0]);
  return models;
}

/// Six models of 10 kB.
std::vector<SeenPair> equalBytes(const PairPlane& plane) {
  constexpr std::array<double, kModels> kShares = {0.02, 0.1, 0.3, 0.5, 0.75, 0.95};
  constexpr double kJoint = 10000;
  std::vector<SeenPair> models;
  for (const double share : kShares)
    models.push_back(
        {{std::min(plane.heights.back(), static_cast<uint64_t>(share * kJoint)),
          std::min(plane.textures.back(), static_cast<uint64_t>((1 - share) * kJoint))},
         0});
  return models;
}

/// dB of the greedy path below the best pair of no more bytes: mean and worst.
std::array<double, 2> greedyLoss(const PairPlane& plane) {
  double sum = 0, worst = 0;
  size_t count = 0;
  for (const SeenPair& pair : plane.greedy) {
    double best = pair.psnr;
    for (size_t h = 0; h < plane.heights.size(); ++h)
      for (size_t t = 0; t < plane.textures.size(); ++t)
        if (plane.heights[h] + plane.textures[t] <= pair.split.total())
          best = std::max(best, plane.at(h, t));
    if (!std::isfinite(best)) continue;
    sum += best - pair.psnr;
    worst = std::max(worst, best - pair.psnr);
    ++count;
  }
  return {sum / static_cast<double>(std::max<size_t>(1, count)), worst};
}

MeshPlan planOf(const Mesh& mesh, const Camera& camera, const GroundFrame& frame,
                std::string caption) {
  std::set<std::pair<uint32_t, uint32_t>> edges;
  const auto corners = mesh.triangles();
  for (size_t i = 0; i < corners.size(); ++i) {
    const size_t next = i % 3 == 2 ? i - 2 : i + 1;
    edges.insert(std::minmax(mesh.gridIndices()[corners[i]], mesh.gridIndices()[corners[next]]));
  }
  MeshPlan plan{std::move(caption), frame.width, frame.height, {}, {}};
  for (const auto& [a, b] : edges)
    plan.edges.push_back({a % frame.width, a / frame.width, b % frame.width, b / frame.width});
  plan.eye = {camera.eye[0] / frame.spacing_x + (frame.width - 1.0) / 2,
              camera.eye[2] / frame.spacing_y + (frame.height - 1.0) / 2};
  return plan;
}

/// Figure 6.4: 2000 triangles for the low camera and for a map.
Status drawMeshes(Stage& stage, tools::Report& report) {
  constexpr uint32_t kTriangles = 2000;
  Result<Decoder> decoder = tools::openDecoder(stage.tracks.cut(stage.tracks.most()));
  if (!decoder) return decoder.status();
  const GroundFrame frame = tools::frameOf(*stage.terrain.original.heights);
  const tools::ImageFile& texture = *stage.terrain.original.image;
  const Camera& camera = report.cameras[kLow];
  Result<std::unique_ptr<tools::Renderer>> renderer = tools::Renderer::create();
  if (!renderer.ok()) return renderer.status();
  const tks_image image = tools::asImage(texture);
  const std::vector<tks_screen_camera> seen = {tools::meshCamera(camera, frame)};
  const Result<Mesh> viewed = decoder->screenMesh(seen, kTriangles, &image);
  if (!viewed) return viewed.status();
  const Result<Mesh> map = decoder->budgetMesh(kTriangles);
  if (!map) return map.status();
  Gallery gallery{"Figure 6.4: meshes for a viewer and for a map",
                  "The low camera's pictures of meshes of as many triangles.",
                  {}};
  for (const auto& [mesh, name] :
       {std::pair(&*viewed, "for the viewer"), std::pair(&*map, "for a map")}) {
    tools::MeshFile placed = tools::placeMesh(*mesh, frame);
    placed.texture = &texture;
    auto picture = (*renderer)->draw(placed, camera);
    if (!picture.ok()) return picture.status();
    const double psnr = tools::screenPsnr({report.originals[kLow]}, {*picture});
    const std::string caption =
        std::to_string(mesh->triangleCount()) + " triangles " + name + ": " + decibels(psnr);
    std::printf("  figure 6.4: %s\n", caption.c_str());
    stage.record(nextPlate(gallery), "db", psnr);
    gallery.plates.push_back({std::move(*picture), caption});
    report.meshes.push_back(planOf(*mesh, camera, frame, caption));
  }
  report.galleries.push_back(std::move(gallery));
  return {};
}

/// Figure 6.5: 16 kB for the low camera and for anybody, as it sees them and from above.
Status drawViewed(Stage& stage, tools::Report& report) {
  constexpr uint64_t kShort = 16384;
  Gallery gallery{"Figure 6.5: bytes for a viewer and for anybody",
                  "Streams of 16 kB, one told the low camera: as it sees them, and from above.",
                  {}};
  for (const Knows knows : {Knows::kCameras, Knows::kNothing}) {
    const auto coded = encodeTerrain(stage.terrain.original, {kShort, knows, 0, "low"});
    if (!coded.ok()) return coded.status();
    auto seen = stage.comparer.measure(coded->stream.bytes(), 0);
    if (!seen.ok()) return seen.status();
    const char* name = knows == Knows::kCameras ? "for the viewer" : "for anybody";
    for (const size_t camera : {kLow, kLow + 1}) {
      const std::string caption = std::string(name) + ", " + report.cameras[camera].name + ": " +
                                  decibels(seen->camera_psnr[camera]) + ", " +
                                  std::to_string(seen->geometry_bytes) + " bytes of heights";
      std::printf("  figure 6.5: %s\n", caption.c_str());
      stage.record(nextPlate(gallery), "db", seen->camera_psnr[camera]);
      stage.record(nextPlate(gallery), "heights_bytes", static_cast<double>(seen->geometry_bytes));
      gallery.plates.push_back({std::move(seen->pictures[camera]), caption});
    }
  }
  report.galleries.push_back(std::move(gallery));
  return {};
}

/// Figures 6.9 and 6.10.
Status drawModels(Stage& stage, tools::Report& report) {
  PairPlane& plane = *report.plane;
  plane.equal_psnr = equalPsnr(plane);
  plane.equal_bytes = equalBytes(plane);
  Result<Gallery> psnr = galleryOf(
      stage, plane.equal_psnr,
      {"Figure 6.9: models of one PSNR", "The letters are those of the chart of equal PSNR.", {}});
  if (!psnr.ok()) return psnr.status();
  Result<Gallery> bytes = galleryOf(
      stage, plane.equal_bytes,
      {"Figure 6.10: models of 10 kB", "The letters are those of the chart of equal bytes.", {}});
  if (!bytes.ok()) return bytes.status();
  for (const Gallery* gallery : {&*psnr, &*bytes})
    for (const Gallery::Plate& plate : gallery->plates)
      std::printf("  %.11s %s\n", gallery->title.c_str(), plate.caption.c_str());
  report.galleries.push_back(std::move(*psnr));
  report.galleries.push_back(std::move(*bytes));
  return {};
}

Status writeText(const std::filesystem::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  return file ? Status() : Status(TKS_IO, "Cannot write " + path.string() + ".");
}

/// What figures 6.6 to 6.8 are drawn from.
std::string numbersOf(const PairPlane& plane) {
  std::string csv = "what,heights,texture,psnr\n";
  const auto line = [&csv](const char* what, const Split& split, const std::string& psnr) {
    csv += std::string(what) + ',' + std::to_string(split.heights) + ',' +
           std::to_string(split.texture) + ',' + psnr + '\n';
  };
  for (size_t h = 0; h < plane.heights.size(); ++h)
    for (size_t t = 0; t < plane.textures.size(); ++t)
      line("pair", {plane.heights[h], plane.textures[t]}, std::to_string(plane.at(h, t)));
  for (const auto& [name, path] :
       {std::pair("hull", &plane.hull), std::pair("greedy", &plane.greedy),
        std::pair("equal_psnr", &plane.equal_psnr), std::pair("equal_bytes", &plane.equal_bytes)})
    for (const SeenPair& pair : *path) line(name, pair.split, std::to_string(pair.psnr));
  for (const Split& split : plane.shipped) line("shipped", split, "");
  return csv;
}

/// Pictures, and their captions in plates.csv.
Status writePlates(const std::filesystem::path& folder, const std::vector<Gallery>& galleries) {
  std::string captions = "plate,caption\n";
  for (const Gallery& gallery : galleries) {
    for (size_t i = 0; i < gallery.plates.size(); ++i) {
      const tools::Picture& picture = gallery.plates[i].picture;
      tools::ImageFile image{picture.width, picture.height, 4, TKS_U8, {}};
      const auto bytes = std::as_bytes(std::span(picture.rgba));
      image.data.assign(bytes.begin(), bytes.end());
      const std::string plate = numberOf(gallery) + static_cast<char>('a' + i);
      captions += plate + ",\"" + gallery.plates[i].caption + "\"\n";
      if (Status status = tools::writeImage((folder / (plate + ".png")).string(), image);
          !status.ok())
        return status;
    }
  }
  return writeText(folder / "plates.csv", captions);
}

/// Edges of the meshes of figure 6.4, one a line; a line without a far end is the viewer.
std::string edgesOf(const std::vector<MeshPlan>& plans) {
  std::string csv = "mesh,x0,y0,x1,y1\n";
  for (size_t i = 0; i < plans.size(); ++i) {
    const std::string mesh = std::to_string(i);
    for (const auto& [x0, y0, x1, y1] : plans[i].edges)
      csv += mesh + ',' + std::to_string(x0) + ',' + std::to_string(y0) + ',' + std::to_string(x1) +
             ',' + std::to_string(y1) + '\n';
    csv += mesh + ',' + std::to_string(plans[i].eye[0]) + ',' + std::to_string(plans[i].eye[1]) +
           ",,\n";
  }
  return csv;
}

Status writeFolder(const std::filesystem::path& folder, const tools::Report& report) {
  const Result<std::string> page = tools::renderPage(report);
  if (!page.ok()) return page.status();
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  for (const auto& [name, text] : {std::pair<const char*, std::string>("index.html", *page),
                                   {"pairs.csv", numbersOf(*report.plane)},
                                   {"edges.csv", edgesOf(report.meshes)}})
    if (Status status = writeText(folder / name, text); !status.ok()) return status;
  return writePlates(folder, report.galleries);
}

/// Figures 6.6 to 6.8, in numbers.
void reportPaths(const Stage& stage, const PairPlane& plane) {
  const auto [mean, worst] = greedyLoss(plane);
  std::printf(
      "  figures 6.6 to 6.8: %zu x %zu = %zu pairs; marginal analysis: path of %zu, looks at "
      "%zu of %zu, %.3f dB below the best pair, %.3f at worst\n",
      plane.heights.size(), plane.textures.size(), plane.psnr.size(), plane.greedy.size(),
      plane.looked, plane.psnr.size(), mean, worst);
  stage.record("marginal", "pairs", static_cast<double>(plane.psnr.size()));
  stage.record("marginal", "path", static_cast<double>(plane.greedy.size()));
  stage.record("marginal", "looked", static_cast<double>(plane.looked));
  stage.record("marginal", "mean_db_lost", mean);
  stage.record("marginal", "worst_db_lost", worst);
}

}  // namespace

Status drawFigures(const Terrain& terrain, uint32_t grid, const std::string& folder,
                   std::vector<ResultRow>& rows) {
  const auto coded = encodeTerrain(terrain.original, {kBytes, Knows::kNothing, 0, "all"});
  if (!coded.ok()) return coded.status();
  const auto stream = coded->stream.bytes();
  Result<tools::Report> report = tools::makeReport(
      terrain.original, {terrain.name, stream, 0, {"", "all"}, tools::PlaneGrid{grid, 0}});
  if (!report.ok()) return report.status();
  const Result<Decoder> decoder = Decoder::open(stream);
  if (!decoder) return decoder.status();
  Result<tools::Comparer> comparer = tools::Comparer::create(terrain.original, decoder->info());
  if (!comparer.ok()) return comparer.status();
  if (Status status = comparer->look({"", "all"}); !status.ok()) return status;
  Result<SplitStream> tracks = SplitStream::take(stream);
  if (!tracks.ok()) return tracks.status();
  Stage stage{terrain, std::move(*comparer), std::move(*tracks), rows};
  reportPaths(stage, *report->plane);
  Status status = drawMeshes(stage, *report);
  if (status.ok()) status = drawViewed(stage, *report);
  if (status.ok()) status = drawModels(stage, *report);
  if (status.ok()) status = writeFolder(folder, *report);
  if (status.ok()) std::printf("  %s/index.html\n", folder.c_str());
  return status;
}

}  // namespace tetrakis::bench
