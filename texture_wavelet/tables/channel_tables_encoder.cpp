// SPDX-License-Identifier: Apache-2.0
#include "texture_wavelet/tables/channel_tables_encoder.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/portable_math.hpp"
#include "bitstream/coder/range_encoder.hpp"
#include "bitstream/coder/value_table_pass.hpp"

namespace tetrakis::inline tables {

namespace {

/// Bits a sample that a table has to save. A larger number misses tables that save bytes; with a
/// smaller one tables take the time of trials in vain.
constexpr double kLeastSaved = 1. / 32;

/// How many samples of a channel have each value.
std::vector<uint32_t> countsOf(const Texels& texels, uint32_t channel, Mask coded) {
  std::vector<uint32_t> counts(size_t{texels.most()} + 1);
  const uint16_t* sample = texels.samples.data() + channel;
  const size_t count = texels.extent().samples();
  for (size_t i = 0; i < count; ++i, sample += texels.channels) counts[*sample] += coded[i];
  return counts;
}

/// A table, and what it does.
struct Table {
  std::vector<uint16_t> values;
  double saved = 0;    ///< about how many bits a sample
  double squares = 1;  ///< FewValues::squares
};

/// Noise around a value spreads over as many places fewer as its gaps are wide. Gaps count by their
/// logarithms: one texel far above all others is no reason to think that all are far from each
/// other.
Table tableOf(const std::vector<uint32_t>& counts) {
  Table table;
  for (size_t v = 0; v < counts.size(); ++v)
    if (counts[v] > 0) table.values.push_back(static_cast<uint16_t>(v));
  double weights = 0, saved = 0;
  for (size_t i = 0; i < table.values.size(); ++i) {
    for (const size_t above : {i, i + 1}) {
      if (above == 0 || above == table.values.size()) continue;
      const double gap = table.values[above] - table.values[above - 1];
      const double weight = counts[table.values[i]];
      weights += weight;
      saved += weight * portable::log2(gap);
    }
  }
  if (weights == 0) return table;
  table.saved = saved / weights;
  table.squares = portable::exp2(2 * table.saved);
  return table;
}

}  // namespace

bool FewValues::none() const {
  return std::all_of(tables.begin(), tables.end(), [](const auto& table) { return table.empty(); });
}

FewValues fewValuesOf(const Texels& texels, uint32_t channels, Mask coded) {
  FewValues few;
  for (uint32_t c = 0; c < channels; ++c) {
    Table table = tableOf(countsOf(texels, c, coded));
    if (table.saved < kLeastSaved) continue;
    few.tables[c] = std::move(table.values);
    few.squares[c] = table.squares;
  }
  return few;
}

void samplesToPlaces(const std::vector<uint16_t>& table, std::vector<int32_t>& channel) {
  std::vector<int32_t> places(size_t{UINT16_MAX} + 1);
  for (size_t i = 0; i < table.size(); ++i) places[table[i]] = static_cast<int32_t>(i);
  for (int32_t& sample : channel) sample = places[static_cast<size_t>(sample)];
}

ChannelTablesHeader headerOf(const ChannelTables& tables, int sample_bits) {
  ChannelTablesHeader header;
  header.present = true;
  DecisionEncoding io;
  ValueTablePass<DecisionEncoding> pass(io, sample_bits);
  for (size_t c = 0; c < tables.size(); ++c) {
    header.values[c] = static_cast<uint32_t>(tables[c].size());
    std::vector<uint32_t> words(tables[c].begin(), tables[c].end());
    pass.run(words);
  }
  const std::vector<uint8_t> code = io.finish();
  header.code.assign(code.begin(), code.end());
  return header;
}

}  // namespace tetrakis::inline tables
