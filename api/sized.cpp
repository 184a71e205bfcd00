// SPDX-License-Identifier: Apache-2.0
#include "api/sized.hpp"

namespace tetrakis::inline api {

Status checkSized(const std::string& name, const void* given, size_t size, size_t least,
                  size_t known) {
  if (size < least || size > kMostStructBytes) {
    return {TKS_USAGE, "The struct of " + name + " takes a size of at least " +
                           std::to_string(least) + " bytes, not " + std::to_string(size) + "."};
  }
  const auto* bytes = static_cast<const std::byte*>(given);
  if (size > known &&
      std::any_of(bytes + known, bytes + size, [](std::byte b) { return b != std::byte{0}; })) {
    return {TKS_UNSUPPORTED,
            "The struct of " + name + " sets a field that this library does not know."};
  }
  return {};
}

}  // namespace tetrakis::inline api
