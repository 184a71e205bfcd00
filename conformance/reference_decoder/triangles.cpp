// SPDX-License-Identifier: Apache-2.0
#include "conformance/reference_decoder/triangles.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "conformance/reference_decoder/glue.hpp"
#include "conformance/reference_decoder/parts.hpp"
#include "conformance/reference_decoder/place_decoder.hpp"

namespace tetrakis::reference {
namespace {

int64_t dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Vector minus(const Vector& a, const Vector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

/// The corner, or side, so many behind one of the same triangle.
int behind(int corner, int i) {
  return corner / 3 * 3 + (corner + i) % 3;
}

/// FORMAT 11, fans and their order. A border is glued to itself.
class Fans {
 public:
  explicit Fans(const std::vector<int>& glued) : glued_(glued), of_(glued.size(), -1) {
    for (int c = 0; c < static_cast<int>(glued.size()); ++c) {
      if (of_[c] >= 0) continue;
      const int fan = static_cast<int>(corners_.size());
      corners_.push_back(around(c));
      for (const int corner : corners_.back()) of_[corner] = fan;
    }
  }

  int of(int corner) const { return of_[corner]; }
  const std::vector<int>& corners(int fan) const { return corners_[fan]; }
  int count() const { return static_cast<int>(corners_.size()); }

  /// The corner of the triangle behind that of `corner`, beyond its opposite side; -1 at a border.
  int beyond(int corner) const {
    const int side = behind(corner, 1), other = glued_[side];
    return other == side ? -1 : behind(other, 2);
  }

  std::vector<int> order() const {
    std::vector<int> all, unknown(of_.size(), 3), times(corners_.size(), 0);
    std::vector<bool> told(corners_.size(), false);
    std::vector<int> waiting[6];
    const auto wait = [&](int fan) {
      if (!told[fan]) waiting[1 + std::min(times[fan], 4)].push_back(fan);
    };
    const auto foretell = [&](int c) {
      if (beyond(c) < 0 || --unknown[c] > 0) return;
      ++times[of_[c]];
      wait(of_[c]);
    };
    for (int first = 0; first < count(); ++first) {
      if (!told[first]) waiting[0].push_back(first);
      for (int rank = 5; rank >= 0;) {
        if (waiting[rank].empty()) {
          --rank;
          continue;
        }
        const int fan = waiting[rank].back();
        waiting[rank].pop_back();
        if (told[fan]) continue;
        told[fan] = true;
        all.push_back(fan);
        for (const int c : corners_[fan]) {
          for (const int e : {behind(c, 1), behind(c, 2)}) {
            wait(of_[e]);
            foretell(e);
          }
          if (beyond(c) >= 0) foretell(beyond(c));
        }
        rank = 5;
      }
    }
    return all;
  }

 private:
  std::vector<int> around(int first) const {
    std::vector<int> all = {first};
    int c = first;
    while (glued_[c] != c) {
      c = behind(glued_[c], 1);
      if (c == first) return all;
      all.push_back(c);
    }
    for (c = first; glued_[behind(c, 2)] != behind(c, 2);) {
      c = glued_[behind(c, 2)];
      all.push_back(c);
    }
    return all;
  }

  const std::vector<int>& glued_;
  std::vector<int> of_;
  std::vector<std::vector<int>> corners_;
};

/// PlaceDecoder that are told, one for each fan.
struct Told {
  std::vector<TellPlace> places;
  std::vector<bool> known;

  explicit Told(int count) : places(count), known(count, false) {}
};

/// FORMAT 11, vertices and texcoords: what is known of a fan. foretell(corner): a place, once both
/// other corners of the triangle are known, or none.
template <class Foretell>
TellPlace tellFan(const Fans& fans, int fan, const Told& told, const Vector& latest,
                  PlaceDecoder& places, const Foretell& foretell) {
  std::vector<TellPlace> nearby;
  std::vector<Vector> all, beside;
  for (const int c : fans.corners(fan)) {
    for (const int e : {behind(c, 1), behind(c, 2)}) {
      if (!told.known[fans.of(e)]) continue;
      nearby.push_back(told.places[fans.of(e)]);
      beside.push_back(nearby.back().at);
    }
    if (!told.known[fans.of(behind(c, 1))] || !told.known[fans.of(behind(c, 2))]) continue;
    if (const auto place = foretell(c)) all.push_back(*place);
  }
  const Vector expected = !all.empty()      ? places.mean(all)
                          : !beside.empty() ? places.mean(beside)
                                            : latest;
  return places.tell(expected, nearby, static_cast<int>(all.size()));
}

class Reading {
 public:
  explicit Reading(const TriangleMeshHeader& header) : header_(header), decoder_(header.codeword) {}

  Triangles run() {
    auto glued = readGlue(decoder_, header_.triangles, 3);
    if (!glued) return {false, {}, {}};
    glued_ = std::move(*glued);
    Triangles out;
    const Fans vertices(glued_);
    const Told places = readPlaces(vertices);
    for (int c = 0; c < static_cast<int>(glued_.size()); ++c) {
      places_.push_back(places.places[vertices.of(c)].at);
      auto& place = out.places.emplace_back();
      for (size_t i = 0; i < 3; ++i)
        place[i] = header_.cell * static_cast<double>(header_.origin[i] + places_[c][i]);
    }
    if (header_.texcoordBits > 0) readTexture(vertices, out);
    if (ended_) return {false, {}, {}};
    return out;
  }

 private:
  Told readPlaces(const Fans& fans) {
    PlaceDecoder places(decoder_, 3, header_.placeBits);
    Told told(fans.count());
    Vector latest;
    latest.fill(places.most() / 2);
    for (const int fan : fans.order()) {
      const auto at = [&](int c) { return told.places[fans.of(c)].at; };
      told.places[fan] = tellFan(fans, fan, told, latest, places, [&](int c) {
        const int far = fans.beyond(c);
        std::optional<Vector> place;
        if (far >= 0 && told.known[fans.of(far)]) {
          place = minus(at(behind(c, 1)), at(far));
          for (size_t i = 0; i < 3; ++i) (*place)[i] += at(behind(c, 2))[i];
        }
        return place;
      });
      told.known[fan] = true;
      latest = told.places[fan].at;
    }
    ended_ |= places.ended();
    return told;
  }

  void readTexture(const Fans& vertices, Triangles& out) {
    std::vector<int> cut;
    try {
      cut = readSeams(vertices);
    } catch (const Undecided&) {
      ended_ = true;
      return;
    }
    const Fans wedges(cut);
    PlaceDecoder places(decoder_, 2, header_.texcoordBits);
    Told told(wedges.count());
    Vector latest = {};
    for (const int fan : wedges.order()) {
      told.places[fan] = tellFan(wedges, fan, told, latest, places,
                                 [&](int c) { return std::optional(flat(c, wedges, told)); });
      told.known[fan] = true;
      latest = told.places[fan].at;
    }
    ended_ |= places.ended();
    for (int c = 0; c < static_cast<int>(glued_.size()); ++c) {
      auto& texcoord = out.texcoords.emplace_back();
      for (size_t i = 0; i < 2; ++i)
        texcoord[i] = std::ldexp(
            static_cast<double>(header_.texcoordOrigin[i] + told.places[wedges.of(c)].at[i]),
            -header_.texcoordFraction);
    }
  }

  std::vector<int> readSeams(const Fans& vertices) {
    std::vector<int> cut = glued_, seams(vertices.count(), 0), untold(vertices.count(), 0);
    std::vector<std::vector<Model>> models(9, std::vector<Model>(9));
    const auto ends = [&](int s) {
      return std::array<int, 2>{vertices.of(s), vertices.of(behind(s, 1))};
    };
    for (int s = 0; s < static_cast<int>(cut.size()); ++s)
      for (const int v : ends(s)) untold[v] += glued_[s] > s;
    for (int s = 0; s < static_cast<int>(cut.size()); ++s) {
      if (glued_[s] <= s) continue;
      int e[2];
      for (size_t i = 0; i < 2; ++i)
        e[i] = 3 * std::min(seams[ends(s)[i]], 2) + std::min(untold[ends(s)[i]], 3) - 1;
      const int seam = models[std::min(e[0], e[1])][std::max(e[0], e[1])].decode(decoder_);
      for (const int v : ends(s)) {
        --untold[v];
        seams[v] += seam;
      }
      if (seam) cut[s] = s;
      if (seam) cut[glued_[s]] = glued_[s];
    }
    return cut;
  }

  Vector flat(int c, const Fans& wedges, const Told& told) {
    const auto at = [&](int corner) { return told.places[wedges.of(corner)].at; };
    const Vector a = at(behind(c, 1)), b = at(behind(c, 2)), d = minus(b, a);
    const int far = wedges.beyond(c);
    if (far >= 0 && told.known[wedges.of(far)]) {
      const Vector r = minus(at(far), a);
      const int64_t turn = d[0] * r[1] - d[1] * r[0];
      if (turn != 0) mirrored_ = turn > 0;
    }
    Vector base = minus(places_[behind(c, 2)], places_[behind(c, 1)]),
           side = minus(places_[c], places_[behind(c, 1)]);
    int64_t largest = 0;
    for (size_t i = 0; i < 3; ++i)
      largest = std::max({largest, std::abs(base[i]), std::abs(side[i])});
    const int k = static_cast<int>(std::bit_width(static_cast<uint64_t>(largest))) - 14;
    for (size_t i = 0; i < 3 && k > 0; ++i) {
      base[i] = meanOf(base[i], int64_t{1} << k);
      side[i] = meanOf(side[i], int64_t{1} << k);
    }
    const int64_t square = dot(base, base), along = dot(base, side);
    if (square == 0) return a;
    const int64_t height = floorRoot(square * dot(side, side) - along * along);
    const int64_t up = mirrored_ ? -height : height;
    const auto moved = [&](size_t i, int64_t sum) {
      return a[i] + std::clamp<int64_t>(meanOf(sum, square), -(1 << 30), 1 << 30);
    };
    return {moved(0, along * d[0] - up * d[1]), moved(1, along * d[1] + up * d[0]), 0};
  }

  static int64_t floorRoot(int64_t x) {
    auto root = static_cast<int64_t>(std::sqrt(static_cast<double>(x)));
    while (root * root > x) --root;
    while ((root + 1) * (root + 1) <= x) ++root;
    return root;
  }

  const TriangleMeshHeader& header_;
  RangeDecoder decoder_;
  std::vector<int> glued_;
  std::vector<Vector> places_;  ///< of corners
  bool ended_ = false, mirrored_ = false;
};

}  // namespace

TriangleMeshHeader readTriangleMesh(Reader& in) {
  TriangleMeshHeader mesh;
  mesh.triangles = static_cast<int>(in.varint(1, 1 << 20));
  mesh.placeBits = in.u8(1, 20);
  mesh.cell = in.f64();
  if (mesh.cell <= 0) in.fail(Outcome::kCorrupt);
  for (int64_t& cells : mesh.origin) cells = in.longZigzag(uint64_t{1} << 50);
  mesh.texcoordBits = in.u8(0, 20);
  if (mesh.texcoordBits > 0) {
    mesh.texcoordFraction = in.u8(0, 24);
    for (int64_t& units : mesh.texcoordOrigin) units = in.longZigzag(1 << 30);
  }
  mesh.codeword = restOf(in);
  return mesh;
}

Triangles readTriangles(const TriangleMeshHeader& header) {
  return Reading(header).run();
}

}  // namespace tetrakis::reference
