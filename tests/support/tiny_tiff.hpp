// SPDX-License-Identifier: Apache-2.0
// Uncompressed single-strip TIFF files built tag by tag (TIFF 6.0, section 2), to test readers with
// files that no writer of ours would make. Little endian.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <vector>

namespace tetrakis::test {

class TinyTiff {
 public:
  enum Type : uint16_t { kAscii = 2, kShort = 3, kLong = 4, kDouble = 12 };
  enum Tag : uint16_t {
    kSubfileType = 254,
    kWidth = 256,
    kHeight = 257,
    kBitsPerSample = 258,
    kCompression = 259,
    kPhotometric = 262,
    kStripOffsets = 273,
    kOrientation = 274,
    kSamplesPerPixel = 277,
    kRowsPerStrip = 278,
    kStripByteCounts = 279,
    kInkSet = 332,
    kExtraSamples = 338,
    kColorMap = 320,
    kSampleFormat = 339,
    kGdalMetadata = 42112,
    kGdalNodata = 42113
  };

  TinyTiff(uint32_t width, uint32_t height, uint16_t channels, uint16_t bits,
           std::vector<uint8_t> pixels)
      : pixels_(std::move(pixels)) {
    longs(kWidth, {width});
    longs(kHeight, {height});
    shorts(kBitsPerSample, std::vector<uint16_t>(channels, bits));
    shorts(kCompression, {1});
    shorts(kPhotometric, {uint16_t(channels < 3 ? 1 : 2)});
    shorts(kSamplesPerPixel, {channels});
    longs(kRowsPerStrip, {height});
    longs(kStripOffsets, {kHeader});
    longs(kStripByteCounts, {uint32_t(pixels_.size())});
  }

  void shorts(uint16_t tag, const std::vector<uint16_t>& values) { set(tag, kShort, values); }
  void longs(uint16_t tag, const std::vector<uint32_t>& values) { set(tag, kLong, values); }
  void doubles(uint16_t tag, const std::vector<double>& values) { set(tag, kDouble, values); }
  void ascii(uint16_t tag, const std::string& text) {
    set(tag, kAscii, std::vector<char>(text.c_str(), text.c_str() + text.size() + 1));
  }
  void remove(uint16_t tag) { entries_.erase(tag); }

  /// Follows this picture in the file.
  void addPage(const TinyTiff& page) { pages_.push_back(page); }

  /// Header, then for each page pixels, values longer than four bytes, directory.
  std::vector<uint8_t> bytes() const {
    std::vector<uint8_t> file(kHeader);
    std::copy_n("II\x2A\0", 4, file.begin());
    uint32_t link = appendTo(file, 4);
    for (TinyTiff page : pages_) {
      if (file.size() % 2 != 0) file.push_back(0);
      page.longs(kStripOffsets, {uint32_t(file.size())});
      link = page.appendTo(file, link);
    }
    return file;
  }

 private:
  static constexpr uint32_t kHeader = 8;
  struct Entry {
    uint16_t type = 0;
    uint32_t count = 0;
    std::vector<uint8_t> value;
  };

  /// Lets the offset at `link` point to this page, and returns where that of the next one stands.
  uint32_t appendTo(std::vector<uint8_t>& file, uint32_t link) const {
    file.insert(file.end(), pixels_.begin(), pixels_.end());
    std::vector<uint8_t> directory;
    put(directory, uint16_t(entries_.size()));
    for (const auto& [tag, entry] : entries_) {
      put(directory, tag);
      put(directory, entry.type);
      put(directory, entry.count);
      std::vector<uint8_t> value = entry.value;
      if (value.size() > 4) {
        if (file.size() % 2 != 0) file.push_back(0);
        const auto offset = uint32_t(file.size());
        file.insert(file.end(), value.begin(), value.end());
        value.clear();
        put(value, offset);
      }
      value.resize(4);
      directory.insert(directory.end(), value.begin(), value.end());
    }
    put(directory, uint32_t{0});
    if (file.size() % 2 != 0) file.push_back(0);
    const auto start = uint32_t(file.size());
    std::memcpy(file.data() + link, &start, 4);
    file.insert(file.end(), directory.begin(), directory.end());
    return uint32_t(file.size() - 4);
  }

  template <class T>
  static void put(std::vector<uint8_t>& to, T value) {
    const auto* bytes = reinterpret_cast<const uint8_t*>(&value);
    to.insert(to.end(), bytes, bytes + sizeof(T));
  }

  template <class T>
  void set(uint16_t tag, Type type, const std::vector<T>& values) {
    Entry entry{type, uint32_t(values.size()), {}};
    for (const T value : values) put(entry.value, value);
    entries_[tag] = entry;
  }

  std::vector<uint8_t> pixels_;
  std::map<uint16_t, Entry> entries_;
  std::vector<TinyTiff> pages_;
};

}  // namespace tetrakis::test
