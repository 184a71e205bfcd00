// SPDX-License-Identifier: Apache-2.0
// The bands of a dataset as the frames of a sequence.
#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include <cpl_error.h>
#include "apps/doors/gdal/copied_samples.hpp"
#include "apps/doors/gdal/copied_voids.hpp"
#include "apps/doors/gdal/create_copy.hpp"
#include "apps/doors/gdal/frame_times.hpp"
#include "apps/doors/gdal/ground_positions.hpp"
#include "apps/doors/gdal/output_file.hpp"
#include "tetrakis/sequence.hpp"

namespace tetrakis::gdal {
namespace {

/// What rounding of doubles to floats may take of a largest error.
constexpr double kRounding = 0.01;

bool isSame(double a, double b) {
  return a == b || (std::isnan(a) && std::isnan(b));
}

class FramesCopy {
 public:
  FramesCopy(const std::string& name, GDALDataset& source, bool strict,
             const CopySettings& settings, const Progress& progress)
      : name_(name),
        source_(source),
        strict_(strict),
        settings_(settings),
        progress_(progress),
        file_(name) {}

  bool write() {
    if (!canBeRenamed(name_)) return refuse("FRAMES=YES writes files, not where none is named.");
    const BandTimes times = timesOf(name_, source_);
    if (!readFirst() || !openEncoder(times.clock) || !file_.open()) return false;
    for (int band = 1; band <= source_.GetRasterCount(); ++band) {
      if (band > 1 && !read(band)) return false;
      const int64_t time = times.ticks[static_cast<size_t>(band) - 1];
      if (!took(encoder_->push(&frame_, nullptr, time)) || !passOn()) return false;
      if (!progressOf(band).report(1)) return reportStop(name_);
    }
    return took(encoder_->flush()) && passOn() && file_.finish();
  }

 private:
  ProgressPart progressOf(int band) const {
    const double bands = source_.GetRasterCount();
    return {progress_, 0.999 * (band - 1) / bands, 0.999 * band / bands};  // 1 is for the file
  }

  bool refuse(const std::string& sentence) {
    reportFailure(TKS_USAGE, name_, sentence);
    return false;
  }

  bool took(const Status& status) {
    if (status.ok()) return true;
    reportFailure(status.code(), name_, status.message());
    return false;
  }

  bool readFirst() {
    if (source_.GetRasterCount() == 0) return refuse("The source has no bands.");
    GDALRasterBand& band = *source_.GetRasterBand(1);
    first_ = describeBand(name_, band);
    if (!first_ || !readHeights(name_, band, strict_, *first_, progressOf(1))) return false;
    takeFill(name_, strict_, *first_);
    tks_heights& heights = first_->heights;
    heights.domain = settings_.domain.value_or(heights.domain);
    addPositions(name_, first_.get(), nullptr, positionBytes(&heights, nullptr, settings_.encode));
    frame_ = heights;
    return checkRounding(1, *first_);
  }

  /// Each band but the first one: all of it is as that but for its samples.
  bool read(int band) {
    if (!readQuietly(*source_.GetRasterBand(band), progressOf(band))) {
      const std::string why = CPLGetLastErrorMsg();
      CPLError(CE_Failure, CPLGetLastErrorNo(), "%s", why.c_str());
      return false;
    }
    if (!checkRounding(band, *last_)) return false;
    const tks_heights& first = first_->heights;
    const tks_heights& heights = last_->heights;
    const bool voids =
        !heights.has_nodata || (first.has_nodata && isSame(heights.nodata, first.nodata));
    const bool alike = heights.width == first.width && heights.height == first.height &&
                       heights.sample == first.sample && heights.scale == first.scale &&
                       heights.offset == first.offset;
    if (!alike || !voids)
      return refuse("Band " + std::to_string(band) + " has another " +
                    (alike ? "nodata value" : "type, scale or offset") +
                    " than band 1, and frames are alike.");
    frame_.data = heights.data;
    return true;
  }

  /// What the first band warned of concerns all.
  bool readQuietly(GDALRasterBand& band, const ProgressPart& progress) {
    const CPLErrorHandlerPusher quiet(CPLQuietErrorHandler);
    last_ = describeBand(name_, band);
    return last_ && readHeights(name_, band, strict_, *last_, progress);
  }

  bool checkRounding(int band, const CopiedHeights& copy) {
    if (settings_.max_z_error == 0 || copy.rounding <= kRounding * settings_.max_z_error)
      return true;
    return refuse("Band " + std::to_string(band) +
                  " is Float64, and Float32 does not hold it well enough for MAX_Z_ERROR.");
  }

  bool openEncoder(const SequenceClock& clock) {
    tks_encode_options encode = settings_.encode;
    encode.index = settings_.index.value_or(TKS_INDEX_NONE);
    const bool doubles = source_.GetRasterBand(1)->GetRasterDataType() == GDT_Float64;
    const double left = settings_.max_z_error * (doubles ? 1 - kRounding : 1);
    encode.max_error = left * std::abs(first_->heights.scale);
    encode.bytes /= static_cast<uint64_t>(source_.GetRasterCount());
    tks_sequence_options options = makeSequenceOptions();
    options.encode = &encode;
    options.reference = settings_.reference;
    options.entry = settings_.entry;
    options.clock = {sizeof options.clock, clock.numerator, clock.denominator, clock.epoch.c_str(),
                     clock.calendar.c_str()};
    Result<SequenceEncoder> opened = SequenceEncoder::open(options);
    if (!opened.ok()) return took(opened.status());
    encoder_.emplace(*std::move(opened));
    return true;
  }

  bool passOn() {
    const Result<Buffer> taken = encoder_->take();
    if (!taken.ok()) return took(taken.status());
    const std::span<const uint8_t> bytes = taken->bytes();
    if (bytes.empty()) return true;
    const uint64_t at = written_;
    written_ += bytes.size();
    return file_.write(at, bytes);
  }

  const std::string& name_;
  GDALDataset& source_;
  bool strict_;
  const CopySettings& settings_;
  Progress progress_;
  StagedFile file_;
  std::unique_ptr<CopiedHeights> first_, last_;
  tks_heights frame_{};
  std::optional<SequenceEncoder> encoder_;
  uint64_t written_ = 0;
};

}  // namespace

bool writeFrames(const std::string& name, GDALDataset& source, bool strict,
                 const CopySettings& settings, const Progress& progress) {
  return FramesCopy(name, source, strict, settings, progress).write();
}

}  // namespace tetrakis::gdal
