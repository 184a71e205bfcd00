// SPDX-License-Identifier: Apache-2.0
#include "api/receiver.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "api/guarded.hpp"
#include "api/outlook.hpp"

namespace tetrakis::inline api {

std::span<const uint8_t> HeldGroup::stream() const {
  const std::span<const uint8_t> there = pieces.from(parsed->bytes);
  return there.first(
      static_cast<size_t>(std::min<uint64_t>(there.size(), parsed->head.stream_bytes)));
}

void HeardAnswers::hear(uint32_t number) {
  if (number < answers_) {  // later than those behind it
    const uint32_t back = answers_ - 1 - number;
    if (back > 0 && back <= kToldAnswers) lost_ &= ~(1u << (back - 1));
    return;
  }
  const uint32_t more = number + 1 - answers_, skipped = std::min(more - 1, kToldAnswers);
  const uint64_t before = more < kToldAnswers ? uint64_t{lost_} << more : 0;
  lost_ = static_cast<uint32_t>(before | ((uint64_t{1} << skipped) - 1));
  answers_ = number + 1;
}

bool decodes(const tks_receiver& receiver, uint64_t number) {
  auto group = receiver.groups.find(number);
  for (;;) {
    if (group == receiver.groups.end() || !group->second.reference) return false;
    const WayBack& back = group->second.parsed->head.back;
    if (back.none()) return true;
    const auto before = receiver.groups.find(group->first - 1);
    if (before == receiver.groups.end() || !before->second.reference) return false;
    const HeldGroup& link = before->second;
    if (link.stream().size() < *group->second.reference) return false;
    if (link.parsed->head.back.depth + 1 != back.depth) return false;
    group = before;
  }
}

namespace {

/// A group whose head or header of the stream may have come with the last bytes.
Status readHeads(uint64_t number, HeldGroup& group) {
  if (!group.parsed) {
    const std::span<const uint8_t> there = group.pieces.from(0);
    const Result<uint64_t> needed = headBytes(there);
    if (!needed.ok()) return needed.status();
    if (*needed > there.size()) return {};
    Result<ParsedHead> parsed = readHead(there);
    if (!parsed.ok()) return parsed.status();
    if (parsed->head.number != number)
      return {TKS_CORRUPT, "Corrupt answer: a group has another number than it is sent with."};
    group.parsed = *std::move(parsed);
  }
  if (group.reference) return {};
  const std::span<const uint8_t> stream = group.stream();
  const Result<uint64_t> needed = headerBytes(stream);
  if (!needed.ok()) return needed.status();
  if (*needed > stream.size()) return {};
  const Result<ParsedHeader> parsed = readHeader(stream);
  if (!parsed.ok()) return parsed.status();
  group.reference = referenceOf(parsed->header);
  if (group.parsed->head.back.none() != (*group.reference == 0)) return misledDepth();
  return {};
}

/// Whether a new head fits between those that are there.
Status checkBetween(const tks_receiver& receiver, const GroupHead& head) {
  const auto precedes = [](const GroupHead& a, const GroupHead& b) {
    return a.first_frame + a.frames() <= b.first_frame && a.times.back() < b.times.front();
  };
  bool fits = !receiver.clock || *receiver.clock == head.clock;
  for (const auto& [number, group] : receiver.groups) {
    if (!group.parsed || number == head.number) continue;
    const GroupHead& other = group.parsed->head;
    fits &= number < head.number ? precedes(other, head) : precedes(head, other);
  }
  if (fits) return {};
  return {TKS_CORRUPT, "Corrupt answer: group " + std::to_string(head.number) +
                           " does not fit to those that came before."};
}

/// The groups of an answer that have no head yet, as they are with it.
Result<std::map<uint64_t, HeldGroup>> begunGroups(const tks_receiver& receiver,
                                                  const Answer& answer) {
  std::map<uint64_t, HeldGroup> begun;
  for (const AnswerPiece& piece : answer.pieces) {
    if (piece.group < receiver.first_group) continue;
    const auto held = receiver.groups.find(piece.group);
    if (held != receiver.groups.end() && held->second.reference) continue;
    auto [group, is_new] = begun.try_emplace(piece.group);
    if (is_new && held != receiver.groups.end()) group->second = held->second;
    group->second.pieces.put(piece.place, piece.bytes);
  }
  for (auto& [number, group] : begun) {
    const bool had_head = group.parsed.has_value();
    if (Status status = readHeads(number, group); !status.ok()) return status;
    if (had_head || !group.parsed) continue;
    if (Status status = checkBetween(receiver, group.parsed->head); !status.ok()) return status;
  }
  return begun;
}

/// The number of the first group in the chain.
uint64_t firstChained(const tks_receiver& receiver) {
  return receiver.chained + 1 - receiver.chain.length();
}

/// Before a group changes: its decoder reads its bytes, and so does the chain. Both stay where
/// others change, so that a live player decodes what frames go on from once.
void letGo(tks_receiver& receiver, uint64_t number) {
  const bool is_linked =
      receiver.chain.length() > 0 && number >= firstChained(receiver) && number <= receiver.chained;
  if (is_linked || receiver.opened == number) receiver.decoder.reset();
  if (is_linked) receiver.chain.clear();
}

Status take(tks_receiver& receiver, std::span<const uint8_t> bytes) {
  const Result<Answer> answer = readAnswer(bytes);
  if (!answer.ok()) return answer.status();
  Result<std::map<uint64_t, HeldGroup>> begun = begunGroups(receiver, *answer);
  if (!begun.ok()) return begun.status();
  for (const AnswerPiece& piece : answer->pieces) {
    if (piece.group < receiver.first_group) continue;
    letGo(receiver, piece.group);
    receiver.bytes += piece.bytes.size();
    if (!begun->contains(piece.group))
      receiver.groups[piece.group].pieces.put(piece.place, piece.bytes);
  }
  for (auto& [number, group] : *begun) {
    if (group.parsed && !receiver.clock) receiver.clock = group.parsed->head.clock;
    receiver.groups[number] = std::move(group);
  }
  receiver.heard.hear(answer->number);
  receiver.source_end = answer->end_frame;
  receiver.last_pieces = answer->pieces.size();
  ++receiver.came;
  return {};
}

/// The last group that decodes of those that begin with a frame or before it.
std::optional<uint64_t> groupUpTo(const tks_receiver& receiver, uint64_t frame) {
  for (auto group = receiver.groups.rbegin(); group != receiver.groups.rend(); ++group) {
    const HeldGroup& held = group->second;
    if (held.reference && held.parsed->head.first_frame <= frame && decodes(receiver, group->first))
      return group->first;
  }
  return std::nullopt;
}

/// Makes the chain that of a group that decodes.
Status makeChain(tks_receiver& receiver, uint64_t number) {
  const uint64_t depth = receiver.groups.at(number).parsed->head.back.depth;
  GroupChain& chain = receiver.chain;
  const bool goes_on = chain.length() > 0 && chain.length() < depth + 1 &&
                       receiver.chained + 1 + depth - chain.length() == number;
  if (!goes_on) chain = GroupChain(receiver.has_limits ? &receiver.limits : nullptr);
  for (uint64_t n = number - depth + chain.length(); n < number; ++n) {
    const Result<ParsedHeader> next = readHeader(receiver.groups.at(n + 1).stream());
    if (!next.ok()) return next.status();
    if (Status status = chain.add(receiver.groups.at(n).stream(), next->header); !status.ok())
      return status;
    receiver.chained = n;
  }
  return {};
}

/// Gives a decoder of the first bytes of a stream what came behind a gap.
Status putRest(const HeldGroup& group, tks_decoder& decoder) {
  if (decoder.parsed.header.index.empty()) return {};
  const uint64_t begin = group.parsed->bytes, end = group.parsed->streamEnd();
  std::vector<tks_range> ranges;
  std::vector<const uint8_t*> data;
  uint64_t at = end;
  for (const ByteRange& gap : group.pieces.missing({begin + group.stream().size(), end})) {
    if (gap.begin > at) {
      ranges.push_back({at - begin, gap.begin - at, 0});
      data.push_back(group.pieces.from(at).data());
    }
    at = gap.end;
  }
  if (at < end) {
    ranges.push_back({at - begin, end - at, 0});
    data.push_back(group.pieces.from(at).data());
  }
  if (ranges.empty()) return {};
  const tks_status status = tks_put_ranges(&decoder, ranges.data(), data.data(), ranges.size());
  return status == TKS_OK ? Status() : Status(status, tks_message(&decoder));
}

Status openGroup(tks_receiver& receiver, uint64_t number) {
  receiver.decoder.reset();
  if (Status status = makeChain(receiver, number); !status.ok()) return status;
  const HeldGroup& group = receiver.groups.at(number);
  Result<OwnedDecoder> opened =
      openBehind(group.stream(), receiver.has_limits ? &receiver.limits : nullptr,
                 receiver.chain.references());
  if (!opened.ok()) return opened.status();
  if (framesOf((*opened)->parsed.header) != group.parsed->head.frames())
    return {TKS_CORRUPT, "Corrupt answer: a group has another number of frames than it says."};
  if (Status status = putRest(group, **opened); !status.ok()) return status;
  receiver.decoder = *std::move(opened);
  receiver.opened = number;
  return {};
}

Status open(tks_receiver& receiver, uint64_t frame) {
  const auto group =
      std::find_if(receiver.groups.begin(), receiver.groups.end(), [&](const auto& numbered) {
        const HeldGroup& held = numbered.second;
        return held.reference && held.parsed->head.first_frame <= frame && frame < held.endFrame();
      });
  if (group == receiver.groups.end())
    return {TKS_USAGE, "Frame " + std::to_string(frame) + " is not there."};
  if (!decodes(receiver, group->first))
    return {TKS_TRUNCATED,
            "Frame " + std::to_string(frame) + " goes on from a group that is not there."};
  if (receiver.decoder == nullptr || receiver.opened != group->first)
    if (Status status = openGroup(receiver, group->first); !status.ok()) return status;
  const auto at = static_cast<uint32_t>(frame - group->second.parsed->head.first_frame);
  const tks_status status = tks_set_frame(receiver.decoder.get(), at);
  return status == TKS_OK ? Status() : Status(status, tks_message(receiver.decoder.get()));
}

/// Rounded to floats, which stay finite.
Result<ControlView> controlViewOf(const tks_screen_camera& given) {
  tks_screen_camera camera{};
  if (Status status = takeCamera("the view", given, camera); !status.ok()) return status;
  if (Status status = refuseGlobes("A message", {&camera, 1}); !status.ok()) return status;
  ControlView view{camera.width, camera.height, {}};
  constexpr std::array<size_t, 3> kRows = {0, 1, 3};
  for (size_t i = 0; i < view.rows.size(); ++i) {
    const auto rounded = static_cast<float>(camera.clip[4 * kRows[i / 4] + i % 4]);
    if (!std::isfinite(rounded)) return Status(TKS_USAGE, "The matrix of the view exceeds floats.");
    view.rows[i] = std::bit_cast<uint32_t>(rounded);
  }
  return view;
}

Result<ControlMessage> messageOf(const tks_receiver& receiver, const tks_wants& wants) {
  if (wants.link < 1 || wants.link > kMostRate || wants.triangles > kMostRate)
    return Status(TKS_USAGE,
                  "A link takes 1 to 2^28 - 1 bytes a second, and a mesh as many "
                  "triangles at most.");
  const uint64_t most = kMostFirstFrame + kMostFrames;
  ControlMessage message{.receiver = receiver.number,
                         .answers = receiver.heard.answers(),
                         .lost = receiver.heard.lost(),
                         .kept = std::min(receiver.kept, most),
                         .link = wants.link,
                         .triangles = wants.triangles};
  if (wants.frame != TKS_NEWEST_FRAME) message.frame = std::min(wants.frame, most);
  if (wants.view == nullptr) return message;
  const Result<ControlView> view = controlViewOf(*wants.view);
  if (!view.ok()) return view.status();
  message.view = *view;
  return message;
}

tks_receiver_info receiverInfo(const tks_receiver& receiver) {
  tks_receiver_info info = {};
  bool is_first = true;
  for (const auto& [number, group] : receiver.groups) {
    if (!group.reference) continue;
    if (is_first) info.first_frame = group.parsed->head.first_frame;
    is_first = false;
    info.end_frame = group.endFrame();
  }
  info.source_end_frame = receiver.source_end;
  info.answers = receiver.came;
  info.last_pieces = receiver.last_pieces;
  info.bytes = receiver.bytes;
  static const Clock kUnknown;
  const Clock& clock = receiver.clock ? *receiver.clock : kUnknown;
  info.clock = {sizeof info.clock, clock.numerator, clock.denominator, clock.epoch.c_str(),
                clock.calendar.c_str()};
  return info;
}

}  // namespace

std::optional<uint64_t> firstThatStays(const tks_receiver& receiver, uint64_t frame) {
  for (const auto& [number, group] : receiver.groups) {
    if (!group.parsed || group.endFrame() <= frame) continue;
    return number - std::min(number, group.parsed->head.back.depth);
  }
  return std::nullopt;
}

void giveUpBefore(tks_receiver& receiver, uint64_t frame) {
  if (receiver.groups.empty()) return;
  const std::optional<uint64_t> first = firstThatStays(receiver, frame);
  const uint64_t end = first ? *first : receiver.groups.rbegin()->first + 1;
  if (end <= receiver.groups.begin()->first) return;
  const auto stay = receiver.groups.lower_bound(end);
  for (auto group = receiver.groups.begin(); group != stay; ++group) letGo(receiver, group->first);
  receiver.groups.erase(receiver.groups.begin(), stay);
  receiver.first_group = std::max(receiver.first_group, end);
  const auto begin = receiver.groups.begin();
  const bool is_known = begin != receiver.groups.end() && begin->second.parsed;
  receiver.kept =
      std::max(receiver.kept, is_known ? begin->second.parsed->head.first_frame : frame);
}

}  // namespace tetrakis::inline api

