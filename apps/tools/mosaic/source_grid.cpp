// SPDX-License-Identifier: Apache-2.0
// openGrid() makes one source of many files that lie on one grid, as the tiles of a national model
// do. Files are opened when a window needs them, and kept open up to kMostOpen of them.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <list>
#include <utility>

#include "apps/tools/files/file_bytes.hpp"
#include "apps/tools/files/place/ground_spacing.hpp"
#include "apps/tools/files/text.hpp"
#include "apps/tools/files/void_samples.hpp"
#include "apps/tools/mosaic/height_source.hpp"
#include "base/samples.hpp"

namespace tetrakis::tools {

namespace {

constexpr size_t kMostOpen = 32;
/// The largest size of a raster, as of streams.
constexpr int64_t kMostSide = 1 << 20;

/// A file of the grid, without its samples.
struct Member {
  std::string path;
  HeightFile described;
  int64_t x = 0, y = 0;  ///< of its first sample, from that of the first file
};

Status odd(const Member& member, const std::string& how) {
  return {TKS_USAGE, quoted(member.path) + " " + how +
                         " than the first file: gdalbuildvrt or gdalwarp can put both on one grid"};
}

/// Where a file lies on the grid of the first one.
Status checkPlace(const HeightFile& first, const Member& member) {
  const HeightFile& file = member.described;
  if (!file.geotransform) return {TKS_USAGE, quoted(member.path) + " does not say where it lies"};
  if (file.sample != first.sample) return odd(member, "has another sample type");
  if (file.crs != first.crs) return odd(member, "has another reference system");
  if (file.unit != first.unit || file.scale != first.scale || file.offset != first.offset)
    return odd(member, "has another unit, scale or offset");
  const GeoTransform &a = *first.geotransform, &b = *file.geotransform;
  const double pixel = std::abs(a[1]), row = std::abs(a[5]);
  const auto differs = [](double x, double y, double by) { return std::abs(x - y) > by; };
  if (a[2] != 0 || a[4] != 0 || b[2] != 0 || b[4] != 0)
    return {TKS_USAGE, quoted(member.path) + " or the first file is turned"};
  if (differs(a[1], b[1], 1e-6 * pixel) || differs(a[5], b[5], 1e-6 * row))
    return odd(member, "has pixels of another size");
  const double x = (b[0] - a[0]) / a[1], y = (b[3] - a[3]) / a[5];
  if (differs(x, std::round(x), 0.01) || differs(y, std::round(y), 0.01))
    return odd(member, "lies a part of a pixel off another grid");
  if (std::abs(x) > 2. * kMostSide || std::abs(y) > 2. * kMostSide)
    return odd(member, "lies more than 2^20 pixels elsewhere");
  return {};
}

/// The same, noted in it.
Status place(const HeightFile& first, Member& member) {
  if (Status status = checkPlace(first, member); !status.ok()) return status;
  const GeoTransform &a = *first.geotransform, &b = *member.described.geotransform;
  member.x = std::llround((b[0] - a[0]) / a[1]);
  member.y = std::llround((b[3] - a[3]) / a[5]);
  return {};
}

class SourceGrid : public HeightSource {
 public:
  SourceGrid(std::vector<Member> members, HeightFile described)
      : members_(std::move(members)), described_(std::move(described)) {}

  const HeightFile& described() const override { return described_; }

  Status read(const tks_window& window, std::byte* samples) override {
    return withSampleType(described_.sample, [&](auto type) {
      return readAs(window, reinterpret_cast<decltype(type)*>(samples));
    });
  }

  double rounding() const override { return rounding_; }

  std::vector<std::string> filesOf(const tks_window& window) const override {
    std::vector<std::string> files;
    for (const Member& member : members_)
      if (const auto shared = sharedWith(member, window); shared.width > 0)
        files.push_back(member.path);
    return files;
  }

 private:
  /// What a file and a window share, in samples of the grid; no samples: nothing.
  static tks_window sharedWith(const Member& member, const tks_window& window) {
    const int64_t x = std::max<int64_t>(window.x, member.x),
                  y = std::max<int64_t>(window.y, member.y);
    const int64_t x1 =
        std::min<int64_t>(int64_t{window.x} + window.width, member.x + member.described.width);
    const int64_t y1 =
        std::min<int64_t>(int64_t{window.y} + window.height, member.y + member.described.height);
    if (x >= x1 || y >= y1) return {0, 0, 0, 0};
    return {static_cast<uint32_t>(x), static_cast<uint32_t>(y), static_cast<uint32_t>(x1 - x),
            static_cast<uint32_t>(y1 - y)};
  }

  template <class T>
  static bool isVoid(T sample, const std::optional<double>& nodata) {
    const auto value = static_cast<double>(sample);
    return std::isnan(value) || (nodata && value == *nodata);
  }

