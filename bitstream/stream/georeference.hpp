// SPDX-License-Identifier: Apache-2.0
// Georeference says where heights and texture lie on the ground, in the reference system of their
// files, and GroundPositions in longitude and latitude. Both are written into the header and read
// from it; samples do not depend on them.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/plane.hpp"
#include "bitstream/stream/fields.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::inline stream {

// Placement says where heights and texture lie (docs/FORMAT.md, section 2, Places), in few
// bytes for a north-up grid. Decoding does not depend on it.

/// Column c and row r, (0, 0) the outer corner of the first sample, are at x = [0] + c [1] + r [2],
/// y = [3] + c [4] + r [5]: the order of GDAL.
using GeoTransform = std::array<double, 6>;

/// How a geotransform is written: what follows from other fields is not.
enum class TransformForm : uint8_t {
  kNone = 0,
  kSpacing = 1,  ///< north-up, samples as large as the metadata's spacing
  kSquare = 2,   ///< north-up, one size
  kNorthUp = 3,  ///< two sizes
  kAny = 4,
  kHeights = 5  ///< of a texture: over the same ground as the heights, from corner to corner
};

/// What a geotransform may follow from.
struct TransformBasis {
  GeoTransform spacing{};  ///< sizes of north-up samples, without an origin
  GeoTransform heights{};  ///< that of a texture over the ground of the heights
  bool has_heights = false;
};

/// The transform of a north-up raster at (0, 0) whose samples have this size.
GeoTransform northUp(double size_x, double size_y);

/// The transform of a raster over the same ground whose samples are so many times as large.
GeoTransform stretched(const GeoTransform& transform, double columns, double rows);

/// The transform of samples that cover the ground of others, of which that is the transform.
GeoTransform over(const GeoTransform& transform, Extent others, Extent samples);

/// The least form that gives the transform back bit for bit.
TransformForm formOf(const GeoTransform& transform, const TransformBasis& basis);

/// Below that in magnitude every sum over a raster is finite.
bool isSound(const GeoTransform& transform);

/// The transform of every 2^level-th column and row of a raster: samples stay where they are.
GeoTransform atLevel(const GeoTransform& transform, int level);

struct Placement {
  bool has_transform = false;
  GeoTransform transform{};
  uint8_t registration = 0;  ///< tks_registration
  std::string geo_keys;

  bool operator==(const Placement&) const = default;

  template <class V>
  void visit(V& v, const TransformBasis& basis) {
    TransformForm form = has_transform ? formOf(transform, basis) : TransformForm::kNone;
    v.u8("transform", form, 0, basis.has_heights ? 5 : 4);
    has_transform = form != TransformForm::kNone;
    if (has_transform) visitTransform(v, form, basis);
    v.require("transform", isSound(transform));
    v.unless(uint8_t{0}, registration, [&] { v.u8("registration", registration, 0, 2); });
    v.unless(std::string(), geo_keys, [&] { v.text("geo_keys", geo_keys); });
  }

 private:
  template <class V>
  void visitTransform(V& v, TransformForm form, const TransformBasis& basis) {
    if (form == TransformForm::kHeights) {
      transform = basis.heights;
      return;
    }
    v.f64("origin_x", transform[0]);
    v.f64("origin_y", transform[3]);
    if (form == TransformForm::kSpacing) {
      transform[1] = basis.spacing[1];
      transform[5] = basis.spacing[5];
      return;
    }
    v.f64("column_x", transform[1]);
    if (form == TransformForm::kSquare) {
      transform[5] = -transform[1];
      return;
    }
    v.f64("row_y", transform[5]);
    if (form == TransformForm::kNorthUp) return;
    v.f64("row_x", transform[2]);
    v.f64("column_y", transform[4]);
  }
};

/// Where the heights and the texture lie.
struct Georeference {
  Placement heights;
  std::string description;  ///< of the heights
  uint8_t nan_nodata = 0;   ///< NaN is declared as the value of void heights
  Placement texture;
  std::string texture_crs;  ///< "" beside no geo_keys: that of the heights

  /// Whether anything is known of the heights' place, and of the texture's.
  bool hasHeights() const {
    return heights != Placement{} || !description.empty() || nan_nodata > 0;
  }
  bool hasTexture() const { return texture != Placement{} || !texture_crs.empty(); }

  /// Whether the texture has a reference system of its own, be it none.
  bool hasTextureCrs() const { return !texture_crs.empty() || !texture.geo_keys.empty(); }

  template <class V>
  void visitHeights(V& v, const TransformBasis& basis) {
    heights.visit(v, basis);
    v.unless(std::string(), description, [&] { v.text("description", description); });
    v.unless(uint8_t{0}, nan_nodata, [&] { v.u8("nan_nodata", nan_nodata, 0, 1); });
  }
  template <class V>
  void visitTexture(V& v, const TransformBasis& basis) {
    texture.visit(v, basis);
    v.unless(std::string(), texture_crs, [&] { v.text("texture_crs", texture_crs); });
  }
};

// GroundPositions gives the longitudes and latitudes of a raster (docs/FORMAT.md, section 2, Ground
// positions) to receivers that do not know its reference system.

/// In degrees. Longitudes go on behind 180 where a raster crosses it.
struct LongitudeLatitude {
  double longitude = 0, latitude = 0;
};

/// A place on the plane that touches the sphere of longitudes and latitudes, projected
/// stereographically: no pole and no date line breaks it, and most maps are nearly similar to it.
using TangentPoint = std::array<double, 2>;

/// The plane that touches at `centre`.
class TangentPlane {
 public:
  explicit TangentPlane(LongitudeLatitude centre);
  TangentPoint project(LongitudeLatitude place) const;
  LongitudeLatitude unproject(const TangentPoint& point) const;

 private:
  double longitude_, sine_, cosine_;
};

/// Polynomials of column and row that give points of a tangent plane.
struct GroundPositions {
  static constexpr uint8_t kMostDegree = 15, kMostExponent = 62;
  static constexpr int64_t kMostCoefficient = int64_t{1} << 50;

  int64_t longitude = 0, latitude = 0;  ///< degrees of the centre
  uint8_t degree = 1;
  uint8_t exponent = 0;  ///< coefficients count in units of 2^-exponent
  /// Of Chebyshev polynomials T_i(u) T_j(v) with i + j <= degree, row by row, of the first
  /// coordinate and then of the second.
  std::vector<int64_t> coefficients;

  static size_t terms(int degree) { return static_cast<size_t>(degree + 1) * (degree + 2) / 2; }

  /// u, v: -1 at the outer edge of the first column and row, 1 at that of the last ones.
  TangentPoint at(double u, double v) const;

  template <class V>
  void visit(V& v) {
    v.zigzag("longitude", longitude, 180);
    v.zigzag("latitude", latitude, 90);
    v.u8("degree", degree, 1, kMostDegree);
    v.u8("exponent", exponent, 0, kMostExponent);
    if (v.ok()) coefficients.resize(2 * terms(degree));
    for (int64_t& c : coefficients) v.zigzag("coefficient", c, kMostCoefficient);
  }
};

std::string written(const GroundPositions& positions);

/// Nothing if the bytes are of another form.
std::optional<GroundPositions> groundPositionsIn(const std::string& bytes);

/// T_0(x) to T_degree(x).
std::array<double, GroundPositions::kMostDegree + 1> chebyshev(double x, int degree);

}  // namespace tetrakis::inline stream
