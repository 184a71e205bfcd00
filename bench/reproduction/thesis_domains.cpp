// SPDX-License-Identifier: Apache-2.0
// bench_thesis_domains: chapter 3 of the thesis, counted on meshes of 2 * 4^d triangles. For each d
// the sizes of all merging domains, of their supports and of the ancestors of all vertices; then
// the shape of a domain in ever finer meshes (fig. 3.7), and the vertices of fig. 3.9.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bench/harness/arguments.hpp"
#include "bench/harness/results.hpp"
#include "codec/mesh/topology/ancestors.hpp"
#include "codec/mesh/topology/lattice.hpp"

namespace {

using namespace tetrakis;
using namespace tetrakis::bench;

constexpr uint32_t kFigureD = 4;  // 17 x 17 samples: fig. 3.9

struct Options {
  uint32_t most = 10;
  std::string csv;
};

/// Triangles of full resolution with a corner in M_v, and those that tile its support once M_v is
/// gone: |M_v| and |M_v without M_v| of (3.3) and (3.4).
struct DomainSize {
  uint64_t before = 0, after = 0;
};

/// Merging domains of a complete mesh, one after another.
class Domains {
 public:
  explicit Domains(uint32_t d)
      : lattice_(*Lattice::make((1u << d) + 1, (1u << d) + 1)),
        side_(1u << d),
        seen_(lattice_.vertexCount()),
        counted_(size_t{2} * side_ * side_) {}

  const Lattice& lattice() const { return lattice_; }
  /// M_v of the last call of sizeOf(), v first.
  const std::vector<Site>& domain() const { return domain_; }
  bool inDomain(Site w) const { return seen_[lattice_.id(w)] == round_; }

  DomainSize sizeOf(Site v) {
    ++round_;
    domain_.assign(1, v);
    seen_[lattice_.id(v)] = round_;
    DomainSize size;
    uint64_t saved = 0;
    for (size_t i = 0; i < domain_.size(); ++i) {
      const Site w = domain_[i];
      saved += lattice_.triangleCost(w);
      size.before += countAround(lattice_.position(w));
      lattice_.forEachChild(w, [&](Site child) {
        uint32_t& seen = seen_[lattice_.id(child)];
        if (seen == round_) return;
        seen = round_;
        domain_.push_back(child);
      });
    }
    size.after = size.before - saved;
    return size;
  }

 private:
  /// Unit triangles around a sample that no vertex of this round has counted. The diagonal of a
  /// unit square joins its corners of even coordinate sum.
  uint32_t countAround(GridPoint p) {
    const bool diagonal = (p.x + p.y) % 2 == 0;
    uint32_t count = 0;
    for (const uint32_t right : {0u, 1u})
      for (const uint32_t down : {0u, 1u}) {
        if (p.x + right == 0 || p.x + right > side_ || p.y + down == 0 || p.y + down > side_)
          continue;
        const size_t square = size_t{p.y + down - 1} * side_ + (p.x + right - 1);
        // Triangle 0 holds the upper one of the corners off the diagonal, triangle 1 the lower.
        for (const uint32_t half : {0u, 1u}) {
          if (!diagonal && half != 1 - down) continue;
          uint32_t& counted = counted_[2 * square + half];
          if (counted != round_) ++count;
          counted = round_;
        }
      }
    return count;
  }

  const Lattice lattice_;
  const uint32_t side_;
  std::vector<uint32_t> seen_, counted_;
  std::vector<Site> domain_;
  uint32_t round_ = 0;
};

uint64_t ancestorCount(const Lattice& lattice, Site v) {
  uint64_t count = 0;
  forEachAncestor(lattice, v, [&](VertexId) { ++count; });
  return count;
}

/// Means and largest values of one level, or of all.
struct Tally {
  double before = 0, after = 0, ancestors = 0, count = 0;
  double most_before = 0, most_after = 0, most_ancestors = 0;

