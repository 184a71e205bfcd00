// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/profile/best_profile.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <utility>

#include "codec/polyline/polylines.hpp"

namespace tetrakis::tools {
namespace {

/// Steps of dynamic programming that take about a second.
constexpr double kMostTrellisSteps = 1 << 30;
/// Entries of the table that says how pieces share the points.
constexpr double kMostShares = 1 << 24;

/// Errors that differ by less than this part of the squares that they are made from are equal.
constexpr double kRounding = 1e-12;

/// The polylines of one piece. A piece of a single sample has a polyline of no segments.
struct Piece {
  size_t samples = 0;
  double squares = 0;
  Polylines polylines;

  size_t most() const { return samples - 1; }  ///< segments
  double error(size_t segments) const { return samples == 1 ? 0 : polylines.errors[segments]; }
  std::vector<uint32_t> points(size_t segments) const {
    if (samples == 1) return {0};
    return polylines.knots(static_cast<uint32_t>(segments));
  }
};

template <class Run>
std::vector<Piece> piecesOf(const GroundLine& line, const Run& run) {
  std::vector<Piece> pieces;
  for (const std::vector<GroundSample>& samples : line.pieces) {
    std::vector<double> distances, heights;
    double sum = 0;
    for (const GroundSample& sample : samples) {
      distances.push_back(sample.distance);
      heights.push_back(sample.height);
      sum += sample.height;
    }
    Piece piece;
    piece.samples = samples.size();
    for (const double height : heights) {
      const double off = height - sum / static_cast<double>(heights.size());
      piece.squares += off * off;
    }
    if (piece.samples > 1) piece.polylines = run(Curve(distances, heights));
    pieces.push_back(std::move(piece));
  }
  return pieces;
}

/// How many segments each piece gets so that the sum of errors is least: dynamic programming over
/// the pieces. least[s]: of the pieces so far, with s segments.
std::vector<size_t> sharedSegments(const std::vector<Piece>& pieces, size_t segments) {
  const double none = std::numeric_limits<double>::infinity();
  std::vector<double> least(segments + 1, none);
  std::vector<std::vector<size_t>> taken;
  least[0] = 0;
  double squares = 0;
  for (const Piece& piece : pieces) {
    std::vector<double> next(segments + 1, none);
    std::vector<size_t> own(segments + 1, 0);
    for (size_t s = 0; s <= segments; ++s)
      for (size_t c = std::min<size_t>(piece.most(), 1); c <= std::min(piece.most(), s); ++c) {
        const double error = least[s - c] + piece.error(c);
        if (error < next[s]) {
          next[s] = error;
          own[s] = c;
        }
      }
    least = std::move(next);
    taken.push_back(std::move(own));
    squares += piece.squares;
  }
  const double enough = *std::min_element(least.begin(), least.end()) + kRounding * squares;
  auto s = static_cast<size_t>(
      std::find_if(least.begin(), least.end(), [&](double error) { return error <= enough; }) -
      least.begin());
  std::vector<size_t> shares(pieces.size());
  for (size_t p = pieces.size(); p-- > 0; s -= shares[p]) shares[p] = taken[p][s];
  return shares;
}

/// The same for nested polylines: the segment whose loss adds least goes first.
std::vector<size_t> decimatedSegments(const std::vector<Piece>& pieces, size_t segments) {
  std::vector<size_t> shares;
  std::priority_queue<std::pair<double, size_t>> cheapest;  // less its cost, of the piece
  size_t left = 0;
  const auto offer = [&](size_t p) {
    const size_t c = shares[p];
    if (c > 1) cheapest.emplace(pieces[p].error(c) - pieces[p].error(c - 1), p);
  };
  for (size_t p = 0; p < pieces.size(); ++p) {
    left += pieces[p].most();
    shares.push_back(pieces[p].most());
    offer(p);
  }
  for (; left > segments; --left) {
    const size_t p = cheapest.top().second;
    cheapest.pop();
    --shares[p];
    offer(p);
  }
  return shares;
}

bool isQuick(const GroundLine& line, size_t points) {
  double steps = 0;
  for (const std::vector<GroundSample>& samples : line.pieces) {
    const auto n = static_cast<double>(samples.size());
    steps += n * n / 2 * std::min(n, static_cast<double>(points));
  }
  steps += static_cast<double>(line.samples()) * static_cast<double>(points);
  const double shares = static_cast<double>(line.pieces.size()) * static_cast<double>(points);
  return steps <= kMostTrellisSteps && shares <= kMostShares;
}

}  // namespace

size_t fewestPoints(const GroundLine& line) {
  size_t count = 0;
  for (const std::vector<GroundSample>& piece : line.pieces)
    count += std::min<size_t>(piece.size(), 2);
  return count;
}

BestProfile bestProfile(const GroundLine& line, size_t points) {
  const size_t most = std::min(points, line.samples()), segments = most - line.pieces.size();
  const bool quick = isQuick(line, most);
  const std::vector<Piece> pieces = piecesOf(line, [&](const Curve& curve) {
    return quick ? uoptimalUpTo(curve, static_cast<uint32_t>(segments)) : udecimateGlobal(curve);
  });
  const std::vector<size_t> shares =
      quick ? sharedSegments(pieces, segments) : decimatedSegments(pieces, segments);
  BestProfile profile;
  profile.algorithm = quick ? "uoptimal" : "udecimate-global";
  double error = 0;
  for (size_t p = 0; p < pieces.size(); ++p) {
    profile.points.push_back(pieces[p].points(shares[p]));
    error += pieces[p].error(shares[p]);
  }
  profile.rmse = std::sqrt(std::max(error, 0.0) / static_cast<double>(line.samples()));
  return profile;
}

}  // namespace tetrakis::tools
