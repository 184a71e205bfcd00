// SPDX-License-Identifier: Apache-2.0
#include "doors/gdal/dataset.hpp"

#include <algorithm>
#include <cstring>
#include <limits>
#include <new>
#include <string_view>
#include <utility>

#include "doors/gdal/overview.hpp"
#include "doors/gdal/settings.hpp"

namespace tetrakis::gdal {

GDALDataType typeOf(tks_sample sample) {
  switch (sample) {
    case TKS_I8:
#if GDAL_VERSION_NUM >= 3070000
      return GDT_Int8;
#endif
    case TKS_U8:
      return GDT_Byte;
    case TKS_U16:
      return GDT_UInt16;
    case TKS_I16:
      return GDT_Int16;
    case TKS_U32:
      return GDT_UInt32;
    case TKS_I32:
      return GDT_Int32;
    case TKS_F32:
      break;
  }
  return GDT_Float32;
}

namespace {

constexpr uint32_t kOverviewEnds = 256;  ///< no overview where both sides are at most this
constexpr int kBlock = 256;              ///< side of blocks where there are no regions

/// What a band says beside its samples.
struct BandFacts {
  std::optional<double> nodata;
  double scale = 1, offset = 0;
  std::string unit;
  GDALColorInterp colour = GCI_GrayIndex;
};

/// Copies a rectangle of one channel out of interleaved pixels.
void copyChannel(const std::byte* from, size_t from_row, size_t pixel_bytes, std::byte* to,
                 size_t to_row, size_t sample_bytes, uint32_t columns, uint32_t rows) {
  for (uint32_t y = 0; y < rows; ++y) {
    const std::byte* in = from + y * from_row;
    std::byte* out = to + y * to_row;
    if (pixel_bytes == sample_bytes) {
      std::memcpy(out, in, columns * sample_bytes);
      continue;
    }
    for (uint32_t x = 0; x < columns; ++x, in += pixel_bytes, out += sample_bytes)
      std::memcpy(out, in, sample_bytes);
  }
}

class Band final : public GDALPamRasterBand {
 public:
  Band(Dataset& dataset, int number, BandFacts facts) : facts_(std::move(facts)) {
    poDS = &dataset;
    nBand = number;
    const Source& source = dataset.source();
    eDataType = typeOf(source.sample());
    nRasterXSize = static_cast<int>(source.width(dataset.level()));
    nRasterYSize = static_cast<int>(source.height(dataset.level()));
    // Small blocks decode each region several times; large ones would fill the cache.
    const uint32_t regions = source.regionSide();
    const int side = regions == 0 ? kBlock : static_cast<int>(std::clamp(regions, 64u, 1024u));
    nBlockXSize = std::min(side, nRasterXSize);
    nBlockYSize = std::min(side, nRasterYSize);
    if (source.sample() == TKS_I8 && eDataType == GDT_Byte)
      GDALRasterBand::SetMetadataItem("PIXELTYPE", "SIGNEDBYTE", "IMAGE_STRUCTURE");
  }

  double GetNoDataValue(int* success) override {
    int found = FALSE;
    const double pam = GDALPamRasterBand::GetNoDataValue(&found);
    if (success != nullptr) *success = found || facts_.nodata;
    return found ? pam : facts_.nodata.value_or(pam);
  }
  double GetScale(int* success) override {
    if (success != nullptr) *success = facts_.scale != 1 || facts_.offset != 0;
    return facts_.scale;
  }
  double GetOffset(int* success) override {
    if (success != nullptr) *success = facts_.scale != 1 || facts_.offset != 0;
    return facts_.offset;
  }
  const char* GetUnitType() override { return facts_.unit.c_str(); }
  GDALColorInterp GetColorInterpretation() override { return facts_.colour; }

  int GetOverviewCount() override { return static_cast<int>(dataset().overviews().size()); }
  GDALRasterBand* GetOverview(int i) override {
    const auto& overviews = dataset().overviews();
    if (i < 0 || i >= static_cast<int>(overviews.size())) return nullptr;
    return overviews[static_cast<size_t>(i)]->GetRasterBand(nBand);
  }

