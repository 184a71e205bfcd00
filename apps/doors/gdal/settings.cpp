// SPDX-License-Identifier: Apache-2.0
#include "apps/doors/gdal/settings.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>

#include <cpl_conv.h>
#include <cpl_multiproc.h>
#include "tetrakis/sequence.h"

namespace tetrakis::gdal {

namespace {

std::optional<uint32_t> threadsOf(const char* text) {
  if (EQUAL(text, "ALL_CPUS")) return static_cast<uint32_t>(CPLGetNumCPUs());
  uint32_t number = 0;
  const char* const end = text + std::strlen(text);
  const auto [stop, error] = std::from_chars(text, end, number);
  const bool whole = error == std::errc() && stop == end && number >= 1 && number <= 1024;
  return whole ? std::optional(number) : std::nullopt;
}

/// Of a setting that is for all of GDAL, whose drivers differ in what they take.
uint32_t threadsOfAll() {
  const char* const given = CPLGetConfigOption("GDAL_NUM_THREADS", "1");
  const std::optional<uint32_t> number = threadsOf(given);
  if (!number) CPLDebug("TKS", "GDAL_NUM_THREADS=%s counts as 1 thread.", given);
  return number.value_or(1);
}

/// The options of one call, whose first mistake is reported.
class Options {
 public:
  Options(const std::string& name, CSLConstList options) : name_(name), options_(options) {}

  bool good() const { return good_; }
  const char* text(const char* key) const { return CSLFetchNameValue(options_, key); }

  uint64_t count(const char* key, const char* meaning) {
    const char* const given = text(key);
    if (given == nullptr) return 0;
    uint64_t value = 0;
    const char* const end = given + std::strlen(given);
    const auto [stop, error] = std::from_chars(given, end, value);
    if (error == std::errc() && stop == end && value > 0) return value;
    refuse(std::string(key) + "=" + given + " is no " + meaning + ".");
    return 0;
  }

  /// As the command line takes sizes (apps/tools/files/units.cpp): digits, then nothing or k, M or
  /// G for powers of 1024, as such or with B or iB.
  uint64_t bytes(const char* key) {
    const char* const given = text(key);
    if (given == nullptr) return 0;
    uint64_t value = 0;
    const auto [stop, error] = std::from_chars(given, given + std::strlen(given), value);
    constexpr const char* kSuffixes[3][3] = {
        {"k", "kB", "kiB"}, {"M", "MB", "MiB"}, {"G", "GB", "GiB"}};
    int bits = *stop == '\0' || EQUAL(stop, "B") ? 0 : -1;
    for (int power = 0; power < 3; ++power)
      for (const char* const suffix : kSuffixes[power])
        if (EQUAL(stop, suffix)) bits = 10 * (power + 1);
    if (error == std::errc() && value > 0 && bits >= 0 && value << bits >> bits == value)
      return value << bits;
    refuse(std::string(key) + "=" + given + " is no number of bytes.");
    return 0;
  }

  double number(const char* key, const char* meaning) {
    const char* const given = text(key);
    if (given == nullptr) return 0;
    char* stop = nullptr;
    const double value = CPLStrtod(given, &stop);
    if (*given != '\0' && *stop == '\0' && std::isfinite(value) && value >= 0) return value;
    refuse(std::string(key) + "=" + given + " is no " + meaning + ".");
    return 0;
  }

  /// Nothing if it is not given, or after a refusal.
  std::optional<bool> flag(const char* key) {
    const char* const given = text(key);
    if (given == nullptr) return std::nullopt;
    for (const char* const yes : {"YES", "TRUE", "ON", "1"})
      if (EQUAL(given, yes)) return true;
    for (const char* const no : {"NO", "FALSE", "OFF", "0"})
      if (EQUAL(given, no)) return false;
    refuse(std::string(key) + "=" + given + " is neither YES nor NO.");
    return std::nullopt;
  }

  uint32_t threads() {
    const char* const given = text("NUM_THREADS");
    if (given == nullptr) return threadsOfAll();
    if (const std::optional<uint32_t> number = threadsOf(given)) return *number;
    refuse(std::string("NUM_THREADS=") + given + " is neither a number of threads nor ALL_CPUS.");
    return 1;
  }

  void refuse(const std::string& sentence) {
    if (good_) reportFailure(TKS_USAGE, name_, sentence);
    good_ = false;
  }

