// SPDX-License-Identifier: Apache-2.0
#include "conformance/reference_decoder/metadata.hpp"

#include <cmath>

namespace tetrakis::reference {
namespace {

/// Of a texture over the ground of the heights.
Transform stretched(Transform t, const Stream& stream) {
  const double columns = double(stream.geometry->shownWidth()) / stream.texture->shownWidth();
  const double rows = double(stream.geometry->shownHeight()) / stream.texture->shownHeight();
  for (const int i : {1, 4}) t[i] *= columns;
  for (const int i : {2, 5}) t[i] *= rows;
  return t;
}

void skipText(Reader& in) {
  if (!in.ends()) in.take(in.varint(0, UINT64_MAX));
}

double f64Or(double otherwise, Reader& in) {
  return in.ends() ? otherwise : in.f64();
}

void skipByte(Reader& in, int largest) {
  if (!in.ends()) in.u8(0, largest);
}

}  // namespace

/// FORMAT 2, the table of forms; forms 1 and 5 repeat what is known.
Transform Places::readTransform(Reader& in, int form) const {
  if (form == 0) return {};
  Transform t = form == 5 ? heights_ : form == 1 ? spacing_ : Transform{};
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

void Places::skipMetadata(Reader& in) {
  skipText(in);  // unit
  skipText(in);  // crs
  const double spacingX = f64Or(0, in), spacingY = f64Or(spacingX, in);
  skipText(in);  // vertical_datum
  const double scale = f64Or(1, in);
  f64Or(0, in);  // offset
  if (scale == 0 || spacingX < 0 || spacingY < 0) in.fail(Outcome::kCorrupt);
  spacing_ = {0, spacingX, 0, 0, 0, -spacingY};
}

void Places::skipHeights(Reader& in) {
  const int form = in.u8(0, 4);
  heights_ = readTransform(in, form);
  has_heights_ = form > 0 && stream_.geometry && stream_.texture;
  if (has_heights_) heights_ = stretched(heights_, stream_);
  skipByte(in, 2);  // registration
  skipText(in);     // geo_keys
  skipText(in);     // description
  skipByte(in, 1);  // nan_nodata
}

void Places::skipTexture(Reader& in) {
  readTransform(in, in.u8(0, has_heights_ ? 5 : 4));
  skipByte(in, 2);  // registration
  skipText(in);     // geo_keys
  skipText(in);     // texture_crs
}

}  // namespace tetrakis::reference
