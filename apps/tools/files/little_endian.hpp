// SPDX-License-Identifier: Apache-2.0
// LittleEndianBuffer builds a little-endian binary file in memory.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "apps/tools/files/file_bytes.hpp"

namespace tetrakis::tools {

struct LittleEndianBuffer {
  std::vector<std::byte> bytes;

  template <class T>
  void putAll(std::span<const T> values) {
    const auto added = std::as_bytes(values);
    const size_t start = bytes.size();
    bytes.insert(bytes.end(), added.begin(), added.end());
    reorderBytes(std::span(bytes).subspan(start), sizeof(T), std::endian::little);
  }
  template <class T>
  void put(T value) {
    putAll(std::span<const T>(&value, 1));
  }
  void putText(std::string_view text) { putAll(std::span<const char>(text)); }
  /// glTF chunks and accessors start at multiples of four.
  void padTo4(char filler) {
    while (bytes.size() % 4 != 0) put(filler);
  }
};

}  // namespace tetrakis::tools
