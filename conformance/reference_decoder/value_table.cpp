// SPDX-License-Identifier: Apache-2.0
// Reference decoder: tables of values (docs/FORMAT.md, sections 8.1 and 9).
#include <array>
#include <list>
#include <optional>

#include "conformance/reference_decoder/layers.hpp"
#include "conformance/reference_decoder/range_decoder.hpp"

namespace tetrakis::reference {
namespace {

/// FORMAT 8.1, "Table of values".
class TableDecoder {
 public:
  explicit TableDecoder(std::span<const uint8_t> codeword) : decoder_(codeword) {}

  /// Nothing: a decision does not count.
  std::optional<std::vector<uint32_t>> table(uint32_t values, int bits) {
    std::vector<uint32_t> words;
    for (uint32_t i = 0; i < values; ++i) {
      const std::optional<uint32_t> next = i == 0 ? firstWord(bits) : gap();
      if (!next) return std::nullopt;
      words.push_back(i == 0 ? *next : words.back() + *next);
    }
    return words;
  }

 private:
  std::optional<uint32_t> firstWord(int bits) {
    uint32_t word = 0;
    for (int i = 0; i < bits; ++i) {
      const std::optional<int> bit = decoder_.decode(1 << 15);
      if (!bit) return std::nullopt;
      word = 2 * word + static_cast<uint32_t>(*bit);
    }
    return word;
  }

  std::optional<uint32_t> gap() {
    int place = 0;
    for (auto known = recent_.begin(); known != recent_.end(); ++known, ++place) {
      const std::optional<int> hit = hit_[place_][place].decode(decoder_);
      if (!hit) return std::nullopt;
      if (!*hit) continue;
      recent_.splice(recent_.begin(), recent_, known);
      place_ = place;
      return recent_.front();
    }
    place_ = place;
    const std::optional<uint32_t> fresh = freshGap();
    if (!fresh) return std::nullopt;
    recent_.pop_back();
    recent_.push_front(*fresh);
    return fresh;
  }

  std::optional<uint32_t> freshGap() {
    int k = 1;
    for (; k < 32; ++k) {
      const std::optional<int> more = more_[bits_][k - 1].decode(decoder_);
      if (!more) return std::nullopt;
      if (!*more) break;
    }
    bits_ = k;
    uint32_t gap = 1;
    for (int i = 1; i < k; ++i) {
      const std::optional<int> bit =
          gap < 8 ? high_[k][gap].decode(decoder_) : decoder_.decode(1 << 15);
      if (!bit) return std::nullopt;
      gap = 2 * gap + static_cast<uint32_t>(*bit);
    }
    return gap;
  }

  RangeDecoder decoder_;
  std::list<uint32_t> recent_ = {1, 2, 3, 4, 5, 6, 7, 8};
  int place_ = 0, bits_ = 0;
  std::array<std::array<Model, 8>, 9> hit_;
  std::array<std::array<Model, 32>, 33> more_;
  std::array<std::array<Model, 8>, 33> high_;
};

}  // namespace

std::vector<std::vector<uint32_t>> decodeTables(std::span<const uint8_t> codeword,
                                                const std::vector<uint32_t>& values, int bits) {
  TableDecoder decoder(codeword);
  std::vector<std::vector<uint32_t>> tables(values.size());
  for (size_t i = 0; i < values.size(); ++i) {
    const std::optional<std::vector<uint32_t>> table = decoder.table(values[i], bits);
    if (!table) break;
    tables[i] = *table;
  }
  return tables;
}

}  // namespace tetrakis::reference
