// SPDX-License-Identifier: Apache-2.0
#include "conformance/reference_decoder/metadata.hpp"

#include <cmath>

namespace tetrakis::reference {
namespace {

/// FORMAT 2, Georeference, the table of forms; forms 1 and 5 repeat what is known.
Transform readTransform(Reader& in, int form, const Transform& spacing, const Transform& heights) {
  if (form == 0) return {};
  Transform t = form == 5 ? heights : form == 1 ? spacing : Transform{};
  if (form < 5) t[0] = in.f64();
  if (form < 5) t[3] = in.f64();
  if (form >= 2 && form <= 4) t[1] = in.f64();
  if (form == 2) t[5] = -t[1];
  if (form == 3 || form == 4) t[5] = in.f64();
  if (form == 4) t[2] = in.f64();
  if (form == 4) t[4] = in.f64();
  for (const double v : t) {
    if (!(std::abs(v) < 0x1p512)) in.fail(Outcome::kCorrupt);
  }
  return t;
}

/// Of a texture over the ground of the heights.
Transform stretched(Transform t, const Stream& stream) {
  const double columns = double(stream.geometry->shownWidth()) / stream.texture->shownWidth();
  const double rows = double(stream.geometry->shownHeight()) / stream.texture->shownHeight();
  for (const int i : {1, 4}) t[i] *= columns;
  for (const int i : {2, 5}) t[i] *= rows;
  return t;
}

}  // namespace

Transform skipMetadata(Reader& in) {
  const double scale = in.f64(), offset = in.f64();
  const double spacingX = in.f64(), spacingY = in.f64();
  for (const double v : {scale, offset, spacingX, spacingY}) {
    if (!std::isfinite(v)) in.fail(Outcome::kCorrupt);
  }
  if (scale == 0 || spacingX < 0 || spacingY < 0) in.fail(Outcome::kCorrupt);
  for (int i = 0; i < 3; ++i) in.take(in.varint(0, UINT64_MAX));
  return {0, spacingX, 0, 0, 0, -spacingY};
}

void skipGeoreference(Reader& in, const Stream& stream, const Transform& spacing) {
  Transform heights = {};
  int forms = 5;
  for (const bool texture : {false, true}) {
    if (texture ? !stream.texture : !stream.geometry) continue;
    const int form = in.u8(0, forms - 1);
    heights = readTransform(in, form, spacing, heights);
    if (!texture && stream.texture && form > 0) {
      heights = stretched(heights, stream);
      forms = 6;
    }
    in.u8(0, 2);                                                    // registration
    for (int i = 0; i < 2; ++i) in.take(in.varint(0, UINT64_MAX));  // texts
    if (!texture) in.u8(0, 1);                                      // nan_nodata
  }
}

}  // namespace tetrakis::reference
