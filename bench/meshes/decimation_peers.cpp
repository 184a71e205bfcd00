// SPDX-License-Identifier: Apache-2.0
// Martini and Delatin through node, meshoptimizer and Draco as libraries.
#include "bench/meshes/decimation_peers.hpp"

#include <draco/compression/decode.h>
#include <draco/compression/encode.h>
#include <draco/mesh/mesh.h>
#include <meshoptimizer.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <filesystem>
#include <fstream>

namespace tetrakis::bench {
namespace {

/// Runs a program to its end; whether it succeeded.
bool runProgram(std::vector<std::string> arguments) {
  std::vector<char*> words;
  for (std::string& argument : arguments) words.push_back(argument.data());
  words.push_back(nullptr);
  const pid_t child = fork();
  if (child < 0) return false;
  if (child == 0) {
    execvp(words[0], words.data());
    _exit(127);
  }
  int status = 0;
  return waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

/// The format of decimation_node.mjs.
std::vector<PeerMesh> readMeshes(const std::string& path, const Raster& raster) {
  std::ifstream file(path, std::ios::binary);
  const auto word = [&] {
    uint32_t value = 0;
    file.read(reinterpret_cast<char*>(&value), sizeof(value));
    return value;
  };
  std::vector<PeerMesh> meshes;
  while (file.peek() != std::ifstream::traits_type::eof()) {
    PeerMesh peer;
    peer.peer = word() == 0 ? "martini" : "delatin";
    peer.budget = word();
    const uint32_t vertices = word(), triangles = word();
    for (uint32_t i = 0; i < vertices; ++i) {
      const uint32_t x = word(), y = word();
      peer.mesh.positions.push_back({static_cast<float>(x), static_cast<float>(y),
                                     static_cast<float>(raster.samples[y * raster.width + x])});
    }
    for (uint32_t i = 0; i < 3 * triangles; ++i) peer.mesh.triangles.push_back(word());
    meshes.push_back(std::move(peer));
  }
  return meshes;
}

}  // namespace

Result<std::vector<PeerMesh>> nodeMeshes(const Raster& raster, const std::string& node_folder,
                                         const std::vector<uint32_t>& budgets) {
  const auto base =
      std::filesystem::temp_directory_path() / ("tetrakis-decimation-" + std::to_string(getpid()));
  const std::string grid = base.string() + ".grid", out = base.string() + ".meshes";
  const std::vector<float> heights(raster.samples.begin(), raster.samples.end());
  std::ofstream(grid, std::ios::binary)
      .write(reinterpret_cast<const char*>(heights.data()),
             static_cast<std::streamsize>(heights.size() * sizeof(float)));
  std::vector<std::string> arguments = {"node", TETRAKIS_DECIMATION_NODE,     node_folder,
                                        grid,   std::to_string(raster.width), out};
  for (const uint32_t budget : budgets) arguments.push_back(std::to_string(budget));
  const bool done = runProgram(arguments);
  std::vector<PeerMesh> meshes;
  if (done) meshes = readMeshes(out, raster);
  std::filesystem::remove(grid);
  std::filesystem::remove(out);
  if (!done)
    return Status(TKS_IO, "node cannot run Martini and Delatin from " + node_folder +
                              ": run bench/decimation, which installs them.");
  return meshes;
}

Simplifier::Simplifier(const Raster& raster, double exaggeration) : raster_(raster) {
  for (uint32_t y = 0; y < raster.height; ++y)
    for (uint32_t x = 0; x < raster.width; ++x)
      positions_.push_back(
          {static_cast<float>(x), static_cast<float>(y),
           static_cast<float>(raster.samples[y * raster.width + x] * exaggeration)});
  for (uint32_t y = 0; y + 1 < raster.height; ++y)
    for (uint32_t x = 0; x + 1 < raster.width; ++x) {
      const uint32_t v = y * raster.width + x, below = v + raster.width;
      triangles_.insert(triangles_.end(), {v, below, v + 1, v + 1, below, below + 1});
    }
}

PlanMesh Simplifier::run(uint32_t budget) const {
  PlanMesh mesh;
  std::vector<uint32_t> indices(triangles_.size());
  indices.resize(meshopt_simplify(indices.data(), triangles_.data(), triangles_.size(),
                                  positions_[0].data(), positions_.size(), sizeof(positions_[0]),
                                  size_t{3} * budget, FLT_MAX));
  std::vector<uint32_t> place(positions_.size(), UINT32_MAX);
  for (const uint32_t v : indices) {
    if (place[v] == UINT32_MAX) {
      place[v] = static_cast<uint32_t>(mesh.positions.size());
      mesh.positions.push_back(
          {positions_[v][0], positions_[v][1], static_cast<float>(raster_.samples[v])});
    }
    mesh.triangles.push_back(place[v]);
  }
  return mesh;
}

namespace {

/// Stored positions are positions * scale, in floats or rounded to whole numbers.
struct DracoSetting {
  int bits;  ///< of floats; 0: integers
  std::array<double, 3> scale;
};

template <class T>
void fillDraco(const PlanMesh& mesh, const DracoSetting& setting, draco::DataType type,
               draco::Mesh& out) {
  out.set_num_points(static_cast<uint32_t>(mesh.positions.size()));
  draco::GeometryAttribute attribute;
  attribute.Init(draco::GeometryAttribute::POSITION, nullptr, 3, type, false, 3 * sizeof(T), 0);
  const int id = out.AddAttribute(attribute, true, out.num_points());
  for (uint32_t i = 0; i < mesh.positions.size(); ++i) {
    std::array<T, 3> value;
    for (size_t k = 0; k < 3; ++k) {
      const double scaled = mesh.positions[i][k] * setting.scale[k];
      value[k] = static_cast<T>(setting.bits == 0 ? std::round(scaled) : scaled);
    }
    out.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(i), value.data());
  }
  for (size_t t = 0; t < mesh.triangleCount(); ++t)
    out.AddFace({draco::PointIndex(mesh.triangles[3 * t]),
                 draco::PointIndex(mesh.triangles[3 * t + 1]),
                 draco::PointIndex(mesh.triangles[3 * t + 2])});
}

Result<PlanMesh> decodeDraco(const draco::EncoderBuffer& coded, const DracoSetting& setting) {
  draco::DecoderBuffer buffer;
  buffer.Init(coded.data(), coded.size());
  draco::Decoder decoder;
  auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
  if (!decoded.ok()) return Status(TKS_MISMATCH, decoded.status().error_msg_string());
  const draco::Mesh& mesh = *decoded.value();
  const auto* positions = mesh.GetNamedAttribute(draco::GeometryAttribute::POSITION);
  PlanMesh out;
  for (draco::PointIndex i(0); i < mesh.num_points(); ++i) {
    std::array<float, 3> value{};
    positions->ConvertValue<float, 3>(positions->mapped_index(i), value.data());
    for (size_t k = 0; k < 3; ++k) value[k] = static_cast<float>(value[k] / setting.scale[k]);
    out.positions.push_back(value);
  }
  for (draco::FaceIndex f(0); f < mesh.num_faces(); ++f)
    for (const draco::PointIndex& i : mesh.face(f)) out.triangles.push_back(i.value());
  return out;
}

Result<CodedMesh> codeDraco(const PlanMesh& mesh, const Raster& raster,
                            const DracoSetting& setting) {
  draco::Mesh points;
  if (setting.bits > 0)
    fillDraco<float>(mesh, setting, draco::DT_FLOAT32, points);
  else
    fillDraco<int32_t>(mesh, setting, draco::DT_INT32, points);
  draco::Encoder encoder;
  encoder.SetSpeedOptions(0, 0);
  if (setting.bits > 0)
    encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, setting.bits);
  draco::EncoderBuffer buffer;
  const draco::Status status = encoder.EncodeMeshToBuffer(points, &buffer);
  if (!status.ok()) return Status(TKS_MISMATCH, status.error_msg_string());
  Result<PlanMesh> decoded = decodeDraco(buffer, setting);
  if (!decoded.ok()) return decoded.status();
  const double error = rmse(*decoded, raster);
  return CodedMesh{buffer.size(), error, std::move(*decoded)};
}

}  // namespace

Result<std::vector<CodedMesh>> dracoCodings(const PlanMesh& mesh, const Raster& raster) {
  const auto [low, high] = std::minmax_element(raster.samples.begin(), raster.samples.end());
  const double range = std::max(1, *high - *low);
  std::vector<DracoSetting> settings;
  for (int bits = 8; bits <= 14; ++bits) settings.push_back({bits, {1, 1, raster.width / range}});
  for (int bits = 7; bits <= 14; ++bits)
    settings.push_back({0, {1, 1, std::min(1.0, ((1 << bits) - 1) / range)}});
  std::vector<CodedMesh> codings;
  for (const DracoSetting& setting : settings) {
    Result<CodedMesh> coded = codeDraco(mesh, raster, setting);
    if (!coded.ok()) return coded.status();
    codings.push_back(std::move(*coded));
  }
  return codings;
}

}  // namespace tetrakis::bench
