// SPDX-License-Identifier: Apache-2.0
// The encoding half of the C interface (include/tetrakis/tetrakis.h): arguments are checked, and a
// stream is proved before it is handed over.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <initializer_list>

#include "api/encode_arguments.hpp"
#include "api/encoded_stream.hpp"
#include "api/guarded.hpp"
#include "base/forest.hpp"
#include "base/samples.hpp"
#include "base/shown_text.hpp"
#include "base/watch.hpp"
#include "bitstream/stream/geometry_header.hpp"
#include "bitstream/stream/georeference.hpp"
#include "bitstream/stream/texture_header.hpp"
#include "encoder/encode_stream.hpp"

namespace tetrakis::inline api {

Status misuse(const std::string& sentence) {
  return {TKS_USAGE, sentence};
}

namespace {

/// Two hundred times what a reference system takes, and a header holds all of them.
Status checkTexts(const std::string& whose, std::initializer_list<const char*> texts) {
  constexpr size_t kMost = 65535;
  for (const char* text : texts) {
    if (text != nullptr && std::strlen(text) > kMost) {
      return misuse("A text about the " + whose + " takes " + std::to_string(std::strlen(text)) +
                    " bytes; each takes at most " + std::to_string(kMost) + ".");
    }
    if (text != nullptr && !isUtf8(text))
      return misuse("A text about the " + whose + " is not UTF-8.");
  }
  return {};
}

template <class T>
Status checkPlace(const std::string& whose, const T& raster) {
  if (raster.registration < TKS_REGISTRATION_UNKNOWN ||
      raster.registration > TKS_REGISTRATION_POINT)
    return misuse("The registration of the " + whose + " is unknown.");
  if (raster.domain < TKS_DOMAIN_PLANE || raster.domain > TKS_DOMAIN_FOREST)
    return misuse("The domain of the " + whose + " is unknown.");
  if (raster.positions != nullptr) {
    const auto* const first = reinterpret_cast<const char*>(raster.positions);
    if (!groundPositionsIn({first, raster.positions_size}))
      return misuse("The positions of the " + whose + " are none of tks_fit_positions.");
  }
  GeoTransform transform;
  std::copy_n(raster.geotransform, transform.size(), transform.begin());
  if (!raster.has_geotransform || isSound(transform)) return {};
  return misuse("The geotransform of the " + whose + " must be six numbers within +-2^512.");
}

/// Whether the samples that patches share are the same in each, of so many bytes each.
bool sharesSamples(const void* data, size_t bytes, const Forest& forest) {
  const size_t n = forest.side() - 1;
  const auto* const samples = static_cast<const std::byte*>(data);
  const auto at = [&](const Forest::Place& place) {
    const size_t row = place.patch * (n + 1) + static_cast<size_t>(place.y);
    return samples + (row * (n + 1) + static_cast<size_t>(place.x)) * bytes;
  };
  bool equal = true;
  forest.forEachShared(static_cast<int64_t>(n), [&](const auto& sample, const auto& owner) {
    equal = equal && std::memcmp(at(sample), at(owner), bytes) == 0;
  });
  return equal;
}

/// bytes: of a sample with all its channels.
template <class Raster>
Status checkForest(const std::string& whose, const Raster& raster, size_t bytes) {
  if (raster.domain != TKS_DOMAIN_FOREST) return {};
  const auto [depth, patches, sides] = raster.forest;
  const uint64_t side = (uint64_t{1} << std::min(depth, 32u)) + 1;
  if (depth < 1 || depth > Forest::kMostDepth || patches < 1 || sides == nullptr ||
      raster.width != side || raster.height != patches * side)
    return misuse("The " + whose + " is not the raster of its forest.");
  if (patches > Forest::kMostPatches)
    return misuse("A forest has at most " + std::to_string(Forest::kMostPatches) + " patches.");
  if (!Forest::isSound({sides, size_t{Forest::kSides} * patches}))
    return misuse("The sides of the forest are not glued in pairs.");
  if (!sharesSamples(raster.data, bytes, *forestOf(raster)))
    return misuse("The patches of the forest have different samples where they share one.");
  return {};
}

Status checkBaseMesh(const tks_heights& h) {
  static_assert(BaseMeshHeader::kMostDepth == TKS_MOST_OBJECT_DEPTH);
  const tks_base_mesh& mesh = h.base_mesh;
  if (mesh.position_bits == 0) return {};
  if (h.domain != TKS_DOMAIN_FOREST || h.forest.depth > TKS_MOST_OBJECT_DEPTH)
    return misuse("A base mesh has a forest of depth 1 to 8.");
  if (mesh.position_bits > BaseMeshHeader::kMostBits || mesh.corners == nullptr)
    return misuse("A base mesh has corners of 1 to 20 bits a coordinate.");
  const auto finite = [](double value) { return std::isfinite(value); };
  if (!(mesh.cell > 0) || !finite(mesh.cell) || !std::all_of(mesh.origin, mesh.origin + 3, finite))
    return misuse("The cell of a base mesh is above 0, and its origin finite.");
  const BaseMesh base = baseMeshOf(h);
  const std::vector<uint32_t> owners = cornerOwners(*base.forest);
  for (size_t corner = 0; corner < owners.size(); ++corner) {
    if (base.corners[corner] != base.corners[owners[corner]])
      return misuse("The quads of a base mesh have different corners where they share one.");
    const auto inside = [&](int32_t x) { return x >= 0 && x < 1 << mesh.position_bits; };
    if (!std::all_of(base.corners[corner].begin(), base.corners[corner].end(), inside))
      return misuse("A corner of the base mesh lies outside of its grid.");
  }
  return {};
}

Status checkHeights(const tks_heights& h) {
  if (h.data == nullptr) return misuse("The heights have no samples.");
  if (tks_sample_bytes(h.sample) == 0) return misuse("The heights have an unknown sample type.");
  if (h.width < 1 || h.height < 1 || h.width > kMaxSide || h.height > kMaxSide) {
    return misuse("Heights of " + std::to_string(h.width) + " x " + std::to_string(h.height) +
                  " samples: each side takes 1 to " + std::to_string(kMaxSide) + ".");
  }
  if (!std::isfinite(h.scale) || h.scale == 0 || !std::isfinite(h.offset)) {
    return misuse("The scale of the heights must be finite and not 0, the offset finite.");
  }
  if (!std::isfinite(h.step) || h.step < 0 || !(h.spacing_x >= 0) || !(h.spacing_y >= 0) ||
      !std::isfinite(h.spacing_x) || !std::isfinite(h.spacing_y)) {
    return misuse("Step and spacing of the heights must be finite and not negative.");
  }
  if (!(std::abs(h.first_latitude) <= 180) || !(std::abs(h.last_latitude) <= 180))
    return misuse("The latitudes of the heights must lie within +-180 degrees.");
  if (Status place = checkPlace("heights", h); !place.ok()) return place;
  const Status forest = checkForest("plane of heights", h, tks_sample_bytes(h.sample));
  if (!forest.ok()) return forest;
  if (Status base = checkBaseMesh(h); !base.ok()) return base;
  if (h.grid_width > kMaxSide || h.grid_height > kMaxSide ||
      (h.grid_width > 0) != (h.grid_height > 0) ||
      (h.grid_width > 0 && h.domain != TKS_DOMAIN_FOREST))
    return misuse("Only heights on a forest are made of a grid, of 1 to 1048576 columns and rows.");
  return checkTexts("heights", {h.unit, h.vertical_datum, h.crs, h.description, h.geo_keys});
}

Status checkImage(const tks_image& i) {
  if (i.data == nullptr) return misuse("The texture has no samples.");
  if (i.sample != TKS_U8 && i.sample != TKS_U16)
    return misuse("A texture has 8 or 16 bits a sample.");
  if (i.channels < 1 || i.channels > 4) return misuse("A texture has 1 to 4 channels.");
  const uint32_t most = i.domain == TKS_DOMAIN_FOREST ? kMaxSide : kMaxTextureSide;
  if (i.width < 1 || i.height < 1 || i.width > most || i.height > most) {
    return misuse("A texture of " + std::to_string(i.width) + " x " + std::to_string(i.height) +
                  " texels: each side takes 1 to " + std::to_string(most) + ".");
  }
  const uint32_t largest = largestTexel(i.sample);
  if (i.white_level > largest || (i.sample == TKS_U8 && i.white_level % largest != 0))
    return misuse("The white level of a texture is 255 of 8 bits, and 1 to 65535 of 16.");
  const Status forest = checkForest("texture", i, i.channels * tks_sample_bytes(i.sample));
  if (!forest.ok()) return forest;
  if (Status place = checkPlace("texture", i); !place.ok()) return place;
  return checkTexts("texture", {i.crs, i.geo_keys});
}

Status checkOptions(const tks_encode_options& o, bool has_heights) {
  const int targets = (o.bytes != 0) + (o.psnr != 0) + (o.max_error != 0) + (o.lossless != 0);
  if (targets != 1) return misuse("Give exactly one of bytes, psnr, max-error and lossless.");
  if (!std::isfinite(o.psnr) || o.psnr < 0 || !std::isfinite(o.max_error) || o.max_error < 0) {
    return misuse("The quality target must be a positive and finite number.");
  }
  if (o.max_error > 0 && !has_heights) return misuse("A maximum error needs heights.");
  const bool any_region = o.regions <= 1;
  if (!any_region && (!std::has_single_bit(o.regions) || o.regions < 1u << kLeastRegionLog2 ||
                      o.regions > 1u << kMostRegionLog2)) {
    return misuse("The side of regions must be a power of two from 16 to 1048576.");
  }
  if (o.weights != TKS_WEIGHTS_PSNR && o.weights != TKS_WEIGHTS_VISUAL)
    return misuse("The weights of the texture are unknown.");
  if (o.index < TKS_INDEX_NONE || o.index > TKS_INDEX_WINDOWS)
    return misuse("The kind of index is unknown.");
  if (o.camera_count > 0 && o.cameras == nullptr) return misuse("The cameras are missing.");
  return {};
}

/// Streams for windows hold all that there is: a texture beside heights within a largest error is
/// cut where it is as good as these.
Status checkWindows(const tks_encode_options& o, bool has_texture) {
  if (o.index != TKS_INDEX_WINDOWS) return {};
  if (o.regions == 1) return misuse("A stream that is laid out for windows needs regions.");
  if (o.lossless != 0 || (o.max_error > 0 && !has_texture)) return {};
  return misuse(
      "Only a lossless stream, or heights alone within a largest error, are laid out for windows: "
      "a shorter stream would lack whole regions.");
}

bool onForest(const auto* raster) {
  return raster != nullptr && raster->domain == TKS_DOMAIN_FOREST;
}

/// What cannot be had on a forest.
Status checkOnForests(const tks_heights* heights, const tks_image* image,
                      const tks_encode_options& o) {
  if (!onForest(heights) && !onForest(image)) return {};
  if (o.triangles > 0 || o.picture_error != nullptr)
    return misuse("On a forest there is no budget of triangles and no error of pictures.");
  if (o.camera_count > 0 && (heights == nullptr || heights->base_mesh.position_bits == 0))
    return misuse("Cameras look at a forest that has heights over a base mesh.");
  if (heights == nullptr || image == nullptr) return {};
  // An image of longitudes and latitudes may lie over a globe, which has no base mesh.
  if (!onForest(image) && heights->base_mesh.position_bits == 0) return {};
  const bool alike =
      onForest(heights) && onForest(image) && heights->forest.patches == image->forest.patches &&
      std::equal(heights->forest.sides, heights->forest.sides + 4 * size_t{heights->forest.patches},
                 image->forest.sides);
  if (alike) return {};
  return misuse("Heights and texture on a forest have patches that are glued alike.");
}

}  // namespace

Status checkedHeights(const tks_heights& given, tks_heights& out) {
  const Status status = takeSized("the heights", given, offsetof(tks_heights, step), out);
  return status.ok() ? checkHeights(out) : status;
}

namespace {

Status takeImage(const tks_image& given, tks_image& out) {
  const Status status = takeSized("the texture", given, offsetof(tks_image, geotransform), out);
  return status.ok() ? checkImage(out) : status;
}

}  // namespace

Status takeArguments(const tks_heights* heights, const tks_image* image,
                     const tks_encode_options* options, Arguments& out) {
  if (options == nullptr) return misuse("The encoding options are missing.");
  if (heights == nullptr && image == nullptr)
    return misuse("There is nothing to encode: give heights or a texture.");
  constexpr size_t kTargets = offsetof(tks_encode_options, threads);
  Status status = takeSized("the encoding options", *options, kTargets, out.options);
  if (status.ok()) status = checkOptions(out.options, heights != nullptr);
  if (status.ok()) status = checkWindows(out.options, image != nullptr);
  if (status.ok() && heights != nullptr) status = checkedHeights(*heights, out.heights);
  if (status.ok() && image != nullptr) status = takeImage(*image, out.image);
  if (status.ok())
    status = checkOnForests(heights != nullptr ? &out.heights : nullptr,
                            image != nullptr ? &out.image : nullptr, out.options);
  if (status.ok() && image != nullptr && out.image.white_level == 0)
    out.image.white_level = findWhiteLevel(out.image);
  return status;
}

namespace {

Status encodeAndProve(const tks_heights* heights, const tks_image* image,
                      const tks_encode_options* options, tks_buffer* out) {
  Arguments known;
  if (Status status = takeArguments(heights, image, options, known); !status.ok()) return status;
  const tks_heights* known_heights = heights != nullptr ? &known.heights : nullptr;
  const tks_image* known_image = image != nullptr ? &known.image : nullptr;
  ToldProgress watch([&](double done) {
    const tks_encode_options& o = known.options;
    return o.progress == nullptr || o.progress(o.user, done) == 0;
  });
  const Watched watched(&watch);
  PlanNotes notes;
  Result<std::vector<uint8_t>> stream =
      encodeStream({.heights = known_heights,
                    .image = known_image,
                    .options = known.options,
                    .notes = known.options.explain != nullptr ? &notes : nullptr});
  if (!stream.ok()) return stream.status();
  watch.stage(1);
  Status proved = prove(
      *stream,
      {{known_heights, heights != nullptr ? 1u : 0u}, {known_image, image != nullptr ? 1u : 0u}},
      known.options);
  if (!proved.ok()) return proved;
  watch.stage(1);
  if (known.options.explain != nullptr)
    explain(notes, heights != nullptr ? known.heights.scale : 1, known.options);
  giveBytes(*stream, *out);
  return {};
}

}  // namespace

}  // namespace tetrakis::inline api

