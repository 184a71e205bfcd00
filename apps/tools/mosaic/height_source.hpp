// SPDX-License-Identifier: Apache-2.0
// HeightSource reads heights window by window, so that they may be larger than memory: from a TIFF,
// from raw samples, from a stream, or from many such files that lie on one grid.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/tools/files/files.hpp"
#include "tetrakis/result.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::tools {

class HeightSource {
 public:
  HeightSource() = default;
  HeightSource(const HeightSource&) = delete;
  HeightSource& operator=(const HeightSource&) = delete;
  virtual ~HeightSource() = default;

  /// All that readHeights() tells of a file, but for its samples.
  virtual const HeightFile& described() const = 0;
  /// Fills the samples of a window, row by row. Floats that nearly meet the nodata value are that
  /// value.
  virtual Status read(const tks_window& window, std::byte* samples) = 0;
  /// How far the samples that were read lie at most from those of the files, which were doubles.
  virtual double rounding() const { return 0; }
  /// The files that the window's samples lie in.
  virtual std::vector<std::string> filesOf(const tks_window& window) const = 0;
};

using OpenSource = std::unique_ptr<HeightSource>;

/// One TIFF of a channel of 8, 16 or 32 bits, or of floats of 32 or 64, in strips or tiles.
Result<OpenSource> openTiffWindows(const std::string& path, Notes& notes);

/// "file.raw:WIDTHxHEIGHT:type", or a tile of SRTM (.hgt), which is read whole.
Result<OpenSource> openRawWindows(const std::string& path);

/// A stream with heights (.tks) on a plane.
Result<OpenSource> openStreamWindows(const std::string& path, Notes& notes);

/// One file of any of these kinds.
Result<OpenSource> openOne(const std::string& path, Notes& notes);

/// Many files, each of which lies on the grid of the first one: of equal pixels, types and
/// reference systems, whole pixels apart. Where they overlap, the sample of the last one that has
/// one counts. Samples that no file has are void. nodata: in the place of what the files declare.
Result<OpenSource> openGrid(const std::vector<std::string>& paths,
                            const std::optional<double>& nodata, Notes& notes);

/// One file, or several on one grid.
Result<OpenSource> openSource(const std::vector<std::string>& files,
                              const std::optional<double>& nodata, Notes& notes);

/// The files that are meant: those of a folder that are .tif, .hgt or .tks, in the order of their
/// names, or the paths themselves.
Result<std::vector<std::string>> sourceFiles(const std::vector<std::string>& paths);

}  // namespace tetrakis::tools
