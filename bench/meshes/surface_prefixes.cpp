// SPDX-License-Identifier: Apache-2.0
#include "bench/meshes/surface_objects.hpp"
#include "bench/meshes/surface_studies.hpp"

namespace tetrakis::bench {
namespace {

constexpr double kKilobyte = 1024;

/// The samples of a stream, encoded anew over their base. Nothing where so few bytes hold no
/// header.
Result<Buffer> onTheSameBase(std::span<const uint8_t> stream, uint64_t bytes) {
  Result<Decoder> decoder = Decoder::open(stream);
  if (!decoder.ok()) return decoder.status();
  const Result<std::vector<float>> surface = decoder->surface();
  if (!surface.ok()) return surface.status();
  const tks_info& info = decoder->info();
  tks_heights heights{};
  heights.size = sizeof heights;
  heights.width = info.width;
  heights.height = info.height;
  heights.sample = TKS_F32;
  heights.data = surface->data();
  heights.scale = 1;
  heights.domain = TKS_DOMAIN_FOREST;
  heights.forest = info.forest;
  heights.base_mesh = info.base_mesh;
  tks_encode_options options = makeEncodeOptions();
  options.bytes = bytes;
  return encode(&heights, nullptr, options);
}

/// Nothing where the bytes show nothing.
std::optional<double> errorOfBytes(const SurfaceModel& model, std::span<const uint8_t> stream,
                                   size_t bytes) {
  const Result<tools::PaintedMesh> mesh = decodedPrefix(stream, bytes);
  return mesh.ok() ? std::optional(errorOf(model, mesh->mesh)) : std::nullopt;
}

}  // namespace

Status studyPrefixes(const SurfaceModel& model, SurfaceFigures& figures) {
  const Result<SurfaceObject> whole =
      surfaceObject(model, {64 << 10, TKS_OBJECT_RESAMPLED, false, true});
  if (!whole.ok()) return whole.status();
  ColumnValues prefixes, made, on_same_base;
  for (const double kilobytes : figures.columns()) {
    const auto bytes = static_cast<size_t>(kilobytes * kKilobyte);
    prefixes.push_back(errorOfBytes(model, whole->stream.bytes(), bytes));
    const Result<SurfaceObject> own =
        surfaceObject(model, {bytes, TKS_OBJECT_RESAMPLED, false, true});
    made.push_back(own.ok() ? errorOfBytes(model, own->stream.bytes(), bytes) : std::nullopt);
    const Result<Buffer> same = onTheSameBase(whole->stream.bytes(), bytes);
    on_same_base.push_back(same.ok() ? errorOfBytes(model, same->bytes(), bytes) : std::nullopt);
  }
  figures.printColumns("errors in kB", 0);
  SurfaceFigures::print("prefixes of 64 kB", prefixes, 2);
  SurfaceFigures::print("made for the length", made, 2);
  SurfaceFigures::print("made on the same base", on_same_base, 2);
  figures.ratios(model.name, "prefix over made", prefixes, made);
  figures.ratios(model.name, "prefix over same base", prefixes, on_same_base);
  return {};
}

}  // namespace tetrakis::bench
