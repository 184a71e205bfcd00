// SPDX-License-Identifier: Apache-2.0
// Reference decoder: tables of values (docs/FORMAT.md, sections 8.1 and 9).
#include <array>
#include <list>

#include "conformance/reference_decoder/layers.hpp"
#include "conformance/reference_decoder/range_decoder.hpp"

namespace tetrakis::reference {
namespace {

/// FORMAT 8.1, "Table of values".
class TableDecoder {
 public:
  explicit TableDecoder(std::span<const uint8_t> codeword) : decoder_(codeword) {}

  std::vector<uint32_t> table(uint32_t values, int bits) {
    std::vector<uint32_t> words;
    for (uint32_t i = 0; i < values; ++i)
      words.push_back(i == 0 ? firstWord(bits) : words.back() + gap());
    return words;
  }

 private:
  uint32_t firstWord(int bits) {
    uint32_t word = 0;
    for (int i = 0; i < bits; ++i) word = 2 * word + static_cast<uint32_t>(decoder_.even());
    return word;
  }

  uint32_t gap() {
    int place = 0;
    for (auto known = recent_.begin(); known != recent_.end(); ++known, ++place) {
      if (!hit_[place_][place].decode(decoder_)) continue;
      recent_.splice(recent_.begin(), recent_, known);
      place_ = place;
      return recent_.front();
    }
    place_ = place;
    const int k = 1 + ones(31, [&](int i) { return more_[bits_][i].decode(decoder_); });
    bits_ = k;
    recent_.pop_back();
    recent_.push_front(digits(k, [&](int, uint32_t number) {
      return number < 8 ? high_[k][number].decode(decoder_) : decoder_.even();
    }));
    return recent_.front();
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
  try {
    for (size_t i = 0; i < values.size(); ++i) tables[i] = decoder.table(values[i], bits);
  } catch (Undecided) {
  }
  return tables;
}

}  // namespace tetrakis::reference
