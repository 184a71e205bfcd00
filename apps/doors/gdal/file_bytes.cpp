// SPDX-License-Identifier: Apache-2.0
#include "apps/doors/gdal/file_bytes.hpp"

#include <algorithm>
#include <iterator>

#include <cpl_error.h>

namespace tetrakis::gdal {
namespace {

/// Another request would take longer than such a gap, however fast the network.
constexpr uint64_t kGap = 8192;
/// What a round trip of 100 ms takes of 10 Mbit/s: wider gaps are never worth it.
constexpr uint64_t kWidestGap = 131072;
constexpr size_t kMostRequests = 64;

uint64_t endOf(const tks_range& range) {
  return range.offset + range.size;
}

/// Ranges that lie so near each other become one.
std::vector<tks_range> joined(const std::vector<tks_range>& ranges, uint64_t gap) {
  std::vector<tks_range> result;
  for (const tks_range& range : ranges) {
    if (!result.empty() && range.offset - endOf(result.back()) <= gap) {
      result.back().size = endOf(range) - result.back().offset;
    } else {
      result.push_back(range);
    }
  }
  return result;
}

/// Few requests. The narrowest gaps are read along, while they add at most a quarter to the bytes
/// that are wanted, or there are too many requests.
std::vector<tks_range> requestsFor(const std::vector<tks_range>& ranges) {
  const std::vector<tks_range> requests = joined(ranges, kGap);
  std::vector<uint64_t> gaps;
  for (size_t i = 1; i < requests.size(); ++i)
    gaps.push_back(requests[i].offset - endOf(requests[i - 1]));
  std::sort(gaps.begin(), gaps.end());
  uint64_t spare = 0, widest = kGap;
  for (const tks_range& range : requests) spare += range.size / 4;
  for (size_t i = 0; i < gaps.size(); ++i) {
    const bool cheap = gaps[i] <= std::min(spare, kWidestGap);
    if (!cheap && gaps.size() - i < kMostRequests) break;
    spare -= std::min(spare, gaps[i]);
    widest = gaps[i];
  }
  return joined(requests, widest);
}

bool readOne(VSILFILE* file, uint64_t begin, const tks_range& range, std::vector<uint8_t>& bytes) {
  return VSIFSeekL(file, begin + range.offset, SEEK_SET) == 0 &&
         VSIFReadL(bytes.data(), 1, bytes.size(), file) == bytes.size();
}

/// Side by side where the kind of file can, else one after the other. A single range GDAL would
/// read through a cache of its own, in pieces of 16 kB, but two that touch are one request of their
/// size.
bool readSideBySide(VSILFILE* file, uint64_t begin, const std::vector<tks_range>& requests,
                    std::vector<std::vector<uint8_t>>& bytes) {
  std::vector<void*> data;
  std::vector<vsi_l_offset> offsets;
  std::vector<size_t> sizes;
  const auto ask = [&](size_t request, size_t from, size_t size) {
    data.push_back(bytes[request].data() + from);
    offsets.push_back(begin + requests[request].offset + from);
    sizes.push_back(size);
  };
  for (size_t i = 0; i < requests.size(); ++i) {
    const size_t size = bytes[i].size(), half = requests.size() == 1 ? size / 2 : 0;
    if (half > 0) ask(i, 0, half);
    ask(i, half, size - half);
  }
  CPLPushErrorHandler(CPLQuietErrorHandler);
  const int failed = VSIFReadMultiRangeL(static_cast<int>(data.size()), data.data(), offsets.data(),
                                         sizes.data(), file);
  CPLPopErrorHandler();
  return failed == 0;
}

}  // namespace

std::optional<uint64_t> lengthOf(const File& file) {
  if (VSIFSeekL(file.get(), 0, SEEK_END) != 0) return std::nullopt;
  return VSIFTellL(file.get());
}

std::span<const uint8_t> FileBytes::at(uint64_t place) const {
  const auto after = runs_.upper_bound(place);
  if (after == runs_.begin()) return {};
  const auto& [begin, run] = *std::prev(after);
  return place - begin < run.size() ? std::span(run).subspan(place - begin)
                                    : std::span<const uint8_t>();
}

std::vector<tks_range> FileBytes::missingOf(std::span<const tks_range> ranges) const {
  std::vector<tks_range> missing;
  for (const tks_range& range : ranges) {
    for (uint64_t place = range.offset; place < endOf(range);) {
      place += at(place).size();
      if (place >= endOf(range)) break;
      const auto next = runs_.upper_bound(place);
      const uint64_t end = next == runs_.end() ? endOf(range) : std::min(endOf(range), next->first);
      missing.push_back({place, end - place, 0});
      place = end;
    }
  }
  return missing;
}

uint64_t FileBytes::costOf(std::span<const tks_range> ranges) {
  uint64_t bytes = 0;
  for (const tks_range& range : requestsFor({ranges.begin(), ranges.end()})) bytes += range.size;
  return bytes;
}

void FileBytes::take(uint64_t place, std::vector<uint8_t>&& bytes) {
  auto next = runs_.upper_bound(place);
  if (next != runs_.begin()) {
    auto& [begin, run] = *std::prev(next);
    if (begin + run.size() >= place) {  // what is there already stays
      const uint64_t known = begin + run.size() - place;
      if (known < bytes.size())
        run.insert(run.end(), bytes.begin() + static_cast<ptrdiff_t>(known), bytes.end());
      next = std::prev(next);
    } else {
      next = runs_.emplace_hint(next, place, std::move(bytes));
    }
  } else {
    next = runs_.emplace_hint(next, place, std::move(bytes));
  }
  const auto run = next;
  for (auto after = std::next(run); after != runs_.end(); after = runs_.erase(after)) {
    const uint64_t end = run->first + run->second.size();
    if (after->first > end) return;
    const uint64_t known = end - after->first;
    if (known < after->second.size()) {
      run->second.insert(run->second.end(), after->second.begin() + static_cast<ptrdiff_t>(known),
                         after->second.end());
    }
  }
}

std::optional<tks_range> FileBytes::read(std::span<const tks_range> ranges) {
  // No byte is read twice: gaps that are read along may hold some that are there.
  const std::vector<tks_range> requests = missingOf(requestsFor(missingOf(ranges)));
  std::vector<std::vector<uint8_t>> bytes;
  for (const tks_range& request : requests) bytes.emplace_back(request.size);
  // GDAL keeps the first bytes, by which it knows formats; of others it would read more than asked.
  const bool first = requests.size() == 1 && begin_ + requests.front().offset == 0;
  const bool together =
      !first && !requests.empty() && readSideBySide(file_.get(), begin_, requests, bytes);
  for (size_t i = 0; i < requests.size(); ++i) {
    if (!together && !readOne(file_.get(), begin_, requests[i], bytes[i])) return requests[i];
    take(requests[i].offset, std::move(bytes[i]));
  }
  return std::nullopt;
}

}  // namespace tetrakis::gdal
