// SPDX-License-Identifier: Apache-2.0
#include "bench/allocation/joint_peers.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <string>
#include <utility>

#include "bench/peers/openjpeg_peer.hpp"
#include "bench/peers/program.hpp"

namespace tetrakis::bench {
namespace {

/// Means of 2 x 2 texels; of fewer at the borders of odd sizes.
tools::ImageFile halved(const tools::ImageFile& fine) {
  tools::ImageFile half{(fine.width + 1) / 2, (fine.height + 1) / 2, fine.channels, TKS_U8, {}};
  half.data.reserve(size_t{half.width} * half.height * half.channels);
  const auto at = [&](uint32_t x, uint32_t y, uint32_t channel) {
    const size_t texel =
        size_t{std::min(y, fine.height - 1)} * fine.width + std::min(x, fine.width - 1);
    return std::to_integer<int>(fine.data[texel * fine.channels + channel]);
  };
  for (uint32_t y = 0; y < fine.height; y += 2)
    for (uint32_t x = 0; x < fine.width; x += 2)
      for (uint32_t c = 0; c < fine.channels; ++c)
        half.data.push_back(static_cast<std::byte>(
            (at(x, y, c) + at(x + 1, y, c) + at(x, y + 1, c) + at(x + 1, y + 1, c) + 2) / 4));
  return half;
}

/// One texture as AVIF files of a folder, by avifenc and avifdec (libaom, 4:4:4, tuned for PSNR).
class AvifTexture {
 public:
  AvifTexture(const TemporaryFolder& folder, uint32_t speed)
      : folder_(folder), speed_(std::to_string(speed)) {}

  Status take(const tools::ImageFile& image) {
    return tools::writeImage(folder_.file("in.png"), image);
  }

  Result<CodedTexels> code(int quantiser) const {
    const std::string in = folder_.file("in.png"), coded = folder_.file("coded.avif");
    const std::string out = folder_.file("out.png"), q = std::to_string(quantiser);
    Status status = runProgram({"avifenc", "-c", "aom", "-j", "1", "-s", speed_, "-d", "8", "-y",
                                "444", "-a", "tune=psnr", "--min", q, "--max", q, in, coded},
                               folder_.file("log"));
    if (status.ok()) status = runProgram({"avifdec", "-j", "1", coded, out}, folder_.file("log"));
    if (!status.ok()) return status;
    Result<tools::ImageFile> image = tools::readImage(out);
    if (!image.ok()) return image.status();
    return CodedTexels{std::filesystem::file_size(coded), std::move(*image)};
  }

 private:
  const TemporaryFolder& folder_;
  std::string speed_;
};

/// Those of which none of fewer bytes has a picture as good. psnr: of each.
std::vector<size_t> bestOfTheirBytes(const std::vector<uint64_t>& bytes,
                                     const std::vector<double>& psnr) {
  std::vector<size_t> order(bytes.size()), kept;
  for (size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](size_t a, size_t b) {
    return bytes[a] != bytes[b] ? bytes[a] < bytes[b] : psnr[a] > psnr[b];
  });
  for (const size_t i : order)
    if (kept.empty() || psnr[i] > psnr[kept.back()]) kept.push_back(i);
  return kept;
}

}  // namespace

Result<JointPeers> JointPeers::create(const Terrain& terrain, Screen& screen, uint64_t most,
                                      uint32_t speed) {
  const tools::HeightFile& heights = *terrain.original.heights;
  Result<Raster> raster = heightRaster(heights);
  if (!raster.ok()) return raster.status();
  if (terrain.original.image->channels != 3 || terrain.original.image->sample != TKS_U8)
    return Status(TKS_UNSUPPORTED, "The peers' textures are RGB of 8 bits.");
  JointPeers peers(terrain, screen, std::move(*raster));
  const tools::Surface surface = tools::heightsOf(heights);
  peers.lowest_ = *std::min_element(surface.values.begin(), surface.values.end());
  peers.steps_ = tools::frameOf(heights);
  peers.steps_.metres_per_unit *= peers.raster_.unit;
  if (Status status = peers.codeTextures(most, speed); !status.ok()) return status;
  return peers;
}

Status JointPeers::codeTextures(uint64_t most, uint32_t speed) {
  constexpr int kCoarsest = 63, kStep = 3, kSizes = 3;
  const TemporaryFolder folder;
  if (!folder.made()) return {TKS_IO, "Cannot make a temporary folder: is the disk full?"};
  const tools::MeshFile ground = tools::fullGrid(tools::heightsOf(*terrain_->original.heights),
                                                 tools::frameOf(*terrain_->original.heights));
  tools::ImageFile image = *terrain_->original.image;
  image.place = {};
  std::vector<CodedTexels> all;
  std::vector<uint64_t> bytes;
  std::vector<double> psnr;
  for (int size = 0; size < kSizes; ++size, image = halved(image)) {
    AvifTexture avif(folder, speed);
    if (Status status = avif.take(image); !status.ok()) return status;
    for (int quantiser = kCoarsest; quantiser > 0; quantiser -= kStep) {
      Result<CodedTexels> coded = avif.code(quantiser);
      if (!coded.ok()) return coded.status();
      if (coded->bytes > most) break;
      const auto score = screen_->score(ground, &coded->image);
      if (!score.ok()) return score.status();
      bytes.push_back(coded->bytes);
      psnr.push_back(score->front());
      all.push_back(std::move(*coded));
    }
  }
  for (const size_t i : bestOfTheirBytes(bytes, psnr)) textures_.push_back(std::move(all[i]));
  return {};
}

