// SPDX-License-Identifier: Apache-2.0
// One component of a stream that GDAL's virtual files hold: which of its bytes are read, and what
// they decode to.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "apps/doors/gdal/file_bytes.hpp"
#include "apps/doors/gdal/group_chain.hpp"
#include "tetrakis/components.h"
#include "tetrakis/tetrakis.h"

namespace tetrakis::gdal {

/// The failure of a call of the library as an error of GDAL: the sentence after the file's name.
void reportFailure(tks_status status, const std::string& name, const std::string& sentence);

/// A checksum as it lies in a file.
std::string hexadecimal(std::span<const uint8_t, 4> bytes);

struct OpenSettings {
  std::optional<uint64_t> bytes;  ///< as if the file were no longer, a header with an index aside
  bool strict = false;            ///< a stream that ends early or has damages is refused
  uint32_t threads = 1;
  std::string
      component;  ///< name or number of the one that is shown; "": the first heights, texture
};

/// One of the rasters of a stream.
struct StreamComponent {
  std::string name;
  tks_component_kind kind;
  uint32_t width, height;
  tks_domain domain;
  bool is_taken;  ///< for the heights, or the texture
};

/// What the last complete packet says of errors; below 0: nothing.
struct StatedQuality {
  double heights_rmse = -1;  ///< in the unit of the heights
  double texture_psnr = -1;  ///< in dB; infinity: exact
};

/// Where a stream lies in a file; `size`: at most.
struct Extent {
  uint64_t begin = 0, size = UINT64_MAX;
  std::string checksum;  ///< that tells the file from others; "": that of the stream
  /// Decodes the stream as that of this group; null: it stands by itself.
  std::shared_ptr<GroupChain> chain;
  ChainedGroup group;
};

/// Opening reads the header; the rest is read when samples are asked for: of streams with a front
/// index the packets that they need, else the file from its beginning.
class Source {
 public:
  /// Null after an error was reported. name: of the file.
  static std::unique_ptr<Source> open(const std::string& name, const File& file,
                                      const Extent& extent, const OpenSettings& settings);

  /// Of level 0. Its texts live until samples or errors are asked for.
  const tks_info& info() const { return info_; }
  /// Whether all of the stream is there to be read.
  bool complete() const { return end_ == info_.stream_bytes; }
  /// How many bytes of it are there to be read.
  uint64_t bytes() const { return end_; }
  /// Reads all bytes that are there, unless the header says enough, or they lie where reading costs
  /// and an index is there to read less. Reports no errors.
  StatedQuality statedQuality();
  /// That of the header, or of the head of a sequence, in hexadecimal digits: it tells the file
  /// from others.
  const std::string& checksum() const { return checksum_; }
  /// All of the stream, by their numbers.
  const std::vector<StreamComponent>& components() const { return components_; }
  /// Whether there are more than the first heights and the first texture.
  bool hasFurtherComponents() const;
  /// Whether it is the first of its kind.
  bool isFirst(uint32_t number) const;
  /// What OpenSettings::component names: heights, if it names heights and a texture.
  std::optional<tks_part> askedPart() const;
  /// The number of the component that is taken for a part.
  std::optional<uint32_t> takenFor(tks_part part) const;
  /// Gives up what was read and decoded, which is read and decoded again once it is asked for.
  void rest();

  /// Everything below concerns this component, the heights at first; and one of its frames or,
  /// without a number, all frames of heights, which are channels, and the first one of a texture.
  void choose(tks_part part, std::optional<uint32_t> frame = std::nullopt) {
    part_ = part;
    frame_ = frame;
  }
  tks_part part() const { return part_; }
  const std::string& name() const { return name_; }
  uint32_t width(uint32_t level) const;
  uint32_t height(uint32_t level) const;
  uint32_t channels() const;
  /// How many are shown: more than one are the channels of heights.
  uint32_t frames() const;
  bool hasAlpha() const;  ///< as the last channel
  /// Coded as it is, without a wavelet: levels hold samples of the raster, not means.
  bool isDrawn() const;
  tks_sample sample() const;
  size_t pixelBytes() const { return channels() * tks_sample_bytes(sample()); }
  uint32_t coarsestLevel() const;
  /// Side of the regions by which windows are decoded; 0: they take as long as all.
  uint32_t regionSide() const;
  /// Of heights on a cube, which are shown as the geographic grid that they were made of, in
  /// floats; 0: they are none. gridWindow() gives all pixels of them.
  uint32_t cubeDepth() const { return part_ == TKS_PART_HEIGHTS ? cube_depth_ : 0; }
  /// Says how many degrees the unit of the grid's CRS has, before any window is read. False after a
  /// reported error: this is no such grid.
  bool placeGrid(double degrees);

