// SPDX-License-Identifier: Apache-2.0
#include "ratecontrol/receiver/sent_pieces.hpp"

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>

#include "bitstream/sequence/control_message.hpp"

namespace tetrakis::inline receiver {

void ByteRanges::add(ByteRange range) {
  if (range.begin >= range.end) return;
  auto next = ends_.upper_bound(range.begin);
  if (next != ends_.begin() && std::prev(next)->second >= range.begin) --next;
  while (next != ends_.end() && next->first <= range.end) {
    range.begin = std::min(range.begin, next->first);
    range.end = std::max(range.end, next->second);
    next = ends_.erase(next);
  }
  ends_.emplace_hint(next, range.begin, range.end);
}

void ByteRanges::remove(ByteRange range) {
  auto next = ends_.upper_bound(range.begin);
  if (next != ends_.begin() && std::prev(next)->second > range.begin) --next;
  while (next != ends_.end() && next->first < range.end) {
    const auto [begin, end] = *next;
    next = ends_.erase(next);
    if (begin < range.begin) ends_.emplace(begin, range.begin);
    if (end > range.end) ends_.emplace(range.end, end);
  }
}

std::vector<ByteRange> ByteRanges::missing(ByteRange wanted) const {
  std::vector<ByteRange> gaps;
  uint64_t at = wanted.begin;
  auto next = ends_.upper_bound(at);
  if (next != ends_.begin()) --next;
  for (; next != ends_.end() && next->first < wanted.end; ++next) {
    if (next->first > at) gaps.push_back({at, next->first});
    at = std::max(at, next->second);
  }
  if (at < wanted.end) gaps.push_back({at, wanted.end});
  return gaps;
}

uint64_t ByteRanges::bytes() const {
  uint64_t sum = 0;
  for (const auto& [begin, end] : ends_) sum += end - begin;
  return sum;
}

std::vector<ByteRange> SentPieces::missing(uint64_t group, ByteRange wanted) const {
  const auto found = groups_.find(group);
  return found != groups_.end() ? found->second.missing(wanted) : ByteRanges().missing(wanted);
}

uint64_t SentPieces::bytesOf(uint64_t group) const {
  const auto found = groups_.find(group);
  return found != groups_.end() ? found->second.bytes() : 0;
}

void SentPieces::add(const SentPiece& piece) {
  groups_[piece.group].add(piece.range);
  added_.push_back(piece);
}

void SentPieces::send() {
  under_way_.push_back({answers_, std::exchange(added_, {})});
  ++answers_;
  if (under_way_.size() <= kToldAnswers) return;
  lose(under_way_.front());
  under_way_.pop_front();
}

Status SentPieces::hear(uint32_t answers, uint32_t lost) {
  if (answers > answers_)
    return {TKS_USAGE, "The control message tells of " + std::to_string(answers) +
                           " answers, and the receiver got " + std::to_string(answers_) +
                           ": it has to begin anew, with another number of its own."};
  if (answers < heard_) return {TKS_USAGE, "The control message is older than one before it."};
  heard_ = answers;
  // Newer answers than the last one that came are on their way.
  while (!under_way_.empty() && under_way_.front().number < answers) {
    const UnderWay& answer = under_way_.front();
    const uint32_t back = answers - 1 - answer.number;
    const bool is_told = back <= kToldAnswers;
    if (!is_told || (back > 0 && (lost >> (back - 1) & 1) != 0)) lose(answer);
    under_way_.pop_front();
  }
  return {};
}

void SentPieces::lose(const UnderWay& answer) {
  for (const SentPiece& piece : answer.pieces) {
    const auto found = groups_.find(piece.group);
    if (found != groups_.end()) found->second.remove(piece.range);
  }
}

void SentPieces::forgetBefore(uint64_t group) {
  groups_.erase(groups_.begin(), groups_.lower_bound(group));
}

}  // namespace tetrakis::inline receiver
