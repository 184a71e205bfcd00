// SPDX-License-Identifier: Apache-2.0
// A tks_sequence passes from group to group as their bytes come, and opens the stream of a group
// once a frame of it is asked for.
#include <algorithm>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "api/guarded.hpp"
#include "api/sequence.hpp"
#include "bitstream/sequence/group_index.hpp"

namespace tetrakis::inline api {

namespace {

Status noFrame(uint64_t frame) {
  return {TKS_USAGE, "The sequence has no frame " + std::to_string(frame) + "."};
}

void closeDecoder(tks_sequence& sequence) {
  sequence.decoder.reset();
  sequence.opened = nullptr;
}

/// Whether a group may follow what is there.
Status checkNext(const tks_sequence& sequence, const GroupHead& head) {
  if (sequence.groups.empty()) return {};
  const GroupHead& before = sequence.groups.back().parsed.head;
  const bool follows = head.number > before.number &&
                       head.first_frame >= sequence.groups.back().endFrame() &&
                       head.times.front() > before.times.back() && head.clock == before.clock;
  // Behind a gap nobody knows what a group goes on from.
  const bool goes_on =
      head.back.none() || head.number > before.number + 1 ||
      (head.back.depth == before.back.depth + 1 &&
       head.back.bytes == before.back.bytes + sequence.groups.back().parsed.groupEnd());
  if (follows && goes_on) return {};
  return {TKS_CORRUPT, "Corrupt sequence: group " + std::to_string(head.number) +
                           " does not follow the one before it."};
}

/// Takes bytes of the last group, which is not whole, and returns how many.
size_t grow(tks_sequence& sequence, std::span<const uint8_t> bytes) {
  KeptGroup& group = sequence.groups.back();
  const ParsedHead& parsed = group.parsed;
  const auto taken =
      static_cast<size_t>(std::min<uint64_t>(bytes.size(), parsed.groupEnd() - group.available));
  const uint64_t left = parsed.streamEnd() - std::min(group.available, parsed.streamEnd());
  const auto of_stream = static_cast<size_t>(std::min<uint64_t>(taken, left));
  if (of_stream > 0 && sequence.opened == &group) closeDecoder(sequence);
  group.stream.insert(group.stream.end(), bytes.begin(),
                      bytes.begin() + static_cast<ptrdiff_t>(of_stream));
  group.available += taken;
  sequence.bytes += taken;
  if (group.whole()) sequence.whole_bytes = sequence.bytes;
  return taken;
}

/// Takes bytes of a head, and returns how many; begins the group once it is whole.
Result<size_t> begin(tks_sequence& sequence, std::span<const uint8_t> bytes) {
  std::vector<uint8_t>& begun = sequence.begun;
  const Result<uint64_t> needed = headBytes(begun);
  if (!needed.ok()) return needed.status();
  const auto taken = static_cast<size_t>(std::min<uint64_t>(bytes.size(), *needed - begun.size()));
  begun.insert(begun.end(), bytes.begin(), bytes.begin() + static_cast<ptrdiff_t>(taken));
  sequence.bytes += taken;
  const Result<uint64_t> now = headBytes(begun);
  if (!now.ok()) return now.status();
  if (*now > begun.size()) return taken;
  Result<ParsedHead> parsed = readHead(begun);
  if (!parsed.ok()) return parsed.status();
  if (Status status = checkNext(sequence, parsed->head); !status.ok()) return status;
  if (sequence.groups.empty()) sequence.clock = parsed->head.clock;
  sequence.groups.push_back({*std::move(parsed), sequence.bytes - begun.size(), begun.size(), {}});
  begun.clear();
  return taken;
}

/// The state of a sequence before it was given bytes. It comes back unless the bytes are taken, or
/// refused: memory may end anywhere.
class BeforeBytes {
 public:
  explicit BeforeBytes(tks_sequence& sequence)
      : sequence_(sequence),
        begun_(sequence.begun),
        groups_(sequence.groups.size()),
        bytes_(sequence.bytes),
        whole_bytes_(sequence.whole_bytes) {
    if (groups_ == 0) return;
    available_ = sequence.groups.back().available;
    of_stream_ = sequence.groups.back().stream.size();
  }
  BeforeBytes(const BeforeBytes&) = delete;
  BeforeBytes& operator=(const BeforeBytes&) = delete;
  ~BeforeBytes() {
    if (done_) return;
    while (sequence_.groups.size() > groups_) sequence_.groups.pop_back();
    if (groups_ > 0) {
      sequence_.groups.back().available = available_;
      sequence_.groups.back().stream.resize(of_stream_);  // which is no more than there is
    } else {
      sequence_.clock = {};
    }
    sequence_.begun = std::move(begun_);
    sequence_.bytes = bytes_;
    sequence_.whole_bytes = whole_bytes_;
  }

