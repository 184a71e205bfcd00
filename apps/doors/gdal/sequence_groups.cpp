// SPDX-License-Identifier: Apache-2.0
#include "apps/doors/gdal/sequence_groups.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

namespace tetrakis::gdal {
namespace {

/// Enough for most heads with the header of the stream behind them, and for the index of the last
/// group. It is also the least that GDAL reads over a network.
constexpr uint64_t kHead = 16384, kTail = 65536;
/// An index leads to the group, or to another one that does.
constexpr int kSteps = 3;
constexpr int64_t kLast = INT64_MAX;

tks_sequence_info infoOf(const tks_sequence* sequence) {
  tks_sequence_info info{};
  info.size = sizeof info;
  tks_sequence_get_info(sequence, &info);
  return info;
}

/// The first group of what the sequence was given, which begins at `offset` of the file. chain:
/// decodes groups that go on from others.
FrameGroup firstGroup(const tks_sequence* sequence, uint64_t frame, uint64_t offset,
                      const std::shared_ptr<GroupChain>& chain) {
  tks_group raw{};
  raw.size = sizeof raw;
  tks_sequence_group(sequence, frame, &raw);
  FrameGroup group;
  group.first_frame = raw.first_frame;
  group.offset = offset + raw.offset;
  group.bytes = raw.bytes;
  group.stream.begin = offset + raw.stream_offset;
  group.stream.size = raw.stream_bytes;
  if (raw.depth > 0) {
    group.stream.chain = chain;
    group.stream.group = {raw.first_frame, group.offset, group.end(), raw.bytes_back};
  }
  group.times.resize(raw.frames);
  for (uint64_t i = 0; i < raw.frames; ++i)
    tks_sequence_time(sequence, raw.first_frame + i, &group.times[i]);
  return group;
}

}  // namespace

bool isSequence(std::span<const uint8_t> bytes) {
  constexpr std::array<uint8_t, 4> kMagic = {'T', 'K', 'G', 0x1A};
  return bytes.size() >= kMagic.size() && std::equal(kMagic.begin(), kMagic.end(), bytes.begin());
}

std::unique_ptr<SequenceGroups> SequenceGroups::open(const std::string& name, const File& file,
                                                     const OpenSettings& settings) {
  const std::optional<uint64_t> length = lengthOf(file);
  if (!length) {
    reportFailure(TKS_IO, name, "The length of the file cannot be found.");
    return nullptr;
  }
  const uint64_t end = std::min(*length, settings.bytes.value_or(UINT64_MAX));
  std::unique_ptr<SequenceGroups> groups(new SequenceGroups(name, file, end));
  if (!groups->findEnds()) return nullptr;
  if (!settings.strict || groups->complete()) return groups;
  reportFailure(TKS_TRUNCATED, name,
                "The sequence ends inside a group, and STRICT=YES refuses that.");
  return nullptr;
}

bool SequenceGroups::findEnds() {
  if (take(0) == nullptr) {
    if (good_) reportFailure(TKS_TRUNCATED, name_, "The sequence ends before its first frame.");
    return false;
  }
  locate(kLast);
  while (good_ && take(groups_.rbegin()->second.end()) != nullptr) {
  }
  return good_;
}

bool SequenceGroups::read(FileBytes& bytes, uint64_t offset, uint64_t size) {
  const tks_range range{offset, size, 0};
  if (!bytes.read({&range, 1})) return true;
  reportFailure(TKS_IO, name_, "The file cannot be read.");
  return good_ = false;
}

const FrameGroup* SequenceGroups::take(uint64_t offset) {
  heads_.forget();
  for (uint64_t size = kHead; offset < end_; size *= 4) {
    const uint64_t there = std::min(size, end_ - offset);
    if (!read(heads_, offset, there)) return nullptr;
    const FrameGroup* const group = take(heads_.at(offset).first(there), offset);
    if (group != nullptr || !good_ || there < size) return group;
  }
  return nullptr;
}

const FrameGroup* SequenceGroups::take(std::span<const uint8_t> bytes, uint64_t offset) {
  const SequencePointer sequence = openSequence(nullptr);
  const tks_status status = tks_sequence_append(sequence.get(), bytes.data(), bytes.size());
  const tks_sequence_info info = infoOf(sequence.get());
  if (info.groups == 0) {  // what is wrong behind a group is told when that place is read
    if (status == TKS_OK) return nullptr;
    reportFailure(status, name_, tks_sequence_message(sequence.get()));
    good_ = false;
    return nullptr;
  }
  FrameGroup group = firstGroup(sequence.get(), info.first_frame, offset, chain_);
  if (!follows(group)) {
    reportFailure(TKS_CORRUPT, name_, "Corrupt sequence: a group does not follow the one before.");
    good_ = false;
    return nullptr;
  }
  if (groups_.empty()) {
    clock_ = {info.clock.numerator, info.clock.denominator, info.clock.epoch, info.clock.calendar};
    // The last four bytes of the head (docs/FORMAT.md, section 14).
    checksum_ = hexadecimal(bytes.subspan(group.stream.begin - offset - 4).first<4>());
  }
  group.stream.checksum = checksum_;
  return &groups_.emplace(group.first_frame, std::move(group)).first->second;
}

bool SequenceGroups::follows(const FrameGroup& group) const {
  const auto after = groups_.lower_bound(group.first_frame);
  if (after == groups_.begin()) return true;
  const FrameGroup& before = std::prev(after)->second;
  return before.endFrame() <= group.first_frame && before.end() <= group.offset &&
         before.times.back() < group.times.front();
}

const FrameGroup* SequenceGroups::locate(int64_t frame) {
  tks_range range{end_ - std::min(end_, kTail), std::min(end_, kTail), 0};
  for (int step = 0; step < kSteps; ++step) {
    if (!read(indices_, range.offset, range.size)) return nullptr;
    const uint64_t end = range.offset + range.size;
    int found = 0;
    const tks_status status = tks_sequence_locate(indices_.at(range.offset).data(), range.size, end,
                                                  0, frame, &range, &found);
    if (status != TKS_OK) return nullptr;  // then heads tell
    if (found != 0) return take(range.offset);
    if (range.offset + range.size > end_) return nullptr;
  }
  return nullptr;
}

const FrameGroup* SequenceGroups::holding(uint64_t frame) {
  const auto holds = [frame](const FrameGroup* group) {
    return group != nullptr && group->first_frame <= frame && frame < group->endFrame();
  };
  good_ = true;
  if (frame >= firstFrame() && frame < endFrame()) {
    const FrameGroup* before = &std::prev(groups_.upper_bound(frame))->second;
    if (holds(before)) return before;
    // The next one is behind the one before; others the index finds.
    if (before->endFrame() != frame) {
      const FrameGroup* const found = locate(static_cast<int64_t>(frame));
      if (holds(found)) return found;
    }
    while (good_ && before != nullptr && before->endFrame() <= frame) {
      before = take(before->end());
      if (holds(before)) return before;
    }
  }
  if (good_)
    reportFailure(TKS_USAGE, name_, "The sequence has no frame " + std::to_string(frame) + ".");
  return nullptr;
}

}  // namespace tetrakis::gdal
