// SPDX-License-Identifier: Apache-2.0
#include "conformance/reference_decoder/metadata.hpp"

#include <cmath>

#include "conformance/reference_decoder/parts.hpp"

namespace tetrakis::reference {
namespace {

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

/// FORMAT 2, the first of a kind, which decoders take by themselves.
const Component* Places::first(int kind) const {
  for (const Component& one : stream_.components)
    if (one.kind == kind && one.domain.known()) return &one;
  return nullptr;
}

/// FORMAT 2, Places: whether form 5 is there for it.
bool Places::liesOnHeights(const Component& component) const {
  return heights_ && first(0) != nullptr && first(0) != &component;
}

/// Form 5.
Transform Places::overHeights(const Component& component) const {
  const Domain &heights = first(0)->domain, &own = component.domain;
  const double columns = double(heights.width) / own.width,
               rows = double(heights.height) / own.height;
  Transform t = *heights_;
  for (const int i : {1, 4}) t[i] *= columns;
  for (const int i : {2, 5}) t[i] *= rows;
  return t;
}

/// FORMAT 2, the table of forms; forms 1 and 5 repeat what is known. component: null: of a mesh.
std::optional<Transform> Places::readPlace(Reader& in, const Component* component,
                                           const Transform& spacing) const {
  const bool over = component != nullptr && liesOnHeights(*component);
  const int form = in.u8(0, over ? 5 : 4);
  if (form == 0 || in.outcome() != Outcome::kDone) return {};  // no T
  Transform t = form == 5 ? overHeights(*component) : form == 1 ? spacing : Transform{};
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

/// Returns what form 1 takes.
Transform Places::readSpacing(Reader& in) {
  skipText(in);  // unit
  skipText(in);  // crs
  const double spacingX = f64Or(0, in), spacingY = f64Or(spacingX, in);
  skipText(in);  // vertical_datum
  const double scale = f64Or(1, in);
  f64Or(0, in);  // offset
  if (scale == 0 || spacingX < 0 || spacingY < 0) in.fail(Outcome::kCorrupt);
  return {0, spacingX, 0, 0, 0, -spacingY};
}

/// Of further heights, or of a texture.
void Places::skipPlace(Reader& in, const Component& component, const Transform& spacing) const {
  readPlace(in, &component, spacing);
  skipByte(in, 2);                           // registration
  skipText(in);                              // geo_keys
  skipText(in);                              // description, or texture_crs
  if (component.kind == 0) skipByte(in, 1);  // nan_nodata
}

void Places::skipHeights(Reader& in) {
  heights_ = readPlace(in, nullptr, spacing_);
  skipByte(in, 2);  // registration
  skipText(in);     // geo_keys
  skipText(in);     // description
  skipByte(in, 1);  // nan_nodata
}

void Places::skipTexture(Reader& in) {
  if (const Component* texture = first(1)) return skipPlace(in, *texture, spacing_);
  readPlace(in, nullptr, spacing_);
  skipByte(in, 2);
  skipText(in);
  skipText(in);
}

void Places::skipDetailsOf(Reader& in, const Component& component) const {
  const bool known = component.domain.known() && (component.kind == 0 || component.kind == 1);
  Transform spacing{0, 0, 0, 0, 0, -0.0};
  Parts parts(in);
  parts.take(64, [](Reader& p) { restOf(p); });  // name
  if (known && component.kind == 0) parts.take(65, [&](Reader& p) { spacing = readSpacing(p); });
  if (known) parts.take(66, [&](Reader& p) { skipPlace(p, component, spacing); });
  parts.take(67, [](Reader&) {});  // lossless
  parts.end();
}

void Places::skipDetails(Reader& in) {
  Parts parts(in);
  for (size_t i = 0; i < stream_.components.size(); ++i)
    parts.take(i, [&](Reader& p) { skipDetailsOf(p, stream_.components[i]); });
  parts.end();
}

}  // namespace tetrakis::reference