  void add(const DomainSize& size, uint64_t chain) {
    const auto b = static_cast<double>(size.before), a = static_cast<double>(size.after);
    const auto c = static_cast<double>(chain);
    before += b;
    after += a;
    ancestors += c;
    ++count;
    most_before = std::max(most_before, b);
    most_after = std::max(most_after, a);
    most_ancestors = std::max(most_ancestors, c);
  }
  void add(const Tally& other) {
    before += other.before;
    after += other.after;
    ancestors += other.ancestors;
    count += other.count;
    most_before = std::max(most_before, other.most_before);
    most_after = std::max(most_after, other.most_after);
    most_ancestors = std::max(most_ancestors, other.most_ancestors);
  }
  void report(const std::string& item, const std::string& of, std::vector<ResultRow>& rows) const {
    rows.push_back({item, of, "vertices", count});
    rows.push_back({item, of, "domain_mean", before / count});
    rows.push_back({item, of, "domain_most", most_before});
    rows.push_back({item, of, "support_mean", after / count});
    rows.push_back({item, of, "support_most", most_after});
    rows.push_back({item, of, "ancestors_mean", ancestors / count});
    rows.push_back({item, of, "ancestors_most", most_ancestors});
  }
};

/// Theorem 3.1, (3.24), (3.25), and fig. 3.5 by level. Levels are the thesis's l, from 1.
void measureSizes(uint32_t d, std::vector<ResultRow>& rows) {
  Domains domains(d);
  const Lattice& lattice = domains.lattice();
  std::vector<Tally> levels(lattice.levelCount());
  lattice.forEachVertex([&](Site site, VertexId) {
    levels[site.level].add(domains.sizeOf(site), ancestorCount(lattice, site));
  });
  Tally all;
  const std::string item = "d_" + std::to_string(d);
  for (size_t level = 0; level < levels.size(); ++level) {
    all.add(levels[level]);
    levels[level].report(item, "l_" + std::to_string(level + 1), rows);
  }
  all.report(item, "all", rows);
  std::printf("%3u %9.0f %10.2f %9.2f %10.2f %9.0f\n", d, all.count, all.before / all.count,
              all.after / all.count, all.ancestors / all.count, all.most_ancestors);
}

/// Proposition 3.2: how far the domain of a vertex reaches from it, along an axis and along a
/// diagonal, in sides of its square, while the mesh is refined k times.
void measureShape(uint32_t d, std::vector<ResultRow>& rows) {
  Domains domains(d);
  const Lattice& lattice = domains.lattice();
  for (uint32_t level = 4; level < lattice.levelCount(); level += 2) {
    const uint32_t step = lattice.plan(level).step;
    const uint32_t middle = (1u << d) / 2 - step;
    const Site v = lattice.siteAt(level, {middle, middle});
    domains.sizeOf(v);
    int64_t axis = 0, sum = 0;
    for (const Site w : domains.domain()) {
      const GridPoint p = lattice.position(w);
      const int64_t dx = std::abs(int64_t{p.x} - middle), dy = std::abs(int64_t{p.y} - middle);
      axis = std::max({axis, dx, dy});
      sum = std::max(sum, dx + dy);
    }
    const std::string item = "k_" + std::to_string((lattice.levelCount() - 2 - level) / 2);
    const double side = 2.0 * step;
    rows.push_back({item, "octagon", "axis_reach", static_cast<double>(axis) / side});
    rows.push_back({item, "octagon", "sum_reach", static_cast<double>(sum) / side});
  }
}

void addPoint(const std::string& item, const Lattice& lattice, Site site,
              std::vector<ResultRow>& rows) {
  const GridPoint p = lattice.position(site);
  const std::string name = std::to_string(p.x) + "_" + std::to_string(p.y);
  rows.push_back({item, name, "level", site.level + 1.0});
}

/// Fig. 3.9: the ancestors of one vertex; a merging domain, and those of it with a parent outside.
void listVertices(std::vector<ResultRow>& rows) {
  Domains domains(kFigureD);
  const Lattice& lattice = domains.lattice();
  const Site fine = lattice.siteAt(lattice.levelCount() - 1, {11, 4});
  addPoint("chain_of", lattice, fine, rows);
  forEachAncestor(lattice, fine,
                  [&](VertexId a) { addPoint("chain", lattice, lattice.site(a), rows); });

  const Site v = lattice.siteAt(4, {10, 6});  // l = 5, squares of side 4
  const DomainSize size = domains.sizeOf(v);
  double outer = 0, links = 0;
  for (const Site w : domains.domain()) {
    uint32_t outside = 0;
    lattice.forEachParent(w, [&](Site parent) { outside += domains.inDomain(parent) ? 0 : 1; });
    outer += outside > 0 ? 1 : 0;
    links += outside;
    addPoint(outside > 0 ? "outer" : "inner", lattice, w, rows);
  }
  rows.push_back({"domain", "fig39", "support", static_cast<double>(size.after)});
  rows.push_back({"domain", "fig39", "outer", outer});
  rows.push_back({"domain", "fig39", "outer_parents", links});
  std::printf("fig. 3.9b: %.0f vertices with %.0f parents outside, %llu triangles of support\n",
              outer, links, static_cast<unsigned long long>(size.after));
}

Status run(const Options& options) {
  std::vector<ResultRow> rows;
  std::printf("%3s %9s %10s %9s %10s %9s\n", "d", "vertices", "E|M_v|", "support", "E|A_v|",
              "most");
  for (uint32_t d = 2; d <= options.most; ++d) measureSizes(d, rows);
  measureShape(options.most, rows);
  listVertices(rows);
  return updateResults(options.csv, "thesis_domains", rows);
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  Arguments arguments("Chapter 3 of the thesis: sizes of merging domains, supports and ancestors");
  arguments.within({"--most", "Largest d: meshes have 2 * 4^d triangles"}, options.most, 6, 11);
  arguments.csv(options.csv);
  if (const std::optional<int> code = arguments.parse(argc, argv)) return *code;
  return exitCode(run(options));
}
