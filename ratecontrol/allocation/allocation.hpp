// SPDX-License-Identifier: Apache-2.0
// allocate() takes the packets of heights and texture with their curves and returns them in one
// order, the packet first that takes most error off the picture for each byte. PairErrors tells the
// error of the picture for any pair of prefixes, because the errors of heights and texture do not
// add.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "bitstream/stream/packet.hpp"
#include "ratecontrol/curves/component_curve.hpp"

namespace tetrakis::inline allocation {

// PairErrors gives the error of the picture for heights and textures of any quality (thesis 6.3.1:
// D(M_i, T_j)), from a grid of pairs that an engine has looked at. The two errors do not add: a
// texture that is in the wrong place is worth little (figure 6.7), and the grid holds that.
//
// Between two columns of the grid the logarithm of the error is linear in that of the squared error
// of the heights. Behind the last column the error goes on to fall towards that of the original,
// with the power of the squared error by which it fell before: the last bytes take off errors of
// fine detail, of which viewers see less. Rows and textures behave likewise.

/// Squared errors of the nodes of a grid, in their own samples: falling, positive. The original, of
/// error 0, is the node behind the last.
struct PairNodes {
  std::vector<double> heights, textures;
};

class PairErrors {
 public:
  /// errors: of the pairs, one row of textures after the other for each of the heights.
  PairErrors(PairNodes nodes, std::vector<double> errors);

  /// Where a squared error lies among the nodes.
  struct Place {
    size_t node = 0;    ///< the one before
    double rest = 0;    ///< of the way to the next one
    bool last = false;  ///< the next one is the original
    double ratio = 1;   ///< above 1: by which the squared error fell to the last node

    /// The exponent with which errors of pictures follow the squared error behind the last node.
    double power(double before, double from, double to) const;
  };
  Place heightsAt(double square) const { return placeOf(nodes_.heights, square); }
  Place textureAt(double square) const { return placeOf(nodes_.textures, square); }

  /// Error of the picture.
  double at(const Place& heights, const Place& texture) const;

 private:
  static Place placeOf(const std::vector<double>& nodes, double square);

  PairNodes nodes_;
  std::vector<double> errors_;
};

// correctedErrors() takes the errors that a model gives for all pairs of prefixes and corrects them
// by the measured errors of some pairs. The error of the model is a factor that changes slowly from
// pair to pair, so that it suffices to measure every other prefix of either component.

/// The places of the prefixes to measure among `prefixes` prefixes, at least one: every other one
/// and the last; and at the end the place of the original, which is behind them.
std::vector<size_t> measuredPlaces(size_t prefixes);

/// Errors of the pictures of all pairs, in the order that PairErrors takes.
struct ErrorGrid {
  size_t heights = 0, textures = 0;  ///< prefixes of either, without the original
  std::vector<double> errors;
};

/// measured: errors of the pairs at measuredPlaces() of either component. Between these places the
/// logarithm of the quotient of measured and modelled errors is linear; at them the result is the
/// measured error, unless the model sees no error there.
std::vector<double> correctedErrors(const ErrorGrid& modelled, const std::vector<double>& measured);

// stateSlopes() computes the worth of a byte of each packet, which the front index states
// (docs/FORMAT.md, section 2), so that viewers can choose packets for the ground that they look at.

/// Sets the slopes of packets, which are in their joint order: the error of the picture that each
/// packet takes off per byte, at its place in the order. Within a component slopes do not rise,
/// because a cheap packet behind a dear one needs the dear one first. A null curve: the stream
/// lacks the component; null errors: there is only one component, and its own squared error counts.
void stateSlopes(std::span<Packet> packets,
                 const std::array<const ComponentCurve*, kComponents>& curves,
                 const PairErrors* errors);

// allocate() puts the packets of both components into one order, by marginal analysis (thesis
// 6.3.2). The next packet is always the one that lowers the error of the picture most per byte, and
// both slopes are renewed after each step, because errors of heights and of textures do not add.
// Read backwards, the order gives up first what costs least per byte. It does not depend on any
// budget.

/// Orders the packets of both components. Within a component their order stays. Of equal slopes,
/// geometry comes first. A slope is the steepest to any point further on: where heights are still
/// so coarse that the next packet changes little, the packets behind it count. Openings come before
/// the packets that need them, whatever they cost.
std::vector<Packet> allocate(const std::array<ComponentCurve, kComponents>& curves,
                             const PairErrors& errors);

/// The same bytes in fewer packets: neighbours of one track are joined if they take less than two
/// steps of stated quality (1.5 dB) together. Packets that count only when whole stay as they are.
std::vector<Packet> joinNeighbours(std::span<const Packet> packets);

}  // namespace tetrakis::inline allocation
