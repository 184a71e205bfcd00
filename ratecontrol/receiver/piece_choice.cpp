// SPDX-License-Identifier: Apache-2.0
#include "ratecontrol/receiver/fetch_plan.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "base/heap_sort.hpp"

namespace tetrakis::inline receiver {

namespace {

Choice chooseFirst(std::span<const Piece> pieces, std::span<const uint32_t> order, uint64_t bytes) {
  Choice chosen(pieces.size());
  for (const uint32_t i : order) {
    chosen[i] = std::min(bytes, pieces[i].size());
    bytes -= chosen[i];
  }
  return chosen;
}

/// The pieces that are worth most where a byte costs `price`, and each run of pieces as much as
/// `request` bytes. A run goes on over pieces that are worth less, or are there, where that is
/// cheaper than to begin another one. The best choice, by dynamic programming.
Choice chooseRuns(std::span<const Piece> pieces, double price, double request) {
  // What the best choice gains from the pieces so far, if the last one is in a run and if not.
  double in = -std::numeric_limits<double>::infinity(), out = 0;
  std::vector<bool> goes_on(pieces.size()), ends(pieces.size());
  for (size_t i = 0; i < pieces.size(); ++i) {
    const double begun = out - price * request, before = std::max(in, begun);
    goes_on[i] = in >= begun;
    ends[i] = in > out;
    out = std::max(out, in);
    in = before + (pieces[i].worth.all - price) * static_cast<double>(pieces[i].size());
  }
  Choice chosen(pieces.size());
  bool is_in = in > out;
  for (size_t i = pieces.size(); i-- > 0;) {
    if (is_in) chosen[i] = pieces[i].size();
    is_in = is_in ? goes_on[i] : ends[i];
  }
  return chosen;
}

uint64_t bytesOf(const Choice& choice) {
  return std::accumulate(choice.begin(), choice.end(), uint64_t{0});
}

/// Runs at the lowest price for which they have no more than so many bytes. Nothing where the first
/// packet alone has more.
Choice chooseRequests(std::span<const Piece> pieces, std::span<const uint32_t> order,
                      const FetchLimits& limits) {
  const auto request = static_cast<double>(limits.request_bytes);
  const auto priced = [&](size_t rank) {
    constexpr double kBelow = 0.999;  // the piece itself, and those like it, are worth more
    return chooseRuns(pieces, kBelow * pieces[order[rank]].worth.all, request);
  };
  // Of pieces that help nobody none is worth a request.
  size_t fitting = 0, count = order.size();
  while (count > 0 && !(pieces[order[count - 1]].worth.all > 0)) --count;
  Choice best(pieces.size());
  while (fitting < count) {
    const size_t rank = fitting + (count - fitting) / 2;
    Choice choice = priced(rank);
    if (bytesOf(choice) > limits.bytes) {
      count = rank;
      continue;
    }
    best = std::move(choice);
    fitting = rank + 1;
  }
  return best;
}

/// Where no run is worth its request: the one of so many bytes that helps most, from one piece that
/// helps to another. Where all that help are longer, the first bytes of the most helpful one.
Choice chooseOne(std::span<const Piece> pieces, std::span<const uint32_t> order, uint64_t bytes) {
  Choice chosen(pieces.size());
  if (order.empty()) return chosen;
  const auto counts = [&](size_t i) {
    return pieces[i].is_missing && pieces[i].helps() == pieces[order[0]].helps();
  };
  const auto gain = [&](size_t i) {
    return counts(i) ? pieces[i].worth.all * static_cast<double>(pieces[i].size()) : 0;
  };
  size_t first = order[0], last = order[0];
  double sum = 0, most = 0;
  for (size_t begin = 0, end = 0; end < pieces.size(); ++end) {
    sum += gain(end);
    for (; pieces[end].end - pieces[begin].begin > bytes && begin < end; ++begin)
      sum -= gain(begin);
    if (!(sum > most) || pieces[end].end - pieces[begin].begin > bytes) continue;
    most = sum;
    first = begin;
    last = end;
  }
  while (first < last && !counts(first)) ++first;
  while (first < last && !counts(last)) --last;
  for (size_t i = first; i <= last; ++i) {
    chosen[i] = std::min(bytes, pieces[i].size());
    bytes -= chosen[i];
  }
  return chosen;
}

/// Runs go on with what helps, up to so many bytes: no request is left over for the last ones.
Choice grown(Choice chosen, std::span<const Piece> pieces, std::span<const uint32_t> order,
             uint64_t bytes) {
  uint64_t left = bytes - bytesOf(chosen);
  for (const uint32_t i : order) {
    const bool follows = i > 0 && chosen[i - 1] == pieces[i - 1].size();
    if (chosen[i] > 0 || !follows || !pieces[i].helps()) continue;
    chosen[i] = std::min(left, pieces[i].size());
    left -= chosen[i];
  }
  return chosen;
}

}  // namespace

std::vector<uint32_t> rankedPieces(std::span<const Piece> pieces) {
  std::vector<uint32_t> order;
  for (uint32_t i = 0; i < pieces.size(); ++i)
    if (pieces[i].is_missing) order.push_back(i);
  heapSort(order, [&](uint32_t i, uint32_t j) {
    const PacketWorth &a = pieces[i].worth, &b = pieces[j].worth;
    return helpsMore(a, b) || (!helpsMore(b, a) && i < j);
  });
  return order;
}

Choice choosePieces(std::span<const Piece> pieces, std::span<const uint32_t> order,
                    const FetchLimits& limits) {
  if (limits.request_bytes == 0) return chooseFirst(pieces, order, limits.bytes);
  Choice chosen = chooseRequests(pieces, order, limits);
  if (bytesOf(chosen) == 0) chosen = chooseOne(pieces, order, limits.bytes);
  return grown(std::move(chosen), pieces, order, limits.bytes);
}

}  // namespace tetrakis::inline receiver
