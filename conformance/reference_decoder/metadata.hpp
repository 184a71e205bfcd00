// SPDX-License-Identifier: Apache-2.0
// Reference decoder: parts of the header that inform (docs/FORMAT.md, section 2).
#pragma once

#include <array>
#include <optional>

#include "conformance/reference_decoder/reader.hpp"
#include "conformance/reference_decoder/stream.hpp"

namespace tetrakis::reference {

using Transform = std::array<double, 6>;

/// FORMAT 2, Metadata, places and details: they decode nothing, but their syntax counts.
class Places {
 public:
  explicit Places(const Stream& stream) : stream_(stream) {}

  void skipMetadata(Reader& in) { spacing_ = readSpacing(in); }
  void skipHeights(Reader& in);
  void skipTexture(Reader& in);
  void skipDetails(Reader& in);

 private:
  static Transform readSpacing(Reader& in);
  const Component* first(int kind) const;
  bool liesOnHeights(const Component& component) const;
  Transform overHeights(const Component& component) const;
  std::optional<Transform> readPlace(Reader& in, const Component* component,
                                     const Transform& spacing) const;
  void skipPlace(Reader& in, const Component& component, const Transform& spacing) const;
  void skipDetailsOf(Reader& in, const Component& component) const;

  const Stream& stream_;
  Transform spacing_{0, 0, 0, 0, 0, -0.0};
  std::optional<Transform> heights_;  ///< T of the first heights
};

}  // namespace tetrakis::reference
