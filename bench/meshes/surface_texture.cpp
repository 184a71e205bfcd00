// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "bench/meshes/surface_atlas.hpp"
#include "bench/meshes/surface_objects.hpp"
#include "bench/meshes/surface_peers.hpp"
#include "bench/meshes/surface_studies.hpp"

namespace tetrakis::bench {
namespace {

/// A textured stream as receivers have it.
struct TexturedObject {
  tks_object_kind kind;
  double bytes = 0, texture_bytes = 0;
  double error = 0;   ///< of the surface, in 1e-4 of the diagonal
  double colour = 0;  ///< RMS of R, G and B, of the worse direction

  double surfacePsnr() const { return 20 * std::log10(1e4 / error); }
  double colourPsnr() const { return tools::colourPsnr(colour * colour); }
};

Result<TexturedObject> texturedObject(const SurfaceModel& model, double bytes,
                                      tks_object_kind kind) {
  const Result<SurfaceObject> object =
      surfaceObject(model, {static_cast<uint64_t>(bytes), kind, true});
  if (!object.ok()) return object.status();
  Result<Decoder> decoder = Decoder::open(object->stream.bytes());
  if (!decoder.ok()) return decoder.status();
  const Result<tools::PaintedMesh> mesh = tools::decodedMesh(*decoder, 0);
  if (!mesh.ok()) return mesh.status();
  const TriangleTree tree(mesh->mesh);
  TexturedObject out{object->report.kind};
  out.bytes = static_cast<double>(object->stream.bytes().size());
  out.texture_bytes = static_cast<double>(decoder->info().texture_bytes);
  out.error = errorOf(model, mesh->mesh);
  out.colour = std::sqrt(std::max(tools::colourError(model.painted, *mesh, tree),
                                  tools::colourError(*mesh, model.painted, model.tree)));
  return out;
}

/// What the same texture and surface take in other files.
struct TexturePeers {
  ErrorCurve own_atlas, avif;
  std::vector<ErrorCurve> meshes;
};

Result<TexturePeers> texturePeers(const SurfaceModel& model, uint32_t sizes) {
  const tools::ImageFile atlas = filledAtlas(model);
  Result<ErrorCurve> own = tetrakisAtlas(model, atlas);
  if (!own.ok()) return own.status();
  Result<ErrorCurve> avif = avifAtlas(model, atlas);
  if (!avif.ok() && avif.status().code() == TKS_UNSUPPORTED)
    std::printf("  without AVIF: %s\n", avif.status().message().c_str());
  else if (!avif.ok())
    return avif.status();
  const Result<std::vector<PeerCoding>> codings =
      surfacePeers(model, texturedFloatMesh(model.painted), sizes);
  if (!codings.ok()) return codings.status();
  return TexturePeers{std::move(*own), avif.ok() ? std::move(*avif) : ErrorCurve(),
                      curvesOf(*codings)};
}

struct TextureLines {
  ColumnValues surface, colours, texels, atlas;                    ///< of streams with patches
  ColumnValues all_surface, all_colours, all, draco, avif, peers;  ///< of the better kind
};

void addPatches(const TexturedObject& object, const TexturePeers& peers, TextureLines& lines) {
  lines.surface.push_back(object.surfacePsnr());
  lines.colours.push_back(object.colourPsnr());
  lines.texels.push_back(object.texture_bytes);
  lines.atlas.push_back(leastAt({peers.own_atlas}, object.colour));
}

void addAll(const TexturedObject& object, const TexturePeers& peers, TextureLines& lines) {
  lines.all_surface.push_back(object.surfacePsnr());
  lines.all_colours.push_back(object.colourPsnr());
  lines.all.push_back(object.bytes);
  lines.draco.push_back(leastAt(peers.meshes, object.error));
  lines.avif.push_back(leastAt({peers.avif}, object.colour));
  const bool both = lines.draco.back() && lines.avif.back();
  lines.peers.push_back(both ? std::optional(*lines.draco.back() + *lines.avif.back())
                             : std::nullopt);
}

void print(const SurfaceModel& model, const TextureLines& lines, SurfaceFigures& figures) {
  figures.printColumns("streams of so many kB", 0);
  SurfaceFigures::print("dB of the surface", lines.surface, 1);
  SurfaceFigures::print("dB of the colours", lines.colours, 1);
  SurfaceFigures::print("bytes of the texels", lines.texels, 0);
  SurfaceFigures::print("of the atlas, tetrakis", lines.atlas, 0);
  figures.ratios(model.name, "texels over atlas", lines.texels, lines.atlas);
  SurfaceFigures::print("kind taken: dB of surface", lines.all_surface, 1);
  SurfaceFigures::print("dB of the colours", lines.all_colours, 1);
  SurfaceFigures::print("bytes of all", lines.all, 0);
  SurfaceFigures::print("Draco", lines.draco, 0);
  SurfaceFigures::print("AVIF", lines.avif, 0);
  figures.ratios(model.name, "all over Draco and AVIF", lines.all, lines.peers);
}

Status printFirstPicture(const SurfaceModel& model) {
  constexpr double kFewest = 1200, kMost = 32 << 10, kRatio = 1.2, kSurface = 69, kColours = 35;
  for (double bytes = kFewest; bytes < kMost; bytes *= kRatio) {
    const Result<TexturedObject> object = texturedObject(model, bytes, TKS_OBJECT_RESAMPLED);
    if (!object.ok() || object->surfacePsnr() < kSurface || object->colourPsnr() < kColours)
      continue;
    std::printf("  first picture: %.0f bytes, %.1f dB of the surface, %.1f of the colours\n",
                object->bytes, object->surfacePsnr(), object->colourPsnr());
    return {};
  }
  std::printf("  first picture: none\n");
  return {};
}

}  // namespace

Status studyTexture(const SurfaceModel& model, const SurfaceStudyOptions& options,
                    SurfaceFigures& figures) {
  constexpr double kKilobyte = 1024;
  if (!model.hasTexture()) return {};
  const Result<TexturePeers> peers = texturePeers(model, options.sizes);
  if (!peers.ok()) return peers.status();
  TextureLines lines;
  for (const double kilobytes : figures.columns()) {
    const double bytes = kilobytes * kKilobyte;
    const Result<TexturedObject> taken = texturedObject(model, bytes, TKS_OBJECT_AUTO);
    if (!taken.ok()) return taken.status();
    addAll(*taken, *peers, lines);
    const Result<TexturedObject> patches = taken->kind == TKS_OBJECT_RESAMPLED
                                               ? taken
                                               : texturedObject(model, bytes, TKS_OBJECT_RESAMPLED);
    if (!patches.ok()) return patches.status();
    addPatches(*patches, *peers, lines);
  }
  print(model, lines, figures);
  return printFirstPicture(model);
}

}  // namespace tetrakis::bench
