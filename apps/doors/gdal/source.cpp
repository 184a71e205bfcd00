// SPDX-License-Identifier: Apache-2.0
#include "apps/doors/gdal/source.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include <cpl_error.h>
#include <cpl_string.h>

#include "apps/doors/gdal/cube.hpp"
#include "base/shown_text.hpp"

namespace tetrakis::gdal {
namespace {

/// A header without an index takes some hundred bytes, with a CRS as WKT two thousand. This is the
/// least that GDAL reads over a network.
constexpr uint64_t kHeaderGuess = 16384;

int errorNumber(tks_status status) {
  switch (status) {
    case TKS_USAGE:
      return CPLE_IllegalArg;
    case TKS_IO:
      return CPLE_FileIO;
    case TKS_UNSUPPORTED:
      return CPLE_NotSupported;
    case TKS_LIMIT:
    case TKS_NO_MEMORY:
      return CPLE_OutOfMemory;
    default:
      return CPLE_AppDefined;
  }
}

tks_limits limits() {
  // Memory is what counts: of large streams windows and levels may fit.
  tks_limits limits{};
  limits.size = sizeof limits;
  limits.max_samples = limits.max_texels = uint64_t{1} << 40;
  return limits;
}

}  // namespace

void reportFailure(tks_status status, const std::string& name, const std::string& sentence) {
  const std::string told =
      status == TKS_NO_MEMORY ? "There is not enough memory." : shownText(sentence);
  CPLError(CE_Failure, errorNumber(status), "%s: %s", shownText(name).c_str(), told.c_str());
}

std::string hexadecimal(std::span<const uint8_t, 4> bytes) {
  return CPLSPrintf("%02X%02X%02X%02X", bytes[3], bytes[2], bytes[1], bytes[0]);
}

std::unique_ptr<Source> Source::open(const std::string& name, const File& file,
                                     const Extent& extent, const OpenSettings& settings) {
  const std::optional<uint64_t> length = lengthOf(file);
  if (!length) {
    reportFailure(TKS_IO, name, "The length of the file cannot be found.");
    return nullptr;
  }
  const bool alone = extent.begin == 0;  // not in a sequence, which is cut as a file
  const uint64_t end = alone ? *length : std::min(*length, settings.bytes.value_or(UINT64_MAX));
  const uint64_t there = std::min(end - std::min(end, extent.begin), extent.size);
  std::unique_ptr<Source> source(new Source(name, settings, FileBytes(file, extent.begin)));
  source->chain_ = extent.chain;
  source->group_ = extent.group;
  if (!source->readHeader(there) || (alone && !source->cutBytes()) || !source->checkLength())
    return nullptr;
  source->checksum_ = extent.checksum.empty() ? source->checksumOfHeader() : extent.checksum;
  if (isGridOnCube(source->info_)) source->cube_depth_ = source->info_.forest.depth;
  return source;
}

std::optional<uint64_t> Source::findHeader() {
  tks_status status = TKS_TRUNCATED;
  uint64_t there = 0, wanted = kHeaderGuess;
  while (status == TKS_TRUNCATED && there < std::min(wanted, end_)) {
    there = std::min(wanted, end_);
    const tks_range front{0, there, 0};
    if (!read({&front, 1})) return std::nullopt;
    status = tks_header_bytes(bytes_.at(0).data(), there, &wanted);
  }
  return there;
}

bool Source::readHeader(uint64_t there) {
  end_ = there;
  const std::optional<uint64_t> header = chain_ ? end_ : findHeader();
  if (!header) return false;
  tks_status status = openPrefix(std::min(end_, std::max(kHeaderGuess, *header)));
  if (status == TKS_OK && info_.shows_sketch)
    status = openPrefix(std::min(end_, info_.header_bytes));
  if (end_ == 0) message_ = "There are no bytes.";
  if (status != TKS_OK && status != TKS_IO) reportFailure(status, name_, message_);
  return status == TKS_OK;
}

bool Source::cutBytes() {
  if (!settings_.bytes) return true;
  const uint64_t beside = info_.index == TKS_INDEX_NONE ? 0 : info_.header_bytes;
  end_ = beside + std::min(*settings_.bytes, end_ - beside);
  if (end_ >= info_.least_bytes)
    return reopen(std::min(end_, std::max(kHeaderGuess, info_.header_bytes)));
  reportFailure(
      TKS_TRUNCATED, name_,
      "BYTES ends inside the header, which takes " + std::to_string(info_.least_bytes) + " bytes.");
  return false;
}

std::string Source::checksumOfHeader() const {
  // The last four bytes of the header that is shown (docs/FORMAT.md, section 2).
  constexpr size_t kBytes = 4;
  const uint64_t end = info_.shows_sketch ? info_.least_bytes : info_.header_bytes;
  return hexadecimal(bytes_.at(end - kBytes).first<kBytes>());
}

void Source::rest() {
  decoder_.reset();
  opened_ = 0;
  has_whole_ = false;
  kept_.clear();
  cubes_.clear();
  bytes_.forget();
}

bool Source::checkLength() {
  has_index_ =
      info_.index != TKS_INDEX_NONE &&
      (info_.index_bytes == 0 || end_ - std::min(end_, info_.stream_bytes) >= info_.index_bytes);
  end_ = std::min(end_, info_.stream_bytes);
  if (!settings_.strict || complete()) return true;
  reportFailure(TKS_TRUNCATED, name_,
                "The stream ends early, and STRICT=YES refuses that: there are " +
                    std::to_string(end_) + " of " + std::to_string(info_.stream_bytes) + " bytes.");
  return false;
}

bool Source::read(std::span<const tks_range> ranges) {
  const std::optional<tks_range> missing = bytes_.read(ranges);
  if (!missing) return true;
  reportFailure(TKS_IO, name_,
                "Bytes " + std::to_string(missing->offset) + " to " +
                    std::to_string(missing->offset + missing->size - 1) +
                    " of the file cannot be read.");
  return false;
}

tks_status Source::openPrefix(uint64_t bytes) {
  decoder_.reset();
  has_whole_ = false;
  if (const tks_status status = openDecoder(bytes); status != TKS_OK) return status;
  opened_ = bytes;
  info_.size = sizeof info_;
  tks_set_threads(decoder_.get(), settings_.threads);
  const tks_status status = tks_get_info(decoder_.get(), &info_);
  return status == TKS_OK ? takeComponents() : status;
}

tks_status Source::openDecoder(uint64_t bytes) {
  const tks_limits most = limits();
  tks_decoder* opened = nullptr;
  if (chain_) {
    const tks_status status = chain_->open(group_, most, &opened);
    message_ = chain_->message();
    if (status == TKS_IO) reportFailure(status, name_, message_);
    decoder_ = DecoderPointer(opened, [](tks_decoder*) {});
    return status;
  }
  const tks_range all{0, bytes, 0};
  if (!read({&all, 1})) return TKS_IO;
  char sentence[512] = "";
  const tks_status status =
      tks_open(bytes_.at(0).data(), bytes, &most, &opened, sentence, sizeof sentence);
  message_ = sentence;
  decoder_ = DecoderPointer(opened, tks_close);
  return status;
}

bool Source::failed(tks_status status) {
  reportFailure(status, name_, decoder_ ? tks_message(decoder_.get()) : message_);
  return false;
}

bool Source::reopen(uint64_t bytes) {
  // A chain may have gone on to another group meanwhile.
  if (decoder_ && opened_ == bytes && !chain_) return true;
  const tks_status status = openPrefix(bytes);
  if (status == TKS_OK || status == TKS_IO) return status == TKS_OK;
  return failed(status);
}

std::optional<std::vector<tks_range>> Source::neededRanges(uint32_t level,
                                                           const tks_window* window) {
  const bool heights = part_ == TKS_PART_HEIGHTS;
  tks_ranges needed{};
  tks_status status = tks_set_levels(decoder_.get(), heights ? level : 0, heights ? 0 : level);
  if (status == TKS_OK) status = tks_needed_ranges(decoder_.get(), part_, window, &needed);
  if (status != TKS_OK) {
    failed(status);
    return std::nullopt;
  }
  std::vector<tks_range> ranges(needed.ranges, needed.ranges + needed.count);
  tks_free_ranges(&needed);
  return ranges;
}

std::optional<std::vector<tks_range>> Source::rangesFor(uint32_t level, const tks_window* window) {
  auto ranges = neededRanges(level, window);
  const auto lists_pages = [&] {
    return ranges && !ranges->empty() && ranges->back().offset >= info_.stream_bytes;
  };
  while (lists_pages()) {
    if (!loadRanges(*ranges, true)) return std::nullopt;
    ranges = neededRanges(level, window);
  }
  return ranges;
}

bool Source::loadRanges(const std::vector<tks_range>& ranges, bool whole) {
  // A decoder that has ranges borrows no bytes, and knows their tracks.
  const bool goes_on = whole && has_whole_;
  if (!goes_on) decoder_.reset();  // which may borrow bytes that move
  if (!read(ranges) || (!goes_on && !reopen(info_.header_bytes))) return false;
  opened_ = 0;
  has_whole_ = whole && !ranges.empty();
  std::vector<const uint8_t*> bytes;
  for (const tks_range& range : ranges) bytes.push_back(bytes_.at(range.offset).data());
  const tks_status status =
      tks_put_ranges(decoder_.get(), ranges.data(), bytes.data(), ranges.size());
  return status == TKS_OK || failed(status);
}

bool Source::cutShares(std::vector<tks_range>& ranges, uint64_t bytes) {
  // The last bit-planes are noise, which costs every sample alike: without the same number of bytes
  // each, regions err alike.
  const auto without = [&](uint64_t most) {
    std::vector<tks_range> cut = ranges;
    for (size_t i = 1; i < cut.size(); ++i) cut[i].size -= std::min(cut[i].size, most);
    return cut;
  };
  uint64_t least = 0, most = 0;
  for (const tks_range& range : ranges) most = std::max(most, range.size);
  while (least < most) {
    const uint64_t middle = least + (most - least) / 2;
    uint64_t sum = 0;
    for (const tks_range& range : without(middle)) sum += range.size;
    if (sum > bytes) {
      least = middle + 1;
    } else {
      most = middle;
    }
  }
  ranges = without(most);
  std::erase_if(ranges, [](const tks_range& range) { return range.size == 0; });
  return most > 0;
}

uint64_t Source::bytesOfOverviewAbove(uint32_t level) const {
  const uint64_t pixels = uint64_t{width(level + 1)} * height(level + 1);
  // Of several components any may have most of the first bytes. Shares of regions are not cut by
  // what their bytes are worth.
  uint64_t copies = 1;
  if (info_.index == TKS_INDEX_WINDOWS) copies = 2;
  if (info_.components > 1) copies = uint64_t{2} * info_.components;
  return copies * pixels * pixelBytes();
}

bool Source::load(uint32_t level, const tks_window* window) {
  if (settings_.strict && !verified_) {
    if (!reopen(end_)) return false;
    if (const tks_status sound = tks_verify(decoder_.get()); sound != TKS_OK) return failed(sound);
    verified_ = true;
  }
  if (chain_) return reopen(end_);
  // A prefix of a stream for windows lacks most regions: a level takes a first part of each.
  const bool pages = info_.index == TKS_INDEX_PAGES;
  const bool apart = info_.index == TKS_INDEX_WINDOWS;
  const bool cuts = level > 0 && !apart && !pages;
  const uint64_t enough = bytesOfOverviewAbove(level);
  const uint64_t first = cuts ? std::min(end_, info_.header_bytes + enough) : end_;
  if (!decoder_ && !reopen(std::min(first, info_.header_bytes))) return false;
  // Of a shorter file the first bytes are asked for, not what a window would need of all.
  if (!complete() || !has_index_) return reopen(first);
  const bool shares = level > 0 && apart && window == nullptr;
  if (opened_ == first && !shares) return true;
  auto ranges = rangesFor(level, window);
  if (!ranges) return false;
  if (shares && cutShares(*ranges, enough)) return loadRanges(*ranges, false);
  const bool most = window == nullptr && FileBytes::costOf(*ranges) >= first - first / 4;
  return most ? reopen(first) : loadRanges(*ranges, true);
}

StatedQuality Source::statedQuality() {
  StatedQuality quality;
  if (info_.lossless && complete()) {
    if (info_.has_heights) quality.heights_rmse = 0;
    if (info_.has_texture) quality.texture_psnr = std::numeric_limits<double>::infinity();
    return quality;
  }
  if (chain_) return {info_.heights_rmse, info_.texture_psnr};
  if (info_.index != TKS_INDEX_NONE && !VSIIsLocal(name_.c_str())) return quality;
  const tks_range all{0, end_, 0};
  decoder_.reset();  // which may borrow bytes that move
  has_whole_ = false;
  if (bytes_.read({&all, 1})) return quality;
  const tks_limits most = limits();
  tks_decoder* opened = nullptr;
  if (tks_open(bytes_.at(0).data(), end_, &most, &opened, nullptr, 0) != TKS_OK) return quality;
  const DecoderPointer decoder(opened, tks_close);
  tks_info info{};
  info.size = sizeof info;
  if (chooseIn(opened) == TKS_OK && tks_get_info(opened, &info) == TKS_OK)
    quality = {info.heights_rmse, info.texture_psnr};
  return quality;
}

}  // namespace tetrakis::gdal
