// SPDX-License-Identifier: Apache-2.0
// GeoTIFF keys as text -> a GeoTIFF of one pixel in memory, of which GDAL says the CRS.
// Sources: docs/FORMAT.md, section 2 (`geo_keys`); OGC GeoTIFF 1.1 (19-008r4), section 7.1.
#include <atomic>
#include <charconv>
#include <initializer_list>
#include <optional>
#include <string_view>
#include <vector>

#include <cpl_conv.h>
#include <cpl_vsi.h>
#include <gdal_priv.h>
#include "apps/doors/gdal/crs.hpp"

namespace tetrakis::gdal {
namespace {

constexpr uint16_t kDoubles = 34736, kTexts = 34737;

/// The three tags of a GeoTIFF.
struct KeyTags {
  std::vector<uint16_t> directory{1, 1, 1, 0};  ///< revision 1.1.1, GeoTIFF 1.1; no keys yet
  std::vector<double> doubles;
  std::string texts;

  void add(uint16_t key, uint16_t place, size_t count, size_t value) {
    for (const size_t word : {size_t{key}, size_t{place}, count, value})
      directory.push_back(static_cast<uint16_t>(word));
    ++directory[3];
  }
};

template <class T>
std::optional<T> numberIn(std::string_view text) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// Takes what comes before one of `ends` off the front.
std::string_view takeUntil(std::string_view& rest, std::string_view ends) {
  const std::string_view word = rest.substr(0, rest.find_first_of(ends));
  rest.remove_prefix(word.size());
  return word;
}

/// Behind the opening quote; quotes inside are doubled.
bool takeText(std::string_view& rest, uint16_t key, KeyTags& tags) {
  std::string text;
  while (true) {
    text += takeUntil(rest, "\"");
    if (rest.empty()) return false;
    rest.remove_prefix(1);
    if (!rest.starts_with('"')) break;
    rest.remove_prefix(1);
    text += '"';
  }
  tags.add(key, kTexts, text.size() + 1, tags.texts.size());
  tags.texts += text + '|';
  return true;
}

bool takeValue(std::string_view& rest, uint16_t key, KeyTags& tags) {
  if (rest.starts_with('"')) {
    rest.remove_prefix(1);
    return takeText(rest, key, tags);
  }
  const std::string_view word = takeUntil(rest, " ");
  if (const auto code = numberIn<uint16_t>(word)) {
    tags.add(key, 0, 1, *code);
    return true;
  }
  const size_t first = tags.doubles.size();
  std::string_view numbers = word;
  while (true) {
    const auto number = numberIn<double>(takeUntil(numbers, ","));
    if (!number) return false;
    tags.doubles.push_back(*number);
    if (numbers.empty()) break;
    numbers.remove_prefix(1);
  }
  tags.add(key, kDoubles, tags.doubles.size() - first, first);
  return true;
}

std::optional<KeyTags> parseKeys(std::string_view rest) {
  constexpr size_t kMostWords = 65535;
  constexpr std::string_view kGeoTiff10 = "1.0 ";
  KeyTags tags;
  if (rest.starts_with(kGeoTiff10)) {
    tags.directory[2] = 0;
    rest.remove_prefix(kGeoTiff10.size());
  }
  while (!rest.empty()) {
    const auto key = numberIn<uint16_t>(takeUntil(rest, "= "));
    if (!key || !rest.starts_with('=')) return std::nullopt;
    rest.remove_prefix(1);
    if (!takeValue(rest, *key, tags)) return std::nullopt;
    if (!rest.empty() && !rest.starts_with(' ')) return std::nullopt;
    if (!rest.empty()) rest.remove_prefix(1);
  }
  if (tags.directory.size() > kMostWords || tags.texts.size() > kMostWords) return std::nullopt;
  return tags;
}

/// A classic TIFF in the machine's byte order. Its entries are 12 bytes each; values that take more
/// than 4 bytes lie behind them.
class TiffBytes {
 public:
  explicit TiffBytes(uint16_t entries) : values_at_(8 + 2 + 12u * entries + 4) {
    const uint16_t order = 1;
    const bool little = *reinterpret_cast<const uint8_t*>(&order) == 1;
    head_ = little ? "II" : "MM";
    put(head_, uint16_t{42});
    put(head_, uint32_t{8});
    put(head_, entries);
  }

  template <class T>
  void add(uint16_t tag, uint16_t type, const T* values, size_t count) {
    std::string bytes(reinterpret_cast<const char*>(values), count * sizeof(T));
    put(head_, tag);
    put(head_, type);
    put(head_, static_cast<uint32_t>(count));
    if (bytes.size() <= 4) {
      bytes.resize(4);
      head_ += bytes;
      return;
    }
    put(head_, static_cast<uint32_t>(values_at_ + values_.size()));
    bytes.resize((bytes.size() + 7) / 8 * 8);
    values_ += bytes;
  }

  std::string take() {
    put(head_, uint32_t{0});  // no other directory
    return head_ + values_;
  }

 private:
  template <class T>
  static void put(std::string& to, T value) {
    to.append(reinterpret_cast<const char*>(&value), sizeof value);
  }

  size_t values_at_;
  std::string head_, values_;
};

/// Width, height, bits and the like are 1; the strip is any byte of the file.
std::string tiffOf(const KeyTags& tags) {
  constexpr uint16_t kShort = 3, kAscii = 2, kDouble = 12, kOne = 1, kBits = 8;
  const bool doubles = !tags.doubles.empty(), texts = !tags.texts.empty();
  TiffBytes tiff(static_cast<uint16_t>(10 + doubles + texts));
  for (const uint16_t tag : std::initializer_list<uint16_t>{256, 257})
    tiff.add(tag, kShort, &kOne, 1);
  tiff.add(258, kShort, &kBits, 1);
  for (const uint16_t tag : std::initializer_list<uint16_t>{259, 262, 273, 277, 278, 279})
    tiff.add(tag, kShort, &kOne, 1);
  tiff.add(34735, kShort, tags.directory.data(), tags.directory.size());
  if (doubles) tiff.add(kDoubles, kDouble, tags.doubles.data(), tags.doubles.size());
  if (texts) tiff.add(kTexts, kAscii, tags.texts.c_str(), tags.texts.size() + 1);
  return tiff.take();
}

}  // namespace

SpatialReference readGeoKeys(const std::string& keys) {
  static std::atomic<unsigned> next{0};
  const std::optional<KeyTags> tags = parseKeys(keys);
  if (!tags) return nullptr;
  std::string bytes = tiffOf(*tags);
  const std::string name =
      CPLSPrintf("/vsimem/tetrakis_keys_%p_%u.tif", static_cast<void*>(bytes.data()), next++);
  VSILFILE* const file = VSIFileFromMemBuffer(name.c_str(), reinterpret_cast<GByte*>(bytes.data()),
                                              bytes.size(), FALSE);
  if (file == nullptr) return nullptr;
  VSIFCloseL(file);
  SpatialReference system;
  const char* const drivers[] = {"GTiff", nullptr};
  GDALDataset* const dataset = GDALDataset::Open(name.c_str(), GDAL_OF_RASTER, drivers);
  if (dataset != nullptr) {
    if (const OGRSpatialReference* found = dataset->GetSpatialRef()) system.reset(found->Clone());
    GDALClose(dataset);
  }
  VSIUnlink(name.c_str());
  return system;
}

}  // namespace tetrakis::gdal
