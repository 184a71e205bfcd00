// SPDX-License-Identifier: Apache-2.0
// A tks_sequence_encoder keeps the frames of a group until it is whole, encodes it, and hands over
// its bytes.
#include <algorithm>
#include <cstddef>
#include <cstring>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "api/encode_arguments.hpp"
#include "api/encoded_stream.hpp"
#include "api/group_chain.hpp"
#include "api/group_writer.hpp"
#include "api/guarded.hpp"
#include "api/sequence.hpp"

namespace tetrakis::inline api {

/// A frame with its own samples and texts.
class KeptFrame {
 public:
  KeptFrame(const tks_heights* heights, const tks_image* image) {
    if (heights != nullptr) {
      const size_t samples = size_t{heights->width} * heights->height;
      keep(heights->data, samples * tks_sample_bytes(heights->sample), heights_);
    }
    if (image != nullptr) {
      const size_t texels = size_t{image->width} * image->height * image->channels;
      keep(image->data, texels * tks_sample_bytes(image->sample), texels_);
    }
  }
  const void* heights() const { return heights_.data(); }
  const void* texels() const { return texels_.data(); }

 private:
  static void keep(const void* data, size_t bytes, std::vector<std::byte>& to) {
    const auto* first = static_cast<const std::byte*>(data);
    to.assign(first, first + bytes);
  }
  std::vector<std::byte> heights_, texels_;
};

/// The texts and positions of the first frame, which outlive the caller's.
class KeptTexts {
 public:
  void take(FrameArguments& first) {
    for (tks_heights& h : first.heights) {
      for (const char** text : {&h.unit, &h.vertical_datum, &h.crs, &h.description, &h.geo_keys})
        keep(*text);
      keepPositions(h);
    }
    for (tks_image& i : first.images) {
      for (const char** text : {&i.crs, &i.geo_keys}) keep(*text);
      keepPositions(i);
    }
  }

 private:
  void keep(const char*& text) {
    if (text != nullptr) text = texts_.emplace_back(std::make_unique<std::string>(text))->c_str();
  }
  void keepPositions(auto& raster) {
    if (raster.positions == nullptr) return;
    const auto* first = reinterpret_cast<const char*>(raster.positions);
    texts_.push_back(std::make_unique<std::string>(first, raster.positions_size));
    raster.positions = reinterpret_cast<const uint8_t*>(texts_.back()->data());
  }
  std::vector<std::unique_ptr<std::string>> texts_;
};

/// A group before its head and index are written.
struct PendingGroup {
  std::vector<KeptFrame> frames;
  std::vector<int64_t> times;
};

}  // namespace tetrakis::inline api

struct tks_sequence_encoder {
  tks_encode_options options = {};
  uint32_t group = 0;
  uint64_t reference = 0;         ///< bytes a frame that later groups go on from; 0: none do
  uint32_t entry = 0;             ///< every how manyth group stands by itself
  tetrakis::FrameArguments like;  ///< the first frame of all, without samples; none so far: empty
  tetrakis::KeptTexts texts;
  tetrakis::PendingGroup pending;
  tetrakis::GroupWriter groups;
  std::shared_ptr<const tetrakis::GroupBefore> last;  ///< null: the next group stands by itself
  /// Of the last group of the sequence that it goes on behind; none: it begins one.
  std::optional<tetrakis::StreamHeader> behind;
  bool has_time = false;
  int64_t last_time = 0;
  std::vector<uint8_t> ready;
};

namespace tetrakis::inline api {

namespace {

constexpr uint32_t kUsualGroup = 16;
constexpr uint32_t kUsualEntry = 16;

/// What an encoder was before a call. It comes back unless the call is done: memory may end
/// anywhere in it.
class Before {
 public:
  explicit Before(tks_sequence_encoder& encoder)
      : encoder_(encoder),
        groups_(encoder.groups),
        last_(encoder.last),
        frames_(encoder.pending.frames.size()),
        ready_(encoder.ready.size()),
        first_(encoder.like.frames() == 0),
        has_time_(encoder.has_time),
        last_time_(encoder.last_time) {}
  Before(const Before&) = delete;
  Before& operator=(const Before&) = delete;
  ~Before() {
    if (done_) return;
    encoder_.groups = std::move(groups_);
    encoder_.last = std::move(last_);
    cut(encoder_.pending.frames, frames_);
    cut(encoder_.pending.times, frames_);
    encoder_.ready.resize(ready_);  // which is no more than there is
    encoder_.has_time = has_time_;
    encoder_.last_time = last_time_;
    if (!first_) return;
    encoder_.like = {};
    encoder_.texts = {};
  }

  Status done(Status status) {
    done_ = true;
    return status;
  }

 private:
  static void cut(auto& list, size_t count) {
    if (list.size() > count) list.erase(list.begin() + static_cast<ptrdiff_t>(count), list.end());
  }

