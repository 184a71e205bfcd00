// SPDX-License-Identifier: Apache-2.0
// curveOf() takes the tracks of a coded component and returns its packets in order, with the curve
// of its error by bytes. On the way orderTracks() orders the passes of several tracks, audit()
// corrects their accounts by decoded prefixes, and lowerHull() says where packets may end.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "bitstream/stream/packet.hpp"
#include "bitstream/track/track_encoder.hpp"

namespace tetrakis::inline curves {

// lowerHull() thins an operational rate-distortion curve to its lower convex hull, which holds the
// only points at which a marginal analysis ever stops (thesis 6.3; Y. Shoham, A. Gersho 1988), and
// packetEnds() divides the bytes between two of these points into packets.

/// Hull vertices from the first to the last point, at least `growth` times the bytes so far (and
/// kLeastPacket) apart so that packet heads stay cheap.
std::vector<RatePoint> lowerHull(std::span<const RatePoint> points, double growth);

/// The bytes of a track that take off at least `slope` distortion each, up to a vertex of the hull.
uint64_t bytesWorth(std::span<const RatePoint> points, double slope);

/// Bytes of the shortest packets. Shorter ones show first bytes sooner, and heads take more of
/// them.
inline constexpr uint64_t kLeastPacket = 24;

/// The ends of packets on the way from one vertex of the hull of `points` to another one: at `to`,
/// and around prefixes that dip, because a packet that dips counts only when complete and should be
/// short. RatePoint::dips is that of the packet.
std::vector<RatePoint> packetEnds(std::span<const RatePoint> points, const RatePoint& from,
                                  const RatePoint& to);

// CodedTracks is a coded component as rate control sees it: codewords with their accounts, whether
// they hold heights or texels.

struct CodedTracks {
  Component component = Component::kGeometry;
  std::span<const EncodedTrack> tracks;  ///< at least one; they outlive this
  uint64_t opening = 0;           ///< bytes of the first track that come before everything else
  uint64_t correction_bytes = 0;  ///< those that come behind everything else
  size_t correction_tracks = 0;   ///< the last ones, which do so as well
};

/// All codewords, in the order of the tracks, which they refer to.
Codewords codewordsOf(std::span<const EncodedTrack> tracks);

/// Squared error that an account states after `bytes` bytes; linear between its points.
double distortionAt(std::span<const RatePoint> points, uint64_t bytes);

/// The codewords that a decoder has after the first `bytes` payload bytes of the component's
/// packets. packets: all of the component's in their order; packets of other components among them
/// are skipped.
Codewords prefixAfter(const CodedTracks& coded, std::span<const Packet> packets, uint64_t bytes);

// orderTracks() orders the packets of a component that is coded in regions. The finest order is the
// marginal allocation (thesis 6.3) among the component's tracks, in its own distortion: the
// cheapest improvement anywhere comes first. Then the packets of a region and of its neighbours are
// strewn over the stream, and a receiver that fetches a window by ranges takes hundreds of them, or
// the bytes between. Two coarser orders keep them together; docs/EXPERIMENTS.md has their cost in
// prefixes.

enum class TrackOrder {
  kSlopes,   ///< steepest first: the best prefixes
  kClasses,  ///< by classes of slopes, two an octave, and track by track within one
  kTracks,   ///< track by track, whatever the slopes: the base, then region by region
};

struct OrderedTracks {
  std::vector<Packet> packets;  ///< their quality is not set
  /// Bytes sent and distortion of the whole component: at the beginning and after each packet.
  std::vector<RatePoint> points;
};

/// The opening comes first and corrections last, whatever their slopes.
OrderedTracks orderTracks(const CodedTracks& coded, TrackOrder by);

// audit() corrects the account that an encoder keeps of a track (bytes and error after each pass)
// by decoding prefixes, as many as the size of the track allows. The account counts errors of
// coefficients; a viewer sees samples.

/// Squared error of the samples decoded from the first `bytes` bytes, in the units of the points.
/// Asked for rising bytes.
using Measure = std::function<double(uint64_t bytes)>;

/// The extent of an audit.
struct AuditScope {
  uint64_t samples = 0;
  uint64_t budget = UINT64_MAX;  ///< bytes of the track that can be sent at most
  /// All of the track is needed, as a largest error needs it, whatever its last bytes improve in
  /// the mean.
  bool whole = false;
};

/// Returns the track's points so that their distortion falls strictly.
///   small tracks    every point is measured, and so many prefixes in between that the quality
///                   between two of them changes by little, or as many as 2^23 decoded samples
///                   allow: all of the first bytes (8192 of 512 samples, 256 of 16 384). Dips are
///                   those that were seen. A quarter behind the budget is as far as anything in
///                   it can depend on
///   large tracks    a few points are measured and the others scaled in between; not with a
///                   budget, because the order must not depend on it. Of exact tracks more
///                   points are measured late, where samples lose most by being rounded
std::vector<RatePoint> audit(const EncodedTrack& track, const AuditScope& scope,
                             const Measure& measure);

/// The account of several tracks in their order, corrected at two points as audit() does if it ends
/// exact or there is no budget; any other account as it is.
std::vector<RatePoint> auditTogether(std::span<const RatePoint> points, const AuditScope& scope,
                                     const Measure& measure);

/// Twice the samples of the largest track of which every prefix is measured. Larger tracks measure
/// one prefix in as many bytes as they have times more samples. A larger number finds more dips,
/// and takes time.
inline constexpr uint64_t kTinySamples = uint64_t{1} << 12;
/// Samples of the largest track of which many prefixes are measured. A larger number finds dips of
/// more tracks, and takes their time.
inline constexpr uint64_t kSmallSamples = uint64_t{1} << 14;

// curveOf() cuts a coded component into packets and computes the worth of their bytes. It audits
// the account of the tracks, thins it to its hull, and states in every packet the quality that it
// leads to. Errors of one component beside those of the other are the business of
// ratecontrol/allocation/allocation.hpp.

/// One component as the allocation sees it: its packets in their order, and the hull of its mean
/// squared errors, whose points lie at ends of packets.
struct ComponentCurve {
  std::vector<RatePoint> points;  ///< from {0, ...}; convex; fewer than two: no packets
  std::vector<Packet> packets;
  size_t opened = 0;  ///< the first point behind the opening
  /// For a large component in one track: the points of its account behind the opening, which are
  /// ends of passes. A point within a pass takes longer to decode. Else empty.
  std::vector<RatePoint> passes = {};
};

/// How packets are priced by the errors of a component, and how the component is divided into
/// packets.
struct Pricing {
  double samples = 1;   ///< squared errors are divided by it: packets state means
  double floor = 0;     ///< bytes that lower the mean squared error below it are worth nothing
  bool shared = false;  ///< there is another component, whose packets may come between the parts of
                        ///< a long packet: such packets are divided
  TrackOrder order = TrackOrder::kSlopes;  ///< of several tracks among each other
};

/// Squared error of the samples decoded from the first bytes of the packets; without packets, of
/// the only track. Asked for rising bytes.
using MeasurePackets = std::function<double(const std::vector<Packet>& packets, uint64_t bytes)>;

/// Makes the curve of a component. Several tracks are ordered among each other by their accounts
/// (orderTracks()), and the joint account is audited with `measure`, as the account of a single
/// track is. The opening comes first, whatever it costs.
ComponentCurve curveOf(const CodedTracks& coded, const AuditScope& scope,
                       const MeasurePackets& measure, const Pricing& pricing);

}  // namespace tetrakis::inline curves
