// SPDX-License-Identifier: Apache-2.0
#include "api/buffer.hpp"

#include <cstdlib>
#include <cstring>
#include <new>

namespace tetrakis::inline api {

void giveBytes(std::span<const uint8_t> bytes, tks_buffer& out) {
  out.data = static_cast<uint8_t*>(std::malloc(bytes.size()));
  if (out.data == nullptr) throw std::bad_alloc();
  std::memcpy(out.data, bytes.data(), bytes.size());
  out.size = bytes.size();
}

}  // namespace tetrakis::inline api

void tks_free_buffer(tks_buffer* buffer) {
  if (buffer == nullptr) return;
  std::free(buffer->data);
  *buffer = {nullptr, 0};
}