  tks_sequence_encoder& encoder_;
  GroupWriter groups_;
  std::shared_ptr<const GroupBefore> last_;
  size_t frames_, ready_;
  bool first_, has_time_;
  int64_t last_time_;
  bool done_ = false;
};

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

/// The frames of the pending group from `first` on.
FrameArguments framesOf(const tks_sequence_encoder& encoder, size_t first, size_t count) {
  FrameArguments frames;
  frames.options = encoder.options;
  for (size_t t = first; t < first + count; ++t) {
    for (tks_heights heights : encoder.like.heights) {
      heights.data = encoder.pending.frames[t].heights();
      frames.heights.push_back(heights);
    }
    for (tks_image image : encoder.like.images) {
      image.data = encoder.pending.frames[t].texels();
      frames.images.push_back(image);
    }
  }
  return frames;
}

/// The stream of a group as far as the next one goes on from it.
std::shared_ptr<const GroupBefore> shownBy(std::span<const uint8_t> stream,
                                           const tks_sequence_encoder& encoder, size_t frames) {
  const uint64_t header = *headerBytes(stream);
  const uint64_t most =
      encoder.reference > stream.size() / frames ? stream.size() : encoder.reference * frames;
  auto shown = std::make_shared<GroupBefore>();
  shown->bytes = std::max(most, header);
  const tks_limits limits = unlimited();
  const References before = encoder.last ? referencesTo(*encoder.last) : References();
  const Result<OwnedDecoder> opened =
      openBehind(stream.first(static_cast<size_t>(shown->bytes)), &limits, before);
  if (!opened.ok()) throw std::bad_alloc();  // the stream has been proved
  tks_decoder& decoder = **opened;
  decoder.threads = encoder.options.threads;
  const auto last = [&](const auto& component, Component which, auto& kept) {
    // Components without frames were coded in ways that only a frame by itself has.
    if (!component || component->frames.none()) return std::shared_ptr<const FrameReference>();
    kept = component;
    kept->frames.before = {};
    return std::make_shared<const FrameReference>(lastFrame(decoder, which));
  };
  const StreamHeader& parsed = decoder.parsed.header;
  shown->last_heights = last(parsed.geometry, Component::kGeometry, shown->heights);
  shown->last_texture = last(parsed.texture, Component::kTexture, shown->texture);
  return shown;
}

/// Keeps what the next group goes on from. head: of the group.
void keepLast(tks_sequence_encoder& encoder, const GroupHead& head,
              std::span<const uint8_t> stream) {
  const bool ends = encoder.reference == 0 || head.back.depth + 1 >= encoder.entry;
  std::shared_ptr<const GroupBefore> last;
  if (!ends) last = shownBy(stream, encoder, head.frames());
  encoder.last = std::move(last);
}

/// Encodes some of the pending frames as a group.
Status encodeGroupOf(tks_sequence_encoder& encoder, size_t first, size_t count) {
  FrameArguments frames = framesOf(encoder, first, count);
  const std::span<const int64_t> times = std::span(encoder.pending.times).subspan(first, count);
  GroupHead head = encoder.groups.next(times, encoder.last != nullptr);
  if (frames.options.bytes > 0) {
    const uint64_t budget = frames.options.bytes * count;
    const uint64_t beside = encoder.groups.bytesBeside(head, std::min<uint64_t>(budget, 1u << 29));
    if (budget <= beside)
      return misuse("A budget of " + std::to_string(budget) + " bytes for a group is too small: " +
                    std::to_string(beside) + " take its head and index alone.");
    frames.options.bytes = budget - beside;
  }
  const Result<std::vector<uint8_t>> stream =
      encodeFrames(frames, {encoder.reference > 0, encoder.last.get()});
  if (!stream.ok()) return stream.status();
  if (referenceOf(readHeader(*stream)->header) == 0) head.back = {};
  encoder.groups.write(head, *stream, encoder.ready);
  keepLast(encoder, head, *stream);
  return {};
}

/// Encodes all pending frames: together, or each by itself where they cannot be.
Status encodePending(tks_sequence_encoder& encoder) {
  const size_t count = encoder.pending.frames.size();
  if (count == 0) return {};
  Status status = encodeGroupOf(encoder, 0, count);
  if (status.code() == TKS_UNSUPPORTED && count > 1) {
    status = {};
    for (size_t t = 0; t < count && status.ok(); ++t) status = encodeGroupOf(encoder, t, 1);
  }
  encoder.pending = {};
  return status;
}

/// Whether a frame is like those of the sequence that it follows.
Status checkLike(const StreamHeader& header, const FrameArguments& frame) {
  const auto likeHeights = [](const GeometryHeader& g, const tks_heights& h) {
    const Extent shown = g.shown();
    return shown.width == h.width && shown.height == h.height && g.sample == h.sample;
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
  return same ? Status() : misuse("The frame has another size or type than the sequence has.");
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
