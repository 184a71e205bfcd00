// SPDX-License-Identifier: Apache-2.0
// A tks_sequence_encoder takes frame by frame, perhaps behind a sequence that was written before,
// and hands over the bytes of the groups that are whole.
#include "api/sequence_encoder.hpp"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <utility>

#include "api/encoded_stream.hpp"
#include "api/guarded.hpp"
#include "api/same_ground.hpp"
#include "api/sequence.hpp"

namespace tetrakis::inline api {

namespace {

constexpr uint32_t kUsualGroup = 16;
constexpr uint32_t kUsualEntry = 16;

Status takeClock(const tks_clock& given, Clock& clock) {
  if (given.size == 0) return {};
  tks_clock known;
  if (Status status = takeSized("the clock", given, sizeof given.size, known); !status.ok())
    return status;
  if ((known.numerator == 0) != (known.denominator == 0))
    return misuse("A tick lasts numerator / denominator seconds: both are above 0, or none is.");
  clock = {known.numerator, known.denominator, known.epoch != nullptr ? known.epoch : "",
           known.calendar != nullptr ? known.calendar : ""};
  if (clock.epoch.size() > 255 || clock.calendar.size() > 255)
    return misuse("The epoch and the calendar of a sequence take at most 255 bytes each.");
  if (clock.none() && !(clock.epoch.empty() && clock.calendar.empty()))
    return misuse("A sequence with an epoch or a calendar has ticks of a known length.");
  return {};
}

Status open(const tks_sequence_options& given, tks_sequence_encoder& encoder) {
  tks_sequence_options known;
  const Status status =
      takeSized("the sequence options", given, offsetof(tks_sequence_options, clock), known);
  if (!status.ok()) return status;
  if (known.group > TKS_MOST_FRAMES) return misuse("A group has 1 to 32 frames.");
  if (known.encode == nullptr) return misuse("The encoding options are missing.");
  const Status options = takeSized("the encoding options", *known.encode,
                                   offsetof(tks_encode_options, threads), encoder.options);
  if (!options.ok()) return options;
  encoder.group = known.group > 0 ? known.group : kUsualGroup;
  if (known.entry > TKS_MOST_DEPTH + 1)
    return misuse("At least every 64th group of a sequence stands by itself.");
  encoder.reference = known.reference;
  encoder.entry = known.entry > 0 ? known.entry : kUsualEntry;
  Clock clock;
  Status taken = takeClock(known.clock, clock);
  encoder.groups = GroupWriter(std::move(clock), known.no_index == 0);
  return taken;
}

/// What the georeference of a sequence says of its heights, and of its texture.
tks_heights heightsOf(const StreamHeader& header) {
  const Placement& place = header.georeference.heights;
  tks_heights heights = {};
  heights.unit = header.metadata.unit.c_str();
  heights.vertical_datum = header.metadata.vertical_datum.c_str();
  heights.crs = header.metadata.crs.c_str();
  heights.has_geotransform = place.has_transform;
  std::copy(place.transform.begin(), place.transform.end(), heights.geotransform);
  return heights;
}
tks_image imageOf(const StreamHeader& header) {
  const Placement& place = header.georeference.texture;
  tks_image image = {};
  const bool shared = !header.georeference.hasTextureCrs();
  image.crs = shared ? header.metadata.crs.c_str() : header.georeference.texture_crs.c_str();
  image.has_geotransform = place.has_transform;
  std::copy(place.transform.begin(), place.transform.end(), image.geotransform);
  return image;
}

/// Whether a frame is like those of the sequence that it follows.
Status checkLike(const StreamHeader& header, const FrameArguments& frame) {
  const Metadata& meaning = header.metadata;
  const auto likeHeights = [&](const GeometryHeader& g, const tks_heights& h) {
    const Extent shown = g.shown();
    return shown.width == h.width && shown.height == h.height && g.sample == h.sample &&
           meaning.scale == h.scale && meaning.offset == h.offset;
  };
  const auto likeImage = [](const TextureHeader& t, const tks_image& i) {
    const Extent shown = t.shown();
    return shown.width == i.width && shown.height == i.height && t.sample == i.sample &&
           t.channels == i.channels;
  };
  const bool same =
      header.geometry.has_value() == !frame.heights.empty() &&
      header.texture.has_value() == !frame.images.empty() &&
      (frame.heights.empty() || likeHeights(*header.geometry, frame.heights.back())) &&
      (frame.images.empty() || likeImage(*header.texture, frame.images.back()));
  if (!same) return misuse("The frame has another size, type or scale than the sequence has.");
  const bool same_ground =
      (frame.heights.empty() || sameGround(frame.heights.back(), heightsOf(header))) &&
      (frame.images.empty() || sameGround(frame.images.back(), imageOf(header)));
  if (same_ground) return {};
  return misuse("The frame has another place, reference system or unit than the sequence has.");
}

Status goOnBehind(tks_sequence_encoder& encoder, const tks_sequence& written) {
  if (encoder.has_time) return misuse("The encoder has taken frames already.");
  if (Status status = checkGapless(written); !status.ok()) return status;
  if (written.groups.empty() || written.whole_bytes < written.bytes || !written.begun.empty())
    return misuse("The sequence ends inside a group: keep its whole groups alone.");
  if (!(written.clock == encoder.groups.clock()))
    return misuse("The sequence has another clock than the encoder.");
  const KeptGroup& last = written.groups.back();
  Result<ParsedHeader> header = readHeader(last.stream);
  if (!header.ok()) return header.status();
  GroupWriter groups(written.clock, written.groups.front().parsed.head.index_bytes > 0);
  for (const KeptGroup& group : written.groups) groups.pass(group.parsed);
  encoder.groups = std::move(groups);
  encoder.behind = std::move(header->header);
  encoder.has_time = true;
  encoder.last_time = last.parsed.head.times.back();
  return {};
}

Status push(tks_sequence_encoder& encoder, const tks_heights* heights, const tks_image* image,
            int64_t time) {
  if (time < -kMostTime || time > kMostTime) return misuse("A time lies within +-2^61 ticks.");
  if (encoder.has_time && time <= encoder.last_time)
    return misuse("A frame at tick " + std::to_string(time) +
                  " is not later than the one before, " + std::to_string(encoder.last_time) + ".");
  FrameArguments taken = encoder.like;
  Status status = takeFrame(heights, image, encoder.options, taken);
  if (status.ok() && encoder.behind) status = checkLike(*encoder.behind, taken);
  if (!status.ok()) return status;
  Before before(encoder);
  if (encoder.like.frames() == 0) {
    encoder.like = taken;
    encoder.texts.take(encoder.like);
    encoder.options = taken.options;
  }
  const bool has_heights = !taken.heights.empty(), has_image = !taken.images.empty();
  encoder.pending.frames.emplace_back(has_heights ? &taken.heights.back() : nullptr,
                                      has_image ? &taken.images.back() : nullptr);
  encoder.pending.times.push_back(time);
  encoder.has_time = true;
  encoder.last_time = time;
  const bool whole = encoder.pending.frames.size() >= encoder.group;
  return before.done(whole ? encodePending(encoder) : Status());
}

Status flush(tks_sequence_encoder& encoder) {
  Before before(encoder);
  return before.done(encodePending(encoder));
}

}  // namespace

}  // namespace tetrakis::inline api