  /// All pixels of a level, channels interleaved, which are kept: coarse ones take a third of the
  /// raster's memory together. Null after an error was reported. A level above 0 takes no more
  /// bytes of the stream than the overview that is made of it has (what it shows comes first, and
  /// a small map takes a small download), or those that it needs, where these are fewer or no
  /// prefix shows all ground.
  const std::byte* level(uint32_t level);
  /// Whether parts of a level are decoded for themselves: of level 0, and of those that are large.
  bool readsWindows(uint32_t level) const;
  /// A part of a level.
  bool window(uint32_t level, const tks_window& window, std::vector<std::byte>& out);
  /// A part of the grid of a cube, or of the coarser grid of a level.
  bool gridWindow(uint32_t level, const tks_window& window, std::vector<std::byte>& out);

 private:
  using DecoderPointer = std::unique_ptr<tks_decoder, decltype(&tks_close)>;

  Source(std::string name, const OpenSettings& settings, FileBytes bytes)
      : name_(std::move(name)), settings_(settings), bytes_(std::move(bytes)) {}
  /// there: how many bytes of the file may be the stream's.
  bool readHeader(uint64_t there);
  std::string checksumOfHeader() const;
  /// Reads as much as the header takes, or there is, and returns how many bytes. Nothing after a
  /// reported error.
  std::optional<uint64_t> findHeader();
  /// Leaves as many bytes as BYTES says. An index, whose length grows with the file's, and all of
  /// the header with it, does not count: what it tells can be read before anything is shown.
  bool cutBytes();
  bool checkLength();
  /// Reads up to this many bytes and opens them; TKS_IO after a reported error.
  tks_status openPrefix(uint64_t bytes);
  /// Finds what is asked for, and chooses it. Another status says why in message_.
  tks_status takeComponents();
  tks_status chooseIn(tks_decoder* decoder) const;
  /// The decoder of these bytes, or of all where it is a chain's.
  tks_status openDecoder(uint64_t bytes);
  bool reopen(uint64_t bytes);
  bool read(std::span<const tks_range> ranges);
  /// How many bytes of the stream show a level well enough for the overview made of it.
  uint64_t bytesOfOverviewAbove(uint32_t level) const;
  /// What a level or a window takes, once the pages of the index that tell it were read. Nothing
  /// after a reported error.
  std::optional<std::vector<tks_range>> rangesFor(uint32_t level, const tks_window* window);
  /// Opens what a level takes, or a window of it (null: all).
  bool load(uint32_t level, const tks_window* window);
  /// What a level or a window takes, by the index. Nothing after a reported error.
  std::optional<std::vector<tks_range>> neededRanges(uint32_t level, const tks_window* window);
  /// whole: no range was cut off. Ranges that are whole join those that the decoder has.
  bool loadRanges(const std::vector<tks_range>& ranges, bool whole);
  /// Leaves the first range whole and a first part of each other one, that many bytes together.
  /// Whether that took anything off.
  static bool cutShares(std::vector<tks_range>& ranges, uint64_t bytes);
  bool failed(tks_status status);
  /// All pixels of the level that is set, or a window of it.
  bool decode(const tks_window* window, uint64_t pixels, std::vector<std::byte>& out);
  tks_status decodeFrame(uint32_t frame, const tks_window* window, std::span<std::byte> out);
  bool decodeLevel(uint32_t level, std::vector<std::byte>& out);

  /// A level of the heights on a cube.
  struct Cube {
    std::vector<float> surface;
    uint32_t depth;
    tks_geographic_grid grid;
  };
  /// Null after an error was reported.
  const Cube* cube(uint32_t level);
  /// The parts of a cube in regions that a window of its grid needs, and no others.
  bool gridOfRegions(uint32_t level, const tks_window& window, std::span<float> heights);
  /// The same of a whole level, which is kept.
  bool gridOfLevel(uint32_t level, const tks_window& window, std::span<float> heights);
  /// The grid of a level, in degrees.
  tks_geographic_grid gridOf(const tks_info& info) const;

  std::string name_;
  OpenSettings settings_;
  tks_part part_ = TKS_PART_HEIGHTS;
  std::optional<uint32_t> frame_;
  std::string checksum_;
  uint64_t end_ = 0;        ///< of what may be used
  bool has_index_ = false;  ///< and is there to be read, all of it
  FileBytes bytes_;
  std::shared_ptr<GroupChain> chain_;  ///< as of Extent; the decoder belongs to it
  ChainedGroup group_;
  uint64_t opened_ = 0;     ///< how many of the first bytes the decoder has; 0: ranges
  bool has_whole_ = false;  ///< some ranges, of which none was cut off
  bool verified_ = false;
  std::string message_;  ///< why openPrefix failed
  DecoderPointer decoder_{nullptr, tks_close};
  tks_info info_{};
  std::vector<StreamComponent> components_;
  std::vector<uint32_t> chosen_;                     ///< of these, in the place of the first ones
  std::map<uint32_t, std::vector<std::byte>> kept_;  ///< what was decoded of whole levels
  uint32_t cube_depth_ = 0;
  double degrees_ = 0;              ///< in the unit of the grid that the cube was made of
  uint32_t round_ = 0;              ///< columns of the grid, without one that repeats the first
  std::map<uint32_t, Cube> cubes_;  ///< by level, once heights were asked for
};

}  // namespace tetrakis::gdal