  template <class T>
  Status readAs(const tks_window& window, T* samples) {
    const size_t count = size_t{window.width} * window.height;
    const double nodata = described_.nodata.value_or(std::numeric_limits<double>::quiet_NaN());
    T nothing{};
    if (std::is_floating_point_v<T> || !std::isnan(nodata)) nothing = static_cast<T>(nodata);
    std::fill_n(samples, count, nothing);
    std::vector<bool> filled(described_.nodata || std::is_floating_point_v<T> ? 0 : count);
    std::vector<T> part;
    for (const Member& member : members_) {
      const tks_window shared = sharedWith(member, window);
      if (shared.width == 0) continue;
      const Result<HeightSource*> file = opened(member);
      if (!file.ok()) return file.status();
      part.resize(size_t{shared.width} * shared.height);
      const tks_window own{static_cast<uint32_t>(shared.x - member.x),
                           static_cast<uint32_t>(shared.y - member.y), shared.width, shared.height};
      if (Status status = (*file)->read(own, reinterpret_cast<std::byte*>(part.data()));
          !status.ok())
        return status;
      rounding_ = std::max(rounding_, (*file)->rounding());
      for (uint32_t y = 0; y < shared.height; ++y) {
        for (uint32_t x = 0; x < shared.width; ++x) {
          const T sample = part[size_t{y} * shared.width + x];
          if (isVoid(sample, member.described.nodata)) continue;
          if (isVoid(sample, described_.nodata)) return takenForVoid(member);
          const size_t at =
              size_t{shared.y - window.y + y} * window.width + (shared.x - window.x + x);
          samples[at] = sample;
          if (!filled.empty()) filled[at] = true;
        }
      }
    }
    if (std::find(filled.begin(), filled.end(), false) == filled.end()) return {};
    return {TKS_USAGE,
            "the files leave gaps, and declare no value for samples that are missing: "
            "give one with --nodata"};
  }

  Status takenForVoid(const Member& member) const {
    return {TKS_USAGE, quoted(member.path) +
                           " has heights of the value that stands for no height "
                           "in another file: gdalwarp -dstnodata writes another"};
  }

  Result<HeightSource*> opened(const Member& member) {
    for (auto open = open_.begin(); open != open_.end(); ++open) {
      if (open->member != &member) continue;
      open_.splice(open_.begin(), open_, open);
      return open_.front().source.get();
    }
    if (open_.size() >= kMostOpen) open_.pop_back();
    Notes ignored;
    Result<OpenSource> source = openOne(member.path, ignored);
    if (!source.ok()) return source.status();
    const HeightFile& now = (*source)->described();
    if (now.width != member.described.width || now.height != member.described.height ||
        now.sample != member.described.sample)
      return Status(TKS_IO, quoted(member.path) + " has changed since it was planned with");
    open_.push_front({&member, *std::move(source)});
    return open_.front().source.get();
  }

  struct Open {
    const Member* member;
    OpenSource source;
  };
  std::vector<Member> members_;
  HeightFile described_;
  double rounding_ = 0;
  std::list<Open> open_;  ///< the last used one first
};

/// The raster around all files.
Result<HeightFile> around(std::vector<Member>& members) {
  int64_t x = 0, y = 0, x1 = 0, y1 = 0;
  for (const Member& member : members) {
    x = std::min(x, member.x);
    y = std::min(y, member.y);
    x1 = std::max(x1, member.x + member.described.width);
    y1 = std::max(y1, member.y + member.described.height);
  }
  if (x1 - x > kMostSide || y1 - y > kMostSide)
    return Status(TKS_USAGE, "the files lie more than 2^20 pixels apart");
  HeightFile all = members.front().described;
  GeoTransform& transform = *all.geotransform;
  transform[0] += static_cast<double>(x) * transform[1];
  transform[3] += static_cast<double>(y) * transform[5];
  all.width = static_cast<uint32_t>(x1 - x);
  all.height = static_cast<uint32_t>(y1 - y);
  for (Member& member : members) {
    member.x -= x;
    member.y -= y;
    if (!all.nodata) all.nodata = member.described.nodata;
  }
  if (const auto spacing = groundSpacing(transform, all.width, all.height, {1, 0}, all.crs);
      spacing && all.crs == "EPSG:4326") {
    all.spacing_x = (*spacing)[0];
    all.spacing_y = (*spacing)[1];
  }
  return all;
}

}  // namespace

Result<OpenSource> openGrid(const std::vector<std::string>& paths,
                            const std::optional<double>& nodata, Notes& notes) {
  std::vector<Member> members;
  for (const std::string& path : paths) {
    Notes ignored;
    const Result<OpenSource> source = openOne(path, members.empty() ? notes : ignored);
    if (!source.ok()) return source.status();
    members.push_back({path, (*source)->described()});
    if (nodata)
      members.back().described.nodata = asSample(*nodata, members.back().described.sample);
    const Status placed = place(members.front().described, members.back());
    if (!placed.ok()) return placed;
  }
  Result<HeightFile> all = around(members);
  if (!all.ok()) return all.status();
  return OpenSource(std::make_unique<SourceGrid>(std::move(members), *std::move(all)));
}

}  // namespace tetrakis::tools
