// SPDX-License-Identifier: Apache-2.0
// GivenObject is a mesh that is to be coded, with all that its two encoders share: that of
// heights over a base mesh, and that of triangles. CodedObject is the stream that one of them made.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/watch.hpp"
#include "codec/remesh/mesh_colours.hpp"
#include "codec/remesh/mesh_distance.hpp"
#include "codec/remesh/object.hpp"
#include "tetrakis/result.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::inline api {

/// Meshes are decimated to so many triangles, unless their topology needs more.
inline constexpr uint32_t kFewestTriangles = 16;

/// Places of either surface by which trials are compared; reports take more.
inline constexpr size_t kTrialPlaces = 6000;

/// Tells the caller how far the search is. Nobody knows how many streams will be tried: each takes
/// a part of what is left.
class SearchProgress {
 public:
  explicit SearchProgress(const tks_encode_options& options) : options_(options) {}

  /// A stream is tried by an encoding under these options.
  void attend(tks_encode_options& options) {
    begin_ = done_;
    options.progress = options_.progress != nullptr ? &SearchProgress::told : nullptr;
    options.user = this;
  }
  /// Another trial has begun. Throws Stopped.
  void tell() {
    if (options_.progress == nullptr) return;
    begin_ = done_;
    if (told(this, 0.1) != 0) throw Stopped();
  }
  bool isStopped() const { return stopped_; }

 private:
  static int told(void* user, double done) {
    constexpr double kOfTheRest = 0.4;
    auto& self = *static_cast<SearchProgress*>(user);
    self.done_ = self.begin_ + done * kOfTheRest * (1 - self.begin_);
    self.stopped_ = self.options_.progress(self.options_.user, self.done_) != 0;
    return self.stopped_;
  }

  const tks_encode_options& options_;
  double begin_ = 0, done_ = 0;
  bool stopped_ = false;
};

/// TKS_USAGE with a sentence.
Status misusedObject(const std::string& sentence);

class ObjectPictures;

/// An image that lies on a mesh beside its texture, and becomes a component of that name.
struct GivenMap {
  std::string name;
  tks_image image{};
  double weight = 0;  ///< as tks_object_map has it
};

/// A mesh whose fields are sound.
struct GivenObject {
  /// All outlive this. image: null, or checked.
  GivenObject(const tks_triangle_mesh& from, const TriangleMesh& triangles,
              const tks_image* its_image, const tks_encode_options& target)
      : mesh(from),
        image(its_image),
        options(target),
        source(triangles, kFewestTriangles),
        progress(target) {}

  double wantedError() const;
  /// The colours of an image that lies on the mesh.
  MeshColours coloursOf(const tks_image& of) const;

  const tks_triangle_mesh& mesh;
  const tks_image* image;
  tks_encode_options options;
  ObjectSource source;
  SearchProgress progress;
  std::vector<GivenMap> maps;
  const ObjectPictures* pictures = nullptr;  ///< by which streams are compared; null: no image
};

struct CodedObject {
  std::vector<uint8_t> stream;
  MeshDistance distance;      ///< to the mesh
  double picture_error = -1;  ///< mean square (ObjectPictures); -1: there is no texture
  /// Of tks_object_report, where they are of the stream.
  tks_object_kind kind = TKS_OBJECT_RESAMPLED;
  uint32_t patches = 0, depth = 0, texture_depth = 0, coded_triangles = 0;
  double resampling_error = 0;
  uint64_t sketch_bytes = 0;
  std::shared_ptr<const ResampledObject> object;  ///< of a resampled one
};

Result<TriangleMesh> meshOf(const tks_triangle_mesh& given);
Status checkMeshImage(const tks_triangle_mesh& mesh, const tks_image* image);
Status checkObjectOptions(const tks_encode_options& options);

/// Encodes heights (null: none), image (null: none), or both.
Result<std::vector<uint8_t>> encodedTrial(GivenObject& given, tks_encode_options options,
                                          const tks_heights* heights, const tks_image* image);

/// Within the target of the options: heights over the base mesh that serves it best.
Result<CodedObject> encodeResampled(GivenObject& given);

/// Within the target of the options: as many triangles, on as fine a grid, as serve it best.
Result<CodedObject> encodeTriangles(GivenObject& given);

/// Puts a sketch before the header of an object, if the mesh asks for one or the header is long.
/// The stream is coded anew if it would exceed the bytes of the options else.
Result<CodedObject> withSketch(GivenObject& given, CodedObject whole);

struct DecoderCloser {
  void operator()(tks_decoder* decoder) const { tks_close(decoder); }
};
/// A decoder of a stream that an encoder has made.
using OwnDecoder = std::unique_ptr<tks_decoder, DecoderCloser>;

/// The texels of a stream, interleaved. Texels of 8 bits become numbers up to 255.
Result<std::vector<uint16_t>> decodedTexels(const std::vector<uint8_t>& stream);

}  // namespace tetrakis::inline api