 protected:
  CPLErr IReadBlock(int x, int y, void* out) override {
    return readBlocks(tks_window{static_cast<uint32_t>(x), static_cast<uint32_t>(y), 1, 1},
                      static_cast<std::byte*>(out));
  }

  /// Decoding one large window takes less than its blocks one by one, whose regions overlap: all
  /// blocks that are not in GDAL's cache are decoded together, in strips that the cache holds.
  CPLErr IRasterIO(GDALRWFlag flag, int x, int y, int width, int height, void* data, int columns,
                   int rows, GDALDataType type, GSpacing pixel, GSpacing line,
                   GDALRasterIOExtraArg* extra) override {
    const bool whole = flag == GF_Read && columns == width && rows == height;
    if (!whole || !dataset().readsWindows()) {
      return GDALPamRasterBand::IRasterIO(flag, x, y, width, height, data, columns, rows, type,
                                          pixel, line, extra);
    }
    const int strip = rowsOfStrip(width);
    for (int top = y; top < y + height;) {
      const int bottom = std::min(y + height, (top / nBlockYSize + strip) * nBlockYSize);
      if (!cacheBlocks(x, top, width, bottom - top)) return CE_Failure;
      const CPLErr read = GDALPamRasterBand::IRasterIO(
          flag, x, top, width, bottom - top, static_cast<GByte*>(data) + (top - y) * line, width,
          bottom - top, type, pixel, line, extra);
      if (read != CE_None) return read;
      top = bottom;
    }
    return CE_None;
  }

 private:
  Dataset& dataset() const { return static_cast<Dataset&>(*poDS); }

  /// Rows of blocks of this width of which a quarter of the cache holds all bands; at least 1.
  int rowsOfStrip(int width) const {
    const GIntBig row = static_cast<GIntBig>(width + 2 * nBlockXSize) * nBlockYSize *
                        static_cast<GIntBig>(dataset().source().pixelBytes());
    return static_cast<int>(std::clamp<GIntBig>(GDALGetCacheMax64() / 4 / row, 1, 1 << 20));
  }

  bool cached(int x, int y) {
    GDALRasterBlock* const block = TryGetLockedBlockRef(x, y);
    if (block != nullptr) block->DropLock();
    return block != nullptr;
  }

  /// The rectangle of blocks that are missing beneath one of samples.
  bool cacheBlocks(int x, int y, int width, int height) {
    int left = std::numeric_limits<int>::max(), top = left, right = -1, bottom = -1;
    for (int by = y / nBlockYSize; by <= (y + height - 1) / nBlockYSize; ++by) {
      for (int bx = x / nBlockXSize; bx <= (x + width - 1) / nBlockXSize; ++bx) {
        if (cached(bx, by)) continue;
        left = std::min(left, bx);
        top = std::min(top, by);
        right = std::max(right, bx);
        bottom = std::max(bottom, by);
      }
    }
    if (right < 0) return true;
    const tks_window blocks{static_cast<uint32_t>(left), static_cast<uint32_t>(top),
                            static_cast<uint32_t>(right - left + 1),
                            static_cast<uint32_t>(bottom - top + 1)};
    return readBlocks(blocks, nullptr) == CE_None;
  }

  /// Decodes a rectangle of blocks. The first one's channel goes to `out` if that is given,
  /// everything else into the cache.
  CPLErr readBlocks(const tks_window& blocks, std::byte* out) {
    const uint32_t x = blocks.x * nBlockXSize, y = blocks.y * nBlockYSize;
    const tks_window window{x, y, std::min<uint32_t>(blocks.width * nBlockXSize, nRasterXSize - x),
                            std::min<uint32_t>(blocks.height * nBlockYSize, nRasterYSize - y)};
    std::vector<std::byte> pixels;
    if (!dataset().read(window, pixels)) return CE_Failure;
    const auto own = [&](int band, uint32_t bx, uint32_t by) {
      return out != nullptr && band == nBand && bx == blocks.x && by == blocks.y;
    };
    for (int band = 1; band <= poDS->GetRasterCount(); ++band) {
      for (uint32_t by = blocks.y; by < blocks.y + blocks.height; ++by) {
        for (uint32_t bx = blocks.x; bx < blocks.x + blocks.width; ++bx) {
          if (own(band, bx, by)) {
            spread(pixels, window, band, bx, by, out);
          } else if (!intoCache(pixels, window, band, bx, by)) {
            return CE_Failure;
          }
        }
      }
    }
    return CE_None;
  }

