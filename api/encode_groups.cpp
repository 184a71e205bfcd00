// SPDX-License-Identifier: Apache-2.0
// The group that a tks_sequence_encoder has collected becomes a stream, which goes on from what a
// part of the stream before shows where the options say so.
#include <algorithm>
#include <new>
#include <span>
#include <string>
#include <utility>

#include "api/encoded_stream.hpp"
#include "api/group_chain.hpp"
#include "api/sequence_encoder.hpp"

namespace tetrakis::inline api {

namespace {

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

/// Whether the next group may go on from the one that is coded now.
bool refers(const tks_sequence_encoder& encoder) {
  return encoder.reference > 0 && encoder.going_on.isTried();
}

/// Keeps what the next group goes on from. head: of the group.
void keepLast(tks_sequence_encoder& encoder, const GroupHead& head,
              std::span<const uint8_t> stream) {
  const bool ends = !refers(encoder) || head.back.depth + 1 >= encoder.entry;
  std::shared_ptr<const GroupBefore> last;
  if (!ends) last = shownBy(stream, encoder, head.frames());
  encoder.going_on.tell(encoder.last != nullptr, !head.back.none(), encoder.entry);
  encoder.last = std::move(last);
}

/// Some of the pending frames as a group that is not written yet.
struct EncodedGroup {
  GroupHead head;
  std::vector<uint8_t> stream;
};

/// frames: of the pending ones, from `first` on.
Result<EncodedGroup> encodeGroupOf(tks_sequence_encoder& encoder, size_t first, size_t count) {
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
  Result<std::vector<uint8_t>> stream = encodeFrames(frames, {refers(encoder), encoder.last.get()});
  if (!stream.ok()) return stream.status();
  if (referenceOf(readHeader(*stream)->header) == 0) head.back = {};
  return EncodedGroup{std::move(head), *std::move(stream)};
}

void write(tks_sequence_encoder& encoder, const EncodedGroup& group) {
  encoder.groups.write(group.head, group.stream, encoder.ready);
  keepLast(encoder, group.head, group.stream);
}

/// Writes each pending frame as a group of its own.
Status encodeEach(tks_sequence_encoder& encoder) {
  for (size_t t = 0; t < encoder.pending.frames.size(); ++t) {
    const Result<EncodedGroup> group = encodeGroupOf(encoder, t, 1);
    if (!group.ok()) return group.status();
    write(encoder, *group);
  }
  return {};
}

/// Whether frames that all have to come back take fewer bytes each by itself than together:
/// drawings, few values and corrections are coded in ways that only a stream of one frame has. The
/// search ends as soon as the frames so far, as a sample of all, say that it does not pay: in most
/// groups it takes the time of one frame.
bool eachIsShorter(tks_sequence_encoder& encoder, const EncodedGroup& all) {
  const auto bytes_of = [&](const EncodedGroup& group) {
    return encoder.groups.bytesBeside(group.head, group.stream.size()) + group.stream.size();
  };
  const uint64_t together = bytes_of(all);
  const tks_encode_options& options = encoder.options;
  const size_t count = encoder.pending.frames.size();
  constexpr size_t kLeast = 4;  // of fewer frames there is little to gain
  if (count < kLeast || refers(encoder) || (options.lossless == 0 && options.max_error == 0))
    return false;
  uint64_t each = 0;
  for (size_t t = 0; t < count; ++t) {
    const Result<EncodedGroup> frame = encodeGroupOf(encoder, t, 1);
    if (!frame.ok()) return false;
    each += bytes_of(*frame);
    if (each * count >= together * (t + 1)) return false;  // these stand for the others
  }
  return true;
}

}  // namespace

Status encodePending(tks_sequence_encoder& encoder) {
  const size_t count = encoder.pending.frames.size();
  if (count == 0) return {};
  const Result<EncodedGroup> group = encodeGroupOf(encoder, 0, count);
  const bool apart = group.status().code() == TKS_UNSUPPORTED && count > 1;
  Status status = group.status();
  if (apart || (group.ok() && eachIsShorter(encoder, *group))) {
    status = encodeEach(encoder);
  } else if (group.ok()) {
    write(encoder, *group);
  }
  encoder.pending = {};
  return status;
}

}  // namespace tetrakis::inline api