 private:
  const std::string& name_;
  CSLConstList options_;
  bool good_ = true;
};

constexpr uint32_t kNoRegions = 1;  ///< of tks_encode_options

/// A power of two from 16 to `most`; 0 after a refusal.
uint32_t sideGiven(Options& options, const char* key, uint32_t most) {
  const uint64_t side = options.count(key, "side");
  if (side >= 16 && side <= most && (side & (side - 1)) == 0) return static_cast<uint32_t>(side);
  options.refuse(std::string(key) + "=" + options.text(key) + " is neither a power of two from 16" +
                 " to " + std::to_string(most) + " nor NONE.");
  return 0;
}

/// What BLOCKSIZE says of regions.
uint32_t regions(Options& options) {
  const char* const given = options.text("BLOCKSIZE");
  if (given == nullptr) return 0;
  if (EQUAL(given, "NONE")) return kNoRegions;
  return sideGiven(options, "BLOCKSIZE", 1 << 20);
}

/// Nothing if it is to be chosen, or after a refusal.
std::optional<uint32_t> tilesGiven(Options& options) {
  const char* const given = options.text("TILES");
  if (given == nullptr || EQUAL(given, "AUTO")) return std::nullopt;
  if (EQUAL(given, "NONE")) return 0;
  return sideGiven(options, "TILES", 1 << 14);
}

/// Nothing if none is given, or after a refusal.
std::optional<tks_index> indexKind(Options& options) {
  const char* const given = options.text("INDEX");
  if (given == nullptr) return std::nullopt;
  if (EQUAL(given, "NO")) return TKS_INDEX_NONE;
  if (EQUAL(given, "YES")) return TKS_INDEX_PACKETS;
  if (EQUAL(given, "WINDOWS")) return TKS_INDEX_WINDOWS;
  options.refuse(std::string("INDEX=") + given + " is none of NO, YES and WINDOWS.");
  return std::nullopt;
}

/// Nothing if the columns are to say it, or after a refusal.
std::optional<tks_domain> domainGiven(Options& options) {
  const char* const given = options.text("DOMAIN");
  if (given == nullptr || EQUAL(given, "AUTO")) return std::nullopt;
  if (EQUAL(given, "PLANE")) return TKS_DOMAIN_PLANE;
  if (EQUAL(given, "CYLINDER")) return TKS_DOMAIN_CYLINDER;
  if (EQUAL(given, "CUBE")) return TKS_DOMAIN_FOREST;
  options.refuse(std::string("DOMAIN=") + given + " is none of AUTO, PLANE, CYLINDER and CUBE.");
  return std::nullopt;
}

/// Of a cube; 0 if it is to be chosen, or after a refusal.
uint32_t depthGiven(Options& options) {
  const uint64_t depth = options.count("DEPTH", "depth of a cube, which is from 1 to 14");
  if (depth <= TKS_MOST_CUBE_DEPTH) return static_cast<uint32_t>(depth);
  options.refuse("DEPTH=" + std::to_string(depth) +
                 " is no depth of a cube, which is from 1 to 14.");
  return 0;
}

/// A cube has other samples than the source.
void checkCube(Options& options, const CopySettings& settings) {
  if (settings.domain != TKS_DOMAIN_FOREST) {
    if (options.text("DEPTH") != nullptr)
      options.refuse("DEPTH is about a cube: give DOMAIN=CUBE.");
    return;
  }
  if (settings.encode.lossless || settings.max_z_error > 0)
    options.refuse(
        "DOMAIN=CUBE resamples heights, so that nothing is lossless or within MAX_Z_ERROR: give "
        "BYTES or PSNR.");
}

/// What is to be kept of the samples.
void takeTarget(Options& options, CopySettings& settings) {
  tks_encode_options& encode = settings.encode;
  settings.max_z_error = options.number("MAX_Z_ERROR", "error of at least 0");
  encode.bytes = options.bytes("BYTES");
  encode.psnr = options.number("PSNR", "number of decibels");
  const bool error = options.text("MAX_Z_ERROR") != nullptr;
  const bool bytes = options.text("BYTES") != nullptr, psnr = options.text("PSNR") != nullptr;
  const std::optional<bool> lossless = options.flag("LOSSLESS");
  if (error + bytes + psnr > 1)
    options.refuse("MAX_Z_ERROR, BYTES and PSNR exclude each other; give one of them.");
  if (psnr && encode.psnr == 0) options.refuse("PSNR must be more than 0.");
  encode.lossless = !bytes && !psnr && settings.max_z_error == 0;
  if (lossless.value_or(false) && !encode.lossless)
    options.refuse("LOSSLESS=YES excludes MAX_Z_ERROR, BYTES and PSNR.");
  if (!lossless.value_or(true) && encode.lossless)
    options.refuse("LOSSLESS=NO needs MAX_Z_ERROR, BYTES or PSNR, which say how much is kept.");
}

/// A sequence has frames of heights, which are coded in memory.
bool framesGiven(Options& options, const CopySettings& settings) {
  if (!options.flag("FRAMES").value_or(false)) return false;
  for (const char* const key : {"TEXTURE", "WHITE_LEVEL", "TILES"})
    if (options.text(key) != nullptr)
      options.refuse(std::string("FRAMES=YES makes a sequence of heights, and ") + key +
                     " does not go with it.");
  if (settings.domain == TKS_DOMAIN_FOREST)
    options.refuse("FRAMES=YES makes a sequence, which has no DOMAIN=CUBE.");
  return true;
}

/// What groups of frames go on from.
void takeReference(Options& options, CopySettings& settings) {
  const char* const given = options.text("REFERENCE");
  if (given != nullptr && EQUAL(given, "ALL")) {
    settings.reference = TKS_ALL_BYTES;
  } else if (given != nullptr && !EQUAL(given, "NONE")) {
    settings.reference = options.bytes("REFERENCE");
  }
  constexpr uint64_t kMost = TKS_MOST_DEPTH + 1;
  const uint64_t entry = options.count("ENTRY", "number of groups, which is from 1 to 64");
  if (entry > kMost)
    options.refuse("ENTRY=" + std::to_string(entry) + " is no number of groups from 1 to 64.");
  settings.entry = static_cast<uint32_t>(std::min(entry, kMost));
  if (entry > 0 && settings.reference == 0)
    options.refuse("ENTRY is about groups that go on from others: give REFERENCE.");
  if (settings.reference > 0 && !settings.frames)
    options.refuse("REFERENCE is about groups of frames: give FRAMES=YES.");
}

std::string textureName(Options& options) {
  const char* const given = options.text("TEXTURE");
  if (given != nullptr && *given == '\0') options.refuse("TEXTURE= names no dataset.");
  return given != nullptr ? given : "";
}

}  // namespace

std::optional<OpenSettings> openSettings(const std::string& name, CSLConstList options) {
  Options given(name, options);
  OpenSettings settings;
  if (given.text("BYTES") != nullptr) settings.bytes = given.bytes("BYTES");
  settings.strict = given.flag("STRICT").value_or(false);
  settings.threads = given.threads();
  if (const char* const component = given.text("COMPONENT")) {
    settings.component = component;
    if (settings.component.empty()) given.refuse("COMPONENT= names no component.");
  }
  if (settings.strict && settings.bytes)
    given.refuse("BYTES and STRICT=YES exclude each other: one cuts the stream, one wants all.");
  return given.good() ? std::optional(settings) : std::nullopt;
}

std::optional<CopySettings> copySettings(const std::string& name, CSLConstList options) {
  Options given(name, options);
  CopySettings settings{};
  tks_encode_options& encode = settings.encode;
  encode.size = sizeof encode;
  takeTarget(given, settings);
  encode.regions = regions(given);
  settings.tiles = tilesGiven(given);
  settings.index = indexKind(given);
  if (settings.index == TKS_INDEX_WINDOWS && encode.regions == kNoRegions)
    given.refuse("INDEX=WINDOWS lays out regions, and BLOCKSIZE=NONE says that there are none.");
  encode.threads = given.threads();
  settings.domain = domainGiven(given);
  settings.depth = depthGiven(given);
  settings.texture = textureName(given);
  settings.frames = framesGiven(given, settings);
  takeReference(given, settings);
  checkCube(given, settings);
  const uint64_t white = given.count("WHITE_LEVEL", "value of UInt16 above 0");
  settings.white_level = static_cast<uint32_t>(std::min<uint64_t>(white, UINT32_MAX));
  return given.good() ? std::optional(settings) : std::nullopt;
}

}  // namespace tetrakis::gdal
