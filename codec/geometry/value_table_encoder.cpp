// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/value_table_encoder.hpp"

#include "bitstream/coder/range_encoder.hpp"
#include "codec/geometry/value_table_pass.hpp"

namespace tetrakis::inline geometry {

namespace {

class TableEncoding {
 public:
  bool decide(AdaptiveBit& model, bool answer) {
    encoder_.encode(model, answer);
    return answer;
  }
  bool even(bool answer) {
    encoder_.encodeEven(answer);
    return answer;
  }
  bool stopped() const { return false; }
  std::vector<uint8_t> finish() { return encoder_.finish(); }

 private:
  RangeEncoder encoder_;
};

}  // namespace

std::vector<uint8_t> encodeValueTable(const ValueTable& table) {
  TableEncoding io;
  std::vector<uint32_t> words = table.words;
  ValueTablePass<TableEncoding>(io).run(words);
  return io.finish();
}

}  // namespace tetrakis::inline geometry
