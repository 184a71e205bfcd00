// SPDX-License-Identifier: Apache-2.0
// Streams (.tks) as the verbs read them, and what they decode to as files hold it.
#include "apps/tools/files/stream.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include "apps/tools/files/cube_heights.hpp"
#include "apps/tools/files/file_bytes.hpp"
#include "apps/tools/files/memory_limit.hpp"

namespace tetrakis::tools {
namespace {

Status checkWhole(std::span<const uint8_t> bytes) {
  Result<Decoder> decoder = openDecoder(bytes);
  if (!decoder) return decoder.status();
  return decoder->verify();
}

/// given: six numbers of tks_info; window: what is decoded of the raster.
std::optional<GeoTransform> placedAt(const double* given, const std::optional<tks_window>& window) {
  GeoTransform transform;
  std::copy_n(given, transform.size(), transform.begin());
  return window ? movedTo(transform, window->x, window->y) : transform;
}

Result<std::vector<std::byte>> samplesOf(Decoder& decoder, const std::optional<tks_window>& window,
                                         uint64_t copies) {
  const Result<uint64_t> fits =
      decoder.checkMemory(TKS_PART_HEIGHTS, window ? &*window : nullptr, 0,
                          heightsBytes(decoder.info(), window) + copies);
  if (!fits) return fits.status();
  return window ? decoder.heights(*window) : decoder.heights();
}

/// Of heights on a cube.
Result<std::vector<std::byte>> gridSamples(Decoder& decoder,
                                           const std::optional<tks_window>& window,
                                           uint64_t copies) {
  const tks_info& info = decoder.info();
  using Samples = Result<std::vector<std::byte>>;
  const auto samples = [&](const Result<std::vector<float>>& heights) -> Samples {
    if (!heights) return heights.status();
    return samplesOfGrid(info, *heights);
  };
  if (window) return samples(gridOfCube(decoder, *window));
  const uint64_t floats =
      sizeof(float) * (uint64_t{info.width} * info.height + shownHeights(info).samples());
  const Result<uint64_t> fits =
      decoder.checkMemory(TKS_PART_HEIGHTS, nullptr, 0, floats + heightsBytes(info) + copies);
  if (!fits) return fits.status();
  const Result<std::vector<float>> surface = decoder.surface();
  if (!surface) return surface.status();
  return samples(gridOfCube(info, *surface));
}

/// The last tick that is not later than so many seconds. Its time may be a rounded number: the tick
/// is the one whose time is printed as these seconds, not the one before it.
int64_t lastTick(double seconds, const tks_clock& clock) {
  const double ticks =
      seconds * static_cast<double>(clock.denominator) / static_cast<double>(clock.numerator);
  const auto secondsAt = [&](int64_t tick) {
    return secondsOf(tick, clock.numerator, clock.denominator);
  };
  auto last = static_cast<int64_t>(std::floor(ticks));
  if (secondsAt(last) > seconds) --last;
  return secondsAt(last + 1) <= seconds ? last + 1 : last;
}

/// The frame that is asked for.
Result<uint64_t> frameOf(const Sequence& sequence, const StreamSource& source) {
  const tks_sequence_info info = sequence.info();
  if (info.end_frame == 0)
    return Status(TKS_TRUNCATED, "the sequence ends before a frame of it can be decoded");
  if (!source.seconds) return source.frame.value_or(info.first_frame);
  if (info.clock.numerator == 0)
    return Status(TKS_USAGE, "the sequence does not say how long its ticks are: give --frame");
  const double ticks = *source.seconds * static_cast<double>(info.clock.denominator) /
                       static_cast<double>(info.clock.numerator);
  if (!(std::abs(ticks) < 4e18)) return Status(TKS_USAGE, "no sequence reaches to that time");
  return sequence.find(lastTick(*source.seconds, info.clock));
}

Result<SequencePlace> placeOf(const Sequence& sequence, uint64_t frame) {
  const Result<tks_group> group = sequence.group(frame);
  if (!group) return group.status();
  const tks_sequence_info info = sequence.info();
  SequencePlace place{info.end_frame,
                      info.groups,
                      info.bytes,
                      frame,
                      *sequence.time(frame),
                      info.clock.numerator,
                      info.clock.denominator,
                      info.clock.epoch,
                      info.clock.calendar,
                      *group};
  return place;
}

/// Refuses a complete stream whose bytes have changed.
Status checkSound(Decoder& decoder) {
  const tks_info& info = decoder.info();
  return info.available_bytes == info.stream_bytes ? decoder.verify() : Status();
}

/// The stream that holds the frame.
Result<OpenStream> openFrame(const StreamSource& source, std::vector<std::byte> bytes) {
  Result<Sequence> sequence = Sequence::open(octets(bytes), limitsOfTools());
  if (!sequence) return sequence.status();
  if (source.strict && sequence->info().whole_bytes < bytes.size())
    return Status(TKS_TRUNCATED, "the sequence ends inside a group");
  const Result<uint64_t> frame = frameOf(*sequence, source);
  if (!frame.ok()) return frame.status();
  Result<SequencePlace> place = placeOf(*sequence, *frame);
  if (!place.ok()) return place.status();
  Result<Decoder> decoder = sequence->decoder(*frame);
  if (!decoder) return decoder.status();
  if (const Status sound = checkSound(*decoder); !sound.ok()) return sound;
  const tks_group& group = place->group;
  const uint64_t end =
      std::min(group.stream_offset + group.stream_bytes, group.offset + group.available_bytes);
  bytes.resize(end);
  bytes.erase(bytes.begin(), bytes.begin() + static_cast<ptrdiff_t>(group.stream_offset));
  return OpenStream{std::move(bytes), std::move(*sequence), std::move(*decoder), *std::move(place)};
}

}  // namespace

double secondsOf(int64_t ticks, uint64_t tick_numerator, uint64_t tick_denominator) {
  return static_cast<double>(ticks) * static_cast<double>(tick_numerator) /
         static_cast<double>(tick_denominator);
}

bool isSequence(std::span<const std::byte> bytes) {
  constexpr std::array<uint8_t, 4> kMagic = {'T', 'K', 'G', 0x1a};
  constexpr size_t kTelling = 3;  // bytes of a file that ends early; streams begin otherwise
  const std::span<const uint8_t> front = octets(bytes).first(std::min(bytes.size(), kMagic.size()));
  return front.size() >= kTelling && std::equal(front.begin(), front.end(), kMagic.begin());
}

std::span<const uint8_t> octets(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()};
}