Result<double> JointPeers::psnrOfGrid(uint64_t bytes, const tools::ImageFile& texture,
                                      PeerPair& pair) {
  // OpenJPEG decodes to whole steps: few bits become 16.
  const uint32_t largest = *std::max_element(raster_.samples.begin(), raster_.samples.end());
  const uint32_t factor = std::max(1u, largest > 0 ? 65535 / largest : 1);
  Raster wide = raster_;
  wide.bits = 16;
  for (uint16_t& sample : wide.samples) sample = static_cast<uint16_t>(sample * factor);
  constexpr int kResolutions = 6;
  auto codestream = encodeOpenJpeg(wide, {bytes, kResolutions});
  if (codestream.ok() && codestream->size() > bytes && 2 * bytes > codestream->size() + 64)
    codestream = encodeOpenJpeg(wide, {2 * bytes - codestream->size(), kResolutions});
  if (!codestream.ok()) return codestream.status();
  const auto decoded = decodeOpenJpeg(*codestream);
  if (!decoded.ok()) return decoded.status();
  tools::Surface surface{raster_.width, raster_.height, {}};
  for (const uint16_t sample : *decoded)
    surface.values.push_back(lowest_ + raster_.unit * sample / factor);
  const GroundFrame frame = tools::frameOf(*terrain_->original.heights);
  const auto score = screen_->score(tools::fullGrid(surface, frame), &texture);
  if (!score.ok()) return score.status();
  pair.height_bytes = codestream->size();
  return score->front();
}

Result<PeerPair> JointPeers::grid(uint64_t bytes) {
  constexpr uint64_t kLeast = 160;  // a codestream's header, and some
  PeerPair best;
  for (const CodedTexels& texture : textures_) {
    if (texture.bytes + kLeast > bytes) break;
    PeerPair pair;
    const Result<double> psnr = psnrOfGrid(bytes - texture.bytes, texture.image, pair);
    if (!psnr.ok()) return psnr.status();
    pair.psnr = *psnr;
    pair.texture_bytes = texture.bytes;
    // Headers of the least sizes cannot be avoided.
    if (pair.height_bytes + pair.texture_bytes > bytes + bytes / 100) continue;
    if (pair.psnr > best.psnr) best = pair;
  }
  return best;
}

Status JointPeers::codeMeshes(uint32_t triangles) {
  if (std::find(coded_.begin(), coded_.end(), triangles) != coded_.end()) return {};
  const double spacing = 0.5 * (steps_.spacing_x + steps_.spacing_y);
  const Simplifier simplifier(raster_, steps_.metres_per_unit / spacing);
  Result<std::vector<CodedMesh>> codings = dracoCodings(simplifier.run(triangles), raster_);
  if (!codings.ok()) return codings.status();
  coded_.push_back(triangles);
  for (CodedMesh& coded : *codings) meshes_.push_back(std::move(coded));
  std::vector<CodedMesh> kept;
  for (CodedMesh& mesh : meshes_) {
    const auto better = [&](const CodedMesh& other) {
      return &other != &mesh && other.bytes <= mesh.bytes && other.rmse <= mesh.rmse &&
             other.mesh.triangleCount() <= mesh.mesh.triangleCount();
    };
    if (std::none_of(meshes_.begin(), meshes_.end(), better)) kept.push_back(mesh);
  }
  meshes_ = std::move(kept);
  return {};
}

Result<PeerPair> JointPeers::mesh(uint64_t bytes, uint32_t triangles) {
  constexpr double kRatio = 1.3, kBytesPerTriangle = 0.7;  // fewer bytes Draco never takes
  constexpr uint32_t kFewest = 50;
  const auto most = static_cast<uint32_t>(
      std::min({double{1} * triangles, 1.9 * static_cast<double>(raster_.pixels()),
                static_cast<double>(bytes) / kBytesPerTriangle}));
  for (double budget = kFewest; budget < most; budget *= kRatio)
    if (Status status = codeMeshes(static_cast<uint32_t>(budget)); !status.ok()) return status;
  if (triangles == most)
    if (Status status = codeMeshes(most); !status.ok()) return status;
  std::vector<const CodedMesh*> allowed;
  std::vector<uint64_t> sizes;
  std::vector<double> quality;
  for (const CodedMesh& mesh : meshes_) {
    if (mesh.mesh.triangleCount() > triangles || mesh.bytes >= bytes) continue;
    allowed.push_back(&mesh);
    sizes.push_back(mesh.bytes);
    quality.push_back(-mesh.rmse);
  }
  PeerPair best;
  uint64_t tried = 0;
  for (const size_t i : bestOfTheirBytes(sizes, quality)) {
    const CodedMesh& mesh = *allowed[i];
    if (mesh.bytes < tried + tried / 16) continue;  // as good as the one before
    const CodedTexels* texture = nullptr;
    for (const CodedTexels& other : textures_)
      if (mesh.bytes + other.bytes <= bytes) texture = &other;
    if (texture == nullptr) break;
    const double offset = lowest_ / raster_.unit;
    const auto score = screen_->score(placed(mesh.mesh, steps_, offset), &texture->image);
    if (!score.ok()) return score.status();
    tried = mesh.bytes;
    if (score->front() <= best.psnr) continue;
    best = {score->front(), mesh.bytes, texture->bytes,
            static_cast<uint32_t>(mesh.mesh.triangleCount())};
  }
  return best;
}

}  // namespace tetrakis::bench
