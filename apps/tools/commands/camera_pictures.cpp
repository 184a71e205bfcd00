// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/commands/camera_pictures.hpp"

#include <utility>

#include "apps/tools/files/files.hpp"

namespace tetrakis::tools {
namespace {

Status stageAll(std::vector<Output>& outputs, const std::vector<Picture>& pictures) {
  for (size_t i = 0; i < outputs.size(); ++i) {
    const ImageFile image = imageOf(pictures[i]);
    const Status status =
        outputs[i].stage([&](const std::string& path) { return writeImage(path, image); });
    if (!status.ok()) return status;
  }
  return Status();
}

}  // namespace

Result<CameraPictures> CameraPictures::plan(const std::string& folder, size_t cameras, bool force) {
  Result<OutputFolder> made = OutputFolder::create(folder);
  if (!made.ok()) return made.status();
  CameraPictures result(std::move(*made));
  for (size_t i = 1; i <= cameras; ++i) {
    for (const auto& [name, outputs] :
         {std::pair("picture-", &result.pictures_), std::pair("original-", &result.originals_)}) {
      const std::string file = name + std::to_string(i) + ".png";
      Result<Output> output = Output::plan(result.folder_.file(file), force, ".png");
      if (!output.ok()) return output.status();
      outputs->push_back(std::move(*output));
    }
  }
  return result;
}

Status CameraPictures::write(const std::vector<Picture>& pictures,
                             const std::vector<Picture>& originals) {
  if (Status status = stageAll(pictures_, pictures); !status.ok()) return status;
  if (Status status = stageAll(originals_, originals); !status.ok()) return status;
  std::vector<Output*> all;
  for (Output& output : pictures_) all.push_back(&output);
  for (Output& output : originals_) all.push_back(&output);
  return Output::commitAll(std::move(all));
}

}  // namespace tetrakis::tools