tks_limits limitsOfTools() {
  tks_limits limits = makeLimits();
  limits.max_samples = limits.max_texels = kMostStreamSamples;
  limits.max_memory = memoryLimit();
  return limits;
}

Result<Decoder> openDecoder(std::span<const uint8_t> bytes) {
  return Decoder::open(bytes, limitsOfTools());
}

namespace {

/// The numbers of the components that have a name, or the one that has that number.
std::vector<uint32_t> componentsNamed(const Decoder& decoder, const std::string& name) {
  std::vector<uint32_t> found;
  for (uint32_t i = 0; !name.empty() && i < decoder.info().components; ++i)
    if (decoder.component(i)->name == name) found.push_back(i);
  if (!found.empty()) return found;
  uint32_t number = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
  if (error == std::errc() && end == name.data() + name.size()) found.push_back(number);
  return found;
}

/// Heights and a texture may have one name, and are then both chosen.
Status choose(Decoder& decoder, const std::string& name) {
  const std::vector<uint32_t> numbers = componentsNamed(decoder, name);
  if (numbers.empty())
    return {TKS_USAGE,
            "the stream has no component " + quoted(name) + ": tetrakis info names them"};
  for (const uint32_t number : numbers)
    if (Status status = decoder.choose(number); !status.ok()) return status;
  return {};
}

/// bytes: of the whole file.
Result<OpenStream> openCut(const StreamSource& source, std::vector<std::byte> bytes) {
  const bool is_sequence = isSequence(bytes);
  if (source.strict && !is_sequence)
    if (Status status = checkWhole(octets(bytes)); !status.ok()) return status;
  if (source.bytes && *source.bytes < bytes.size()) bytes.resize(*source.bytes);
  if (is_sequence && !source.components.empty())
    return Status(TKS_USAGE, quoted(source.path) + " is a sequence, which has no --component");
  if (is_sequence) return openFrame(source, std::move(bytes));
  if (source.seconds)
    return Status(TKS_USAGE, quoted(source.path) + " is no sequence, so that no --time is in it");
  Result<Decoder> decoder = openDecoder(octets(bytes));
  if (!decoder) return decoder.status();
  for (const std::string& component : source.components)
    if (Status status = choose(*decoder, component); !status.ok()) return status;
  if (const uint64_t frame = source.frame.value_or(0); frame > 0) {
    const auto asked = static_cast<uint32_t>(std::min<uint64_t>(frame, UINT32_MAX));
    if (Status status = decoder->setFrame(asked); !status.ok()) return status;
  }
  if (const Status sound = checkSound(*decoder); !sound.ok()) return sound;
  return OpenStream{std::move(bytes), std::nullopt, std::move(*decoder)};
}

}  // namespace

Result<Decoder> openAgain(const OpenStream& stream) {
  if (stream.groups) return Status(TKS_USAGE, "the stream is a part of a sequence");
  Result<Decoder> decoder = openDecoder(octets(stream.bytes));
  if (!decoder) return decoder.status();
  for (uint32_t i = 0; i < decoder->info().components; ++i) {
    if (!stream.decoder.component(i)->is_taken || decoder->component(i)->is_taken) continue;
    if (Status status = decoder->choose(i); !status.ok()) return status;
  }
  if (Status status = decoder->setFrame(stream.decoder.info().frame); !status.ok()) return status;
  return decoder;
}

