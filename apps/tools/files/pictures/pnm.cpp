// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/files/pictures/pnm.hpp"

#include <charconv>
#include <cstring>
#include <string_view>

#include "apps/tools/files/file_bytes.hpp"

namespace tetrakis::tools {
namespace {

bool isSpace(char c) {
  return c == ' ' || (c >= '\t' && c <= '\r');
}

/// Words parted by white space and by comments, from # to the end of the line.
class Words {
 public:
  explicit Words(std::string_view text, size_t position = 0) : text_(text), position_(position) {}

  /// Behind the last word.
  size_t position() const { return position_; }

  std::optional<uint64_t> number() {
    skipSpace();
    uint64_t value = 0;
    const char* const first = text_.data() + position_;
    const auto [last, error] = std::from_chars(first, text_.data() + text_.size(), value);
    if (error != std::errc()) return std::nullopt;
    position_ += static_cast<size_t>(last - first);
    return value;
  }

 private:
  void skipSpace() {
    for (; position_ < text_.size(); ++position_) {
      if (text_[position_] == '#')
        position_ = std::min(text_.find_first_of("\n\r", position_), text_.size() - 1);
      else if (!isSpace(text_[position_]))
        return;
    }
  }

  std::string_view text_;
  size_t position_;
};

std::string_view textOf(std::span<const std::byte> file) {
  return {reinterpret_cast<const char*>(file.data()), file.size()};
}

}  // namespace

std::optional<std::array<uint64_t, 2>> readPnmSides(std::string_view file) {
  Words words(file, 2);
  const auto width = words.number(), height = words.number();
  if (!width || !height) return std::nullopt;
  return std::array{*width, *height};
}

std::optional<PnmHeader> readPnmHeader(std::span<const std::byte> file) {
  const std::string_view text = textOf(file);
  const std::string_view magic = text.substr(0, 2);
  const bool numbers = magic == "P2" || magic == "P3";
  if (!numbers && magic != "P5" && magic != "P6") return std::nullopt;
  Words words(text, magic.size());
  const auto width = words.number(), height = words.number(), white = words.number();
  if (!width || !height || !white) return std::nullopt;
  // One character parts the header from binary samples.
  return PnmHeader{numbers, *white, std::min(words.position() + 1, text.size())};
}

Result<std::vector<std::byte>> readWidePnm(std::span<const std::byte> file, const PnmHeader& header,
                                           size_t samples, const std::string& name) {
  const Status damaged(TKS_IO, "cannot read " + name + ": it ends early or is damaged");
  const std::span<const std::byte> stored = file.subspan(header.end);
  constexpr size_t kBytes = sizeof(uint16_t);
  if (stored.size() / (header.text ? 1 : kBytes) < samples) return damaged;
  if (!header.text) {
    std::vector<std::byte> wide(stored.begin(), stored.begin() + samples * kBytes);
    reorderBytes(wide, kBytes, std::endian::big);
    return wide;
  }
  std::vector<std::byte> wide(samples * kBytes);
  Words words(textOf(stored));
  for (size_t i = 0; i < samples; ++i) {
    const auto number = words.number();
    if (!number || *number > header.white) return damaged;
    const auto sample = static_cast<uint16_t>(*number);
    std::memcpy(&wide[i * kBytes], &sample, kBytes);
  }
  return wide;
}

}  // namespace tetrakis::tools
