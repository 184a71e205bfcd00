// SPDX-License-Identifier: Apache-2.0
// Reference decoder: parts of the header that inform (docs/FORMAT.md, section 2).
#pragma once

#include <array>

#include "conformance/reference_decoder/reader.hpp"
#include "conformance/reference_decoder/stream.hpp"

namespace tetrakis::reference {

using Transform = std::array<double, 6>;

/// FORMAT 2, Metadata: it decodes nothing, but its syntax counts. Returns the spacing as a
/// geotransform.
Transform skipMetadata(Reader& in);

/// FORMAT 2, Georeference, likewise. spacing: 0 without metadata.
void skipGeoreference(Reader& in, const Stream& stream, const Transform& spacing);

}  // namespace tetrakis::reference
