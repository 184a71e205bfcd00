// SPDX-License-Identifier: Apache-2.0
// Reference decoder: parts of the header that inform (docs/FORMAT.md, section 2).
#pragma once

#include <array>

#include "conformance/reference_decoder/reader.hpp"
#include "conformance/reference_decoder/stream.hpp"

namespace tetrakis::reference {

using Transform = std::array<double, 6>;

/// FORMAT 2, Metadata and places: they decode nothing, but their syntax counts.
class Places {
 public:
  explicit Places(const Stream& stream) : stream_(stream) {}

  void skipMetadata(Reader& in);
  void skipHeights(Reader& in);
  void skipTexture(Reader& in);

 private:
  Transform readTransform(Reader& in, int form) const;

  const Stream& stream_;
  Transform spacing_{0, 0, 0, 0, 0, -0.0};
  Transform heights_{};  ///< stretched over the texture
  bool has_heights_ = false;
};

}  // namespace tetrakis::reference
