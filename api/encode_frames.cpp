// SPDX-License-Identifier: Apache-2.0
// tks_encode_frames() encodes the frames of a group into one stream.
#include <cstring>
#include <utility>

#include "api/encode_arguments.hpp"
#include "api/encoded_stream.hpp"
#include "api/guarded.hpp"
#include "api/same_ground.hpp"
#include "base/watch.hpp"
#include "encoder/encode_stream.hpp"
#include "encoder/groups/encode_group.hpp"

namespace tetrakis::inline api {

namespace {

/// The parts of the work that are done when the stream is made.
constexpr double kEncoded = 0.9;

bool alike(const tks_heights& a, const tks_heights& b) {
  const bool nodata = a.has_nodata == b.has_nodata &&
                      (a.has_nodata == 0 || std::memcmp(&a.nodata, &b.nodata, 8) == 0);
  return a.width == b.width && a.height == b.height && a.sample == b.sample &&
         a.domain == b.domain && a.scale == b.scale && a.offset == b.offset && a.step == b.step &&
         nodata;
}

bool alike(const tks_image& a, const tks_image& b) {
  return a.width == b.width && a.height == b.height && a.channels == b.channels &&
         a.sample == b.sample && a.domain == b.domain && a.opaque == b.opaque;
}

Status checkFrame(const tks_heights* heights, const tks_image* image,
                  const FrameArguments& before) {
  if ((heights != nullptr && heights->domain == TKS_DOMAIN_FOREST) ||
      (image != nullptr && image->domain == TKS_DOMAIN_FOREST))
    return misuse("Frames do not lie on a forest.");
  if (before.frames() == 0) return {};
  const bool same_parts =
      (heights == nullptr) == before.heights.empty() && (image == nullptr) == before.images.empty();
  const bool same = same_parts && (heights == nullptr || alike(*heights, before.heights.front())) &&
                    (image == nullptr || alike(*image, before.images.front()));
  if (!same)
    return misuse("The frame has another size, type, scale or nodata value than the first one.");
  const bool same_ground = (heights == nullptr || sameGround(*heights, before.heights.front())) &&
                           (image == nullptr || sameGround(*image, before.images.front()));
  if (same_ground) return {};
  return misuse("The frame has another place, reference system or unit than the first one.");
}

Result<std::vector<uint8_t>> encode(const FrameArguments& frames, const GroupCoding& coding) {
  if (frames.frames() > 1 || coding.refers) {
    Result<std::vector<uint8_t>> group =
        encodeGroup({frames.heights, frames.images, frames.options, coding.before});
    if (frames.frames() > 1 || group.status().code() != TKS_UNSUPPORTED) return group;
  }
  return encodeStream({.heights = frames.heights.empty() ? nullptr : frames.heights.data(),
                       .image = frames.images.empty() ? nullptr : frames.images.data(),
                       .options = frames.options});
}

}  // namespace

Status takeFrame(const tks_heights* heights, const tks_image* image,
                 const tks_encode_options& options, FrameArguments& out) {
  Arguments known;
  if (Status status = takeArguments(heights, image, &options, known); !status.ok()) return status;
  const tks_heights* const known_heights = heights != nullptr ? &known.heights : nullptr;
  const tks_image* const known_image = image != nullptr ? &known.image : nullptr;
  if (Status status = checkFrame(known_heights, known_image, out); !status.ok()) return status;
  if (out.frames() == 0) {
    out.options = known.options;
    out.options.explain = nullptr;
  }
  if (heights != nullptr) out.heights.push_back(known.heights);
  if (image != nullptr) out.images.push_back(known.image);
  // White is what it is in the first frame.
  if (image != nullptr) out.images.back().white_level = out.images.front().white_level;
  return {};
}

Result<std::vector<uint8_t>> encodeFrames(const FrameArguments& frames, const GroupCoding& coding) {
  ToldProgress watch([&](double done) {
    const tks_encode_options& o = frames.options;
    return o.progress == nullptr || o.progress(o.user, done) == 0;
  });
  const Watched watched(&watch);
  try {
    watch.stage(kEncoded);
    Result<std::vector<uint8_t>> stream = encode(frames, coding);
    if (!stream.ok()) return stream;
    watch.stage(1);
    References references;
    if (coding.before != nullptr) references = referencesTo(*coding.before);
    Status proved =
        prove(*stream, {frames.heights, frames.images, std::move(references)}, frames.options);
    if (!proved.ok()) return proved;
    watch.stage(1);
    return stream;
  } catch (const Stopped&) {
    return misuse("Encoding was stopped by the caller.");
  }
}

namespace {

/// Frame t of an array of structs, each as long as the first one's size says.
template <class T>
const T* frameAt(const T* first, uint32_t t) {
  if (first == nullptr) return nullptr;
  return reinterpret_cast<const T*>(reinterpret_cast<const std::byte*>(first) + t * first->size);
}

}  // namespace

}  // namespace tetrakis::inline api

tks_status tks_encode_frames(const tks_heights* heights, const tks_image* images, uint32_t count,
                             const tks_encode_options* options, tks_buffer* out, char* message,
                             size_t message_size) {
  if (out != nullptr) *out = {nullptr, 0};
  return tetrakis::reporting(message, message_size, [&]() -> tetrakis::Status {
    if (out == nullptr) return tetrakis::outputMissing();
    if (options == nullptr) return tetrakis::misuse("The encoding options are missing.");
    if (count < 2 || count > TKS_MOST_FRAMES)
      return tetrakis::misuse("A stream has 2 to 32 frames.");
    tetrakis::FrameArguments frames;
    for (uint32_t t = 0; t < count; ++t) {
      tetrakis::Status status = tetrakis::takeFrame(tetrakis::frameAt(heights, t),
                                                    tetrakis::frameAt(images, t), *options, frames);
      if (!status.ok()) return status;
    }
    const auto stream = tetrakis::encodeFrames(frames);
    if (!stream.ok()) return stream.status();
    tetrakis::giveBytes(*stream, *out);
    return {};
  });
}