tks_status tks_receiver_open(uint64_t number, const tks_limits* limits, tks_receiver** out) {
  if (out == nullptr) return TKS_USAGE;
  *out = nullptr;
  return tetrakis::answering([&]() -> tetrakis::Status {
    auto receiver = std::make_unique<tks_receiver>();
    receiver->number = number;
    receiver->has_limits = limits != nullptr;
    if (limits != nullptr) {
      tetrakis::Status status =
          tetrakis::takeSized("the limits", *limits, sizeof limits->size, receiver->limits);
      if (!status.ok()) return status;
    }
    *out = receiver.release();
    return {};
  });
}

void tks_receiver_close(tks_receiver* receiver) {
  delete receiver;
}

const char* tks_receiver_message(const tks_receiver* receiver) {
  return receiver != nullptr ? receiver->sentence : "";
}

tks_status tks_receiver_control(tks_receiver* receiver, const tks_wants* wants,
                                uint8_t control[TKS_MOST_CONTROL_BYTES], size_t* size) {
  return tetrakis::keepingSentence(receiver, [&]() -> tetrakis::Status {
    if (wants == nullptr || control == nullptr || size == nullptr) return tetrakis::outputMissing();
    tks_wants taken{};
    if (auto s = tetrakis::takeSized("what is wanted", *wants, sizeof *wants, taken); !s.ok())
      return s;
    const auto message = tetrakis::messageOf(*receiver, taken);
    if (!message.ok()) return message.status();
    const std::vector<uint8_t> bytes = tetrakis::writeControl(*message);
    std::copy(bytes.begin(), bytes.end(), control);
    *size = bytes.size();
    return {};
  });
}

