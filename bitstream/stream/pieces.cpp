// SPDX-License-Identifier: Apache-2.0
#include "bitstream/stream/pieces.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace tetrakis::inline stream {

void ByteRun::prepend(std::span<const uint8_t> more) {
  if (first_ < more.size()) {
    const size_t free = more.size() + size();
    std::vector<uint8_t> room(free + size());
    std::copy(bytes().begin(), bytes().end(), room.begin() + static_cast<ptrdiff_t>(free));
    room_ = std::move(room);
    first_ = free;
  }
  first_ -= more.size();
  std::copy(more.begin(), more.end(), room_.begin() + static_cast<ptrdiff_t>(first_));
}

void ByteRun::makeRoom(size_t more) {
  const size_t needed = room_.size() + more;
  if (needed > room_.capacity()) room_.reserve(std::max(needed, 2 * room_.capacity()));
}

void Pieces::put(uint64_t place, std::span<const uint8_t> bytes) {
  for (const ByteRange& gap : missing({place, place + bytes.size()}))
    fill(gap.begin, bytes.subspan(gap.begin - place, gap.end - gap.begin));
}

/// The run begins elsewhere from now on.
Pieces::Runs::iterator Pieces::moved(Runs::iterator run, uint64_t place) {
  auto node = runs_.extract(run);
  node.key() = place;
  return runs_.insert(std::move(node)).position;
}

/// None of the bytes is there. Of two runs that meet the shorter one is copied, so that a byte is
/// copied once for each time that its run has doubled.
void Pieces::fill(uint64_t place, std::span<const uint8_t> bytes) {
  auto next = runs_.lower_bound(place);
  const auto before = next == runs_.begin() ? runs_.end() : std::prev(next);
  const bool goes_on = before != runs_.end() && before->first + before->second.size() == place;
  const bool is_met = next != runs_.end() && next->first == place + bytes.size();
  if (!goes_on && !is_met) {
    runs_.emplace_hint(next, place, ByteRun())->second.append(bytes);
  } else if (goes_on && (!is_met || before->second.size() >= next->second.size())) {
    before->second.makeRoom(bytes.size() + (is_met ? next->second.size() : 0));
    before->second.append(bytes);
    if (is_met) {
      before->second.append(next->second.bytes());
      runs_.erase(next);
    }
  } else {
    next->second.prepend(bytes);
    next = moved(next, place);
    if (goes_on) {
      next->second.prepend(before->second.bytes());
      const uint64_t begin = before->first;
      runs_.erase(before);
      moved(next, begin);
    }
  }
  bytes_ += bytes.size();
}

std::span<const uint8_t> Pieces::from(uint64_t place) const {
  const auto after = runs_.upper_bound(place);
  if (after == runs_.begin()) return {};
  const auto& [begin, run] = *std::prev(after);
  return place - begin < run.size() ? run.bytes().subspan(place - begin)
                                    : std::span<const uint8_t>();
}

std::vector<ByteRange> Pieces::missing(ByteRange wanted) const {
  std::vector<ByteRange> gaps;
  uint64_t at = wanted.begin;
  auto run = runs_.upper_bound(at);
  if (run != runs_.begin()) --run;
  for (; run != runs_.end() && run->first < wanted.end; ++run) {
    if (run->first > at) gaps.push_back({at, run->first});
    at = std::max(at, run->first + run->second.size());
  }
  if (at < wanted.end) gaps.push_back({at, wanted.end});
  return gaps;
}

bool Pieces::hasAny(ByteRange range) const {
  const auto after = runs_.upper_bound(range.begin);
  return (after != runs_.end() && after->first < range.end) || !from(range.begin).empty();
}

}  // namespace tetrakis::inline stream