  bool intoCache(const std::vector<std::byte>& pixels, const tks_window& window, int band,
                 uint32_t bx, uint32_t by) {
    Band& other = static_cast<Band&>(*poDS->GetRasterBand(band));
    const int x = static_cast<int>(bx), y = static_cast<int>(by);
    if (other.cached(x, y)) return true;
    GDALRasterBlock* const block = other.GetLockedBlockRef(x, y, TRUE);
    if (block == nullptr) return false;
    spread(pixels, window, band, bx, by, static_cast<std::byte*>(block->GetDataRef()));
    block->DropLock();
    return true;
  }

  /// One block of one channel out of the pixels of a window.
  void spread(const std::vector<std::byte>& pixels, const tks_window& window, int band, uint32_t bx,
              uint32_t by, std::byte* to) const {
    const size_t sample = tks_sample_bytes(dataset().source().sample());
    const size_t pixel = dataset().source().pixelBytes();
    const uint32_t x = bx * nBlockXSize - window.x, y = by * nBlockYSize - window.y;
    const size_t row = window.width * pixel;
    copyChannel(pixels.data() + y * row + x * pixel + (band - 1) * sample, row, pixel, to,
                nBlockXSize * sample, sample, std::min<uint32_t>(nBlockXSize, window.width - x),
                std::min<uint32_t>(nBlockYSize, window.height - y));
  }

