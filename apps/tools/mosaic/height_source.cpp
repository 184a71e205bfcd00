// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/mosaic/height_source.hpp"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "apps/tools/files/file_bytes.hpp"
#include "apps/tools/files/plain_heights.hpp"
#include "apps/tools/files/text.hpp"
#include "apps/tools/files/void_samples.hpp"

namespace tetrakis::tools {

namespace {

/// The same samples under another nodata value.
class Redeclared : public HeightSource {
 public:
  Redeclared(OpenSource source, double nodata) : source_(std::move(source)) {
    described_ = source_->described();
    described_.nodata = nodata;
    matchNodata(described_);
  }
  const HeightFile& described() const override { return described_; }
  Status read(const tks_window& window, std::byte* samples) override {
    return source_->read(window, samples);
  }
  double rounding() const override { return source_->rounding(); }
  std::vector<std::string> filesOf(const tks_window& window) const override {
    return source_->filesOf(window);
  }

 private:
  OpenSource source_;
  HeightFile described_;
};

bool isNamedHeights(const std::filesystem::path& path) {
  const std::string format = formatOf(path.string(), "");
  return format == "tif" || format == "tiff" || format == "tks" || isNamedHgt(path.string());
}

Result<std::vector<std::string>> filesIn(const std::string& folder) {
  std::vector<std::string> files;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error))
    if (isNamedHeights(entry.path())) files.push_back(entry.path().string());
  if (error) return Status(TKS_IO, "cannot read " + quoted(folder) + ": " + error.message());
  if (files.empty())
    return Status(TKS_USAGE, "the folder " + quoted(folder) + " holds no .tif, .hgt or .tks file");
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

Result<OpenSource> openOne(const std::string& path, Notes& notes) {
  if (parseRawName(path) || isNamedHgt(path)) return openRawWindows(path);
  if (formatOf(path, "") == "tks") return openStreamWindows(path, notes);
  return openTiffWindows(path, notes);
}

Result<OpenSource> openSource(const std::vector<std::string>& files,
                              const std::optional<double>& nodata, Notes& notes) {
  if (files.size() > 1) return openGrid(files, nodata, notes);
  Result<OpenSource> source = openOne(files.front(), notes);
  if (!source.ok() || !nodata) return source;
  return OpenSource(std::make_unique<Redeclared>(*std::move(source), *nodata));
}

Result<std::vector<std::string>> sourceFiles(const std::vector<std::string>& paths) {
  std::error_code ignored;
  if (paths.size() == 1 && std::filesystem::is_directory(paths[0], ignored))
    return filesIn(paths[0]);
  return paths;
}

}  // namespace tetrakis::tools
