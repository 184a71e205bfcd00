// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/commands/decode_outputs.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "apps/tools/files/file_bytes.hpp"

namespace tetrakis::tools {
namespace {

Status plan(const std::string& path, bool force, const char* extension,
            std::optional<Output>& output) {
  if (path.empty()) return Status();
  Result<Output> planned = Output::plan(path, force, extension);
  if (!planned.ok()) return planned.status();
  output.emplace(std::move(*planned));
  return Status();
}

/// The size that an engine wants; nothing where none is asked for.
Result<std::optional<EngineSize>> engineOf(const DecodeArguments& arguments, const tks_info& info,
                                           const std::optional<Output>& height) {
  if (arguments.size.empty()) {
    if (!height || formatOf(height->name(), "") != "r16") return std::optional<EngineSize>();
    return Status(TKS_USAGE, "an .r16 file is one of an engine: give --size unreal or unity");
  }
  const Result<EngineSize> size =
      parseEngineSize(arguments.size, std::max(info.width, info.height));
  if (!size.ok()) return size.status();
  if (Status status = checkEngineFormat(*size, height->name()); !status.ok()) return status;
  return std::optional<EngineSize>(*size);
}

}  // namespace

Result<DecodeOutputs> planOutputs(const DecodeArguments& arguments, const tks_info& info) {
  DecodeOutputs outputs;
  const bool force = arguments.force;
  const char* const heights = arguments.size.empty() ? ".tif" : ".r16";
  Status status = plan(arguments.height, force, heights, outputs.height);
  if (status.ok()) status = plan(arguments.texture, force, ".png", outputs.texture);
  if (status.ok()) status = plan(arguments.mesh, force, ".glb", outputs.mesh);
  if (status.ok()) status = plan(arguments.normal_map, force, ".png", outputs.normals);
  if (status.ok() && outputs.mesh)
    status = checkMeshOptions(outputs.mesh->name(), arguments.mesh_options);
  if (status.ok() && outputs.normals)
    status = checkImageFormat(outputs.normals->name(), {.channels = 3});
  if (!status.ok()) return status;
  const Result<std::optional<EngineSize>> engine = engineOf(arguments, info, outputs.height);
  if (!engine.ok()) return engine.status();
  outputs.engine = *engine;
  if (!outputs.texture || !info.has_texture) return outputs;
  status = checkImageFormat(outputs.texture->name(), {.channels = info.texture_channels,
                                                      .sample = info.texture_sample,
                                                      .opaque = info.texture_opaque != 0});
  if (!status.ok()) return status;
  return outputs;
}

Status commit(DecodeOutputs& outputs) {
  std::vector<Output*> planned;
  for (std::optional<Output>* output :
       {&outputs.height, &outputs.texture, &outputs.mesh, &outputs.normals})
    if (*output) planned.push_back(&**output);
  return Output::commitAll(std::move(planned));
}

}  // namespace tetrakis::tools