  void done() { done_ = true; }

 private:
  tks_sequence& sequence_;
  std::vector<uint8_t> begun_;
  size_t groups_;
  uint64_t bytes_, whole_bytes_;
  uint64_t available_ = 0;  ///< of the last group
  size_t of_stream_ = 0;
  bool done_ = false;
};

Status append(tks_sequence& sequence, std::span<const uint8_t> bytes) {
  if (!sequence.refused.ok()) return sequence.refused;
  BeforeBytes before(sequence);
  while (!bytes.empty()) {
    if (!sequence.groups.empty() && !sequence.groups.back().whole()) {
      bytes = bytes.subspan(grow(sequence, bytes));
      continue;
    }
    const Result<size_t> taken = begin(sequence, bytes);
    if (!taken.ok()) {
      before.done();
      return sequence.refused = taken.status();
    }
    bytes = bytes.subspan(*taken);
  }
  before.done();
  return {};
}

}  // namespace

size_t decodingGroups(const tks_sequence& sequence) {
  const size_t count = sequence.groups.size();
  return count > 0 && !sequence.groups.back().decodes() ? count - 1 : count;
}

const KeptGroup* groupOf(const tks_sequence& sequence, uint64_t frame) {
  const auto end = sequence.groups.begin() + static_cast<ptrdiff_t>(decodingGroups(sequence));
  const auto after = std::upper_bound(
      sequence.groups.begin(), end, frame,
      [](uint64_t f, const KeptGroup& group) { return f < group.parsed.head.first_frame; });
  if (after == sequence.groups.begin()) return nullptr;
  const KeptGroup& group = *(after - 1);
  return frame < group.endFrame() ? &group : nullptr;
}

namespace {

/// The place of a group among those that are there.
size_t placeOf(const tks_sequence& sequence, const KeptGroup& group) {
  const auto at = std::lower_bound(
      sequence.groups.begin(), sequence.groups.end(), group.parsed.head.number,
      [](const KeptGroup& g, uint64_t number) { return g.parsed.head.number < number; });
  return static_cast<size_t>(at - sequence.groups.begin());
}

/// Makes the chain that of the group at a place. Streams of it that the chain has already stay.
Status makeChain(tks_sequence& sequence, size_t place) {
  const GroupHead& head = sequence.groups[place].parsed.head;
  const auto depth = static_cast<size_t>(head.back.depth);
  const auto numberAt = [&](size_t p) { return sequence.groups[p].parsed.head.number; };
  if (depth > place || numberAt(place - depth) != head.number - depth)
    return {TKS_TRUNCATED, "Group " + std::to_string(head.number) +
                               " of the sequence goes on from group " +
                               std::to_string(head.number - depth) + ", which is not there."};
  GroupChain& chain = sequence.chain;
  const bool goes_on = chain.length() > 0 && chain.length() < depth + 1 &&
                       sequence.chained + 1 + depth - chain.length() == head.number;
  if (!goes_on) chain = GroupChain(sequence.has_limits ? &sequence.limits : nullptr);
  for (size_t p = place - depth + chain.length(); p < place; ++p) {
    const Result<ParsedHeader> next = readHeader(sequence.groups[p + 1].stream);
    if (!next.ok()) return next.status();
    if (Status status = chain.add(sequence.groups[p].stream, next->header); !status.ok())
      return status;
    sequence.chained = numberAt(p);
  }
  return {};
}

Status openGroup(tks_sequence& sequence, const KeptGroup& group) {
  closeDecoder(sequence);
  if (Status status = makeChain(sequence, placeOf(sequence, group)); !status.ok()) return status;
  Result<OwnedDecoder> opened = openBehind(
      group.stream, sequence.has_limits ? &sequence.limits : nullptr, sequence.chain.references());
  if (!opened.ok()) return opened.status();
  const StreamHeader& header = (*opened)->parsed.header;
  if (framesOf(header) != group.parsed.head.frames())
    return {TKS_CORRUPT,
            "Corrupt sequence: a group has another number of frames than its head says."};
  if (group.parsed.head.back.none() != (referenceOf(header) == 0)) return misledDepth();
  sequence.decoder = *std::move(opened);
  sequence.opened = &group;
  return {};
}

Status open(tks_sequence& sequence, uint64_t frame) {
  const KeptGroup* const group = groupOf(sequence, frame);
  if (group == nullptr) return noFrame(frame);
  if (sequence.opened != group)
    if (Status status = openGroup(sequence, *group); !status.ok()) return status;
  const auto at = static_cast<uint32_t>(frame - group->parsed.head.first_frame);
  const tks_status status = tks_set_frame(sequence.decoder.get(), at);
  return status == TKS_OK ? Status() : Status(status, tks_message(sequence.decoder.get()));
}

Status forgetBefore(tks_sequence& sequence, uint64_t frame) {
  std::deque<KeptGroup>& groups = sequence.groups;
  size_t first = 0;  // that is kept, with those that it goes on from
  while (first + 1 < groups.size() && groups[first].endFrame() <= frame) ++first;
  if (groups.empty()) return {};
  first -= static_cast<size_t>(std::min<uint64_t>(first, groups[first].parsed.head.back.depth));
  if (first == 0) return {};
  // The opened group stays open if all that it goes on from stays.
  const KeptGroup* const opened = sequence.opened;
  if (opened != nullptr && placeOf(sequence, *opened) < first + opened->parsed.head.back.depth)
    closeDecoder(sequence);
  if (sequence.opened == nullptr) sequence.chain.clear();
  groups.erase(groups.begin(), groups.begin() + static_cast<ptrdiff_t>(first));
  return {};
}

int64_t timeOf(const KeptGroup& group, uint64_t frame) {
  return group.parsed.head.times[frame - group.parsed.head.first_frame];
}

/// The last frame that is not after the time; the first one if all are.
uint64_t frameAt(const tks_sequence& sequence, int64_t time) {
  const auto end = sequence.groups.begin() + static_cast<ptrdiff_t>(decodingGroups(sequence));
  auto after = std::upper_bound(
      sequence.groups.begin(), end, time,
      [](int64_t t, const KeptGroup& group) { return t < group.parsed.head.times.front(); });
  if (after == sequence.groups.begin()) ++after;
  const GroupHead& head = (after - 1)->parsed.head;
  const auto behind = std::upper_bound(head.times.begin() + 1, head.times.end(), time);
  return head.first_frame + static_cast<uint64_t>(behind - head.times.begin()) - 1;
}

}  // namespace

tks_sequence_info infoOf(const tks_sequence& sequence) {
  tks_sequence_info info = {};
  info.groups = decodingGroups(sequence);
  if (info.groups > 0) {
    info.first_frame = sequence.groups.front().parsed.head.first_frame;
    info.end_frame = sequence.groups[info.groups - 1].endFrame();
  }
  info.bytes = sequence.bytes;
  info.whole_bytes = sequence.whole_bytes;
  const Clock& clock = sequence.clock;
  info.clock = {sizeof info.clock, clock.numerator, clock.denominator, clock.epoch.c_str(),
                clock.calendar.c_str()};
  return info;
}

namespace {

/// The end of a file that may have been cut: up to the last index in it.
std::optional<ReadIndex> lastIndex(std::span<const uint8_t>& tail) {
  for (; tail.size() >= kIndexEnd; tail = tail.first(tail.size() - 1))
    if (std::optional<ReadIndex> index = readIndex(tail)) return index;
  return std::nullopt;
}

bool reaches(const GroupSpan& span, uint64_t first_frame, bool by_time, int64_t place) {
  return by_time ? span.first_time <= place
                 : place >= 0 && first_frame <= static_cast<uint64_t>(place);
}

Status locate(std::span<const uint8_t> tail, uint64_t end, bool by_time, int64_t place,
              tks_range& range, int& found) {
  const size_t given = tail.size();
  const std::optional<ReadIndex> index = lastIndex(tail);
  if (!index) return {TKS_USAGE, "No group with an index ends in these bytes."};
  uint64_t begin = end - (given - tail.size());
  uint64_t first_frame = index->first_frame;
  const auto step = [&](const GroupSpan& span) {
    if (span.bytes > begin) return false;
    begin -= span.bytes;
    return true;
  };
  const Status wrong(TKS_CORRUPT, "Corrupt sequence: an index lists more than there is.");
  if (!step(index->own)) return wrong;
  range = {begin, index->own.bytes, 0};
  found = 1;
  if (reaches(index->own, first_frame, by_time, place)) return {};
  for (const GroupSpan& span : index->before) {
    if (!step(span) || span.frames > first_frame || span.index_bytes > span.bytes) return wrong;
    first_frame -= span.frames;
    found = span.groups == 1;
    range = found ? tks_range{begin, span.bytes, 0}
                  : tks_range{begin + span.bytes - span.index_bytes, span.index_bytes, 0};
    if (range.size == 0) return {TKS_USAGE, "A group that leads to others has no index."};
    if (reaches(span, first_frame, by_time, place)) break;
  }
  return {};
}

}  // namespace

}  // namespace tetrakis::inline api