Status showFrame(OpenStream& stream, uint64_t frame) {
  if (!stream.groups)
    return stream.decoder.setFrame(static_cast<uint32_t>(std::min<uint64_t>(frame, UINT32_MAX)));
  Result<Decoder> decoder = stream.groups->decoder(frame);
  if (!decoder) return decoder.status();
  stream.decoder = std::move(*decoder);
  return checkSound(stream.decoder);
}

Result<OpenStream> openStream(const StreamSource& source) {
  Result<std::vector<std::byte>> bytes = readBytes(source.path);
  if (!bytes.ok()) return bytes.status();
  return openCut(source, *std::move(bytes));
}

Result<std::vector<std::byte>> readCut(const StreamSource& source) {
  Result<std::vector<std::byte>> bytes = readBytes(source.path);
  if (!bytes.ok()) return bytes;
  if (!isSequence(*bytes)) {
    Result<OpenStream> stream = openCut(source, *std::move(bytes));
    if (!stream.ok()) return stream.status();
    return std::move(stream->bytes);
  }
  if (source.bytes && *source.bytes < bytes->size()) bytes->resize(*source.bytes);
  const Result<OpenStream> first = openFrame(source, *bytes);
  if (!first.ok()) return first.status();
  return bytes;
}

Result<OpenStream> openTerrain(const StreamSource& source) {
  Result<OpenStream> stream = openStream(source);
  if (stream.ok() && isObject(stream->decoder.info()))
    return Status(TKS_USAGE, quoted(source.path) +
                                 " holds an object, which has no ground: decode --mesh writes it");
  return stream;
}

Extent shownHeights(const tks_info& info) {
  return isGridOnCube(info) ? Extent{info.grid_width, info.grid_height}
                            : Extent{info.width, info.height};
}

uint64_t heightsBytes(const tks_info& info, const std::optional<tks_window>& window) {
  const Extent all = shownHeights(info);
  const uint64_t samples = window ? uint64_t{window->width} * window->height : all.samples();
  return samples * tks_sample_bytes(info.sample);
}

uint64_t imageBytes(const tks_info& info, const std::optional<tks_window>& window) {
  const uint64_t texels = window ? uint64_t{window->width} * window->height
                                 : uint64_t{info.texture_width} * info.texture_height;
  return texels * info.texture_channels * tks_sample_bytes(info.texture_sample);
}

Result<HeightFile> decodeHeights(Decoder& decoder, const std::optional<tks_window>& window,
                                 uint64_t copies) {
  const tks_info& info = decoder.info();
  if (!info.has_heights) return Status(TKS_USAGE, "the stream has no heights");
  Result<std::vector<std::byte>> samples = isGridOnCube(info) ? gridSamples(decoder, window, copies)
                                                              : samplesOf(decoder, window, copies);
  if (!samples) return samples.status();
  const Extent all = shownHeights(info);
  HeightFile file;
  file.width = window ? window->width : all.width;
  file.height = window ? window->height : all.height;
  file.sample = info.sample;
  file.data = std::move(*samples);
  file.scale = info.scale;
  file.offset = info.offset;
  file.spacing_x = info.spacing_x;
  file.spacing_y = info.spacing_y;
  file.unit = info.unit;
  file.vertical_datum = info.vertical_datum;
  file.crs = info.crs;
  file.description = info.description;
  file.registration = info.registration;
  file.geo_keys = info.geo_keys;
  if (info.has_geotransform) file.geotransform = placedAt(info.geotransform, window);
  if (info.has_nodata) file.nodata = info.nodata;
  return file;
}

Result<ImageFile> decodeImage(Decoder& decoder, const std::optional<tks_window>& window,
                              uint64_t copies) {
  const tks_info& info = decoder.info();
  if (!info.has_texture) return Status(TKS_USAGE, "the stream has no texture");
  const Result<uint64_t> fits = decoder.checkMemory(TKS_PART_TEXTURE, window ? &*window : nullptr,
                                                    0, imageBytes(info, window) + copies);
  if (!fits) return fits.status();
  Result<std::vector<std::byte>> texels = window ? decoder.texture(*window) : decoder.texture();
  if (!texels) return texels.status();
  ImageFile file;
  file.width = window ? window->width : info.texture_width;
  file.height = window ? window->height : info.texture_height;
  file.channels = info.texture_channels;
  file.sample = info.texture_sample;
  file.data = std::move(*texels);
  file.opaque = info.texture_opaque != 0;
  file.white_level = info.texture_white_level;
  file.place.registration = info.texture_registration;
  file.place.crs = info.texture_crs;
  file.place.geo_keys = info.texture_geo_keys;
  if (info.texture_has_geotransform)
    file.place.geotransform = placedAt(info.texture_geotransform, window);
  return file;
}

}  // namespace tetrakis::tools