tks_status tks_receiver_take(tks_receiver* receiver, const uint8_t* answer, size_t size) {
  if (answer == nullptr && size != 0) return TKS_USAGE;
  return tetrakis::keepingSentence(receiver, [&] {
    return tetrakis::take(*receiver, {answer, size});
  });
}

tks_status tks_receiver_get_info(const tks_receiver* receiver, tks_receiver_info* info) {
  if (receiver == nullptr || info == nullptr || info->size < sizeof info->size ||
      info->size > tetrakis::kMostStructBytes)
    return TKS_USAGE;
  return tetrakis::answering([&]() -> tetrakis::Status {
    tetrakis::giveSized(tetrakis::receiverInfo(*receiver), *info);
    return {};
  });
}

tks_status tks_receiver_find(tks_receiver* receiver, uint64_t frame, uint64_t* found,
                             int64_t* time) {
  return tetrakis::keepingSentence(receiver, [&]() -> tetrakis::Status {
    if (found == nullptr || time == nullptr) return tetrakis::outputMissing();
    const std::optional<uint64_t> number = tetrakis::groupUpTo(*receiver, frame);
    if (!number) return {TKS_USAGE, "No frame is there yet."};
    const tetrakis::HeldGroup& group = receiver->groups.at(*number);
    const tetrakis::GroupHead& head = group.parsed->head;
    *found = std::min(frame, group.endFrame() - 1);
    *time = head.times[*found - head.first_frame];
    return {};
  });
}

tks_status tks_receiver_frame(tks_receiver* receiver, uint64_t frame, tks_decoder** decoder) {
  if (decoder == nullptr) return TKS_USAGE;
  *decoder = nullptr;
  return tetrakis::keepingSentence(receiver, [&] {
    tetrakis::Status status = tetrakis::open(*receiver, frame);
    if (status.ok()) *decoder = receiver->decoder.get();
    return status;
  });
}

tks_status tks_receiver_forget(tks_receiver* receiver, uint64_t frame) {
  return tetrakis::keepingSentence(receiver, [&]() -> tetrakis::Status {
    tetrakis::giveUpBefore(*receiver, frame);
    return {};
  });
}
