// SPDX-License-Identifier: Apache-2.0
#include "ratecontrol/receiver/piece_ranges.hpp"

namespace tetrakis::inline receiver {

namespace {

/// Chosen pieces in the stream's order; neighbours are one, unless only one of them helps.
std::vector<RankedRange> stretches(std::span<const Piece> pieces, std::span<const uint32_t> order,
                                   const Choice& chosen) {
  std::vector<uint32_t> ranks(pieces.size(), static_cast<uint32_t>(pieces.size()));
  for (uint32_t rank = 0; rank < order.size(); ++rank) ranks[order[rank]] = rank;
  std::vector<RankedRange> found;
  for (size_t i = 0; i < pieces.size(); ++i) {
    if (chosen[i] == 0) continue;
    const uint64_t begin = pieces[i].begin;
    const RankedRange next{{begin, begin + chosen[i], pieces[i].worth.now}, ranks[i]};
    const bool touches = !found.empty() && found.back().range.end == begin;
    if (touches && (found.back().range.gain > 0) == pieces[i].helps())
      found.back().join(next);
    else
      found.push_back(next);
  }
  return found;
}

}  // namespace

std::vector<FetchRange> rangesOf(std::span<const Piece> pieces, std::span<const uint32_t> order,
                                 const Choice& chosen, uint64_t request_bytes) {
  std::vector<RankedRange> joined;
  const std::vector<RankedRange> found = stretches(pieces, order, chosen);
  for (size_t i = 0; i < found.size(); ++i) {
    joined.push_back(found[i]);
    while (joined.back().range.gain > 0 && i + 2 < found.size()) {
      const FetchRange &between = found[i + 1].range, &next = found[i + 2].range;
      const bool touch = joined.back().range.end == between.begin && between.end == next.begin;
      if (!touch || between.end - between.begin > request_bytes) break;
      joined.back().join(found[i + 1]);
      joined.back().join(found[i + 2]);
      i += 2;
    }
  }
  std::vector<FetchRange> ranked(pieces.size() + 1);
  for (const RankedRange& r : joined) ranked[r.rank] = r.range;
  std::erase_if(ranked, [](const FetchRange& range) { return range.begin == range.end; });
  return ranked;
}

}  // namespace tetrakis::inline receiver