  BandFacts facts_;
};

GDALColorInterp colourOf(uint32_t channels, uint32_t channel) {
  if (channels % 2 == 0 && channel + 1 == channels) return GCI_AlphaBand;
  if (channels <= 2) return GCI_GrayIndex;
  constexpr GDALColorInterp kColours[] = {GCI_RedBand, GCI_GreenBand, GCI_BlueBand};
  return kColours[channel];
}

/// Heights that are void come back as this.
std::optional<double> nodataOf(const tks_info& info) {
  if (info.has_nodata) return info.nodata;
  if (info.has_voids) return std::numeric_limits<double>::quiet_NaN();
  return std::nullopt;
}

struct Name {
  std::string file, part;  ///< part: "", "heights" or "texture"
};

/// TKS:"file":part, also without the quotes.
std::optional<Name> subdatasetName(const char* text) {
  constexpr std::string_view kPrefix = "TKS:";
  if (!STARTS_WITH_CI(text, kPrefix.data())) return std::nullopt;
  const std::string rest = text + kPrefix.size();
  const size_t colon = rest.rfind(':');
  if (colon == std::string::npos) return std::nullopt;
  Name name{rest.substr(0, colon), rest.substr(colon + 1)};
  if (name.file.size() >= 2 && name.file.front() == '"' && name.file.back() == '"')
    name.file = name.file.substr(1, name.file.size() - 2);
  if (name.part != "heights" && name.part != "texture") return std::nullopt;
  return name;
}

/// The component that the name means, or that there is; nothing after a reported error.
std::optional<tks_part> partOf(const Name& name, const tks_info& info) {
  const bool texture = name.part == "texture" || (name.part.empty() && !info.has_heights);
  if (texture ? info.has_texture : info.has_heights)
    return texture ? TKS_PART_TEXTURE : TKS_PART_HEIGHTS;
  reportFailure(TKS_USAGE, name.file,
                texture ? "The stream has no texture." : "The stream has no heights.");
  return std::nullopt;
}

}  // namespace

int Dataset::Identify(GDALOpenInfo* info) {
  constexpr GByte kMagic[] = {'T', 'K', 'S', 0x1A};
  if (subdatasetName(info->pszFilename)) return TRUE;
  return info->nHeaderBytes >= static_cast<int>(sizeof kMagic) &&
         std::memcmp(info->pabyHeader, kMagic, sizeof kMagic) == 0;
}

GDALDataset* Dataset::Open(GDALOpenInfo* info) {
  if (!Identify(info)) return nullptr;
  const std::optional<Name> part = subdatasetName(info->pszFilename);
  const Name name = part.value_or(Name{info->pszFilename, ""});
  if (info->eAccess == GA_Update) {
    CPLError(CE_Failure, CPLE_NotSupported,
             "%s: A stream cannot be changed in place; open it read-only and make a copy.",
             name.file.c_str());
    return nullptr;
  }
  const std::optional<OpenSettings> settings = openSettings(name.file, info->papszOpenOptions);
  if (!settings) return nullptr;
  const std::shared_ptr<Source> source = Source::open(name.file, *settings);
  if (!source) return nullptr;
  const tks_info& facts = source->info();
  const std::optional<tks_part> component = partOf(name, facts);
  if (!component) return nullptr;
  source->choose(*component);
  const bool heights = *component == TKS_PART_HEIGHTS;
  const std::optional<double> nodata = heights ? nodataOf(facts) : std::nullopt;
  std::unique_ptr<Dataset> dataset(new Dataset(source, nodata, 0));
  dataset->takeFacts(facts, heights);
  dataset->takePlace(facts, heights);
  dataset->addOverviews();
  if (!part && facts.has_heights && facts.has_texture) dataset->listSubdatasets();
  dataset->SetDescription(info->pszFilename);
  if (part) {
    dataset->SetPhysicalFilename(name.file.c_str());
    dataset->SetSubdatasetName(name.part.c_str());
  }
  dataset->TryLoadXML(part ? nullptr : info->GetSiblingFiles());
  return dataset.release();
}

Dataset::Dataset(std::shared_ptr<Source> source, std::optional<double> nodata, uint32_t level)
    : source_(std::move(source)), nodata_(nodata), level_(level) {
  nRasterXSize = static_cast<int>(source_->width(level));
  nRasterYSize = static_cast<int>(source_->height(level));
  if (level > 0) nPamFlags |= GPF_NOSAVE;
  const tks_info& info = source_->info();
  const bool heights = source_->part() == TKS_PART_HEIGHTS;
  for (uint32_t channel = 0; channel < source_->channels(); ++channel) {
    BandFacts facts;
    facts.nodata = nodata;
    facts.colour = colourOf(source_->channels(), channel);
    if (heights) {
      facts.scale = info.scale;
      facts.offset = info.offset;
      facts.unit = info.unit;
    }
    SetBand(static_cast<int>(channel) + 1,
            new Band(*this, static_cast<int>(channel) + 1, std::move(facts)));
  }
  if (source_->channels() > 1)
    GDALDataset::SetMetadataItem("INTERLEAVE", "PIXEL", "IMAGE_STRUCTURE");
}

void Dataset::takeFacts(const tks_info& info, bool heights) {
  const bool exact = info.lossless && source_->complete();
  GDALDataset::SetMetadataItem("COMPRESSION_REVERSIBILITY", exact ? "LOSSLESS" : "LOSSY",
                               "IMAGE_STRUCTURE");
  const tks_registration registration = heights ? info.registration : info.texture_registration;
  if (registration == TKS_REGISTRATION_AREA)
    GDALDataset::SetMetadataItem(GDALMD_AREA_OR_POINT, GDALMD_AOP_AREA);
  if (registration == TKS_REGISTRATION_POINT)
    GDALDataset::SetMetadataItem(GDALMD_AREA_OR_POINT, GDALMD_AOP_POINT);
  if (!heights) return;
  if (*info.vertical_datum != '\0')
    GDALDataset::SetMetadataItem("VERTICAL_DATUM", info.vertical_datum, "TKS");
  if (info.max_error >= 0 && source_->complete()) {
    GDALDataset::SetMetadataItem("MAX_ERROR", CPLSPrintf("%.17g", info.max_error), "TKS");
  }
  GetRasterBand(1)->GDALRasterBand::SetDescription(info.description);
}

void Dataset::takePlace(const tks_info& info, bool heights) {
  const std::string& file = source_->name();
  if (heights ? info.has_geotransform : info.texture_has_geotransform) {
    transform_.emplace();
    std::copy_n(heights ? info.geotransform : info.texture_geotransform, 6, transform_->begin());
  }
  const char* const datum = heights ? info.vertical_datum : "";
  crs_ = heights ? readCrs({info.crs, datum, info.geo_keys}, file)
                 : readCrs({info.texture_crs, datum, info.texture_geo_keys}, file);
}

/// Overview k is made of level k - 1.
void Dataset::addOverviews() {
  for (uint32_t level = 1; level <= source_->coarsestLevel() + 1 && level < 31; ++level) {
    if (std::max(source_->width(level - 1), source_->height(level - 1)) <= kOverviewEnds) return;
    overviews_.emplace_back(new Dataset(source_, nodata_, level));
  }
}

void Dataset::listSubdatasets() {
  const tks_info& info = source_->info();
  const char* const file = source_->name().c_str();
  const auto add = [this](const char* key, const char* value) {
    GDALDataset::SetMetadataItem(key, value, "SUBDATASETS");
  };
  add("SUBDATASET_1_NAME", CPLSPrintf("TKS:\"%s\":heights", file));
  add("SUBDATASET_1_DESC", CPLSPrintf("[%ux%u] heights", info.height, info.width));
  add("SUBDATASET_2_NAME", CPLSPrintf("TKS:\"%s\":texture", file));
  add("SUBDATASET_2_DESC", CPLSPrintf("[%ux%ux%u] texture", info.texture_channels,
                                      info.texture_height, info.texture_width));
}

CPLErr Dataset::GetGeoTransform(double* transform) {
  if (GDALPamDataset::GetGeoTransform(transform) == CE_None) return CE_None;
  if (!transform_) return CE_Failure;
  std::copy(transform_->begin(), transform_->end(), transform);
  return CE_None;
}

const OGRSpatialReference* Dataset::GetSpatialRef() const {
  const OGRSpatialReference* const pam = GDALPamDataset::GetSpatialRef();
  return pam != nullptr ? pam : crs_.get();
}

char** Dataset::GetFileList() {
  char** files = GDALPamDataset::GetFileList();
  if (CSLFindString(files, source_->name().c_str()) < 0)
    files = CSLInsertString(files, 0, source_->name().c_str());
  return files;
}

#if GDAL_VERSION_NUM >= 3060000
CPLErr Dataset::IBuildOverviews(const char*, int, const int*, int, const int*, GDALProgressFunc,
                                void*, CSLConstList) {
  CPLError(CE_Failure, CPLE_NotSupported,
           "%s: A stream is its own overviews; none can be added or removed.",
           source_->name().c_str());
  return CE_Failure;
}
#endif

bool Dataset::read(const tks_window& window, std::vector<std::byte>& out) {
  try {
    const size_t pixel = source_->pixelBytes();
    if (level_ == 0 && readsWindows()) return source_->window(window, out);
    const uint32_t below = level_ == 0 ? 0 : level_ - 1;
    const uint32_t width = source_->width(below), height = source_->height(below);
    tks_window area = level_ == 0 ? window : areaBelow(window, width, height);
    std::vector<std::byte> part;
    const std::byte* pixels = nullptr;
    if (readsWindows()) {
      if (!source_->window(area, part)) return false;
      pixels = part.data();
    } else {
      pixels = source_->level(below);
      if (pixels == nullptr) return false;
      if (level_ > 0) area = {0, 0, width, height};
    }
    out.resize(size_t{window.width} * window.height * pixel);
    if (level_ == 0) {
      copyChannel(pixels + (size_t{window.y} * width + window.x) * pixel, width * pixel, pixel,
                  out.data(), window.width * pixel, pixel, window.width, window.height);
      return true;
    }
    const FinerLevel finer{pixels, area, width, height, source_->sample(), source_->channels(),
                           nodata_};
    makeOverview(finer, level_, window, out.data());
    return true;
  } catch (const std::bad_alloc&) {
    reportFailure(TKS_NO_MEMORY, source_->name(), "");
    return false;
  }
}

}  // namespace tetrakis::gdal