tks_status tks_encode(const tks_heights* heights, const tks_image* image,
                      const tks_encode_options* options, tks_buffer* out, char* message,
                      size_t message_size) {
  if (out != nullptr) *out = {nullptr, 0};
  return tetrakis::reporting(message, message_size, [&]() -> tetrakis::Status {
    if (out == nullptr) return tetrakis::outputMissing();
    try {
      return tetrakis::encodeAndProve(heights, image, options, out);
    } catch (const tetrakis::Stopped&) {
      return tetrakis::misuse("Encoding was stopped by the caller.");
    }
  });
}

uint32_t tks_find_white_level(const tks_image* image) {
  if (image == nullptr) return 0;
  uint32_t found = 0;
  tetrakis::answering([&] {
    tks_image known;
    tetrakis::Status taken = tetrakis::takeImage(*image, known);
    if (taken.ok()) found = tetrakis::findWhiteLevel(known);
    return taken;
  });
  return found;
}

tks_status tks_find_outliers(const tks_heights* heights, tks_outliers* out) {
  if (heights == nullptr || out == nullptr || out->size < sizeof *out ||
      out->size > tetrakis::kMostStructBytes)
    return TKS_USAGE;
  return tetrakis::answering([&] {
    tks_heights known;
    tetrakis::Status status = tetrakis::checkedHeights(*heights, known);
    if (status.ok()) tetrakis::giveSized(tetrakis::findOutliers(known), *out);
    return status;
  });
}
