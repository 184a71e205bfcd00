// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/value_table_decoder.hpp"

#include "bitstream/coder/range_decoder.hpp"
#include "codec/geometry/value_table_pass.hpp"

namespace tetrakis::inline geometry {

namespace {

class TableDecoding {
 public:
  explicit TableDecoding(std::span<const uint8_t> codeword) : decoder_(codeword) {}
  bool decide(AdaptiveBit& model, bool) { return decoder_.decode(model); }
  bool even(bool) { return decoder_.decodeEven(); }
  bool stopped() const { return decoder_.exhausted(); }

 private:
  RangeDecoder decoder_;
};

}  // namespace

ValueTable decodeValueTable(std::span<const uint8_t> codeword, uint32_t values) {
  ValueTable table{std::vector<uint32_t>(values)};
  TableDecoding io(codeword);
  ValueTablePass<TableDecoding>(io).run(table.words);
  if (io.stopped()) return {};
  return table;
}

}  // namespace tetrakis::inline geometry
