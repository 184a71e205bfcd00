// SPDX-License-Identifier: Apache-2.0
// A codec that is two programs of a Debian package: samples go in and come back as PNG files
// without colour chunks, which codecs would act upon. The sizes are those of the coded files,
// whole.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bench/peers/peer.hpp"

namespace tetrakis::bench {

/// Run as `encoder OPTIONS in.png coded` and `decoder OPTIONS coded out.png`, found on the PATH.
struct CommandTools {
  std::string encoder, decoder;
  std::vector<std::string> decoder_options;
  std::string extension;  ///< of coded files, with the dot
  std::string package;    ///< of Debian, for the note that it is missing
};

/// Settings of the encoder, in its own words.
struct CommandQualities {
  std::vector<std::string> lossy;  ///< coarsest first; may be empty
  std::string lossless;            ///< empty: the codec has no lossless mode
};

class CommandPeer : public Peer {
 public:
  /// One file for each lossy quality, coarsest first, until one is larger than the last target (the
  /// sizes are the codec's: it cannot aim at bytes), and one lossless file, which must be exact.
  Result<PeerCurves> curves(const Raster& raster,
                            const std::vector<uint64_t>& targets) const override;

  /// TKS_UNSUPPORTED, with the package to install, when one of the programs does not run.
  Status installed() const;

 protected:
  CommandPeer(CommandTools tools, CommandQualities qualities)
      : tools_(std::move(tools)), qualities_(std::move(qualities)) {}
  virtual std::vector<std::string> encoderOptions(const Raster& raster,
                                                  const std::string& quality) const = 0;

 private:
  class Session;

  CommandTools tools_;
  CommandQualities qualities_;
};

/// Appends the peer, or, where it is not installed, leaves it out with a note on stderr.
void addInstalled(std::unique_ptr<CommandPeer> peer, std::vector<std::unique_ptr<Peer>>& peers);

}  // namespace tetrakis::bench