tks_status tks_sequence_open(const tks_limits* limits, tks_sequence** out) {
  if (out == nullptr) return TKS_USAGE;
  *out = nullptr;
  return tetrakis::answering([&]() -> tetrakis::Status {
    auto sequence = std::make_unique<tks_sequence>();
    if (limits != nullptr) {
      const tetrakis::Status status =
          tetrakis::takeSized("the limits", *limits, sizeof limits->size, sequence->limits);
      if (!status.ok()) return status;
      sequence->has_limits = true;
    }
    *out = sequence.release();
    return {};
  });
}

void tks_sequence_close(tks_sequence* sequence) {
  delete sequence;
}

const char* tks_sequence_message(const tks_sequence* sequence) {
  return sequence != nullptr ? sequence->sentence : "";
}

tks_status tks_sequence_append(tks_sequence* sequence, const uint8_t* data, size_t size) {
  if (data == nullptr && size != 0) return TKS_USAGE;
  return tetrakis::keepingSentence(sequence, [&] {
    return tetrakis::append(*sequence, {data, size});
  });
}

tks_status tks_sequence_forget(tks_sequence* sequence, uint64_t frame) {
  return tetrakis::keepingSentence(sequence,
                                   [&] { return tetrakis::forgetBefore(*sequence, frame); });
}

