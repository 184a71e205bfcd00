// SPDX-License-Identifier: Apache-2.0
#include "api/answer_plan.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "api/outlook.hpp"
#include "api/renderer_bound.hpp"

namespace tetrakis::inline api {

namespace {

constexpr double kAhead = 10;  ///< seconds behind the wanted frame that are sent ahead of time
constexpr size_t kMostKnown = 32;

/// The matrix of a message, whose third row nobody looks at.
tks_screen_camera cameraOf(const ControlView& view) {
  tks_screen_camera camera = {};
  camera.size = sizeof camera;
  camera.width = view.width;
  camera.height = view.height;
  constexpr std::array<size_t, 3> kRows = {0, 1, 3};
  for (size_t i = 0; i < view.rows.size(); ++i)
    camera.clip[4 * kRows[i / 4] + i % 4] = static_cast<double>(std::bit_cast<float>(view.rows[i]));
  return camera;
}

}  // namespace

size_t AnswerPlan::placeWanted() const {
  const size_t count = decodingGroups(transmitter_.sequence);
  if (!message_.frame) return count > 0 ? count - 1 : 0;
  const auto end = groups().begin() + static_cast<ptrdiff_t>(count);
  const auto found =
      std::upper_bound(groups().begin(), end, *message_.frame,
                       [](uint64_t frame, const KeptGroup& g) { return frame < g.endFrame(); });
  return static_cast<size_t>(found - groups().begin());
}

bool AnswerPlan::hasChain(size_t place) const {
  const GroupHead& head = groups()[place].parsed.head;
  const uint64_t depth = head.back.depth;
  return depth <= place &&
         groups()[place - static_cast<size_t>(depth)].parsed.head.number == head.number - depth;
}

double AnswerPlan::secondsBetween(int64_t from, int64_t to) const {
  const Clock& clock = transmitter_.sequence.clock;
  if (clock.none()) return std::numeric_limits<double>::infinity();
  const double ticks = static_cast<double>(to) - static_cast<double>(from);
  return ticks * static_cast<double>(clock.numerator) / static_cast<double>(clock.denominator);
}

double AnswerPlan::secondsOf(size_t place) const {
  const std::vector<int64_t>& times = groups()[place].parsed.head.times;
  if (place + 1 < groups().size())
    return secondsBetween(times.front(), groups()[place + 1].parsed.head.times.front());
  if (times.size() == 1) return std::numeric_limits<double>::infinity();
  const auto count = static_cast<double>(times.size());
  return secondsBetween(times.front(), times.back()) * count / (count - 1);
}

uint64_t AnswerPlan::shareOf(size_t place) const {
  const double bytes = secondsOf(place) * message_.link;
  const uint64_t sent = sent_.bytesOf(groups()[place].parsed.head.number);
  if (!(bytes < 1e15)) return UINT64_MAX;
  const auto share = static_cast<uint64_t>(bytes);
  return share - std::min(share, sent);
}

size_t AnswerPlan::endAhead(size_t wanted) const {
  const size_t count = decodingGroups(transmitter_.sequence);
  const int64_t begin = groups()[wanted].parsed.head.times.front();
  size_t end = wanted + 1;
  while (end < count && hasChain(end) &&
         secondsBetween(begin, groups()[end].parsed.head.times.front()) <= kAhead)
    ++end;
  // The next group is sent ahead in any case.
  return end == wanted + 1 && end < count && hasChain(end) ? end + 1 : end;
}

Result<KnownGroup*> AnswerPlan::known(size_t place) {
  const KeptGroup& group = groups()[place];
  const uint64_t number = group.parsed.head.number;
  const auto found = transmitter_.known.find(number);
  if (found != transmitter_.known.end()) return &found->second;
  Result<ParsedHeader> parsed = readHeader(group.stream);
  if (!parsed.ok()) return parsed.status();
  if (transmitter_.known.size() >= kMostKnown) transmitter_.known.clear();
  return &transmitter_.known.try_emplace(number, KnownGroup{*std::move(parsed)}).first->second;
}

size_t AnswerPlan::entryOf(size_t place) const {
  return place - static_cast<size_t>(groups()[place].parsed.head.back.depth);
}

Result<tks_decoder*> AnswerPlan::decoderOfEntry(size_t place) {
  tks_decoder* decoder = nullptr;
  tks_sequence& sequence = transmitter_.sequence;
  const uint64_t frame = groups()[entryOf(place)].endFrame() - 1;
  const tks_status status = tks_sequence_frame(&sequence, frame, &decoder);
  if (status != TKS_OK) return Status(status, tks_sequence_message(&sequence));
  return decoder;
}

Result<std::vector<WeightedSighting>> AnswerPlan::sightings(size_t place, Ground ground) {
  if (ground == Ground::kAll || !message_.view)
    return std::vector<WeightedSighting>{{{.ground = {}, .triangles = message_.triangles}, 1}};
  const Result<KnownGroup*> group = known(entryOf(place));
  if (!group.ok()) return group.status();
  if (!(*group)->ground) {
    const Result<tks_decoder*> decoder = decoderOfEntry(place);
    if (!decoder.ok()) return decoder.status();
    Result<CoarseGround> coarse = coarseGround(**decoder);
    if (!coarse.ok()) return coarse.status();
    (*group)->ground = *std::move(coarse);
  }
  return std::vector<WeightedSighting>{
      {sightingOf(*(*group)->ground, cameraOf(*message_.view), message_.triangles), 1}};
}

Result<ByteRanges> AnswerPlan::beyondRenderer(size_t place) {
  constexpr double kShare = 0.5;  // of the error of the mesh, which then hardly grows
  if (message_.triangles == 0) return ByteRanges();
  const Result<KnownGroup*> entry = known(entryOf(place));
  if (!entry.ok()) return entry.status();
  if (!(*entry)->parsed.header.geometry) return ByteRanges();
  const uint32_t triangles = std::bit_ceil(message_.triangles);
  auto& errors = (*entry)->mesh_errors;
  if (!errors.contains(triangles)) {
    const Result<tks_decoder*> decoder = decoderOfEntry(place);
    if (!decoder.ok()) return decoder.status();
    const Result<double> error = meshError(**decoder, triangles);
    errors[triangles] = error.ok() ? *error : 0;  // of what has no such mesh all is shown
  }
  const double error = kShare * errors[triangles];
  const Result<KnownGroup*> group = known(place);
  if (!group.ok()) return group.status();
  return beyondError((*group)->parsed, groups()[place].stream, error);
}

void AnswerPlan::add(size_t place, ByteRange range) {
  const KeptGroup& group = groups()[place];
  range.end = std::min<uint64_t>(range.end, group.parsed.bytes + group.stream.size());
  if (range.begin >= range.end) return;
  for (const ByteRange& gap : sent_.missing(group.parsed.head.number, range)) {
    if (left_ <= kMostPieceHead) return;
    const uint64_t bytes = std::min(gap.end - gap.begin, left_ - kMostPieceHead);
    sent_.add({group.parsed.head.number, {gap.begin, gap.begin + bytes}});
    left_ -= bytes + kMostPieceHead;
  }
}

Status AnswerPlan::require(size_t place, uint64_t stream_bytes) {
  const Result<KnownGroup*> group = known(place);
  if (!group.ok()) return group.status();
  const uint64_t header = (*group)->parsed.bytes;
  add(place, {0, groups()[place].parsed.bytes + std::max(header, stream_bytes)});
  return {};
}

Status AnswerPlan::requireBehind(size_t place) {
  const Result<KnownGroup*> next = known(place + 1);
  if (!next.ok()) return next.status();
  return require(place, referenceOf((*next)->parsed.header));
}

Status AnswerPlan::give(size_t place, uint64_t most, Ground ground) {
  if (left_ <= kMostPieceHead || most == 0) return {};
  const auto sighted = sightings(place, ground);
  if (!sighted.ok()) return sighted.status();
  const Result<KnownGroup*> group = known(place);
  if (!group.ok()) return group.status();
  const uint64_t head = groups()[place].parsed.bytes, number = groups()[place].parsed.head.number;
  const uint64_t there = groups()[place].stream.size();
  const Result<ByteRanges> beyond = beyondRenderer(place);
  if (!beyond.ok()) return beyond.status();
  const auto missing = [&](uint64_t begin, uint64_t end) {
    std::vector<ByteRange> gaps;
    if (begin >= std::min(end, there)) return gaps;
    for (const ByteRange& gap :
         sent_.missing(number, {head + begin, head + std::min(end, there)})) {
      const auto shown = beyond->missing({gap.begin - head, gap.end - head});
      gaps.insert(gaps.end(), shown.begin(), shown.end());
    }
    return gaps;
  };
  const auto ranges = planFetch((*group)->parsed, nullptr, *sighted, missing,
                                {std::min(most, left_ - kMostPieceHead), 0});
  if (!ranges.ok()) return ranges.status();
  for (const FetchRange& range : *ranges)
    if (range.gain > 0) add(place, {head + range.begin, head + range.end});
  return {};
}

Status AnswerPlan::choose() {
  const size_t wanted = placeWanted();
  if (wanted >= decodingGroups(transmitter_.sequence) || !hasChain(wanted)) return {};
  const auto depth = static_cast<size_t>(groups()[wanted].parsed.head.back.depth);
  Status status;
  for (size_t place = wanted - depth; place < wanted && status.ok(); ++place)
    status = requireBehind(place);
  const size_t end = endAhead(wanted);
  for (size_t place = wanted; place < end && status.ok(); ++place) {
    if (place > wanted && !groups()[place].parsed.head.back.none())
      status = requireBehind(place - 1);
    if (status.ok()) status = require(place, 0);
    if (status.ok()) status = give(place, shareOf(place), Ground::kSeen);
  }
  for (const Ground ground : {Ground::kSeen, Ground::kAll})
    for (size_t place = wanted; place < end && status.ok(); ++place)
      status = give(place, UINT64_MAX, ground);
  return status;
}

}  // namespace tetrakis::inline api
