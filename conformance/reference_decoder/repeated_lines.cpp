// SPDX-License-Identifier: Apache-2.0
// Reference decoder: repeated lines (docs/FORMAT.md, section 8.3).
#include <algorithm>
#include <span>

#include "conformance/reference_decoder/range_decoder.hpp"
#include "conformance/reference_decoder/stream.hpp"
#include "conformance/reference_decoder/wavelet.hpp"

namespace tetrakis::reference {

LineMap::LineMap(std::span<const uint8_t> code, int width, int height) {
  RangeDecoder decoder(code);
  Model models[9];
  bool counts = true;
  const auto order = [](int a, int b) { return a < b ? 0 : a == b ? 1 : 2; };
  for (std::vector<int>* side : {&columns, &rows}) {
    side->assign(side == &columns ? width : height, 0);
    int run = 1, last = 0, before = 0;
    for (size_t i = 1; i < side->size(); ++i) {
      bool repeated = false;
      try {
        if (counts) repeated = models[3 * order(run, last) + order(run, before)].decode(decoder);
      } catch (Undecided) {
        counts = false;
      }
      (*side)[i] = (*side)[i - 1] + !repeated;
      if (!repeated) {
        before = last;
        last = run;
      }
      run = repeated ? run + 1 : 1;
    }
  }
}

namespace {

/// The mip level of what is shown. decode(level): the samples of the coded lines, width x height.
template <class Decode>
std::vector<uint8_t> shownSamples(const LineMap& map, int codedWidth, int codedHeight, int level,
                                  const Decode& decode) {
  if (map.columns.empty()) return decode(level);
  const int width = static_cast<int>(map.columns.size()),
            height = static_cast<int>(map.rows.size());
  level = std::min(level, subbandsOf(width, height).front().level);
  int apart = 0;
  while (int64_t{codedWidth} << apart < width || int64_t{codedHeight} << apart < height) ++apart;
  const int coarsest = subbandsOf(codedWidth, codedHeight).front().level;
  const int coded = std::clamp(level - apart, 0, coarsest);
  const std::vector<uint8_t> samples = decode(coded);
  const int columns = ((codedWidth - 1) >> coded) + 1, rows = ((codedHeight - 1) >> coded) + 1;
  const size_t bytes = samples.size() / (size_t(columns) * rows);
  const int half = coded > 0 ? 1 << (coded - 1) : 0;
  std::vector<uint8_t> shown;
  for (int y = 0; y < height; y += 1 << level) {
    const int row = std::min((map.rows[y] + half) >> coded, rows - 1);
    for (int x = 0; x < width; x += 1 << level) {
      const int column = std::min((map.columns[x] + half) >> coded, columns - 1);
      const auto from = samples.begin() + (size_t(row) * columns + column) * bytes;
      shown.insert(shown.end(), from, from + bytes);
    }
  }
  return shown;
}

}  // namespace

std::vector<uint8_t> decodeShownHeights(const GeometryHeader& header, const Layers& layers,
                                        const Codewords& codewords, int level) {
  return shownSamples(header.lines, header.width, header.height, level,
                      [&](int coded) { return decodeHeights(header, layers, codewords, coded); });
}

std::vector<uint8_t> decodeShownTexture(const TextureHeader& header, const Codewords& codewords,
                                        int level) {
  return shownSamples(header.lines, header.width, header.height, level,
                      [&](int coded) { return decodeTexture(header, codewords, coded); });
}

}  // namespace tetrakis::reference