tks_status tks_sequence_get_info(const tks_sequence* sequence, tks_sequence_info* info) {
  if (sequence == nullptr || info == nullptr || info->size < sizeof info->size ||
      info->size > tetrakis::kMostStructBytes)
    return TKS_USAGE;
  return tetrakis::answering([&]() -> tetrakis::Status {
    tetrakis::giveSized(tetrakis::infoOf(*sequence), *info);
    return {};
  });
}

tks_status tks_sequence_time(const tks_sequence* sequence, uint64_t frame, int64_t* time) {
  if (sequence == nullptr || time == nullptr) return TKS_USAGE;
  return tetrakis::answering([&]() -> tetrakis::Status {
    const tetrakis::KeptGroup* const group = tetrakis::groupOf(*sequence, frame);
    if (group == nullptr) return tetrakis::noFrame(frame);
    *time = tetrakis::timeOf(*group, frame);
    return {};
  });
}

tks_status tks_sequence_find(const tks_sequence* sequence, int64_t time, uint64_t* frame) {
  if (sequence == nullptr || frame == nullptr) return TKS_USAGE;
  return tetrakis::answering([&]() -> tetrakis::Status {
    if (tetrakis::decodingGroups(*sequence) == 0) return tetrakis::noFrame(0);
    *frame = tetrakis::frameAt(*sequence, time);
    return {};
  });
}

tks_status tks_sequence_group(const tks_sequence* sequence, uint64_t frame, tks_group* out) {
  if (sequence == nullptr || out == nullptr || out->size < sizeof out->size ||
      out->size > tetrakis::kMostStructBytes)
    return TKS_USAGE;
  return tetrakis::answering([&]() -> tetrakis::Status {
    const tetrakis::KeptGroup* const group = tetrakis::groupOf(*sequence, frame);
    if (group == nullptr) return tetrakis::noFrame(frame);
    const tetrakis::ParsedHead& parsed = group->parsed;
    tetrakis::giveSized(
        tks_group{sizeof *out, parsed.head.first_frame, parsed.head.frames(), group->offset,
                  parsed.groupEnd(), group->offset + parsed.bytes, parsed.head.stream_bytes,
                  group->available, static_cast<uint32_t>(parsed.head.back.depth),
                  parsed.head.back.bytes},
        *out);
    return {};
  });
}

tks_status tks_sequence_frame(tks_sequence* sequence, uint64_t frame, tks_decoder** decoder) {
  if (decoder == nullptr) return TKS_USAGE;
  *decoder = nullptr;
  return tetrakis::keepingSentence(sequence, [&] {
    tetrakis::Status status = tetrakis::open(*sequence, frame);
    if (status.ok()) *decoder = sequence->decoder.get();
    return status;
  });
}

tks_status tks_sequence_locate(const uint8_t* tail, size_t size, uint64_t end, int by_time,
                               int64_t place, tks_range* range, int* found) {
  if (range == nullptr || found == nullptr || (tail == nullptr && size != 0) || end < size)
    return TKS_USAGE;
  return tetrakis::answering([&] {
    return tetrakis::locate({tail, size}, end, by_time != 0, place, *range, *found);
  });
}