tks_status tks_sequence_encoder_open(const tks_sequence_options* options,
                                     tks_sequence_encoder** out, char* message,
                                     size_t message_size) {
  if (out != nullptr) *out = nullptr;
  return tetrakis::reporting(message, message_size, [&]() -> tetrakis::Status {
    if (out == nullptr) return tetrakis::outputMissing();
    if (options == nullptr) return tetrakis::misuse("The sequence options are missing.");
    auto encoder = std::make_unique<tks_sequence_encoder>();
    tetrakis::Status status = tetrakis::open(*options, *encoder);
    if (status.ok()) *out = encoder.release();
    return status;
  });
}

void tks_sequence_encoder_close(tks_sequence_encoder* encoder) {
  delete encoder;
}

tks_status tks_sequence_encoder_continue(tks_sequence_encoder* encoder, const tks_sequence* written,
                                         char* message, size_t message_size) {
  if (encoder == nullptr || written == nullptr) return TKS_USAGE;
  return tetrakis::reporting(message, message_size,
                             [&] { return tetrakis::goOnBehind(*encoder, *written); });
}

tks_status tks_sequence_push(tks_sequence_encoder* encoder, const tks_heights* heights,
                             const tks_image* image, int64_t time, char* message,
                             size_t message_size) {
  if (encoder == nullptr) return TKS_USAGE;
  return tetrakis::reporting(message, message_size,
                             [&] { return tetrakis::push(*encoder, heights, image, time); });
}

tks_status tks_sequence_flush(tks_sequence_encoder* encoder, char* message, size_t message_size) {
  if (encoder == nullptr) return TKS_USAGE;
  return tetrakis::reporting(message, message_size, [&] { return tetrakis::flush(*encoder); });
}

tks_status tks_sequence_take(tks_sequence_encoder* encoder, tks_buffer* out) {
  if (out != nullptr) *out = {nullptr, 0};
  if (encoder == nullptr || out == nullptr) return TKS_USAGE;
  return tetrakis::answering([&]() -> tetrakis::Status {
    if (encoder->ready.empty()) return {};
    tetrakis::giveBytes(encoder->ready, *out);
    encoder->ready = {};
    return {};
  });
}
