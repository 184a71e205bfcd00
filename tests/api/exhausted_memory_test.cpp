// SPDX-License-Identifier: Apache-2.0
// Every function of tetrakis.h, sequence.h and transmit.h while memory ends at each place where it
// allocates: it says so in its sentence, writes nothing, leaks nothing, and its decoder goes on, or
// says that it does not.
#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <iterator>
#include <regex>
#include <set>

#include "tests/support/ending_memory.hpp"
#include "tests/support/indexed_terrain.hpp"
#include "tetrakis/components.h"

namespace tetrakis::test {
namespace {

constexpr tks_window kWindow{3, 2, 5, 4};

std::vector<Called> heightCalls() {
  const auto samples = [](tks_info info) { return size_t{info.width} * info.height; };
  return {{"tks_decode_heights",
           [](Desk& d) { return tks_decode_heights(d.decoder, d.out.data(), d.heightBytes()); }},
          {"tks_decode_heights_window",
           [](Desk& d) {
             const size_t bytes = 20 * tks_sample_bytes(d.info.sample);
             return tks_decode_heights_window(d.decoder, &kWindow, d.out.data(), bytes);
           }},
          {"tks_decode_surface",
           [=](Desk& d) {
             auto* const out = reinterpret_cast<float*>(d.out.data());
             return tks_decode_surface(d.decoder, out, samples(d.info));
           }},
          {"tks_decode_surface_window",
           [](Desk& d) {
             auto* const out = reinterpret_cast<float*>(d.out.data());
             return tks_decode_surface_window(d.decoder, &kWindow, out, 20);
           }},
          {"tks_decode_validity",
           [=](Desk& d) { return tks_decode_validity(d.decoder, d.out.data(), samples(d.info)); }},
          {"tks_decode_validity_window", [](Desk& d) {
             return tks_decode_validity_window(d.decoder, &kWindow, d.out.data(), 20);
           }}};
}

std::vector<Called> textureCalls() {
  return {{"tks_decode_texture",
           [](Desk& d) { return tks_decode_texture(d.decoder, d.out.data(), d.texelBytes()); }},
          {"tks_decode_texture_window", [](Desk& d) {
             const size_t bytes =
                 20 * d.info.texture_channels * tks_sample_bytes(d.info.texture_sample);
             return tks_decode_texture_window(d.decoder, &kWindow, d.out.data(), bytes);
           }}};
}

std::vector<Called> meshCalls() {
  return {{"tks_decode_mesh",
           [](Desk& d) { return tks_decode_mesh(d.decoder, TKS_MESH_BUDGET, 50, &d.mesh); }},
          {"tks_decode_screen_mesh",
           [](Desk& d) {
             tks_screen_camera camera = alongRows(5, -10, 900);
             camera.width = 32;  // pictures take time
             camera.height = 20;
             tks_screen screen = {};
             screen.size = sizeof screen;
             screen.cameras = &camera;
             screen.camera_count = 1;
             return tks_decode_screen_mesh(d.decoder, &screen, 50, &d.mesh);
           }},
          {"tks_decode_mesh_tree",
           [](Desk& d) {
             tks_free_mesh_tree(d.tree);
             return tks_decode_mesh_tree(d.decoder, TKS_MESH_CODED, 0, &d.tree);
           }},
          {"tks_view_mesh",
           [](Desk& d) {
             const tks_screen_camera map = mapOf(0, 0, 8, 6);
             return tks_view_mesh(d.tree, map.clip, &d.mesh);
           },
           [](Desk& d) {
             EXPECT_EQ(tks_decode_mesh_tree(d.decoder, TKS_MESH_CODED, 0, &d.tree), TKS_OK);
           },
           [](Desk&) {}, false}};
}

std::vector<Called> decoderCalls() {
  return {{"tks_get_info",
           [](Desk& d) {
             tks_info info = {};
             info.size = sizeof info;
             return tks_get_info(d.decoder, &info);
           },
           [](Desk&) {}, [](Desk&) {}, false},
          {"tks_set_levels", [](Desk& d) { return tks_set_levels(d.decoder, 0, 0); }},
          {"tks_set_threads", [](Desk& d) { return tks_set_threads(d.decoder, 3); }},
          {"tks_verify", [](Desk& d) { return tks_verify(d.decoder); }},
          {"tks_get_component",
           [](Desk& d) {
             tks_component component = {};
             component.size = sizeof component;
             return tks_get_component(d.decoder, 0, &component);
           },
           [](Desk&) {}, [](Desk&) {}, false},
          {"tks_choose_component", [](Desk& d) { return tks_choose_component(d.decoder, 0); }},
          {"tks_fed_level",
           [](Desk& d) {
             uint32_t level = 0;
             return tks_fed_level(d.decoder, TKS_PART_HEIGHTS, &level);
           }},
          {"tks_check_memory", [](Desk& d) {
             uint64_t bytes = 0;
             return tks_check_memory(d.decoder, TKS_PART_HEIGHTS, &kWindow, 0, 0, &bytes);
           }}};
}

/// Of streams with an index.
std::vector<Called> indexCalls() {
  return {
      {"tks_needed_ranges",
       [](Desk& d) { return tks_needed_ranges(d.decoder, TKS_PART_HEIGHTS, &kWindow, &d.ranges); }},
      {"tks_plan",
       [](Desk& d) {
         const tks_screen_camera camera = alongRows(5, -10, 900);
         tks_fetch fetch = {};
         fetch.size = sizeof fetch;
         fetch.bytes = 900;
         fetch.request_bytes = 20;
         return tks_plan(d.decoder, &camera, &fetch, &d.ranges);
       }},
      {"tks_reorder", [](Desk& d) {
         const tks_screen_camera camera = alongRows(5, -10, 900);
         return tks_reorder(d.decoder, &camera, 1, &d.buffer);
       }}};
}

samples::Raster smallHeights() {
  return samples::make({samples::Pattern::kRidges, 19, 17, 1, TKS_I16});
}

/// Heights and a texture in regions, with an index.
const Bytes& indexedStream() {
  static const Bytes stream = [] {
    const samples::Raster heights = smallHeights();
    const samples::Raster image = samples::make({samples::Pattern::kRidges, 20, 18, 3, TKS_U8});
    return encodeRegions(&heights, &image, lossless());
  }();
  return stream;
}

/// Calls that give a decoder of some first bytes others. Then it decodes all that it has.
std::vector<Called> givingCalls() {
  static const Bytes& all = indexedStream();
  static const size_t half = all.size() / 2;
  const auto decode = [](Desk& d) {
    EXPECT_EQ(tks_decode_heights(d.decoder, d.out.data(), d.heightBytes()), TKS_OK);
    uint8_t* const texels = d.out.data() + d.heightBytes();
    EXPECT_EQ(tks_decode_texture(d.decoder, texels, d.texelBytes()), TKS_OK);
  };
  const auto giving = [&](const std::string& name, std::function<tks_status(Desk&)> run) {
    return Called{name, std::move(run), decode, decode, true, true};
  };
  return {
      giving("tks_append", [](Desk& d) { return tks_append(d.decoder, all.data() + half, 300); }),
      giving("tks_put",
             [](Desk& d) { return tks_put(d.decoder, half + 9, all.data() + half + 9, 180); }),
      giving("tks_put_ranges", [](Desk& d) {
        const tks_range ranges[] = {{half + 200, 40, 0}, {half + 1, 60, 0}};
        const uint8_t* const data[] = {all.data() + half + 200, all.data() + half + 1};
        return tks_put_ranges(d.decoder, ranges, data, 2);
      })};
}

/// Brings the header of a stream whose sketch was there.
Called endingASketch(const Bytes& all, size_t there) {
  const auto decode = [](Desk& d) {
    tks_info info = {};
    info.size = sizeof info;
    EXPECT_EQ(tks_get_info(d.decoder, &info), TKS_OK);
    EXPECT_EQ(info.shows_sketch, 0);
    const size_t bytes = size_t{info.width} * info.height * tks_sample_bytes(info.sample);
    EXPECT_EQ(tks_decode_heights(d.decoder, d.out.data(), bytes), TKS_OK);
  };
  return {"tks_append",
          [&all, there](Desk& d) {
            return tks_append(d.decoder, all.data() + there, all.size() - there);
          },
          [](Desk&) {},
          decode,
          true,
          true};
}

/// Calls without a decoder.
std::vector<Called> firstCalls() {
  static const Bytes& stream = indexedStream();
  return {{"tks_open",
           [](Desk& d) {
             tks_decoder* decoder = nullptr;
             const tks_status status = tks_open(stream.data(), stream.size(), nullptr, &decoder,
                                                d.message, sizeof d.message);
             EXPECT_EQ(decoder == nullptr, status != TKS_OK);
             tks_close(decoder);
             return status;
           }},
          {"tks_header_bytes",
           [](Desk& d) {
             uint64_t bytes = 0;
             const tks_status status = tks_header_bytes(stream.data(), stream.size(), &bytes);
             if (status == TKS_OK) d.out[0] = static_cast<uint8_t>(bytes);
             return status;
           },
           [](Desk&) {}, [](Desk&) {}, false},
          {"tks_find_outliers",
           [](Desk&) {
             static const samples::Raster raster = smallHeights();
             const tks_heights heights = raster.heights();
             tks_outliers outliers = {};
             outliers.size = sizeof outliers;
             return tks_find_outliers(&heights, &outliers);
           },
           [](Desk&) {}, [](Desk&) {}, false},
          {"tks_find_white_level",
           [](Desk& d) {
             static const samples::Raster raster =
                 samples::make({samples::Pattern::kRidges, 9, 8, 2, TKS_U16});
             const tks_image image = raster.image();
             const uint32_t found = tks_find_white_level(&image);
             if (found > 0) d.out[0] = static_cast<uint8_t>(found);
             return found > 0 ? TKS_OK : TKS_NO_MEMORY;
           },
           [](Desk&) {}, [](Desk&) {}, false},
          {"tks_sample_bytes",
           [](Desk&) { return tks_sample_bytes(TKS_F32) == 4 ? TKS_OK : TKS_USAGE; }},
          {"tks_cube_sides", [](Desk&) { return tks_cube_sides()[0] == 18 ? TKS_OK : TKS_USAGE; }},
          {"tks_cube_depth", [](Desk&) { return tks_cube_depth(1024) == 8 ? TKS_OK : TKS_USAGE; }}};
}

std::vector<Called> cubeCalls() {
  static const tks_geographic_grid grid = {
      sizeof(tks_geographic_grid), 12, 6, {-180, 30, 0, 90, 0, -30}};
  static const std::vector<float> heights(6 * 25);
  return {{"tks_cube_from_grid",
           [](Desk& d) {
             auto* const cube = reinterpret_cast<float*>(d.out.data());
             return tks_cube_from_grid(&grid, heights.data(), 2, 2, cube, nullptr, nullptr,
                                       d.message, sizeof d.message);
           }},
          {"tks_grid_from_cube",
           [](Desk& d) {
             auto* const out = reinterpret_cast<float*>(d.out.data());
             return tks_grid_from_cube(heights.data(), 2, &grid, &kWindow, 2, out, d.message,
                                       sizeof d.message);
           }},
          {"tks_cube_windows", [](Desk& d) {
             std::array<tks_window, 6> windows{};
             return tks_cube_windows(2, &grid, &kWindow, windows.data(), d.message,
                                     sizeof d.message);
           }}};
}

/// Of heights on a cube.
std::vector<Called> gridCalls() {
  static const tks_geographic_grid grid = {
      sizeof(tks_geographic_grid), 24, 12, {-180, 15, 0, 90, 0, -15}};
  return {{"tks_decode_grid", [](Desk& d) {
             auto* const out = reinterpret_cast<float*>(d.out.data());
             return tks_decode_grid(d.decoder, &grid, &kWindow, out, 20);
           }}};
}

int onEquator(void*, double column, double row, double* longitude, double* latitude) {
  *longitude = 0.01 * column;
  *latitude = -0.01 * row;
  return 0;
}

tks_status fitPositions(tks_buffer& out) {
  tks_ground ground = {};
  ground.size = sizeof ground;
  ground.width = 19;
  ground.height = 17;
  ground.locate = onEquator;
  return tks_fit_positions(&ground, &out);
}

std::vector<Called> fittingCalls() {
  return {{"tks_fit_positions",
           [](Desk& d) {
             tks_free_buffer(&d.buffer);
             return fitPositions(d.buffer);
           },
           [](Desk&) {}, [](Desk&) {}, false}};
}

/// Of streams with positions.
std::vector<Called> positionCalls() {
  return {{"tks_locate", [](Desk& d) {
             const tks_pixel pixel{TKS_PART_HEIGHTS, 3, 4};
             double longitude = 0, latitude = 0;
             return tks_locate(d.decoder, &pixel, &longitude, &latitude);
           }}};
}

Bytes streamWithPositions() {
  tks_buffer positions = {};
  EXPECT_EQ(fitPositions(positions), TKS_OK);
  const samples::Raster raster = smallHeights();
  tks_heights heights = raster.heights();
  heights.positions = positions.data;
  heights.positions_size = positions.size;
  tks_buffer stream = {};
  const tks_encode_options options = lossless();
  EXPECT_EQ(tks_encode(&heights, nullptr, &options, &stream, nullptr, 0), TKS_OK);
  const Bytes bytes(stream.data, stream.data + stream.size);
  tks_free_buffer(&stream);
  tks_free_buffer(&positions);
  return bytes;
}

/// Of streams whose columns go round.
std::vector<Called> globeCalls() {
  return {{"tks_decode_globe", [](Desk& d) {
             const tks_globe sphere = {sizeof sphere, 1, 1, 0, 0};
             tks_free_globe_mesh(&d.globe);
             return tks_decode_globe(d.decoder, TKS_MESH_BUDGET, 30, &sphere, &d.globe);
           }}};
}

std::vector<Called> objectCalls() {
  return {{"tks_decode_object", [](Desk& d) {
             tks_free_object_mesh(&d.object);
             return tks_decode_object(d.decoder, TKS_MESH_BUDGET, 0, &d.object);
           }}};
}

/// Of a tetrahedron.
Called encodingAnObject() {
  static const double positions[] = {0, 0, 0, 4, 0, 0, 0, 4, 0, 0, 0, 4};
  static const uint32_t triangles[] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
  Called encode{"tks_encode_object", [](Desk& d) {
                  tks_free_buffer(&d.buffer);
                  tks_triangle_mesh mesh{};
                  mesh.size = sizeof mesh;
                  mesh.vertex_count = 4;
                  mesh.triangle_count = 4;
                  mesh.positions = positions;
                  mesh.triangles = triangles;
                  const tks_encode_options options = budget(400);
                  return tks_encode_object(&mesh, nullptr, &options, nullptr, &d.buffer, d.message,
                                           sizeof d.message);
                }};
  encode.remembers = false;
  return encode;
}

Bytes streamRound() {
  const samples::Raster raster = samples::make({samples::Pattern::kRidges, 18, 9, 1, TKS_I16});
  tks_heights heights = raster.heights();
  heights.has_geotransform = 1;
  const double transform[] = {-180, 20, 0, 90, 0, -20};
  std::copy(std::begin(transform), std::end(transform), heights.geotransform);
  return encodeHeights(heights, lossless());
}

std::vector<Called> encodingCalls() {
  static const samples::Raster heights =
      samples::make({samples::Pattern::kRidges, 7, 6, 1, TKS_I16});
  static const samples::Raster image = samples::make({samples::Pattern::kRidges, 5, 6, 3, TKS_U8});
  const auto encoding = [](const tks_heights& h, const tks_image& i, tks_encode_options options) {
    options.threads = 2;
    Called encode{"tks_encode", [=](Desk& d) {
                    tks_free_buffer(&d.buffer);
                    return tks_encode(h.size > 0 ? &h : nullptr, i.size > 0 ? &i : nullptr,
                                      &options, &d.buffer, d.message, sizeof d.message);
                  }};
    encode.remembers = false;
    return encode;
  };
  return {encoding(heights.heights(), {}, lossless()), encoding({}, image.image(), lossless()),
          encoding(heights.heights(), image.image(), budget(150))};
}

/// A stream of the conformance vectors.
Bytes vectorOf(const std::string& name) {
  std::ifstream file(std::string(TETRAKIS_VECTORS) + "/" + name + ".tks", std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

tks_heights frameOf(int64_t time) {
  static const samples::Raster frames[] = {
      samples::make({samples::Pattern::kRidges, 4, 3, 1, TKS_U8, 1}),
      samples::make({samples::Pattern::kRidges, 4, 3, 1, TKS_U8, 2})};
  return frames[time % 2].heights();
}

tks_status openEncoder(Desk& d) {
  tks_sequence_encoder_close(d.sequence_encoder);
  d.sequence_encoder = nullptr;
  static const tks_encode_options encode = lossless();
  tks_sequence_options options = {};
  options.size = sizeof options;
  options.group = 2;
  options.encode = &encode;
  options.clock.size = sizeof options.clock;
  options.reference = TKS_ALL_BYTES;
  return tks_sequence_encoder_open(&options, &d.sequence_encoder, d.message, sizeof d.message);
}

tks_status push(Desk& d, int64_t time) {
  const tks_heights heights = frameOf(time);
  return tks_sequence_push(d.sequence_encoder, &heights, nullptr, time, d.message,
                           sizeof d.message);
}

tks_status flush(Desk& d) {
  return tks_sequence_flush(d.sequence_encoder, d.message, sizeof d.message);
}

tks_status take(Desk& d) {
  tks_free_buffer(&d.buffer);
  return tks_sequence_take(d.sequence_encoder, &d.buffer);
}

/// The encoder with frames before this one.
std::function<void(Desk&)> encoderAt(int64_t time) {
  return [time](Desk& d) {
    EXPECT_EQ(openEncoder(d), TKS_OK);
    for (int64_t t = 0; t < time; ++t) EXPECT_EQ(push(d, t), TKS_OK);
  };
}

std::vector<Called> sequenceEncoderCalls() {
  const auto taken = [](Desk& d) { EXPECT_EQ(take(d), TKS_OK); };
  return {{"tks_encode_frames",
           [](Desk& d) {
             tks_free_buffer(&d.buffer);
             const tks_heights frames[] = {frameOf(0), frameOf(1)};
             const tks_encode_options options = lossless();
             return tks_encode_frames(frames, nullptr, 2, &options, &d.buffer, d.message,
                                      sizeof d.message);
           }},
          {"tks_sequence_encoder_open", openEncoder},
          {"tks_sequence_push", [](Desk& d) { return push(d, 1); }, encoderAt(1), taken},
          {"tks_sequence_flush", flush, encoderAt(1), taken},
          {"tks_sequence_take", take, encoderAt(2), [](Desk&) {}, false}};
}

/// Two groups of two frames.
const Bytes& smallSequence() {
  static const Bytes bytes = [] {
    Desk d({});
    encoderAt(4)(d);
    EXPECT_EQ(take(d), TKS_OK);
    return Bytes(d.buffer.data, d.buffer.data + d.buffer.size);
  }();
  return bytes;
}

tks_status openSequence(Desk& d) {
  tks_sequence_close(d.sequence);
  d.sequence = nullptr;
  return tks_sequence_open(nullptr, &d.sequence);
}

tks_status append(Desk& d) {
  return tks_sequence_append(d.sequence, smallSequence().data(), smallSequence().size());
}

std::vector<Called> sequenceCalls() {
  const auto opened = [](Desk& d) { EXPECT_EQ(openSequence(d), TKS_OK); };
  const auto filled = [](Desk& d) {
    EXPECT_EQ(openSequence(d), TKS_OK);
    EXPECT_EQ(append(d), TKS_OK);
  };
  const auto about = [&](const char* name, const std::function<tks_status(Desk&)>& run) {
    return Called{name, run, filled, [](Desk&) {}, false};
  };
  return {{"tks_sequence_open", openSequence, [](Desk&) {}, [](Desk&) {}, false},
          {"tks_sequence_append", append, opened, [](Desk&) {}, false},
          about("tks_sequence_forget", [](Desk& d) { return tks_sequence_forget(d.sequence, 2); }),
          about("tks_sequence_get_info",
                [](Desk& d) {
                  tks_sequence_info info = {};
                  info.size = sizeof info;
                  return tks_sequence_get_info(d.sequence, &info);
                }),
          about("tks_sequence_time",
                [](Desk& d) {
                  int64_t time = 0;
                  return tks_sequence_time(d.sequence, 3, &time);
                }),
          about("tks_sequence_find",
                [](Desk& d) {
                  uint64_t frame = 0;
                  return tks_sequence_find(d.sequence, 3, &frame);
                }),
          about("tks_sequence_group",
                [](Desk& d) {
                  tks_group group = {};
                  group.size = sizeof group;
                  return tks_sequence_group(d.sequence, 3, &group);
                }),
          about("tks_sequence_frame",
                [](Desk& d) {
                  tks_decoder* decoder = nullptr;
                  return tks_sequence_frame(d.sequence, 3, &decoder);
                }),
          about("tks_sequence_thin",
                [](Desk& d) {
                  tks_free_buffer(&d.buffer);
                  return tks_sequence_thin(d.sequence, 30, &d.buffer, d.message, sizeof d.message);
                }),
          {"tks_sequence_encoder_continue",
           [](Desk& d) {
             return tks_sequence_encoder_continue(d.sequence_encoder, d.sequence, d.message,
                                                  sizeof d.message);
           },
           [filled](Desk& d) {
             EXPECT_EQ(openEncoder(d), TKS_OK);
             filled(d);
           },
           [](Desk&) {}, false},
          about("tks_sequence_locate", [](Desk&) {
            tks_range range = {};
            int found = 0;
            return tks_sequence_locate(smallSequence().data(), smallSequence().size(),
                                       smallSequence().size(), 0, 1, &range, &found);
          })};
}

tks_status openReceiver(Desk& d) {
  tks_receiver_close(d.receiver);
  d.receiver = nullptr;
  return tks_receiver_open(7, nullptr, &d.receiver);
}

tks_status openTransmitter(Desk& d) {
  tks_transmitter_close(d.transmitter);
  d.transmitter = nullptr;
  return tks_transmitter_open(nullptr, &d.transmitter, d.message, sizeof d.message);
}

tks_status appendToTransmitter(Desk& d) {
  return tks_transmitter_append(d.transmitter, smallSequence().data(), smallSequence().size(),
                                d.message, sizeof d.message);
}

/// Writes it where other outputs go.
tks_status control(Desk& d) {
  tks_wants wants = {};
  wants.size = sizeof wants;
  wants.link = 1000;
  const tks_screen_camera camera = mapOf(0, 0, 4, 3);
  wants.view = &camera;
  size_t size = 0;
  return tks_receiver_control(d.receiver, &wants, d.out.data(), &size);
}

tks_status answer(Desk& d) {
  tks_free_buffer(&d.buffer);
  static const Bytes message = [] {
    Desk other({});
    size_t size = 0;
    tks_wants wants = {};
    wants.size = sizeof wants;
    wants.link = 1000;
    EXPECT_EQ(openReceiver(other), TKS_OK);
    EXPECT_EQ(tks_receiver_control(other.receiver, &wants, other.out.data(), &size), TKS_OK);
    return Bytes(other.out.begin(), other.out.begin() + static_cast<ptrdiff_t>(size));
  }();
  return tks_transmitter_answer(d.transmitter, message.data(), message.size(), &d.buffer, d.message,
                                sizeof d.message);
}

void serve(Desk& d) {
  EXPECT_EQ(openTransmitter(d), TKS_OK);
  EXPECT_EQ(appendToTransmitter(d), TKS_OK);
}

/// What a receiver gets of the small sequence.
const Bytes& smallAnswer() {
  static const Bytes bytes = [] {
    Desk d({});
    serve(d);
    EXPECT_EQ(answer(d), TKS_OK);
    return Bytes(d.buffer.data, d.buffer.data + d.buffer.size);
  }();
  return bytes;
}

tks_status takeAnswer(Desk& d) {
  return tks_receiver_take(d.receiver, smallAnswer().data(), smallAnswer().size());
}

std::vector<Called> transmitterCalls() {
  const auto opened = [](Desk& d) { EXPECT_EQ(openTransmitter(d), TKS_OK); };
  const auto about = [&](const char* name, const std::function<tks_status(Desk&)>& run) {
    return Called{name, run, serve, [](Desk&) {}, false};
  };
  return {{"tks_transmitter_open", openTransmitter},
          {"tks_transmitter_append", appendToTransmitter, opened, [](Desk&) {}, false},
          about("tks_transmitter_forget",
                [](Desk& d) { return tks_transmitter_forget(d.transmitter, 2); }),
          about("tks_transmitter_get_info",
                [](Desk& d) {
                  tks_sequence_info info = {};
                  info.size = sizeof info;
                  return tks_transmitter_get_info(d.transmitter, &info);
                }),
          {"tks_transmitter_answer", answer, serve, [](Desk&) {}, true, false, false}};
}

std::vector<Called> receiverCalls() {
  const auto opened = [](Desk& d) { EXPECT_EQ(openReceiver(d), TKS_OK); };
  const auto filled = [](Desk& d) {
    EXPECT_EQ(openReceiver(d), TKS_OK);
    EXPECT_EQ(takeAnswer(d), TKS_OK);
  };
  const auto about = [&](const char* name, const std::function<tks_status(Desk&)>& run) {
    return Called{name, run, filled, [](Desk&) {}, false};
  };
  return {{"tks_receiver_open", openReceiver, [](Desk&) {}, [](Desk&) {}, false},
          {"tks_receiver_control", control, opened, [](Desk&) {}, false},
          {"tks_receiver_take", takeAnswer, opened, [](Desk&) {}, false},
          about("tks_receiver_get_info",
                [](Desk& d) {
                  tks_receiver_info info = {};
                  info.size = sizeof info;
                  return tks_receiver_get_info(d.receiver, &info);
                }),
          about("tks_receiver_find",
                [](Desk& d) {
                  uint64_t found = 0;
                  int64_t time = 0;
                  return tks_receiver_find(d.receiver, 3, &found, &time);
                }),
          about("tks_receiver_frame",
                [](Desk& d) {
                  tks_decoder* decoder = nullptr;
                  return tks_receiver_frame(d.receiver, 3, &decoder);
                }),
          about("tks_receiver_forget", [](Desk& d) { return tks_receiver_forget(d.receiver, 2); }),
          about("tks_receiver_write", [](Desk& d) {
            tks_free_buffer(&d.buffer);
            return tks_receiver_write(d.receiver, TKS_NEWEST_FRAME, &d.buffer);
          })};
}

/// Of a stream of several frames.
std::vector<Called> frameCalls() {
  const auto heights = heightCalls();
  Called called = heights.front();
  called.before = [](Desk& d) { EXPECT_EQ(tks_set_frame(d.decoder, 1), TKS_OK); };
  return {called, {"tks_set_frame", [](Desk& d) { return tks_set_frame(d.decoder, 1); }}};
}

std::vector<Called> combiningCalls() {
  Called combine{"tks_combine", [](Desk& d) {
                   tks_free_buffer(&d.buffer);
                   const Bytes& small = indexedStream();
                   const tks_combined streams[] = {
                       {sizeof(tks_combined), small.data(), small.size(), nullptr, 0},
                       {sizeof(tks_combined), small.data(), small.size(), "again", 2}};
                   return tks_combine(streams, 2, nullptr, &d.buffer, d.message, sizeof d.message);
                 }};
  combine.remembers = false;
  return {combine};
}

void exhaustAll(const std::vector<Called>& calls, Prefix stream) {
  for (const Called& called : calls) exhaust(called, stream);
}

TEST(ExhaustedMemory, OfCallsWithoutADecoder) {
  exhaustAll(firstCalls(), {});
}

TEST(ExhaustedMemory, OfGlobes) {
  exhaustAll(cubeCalls(), {});
  exhaustAll(gridCalls(), vectorOf("forest_cube_17x102"));
}

TEST(ExhaustedMemory, OfCallsAboutAStream) {
  exhaustAll(decoderCalls(), indexedStream());
  exhaustAll(indexCalls(), indexedStream());
}

TEST(ExhaustedMemory, OfCombining) {
  exhaustAll(combiningCalls(), {});
}

TEST(ExhaustedMemory, OfPositions) {
  exhaustAll(fittingCalls(), {});
  exhaustAll(positionCalls(), streamWithPositions());
}

TEST(ExhaustedMemory, OfMoreBytes) {
  exhaustAll(givingCalls(), Prefix(indexedStream()).first(indexedStream().size() / 2));
}

TEST(ExhaustedMemory, OfSketches) {
  const Bytes stream = vectorOf("sketch_33x33");
  for (const size_t there : {100u, 140u})
    exhaust(endingASketch(stream, there), Prefix(stream).first(there));
}

TEST(ExhaustedMemory, OfMeshes) {
  const samples::Raster heights = samples::make({samples::Pattern::kRidges, 9, 8, 1, TKS_I16});
  exhaustAll(meshCalls(), encode(&heights, nullptr, lossless()));
  exhaustAll(meshCalls(), vectorOf("checker_voids_18x9"));
  exhaustAll(globeCalls(), streamRound());
  exhaustAll(globeCalls(), vectorOf("forest_smallest_3x18"));
}

TEST(ExhaustedMemory, OfObjects) {
  exhaustAll(objectCalls(), vectorOf("object_open_17x68"));
  exhaustAll(objectCalls(), vectorOf("object_joint_9x54_17x102"));
  exhaustAll(objectCalls(), vectorOf("triangles_textured_81"));
  exhaust(encodingAnObject(), {});
}

TEST(ExhaustedMemory, OfSequences) {
  exhaustAll(sequenceEncoderCalls(), {});
  exhaustAll(sequenceCalls(), {});
  exhaustAll(frameCalls(), vectorOf("frames_voids_40x33"));
  exhaust(textureCalls().front(), vectorOf("frames_rgb_40x30"));
}

TEST(ExhaustedMemory, OfTransmissions) {
  exhaustAll(transmitterCalls(), {});
  exhaustAll(receiverCalls(), {});
}

TEST(ExhaustedMemory, OfEncoders) {
  for (const Called& called : encodingCalls()) exhaust(called, {});
}

/// A vector of each way to code heights, and of each way to code textures.
TEST(ExhaustedMemory, OfDecoders) {
  for (const char* name :
       {"regions_coast_gridless_60x41", "noise_steps_regions_40x33", "noise_relative_f32_30x20",
        "noise_facets_30x20", "noise_drawn_heights_30x21", "noise_table_knots_28x23",
        "noise_late_table_60_28x23", "noise_repeats_f32_70x31", "noise_flat_none_30x30",
        "forest_cube_17x102"}) {
    SCOPED_TRACE(name);
    exhaustAll(heightCalls(), vectorOf(name));
  }
  for (const char* name : {"tables_overlay_80x60", "further_rgb_regions_53x38",
                           "noise_repeats_texels_61x44", "noise_drawn_21x20", "stored_rgb_15x13",
                           "bridged_cutout_grey16_45x64", "forest_texture_33x66"}) {
    SCOPED_TRACE(name);
    exhaustAll(textureCalls(), vectorOf(name));
  }
}

/// Threads that are refused, or end, in the middle of work.
TEST(ExhaustedMemory, OfThreads) {
  std::vector<Called> calls = heightCalls();
  const std::vector<Called> more = textureCalls();
  calls.insert(calls.end(), more.begin(), more.end());
  for (Called& called : calls)
    called.before = [](Desk& d) { EXPECT_EQ(tks_set_threads(d.decoder, 4), TKS_OK); };
  exhaustAll(calls, indexedStream());
}

/// All functions that the headers declare.
TEST(ExhaustedMemory, IsTriedOfEveryFunction) {
  std::set<std::string> tried = {
      "tks_free_buffer",     "tks_free_mesh",        "tks_free_ranges",
      "tks_close",           "tks_free_mesh_tree",   "tks_message",
      "tks_free_globe_mesh", "tks_free_object_mesh", "tks_encode_object",
      "tks_sequence_close",  "tks_sequence_message", "tks_sequence_encoder_close",
      "tks_receiver_close",  "tks_receiver_message", "tks_transmitter_close"};
  for (const auto& calls : {firstCalls(),       decoderCalls(),  indexCalls(),
                            givingCalls(),      meshCalls(),     globeCalls(),
                            objectCalls(),      fittingCalls(),  positionCalls(),
                            cubeCalls(),        gridCalls(),     encodingCalls(),
                            heightCalls(),      textureCalls(),  sequenceEncoderCalls(),
                            sequenceCalls(),    frameCalls(),    receiverCalls(),
                            transmitterCalls(), combiningCalls()})
    for (const Called& called : calls) tried.insert(called.name);
  const std::regex declared("\\n[a-z][A-Za-z0-9_ *]*[ *](tks_[a-z_]+)\\(");
  std::set<std::string> functions;
  for (const char* name : {"tetrakis.h", "components.h", "sequence.h", "transmit.h"}) {
    std::ifstream file(std::string(TETRAKIS_HEADERS "/") + name);
    const std::string header{std::istreambuf_iterator<char>(file), {}};
    for (std::sregex_iterator at(header.begin(), header.end(), declared), end; at != end; ++at)
      functions.insert((*at)[1]);
  }
  EXPECT_GT(functions.size(), 30u);
  EXPECT_EQ(functions, tried);
}

}  // namespace
}  // namespace tetrakis::test
