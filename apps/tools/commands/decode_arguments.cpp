// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/commands/decode_arguments.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "apps/tools/output/output_names.hpp"

namespace tetrakis::tools {
namespace {

/// Words to values.
template <class T>
CLI::Option* addChoice(CLI::App& verb, const char* name, T& value, const std::string& help,
                       const std::map<std::string, T>& words) {
  std::string names;
  for (const auto& word : words) names += (names.empty() ? "" : "|") + word.first;
  const auto known = [words, names](std::string& text) {
    const auto word = words.find(text);
    if (word == words.end()) return "'" + text + "' is none of " + names;
    text = std::to_string(static_cast<int>(word->second));
    return std::string();
  };
  return verb.add_option(name, value, help)->transform(CLI::Validator(known, ""))->type_name(names);
}

CLI::Option* addGround(CLI::App& verb, DecodeArguments& arguments) {
  CLI::Option* const height = verb.add_option("--height", arguments.height,
                                              "Heights, same type as encoded (.tif .png .exr …)")
                                  ->type_name("OUT.tif");
  CLI::Option* const size =
      verb.add_option("--size", arguments.size,
                      "Heights as a square of 16 bits for an engine: unreal, unity, unreal:2017")
          ->type_name("ENGINE")
          ->needs(height);
  verb.add_flag("--json", arguments.json, "With --size: its scales as JSON")->needs(size);
  verb.add_option("--texture", arguments.texture, "Texture (.png .tif .jpg .bmp .webp .jp2 …)")
      ->type_name("OUT.png");
  verb.add_option("--normal-map", arguments.normal_map,
                  "Normals of the surface as a picture (.png .tif …)")
      ->type_name("OUT.png");
  return size;
}

CLI::Option* addMesh(CLI::App& verb, DecodeArguments& arguments) {
  CLI::Option* const mesh =
      verb.add_option("--mesh", arguments.mesh, "Mesh in metres (.glb .obj .ply)")
          ->type_name("OUT.glb");
  CLI::Option* const triangles =
      addTriangles(verb, arguments.triangles, "At most so many triangles; else every sample")
          ->needs(mesh);
  verb.add_flag("--coded-mesh", arguments.coded_mesh, "The mesh that the bytes themselves code")
      ->needs(mesh)
      ->excludes(triangles);
  CLI::Option* const turned =
      verb.add_flag("--turn-edges", arguments.turn_edges,
                    "Edges follow the terrain: fewer errors, but no 4-8 mesh")
          ->needs(triangles);
  CLI::Option* const globe =
      verb.add_flag("--globe", arguments.globe,
                    "A closed globe, of heights that go round one or lie on a cube")
          ->needs(mesh)
          ->excludes(turned);
  verb.add_option("--exaggeration", arguments.exaggeration,
                  "What heights on a globe are multiplied by (default: 1)")
      ->type_name("X")
      ->needs(globe);
  addChoice<MeshCompression>(verb, "--compress", arguments.mesh_options.compression,
                             "Of the geometry in a .glb (default: none)",
                             {{"none", MeshCompression::kNone},
                              {"draco", MeshCompression::kDraco},
                              {"meshopt", MeshCompression::kMeshopt}})
      ->needs(mesh);
  addChoice<MeshTexture>(verb, "--mesh-texture", arguments.mesh_options.texture,
                         "Of the texture in a .glb (default: JPEG, or PNG with alpha or 16 bits)",
                         {{"jpeg", MeshTexture::kJpeg},
                          {"png", MeshTexture::kPng},
                          {"webp", MeshTexture::kWebp},
                          {"ktx2", MeshTexture::kKtx2}})
      ->needs(mesh);
  CLI::Option* const cameras =
      verb.add_option(
              "--cameras", arguments.camera.file,
              "With --triangles the mesh for the file's cameras; else what one of them sees")
          ->type_name("FILE.json")
          ->needs(mesh)
          ->excludes(globe);
  verb.add_option("--view", arguments.camera.view,
                  "The same for a preset: low, oblique, top; with --triangles orbit, all, any too")
      ->check(presetView())
      ->type_name("NAME")
      ->needs(mesh)
      ->excludes(cameras)
      ->excludes(globe);
  return mesh;
}

}  // namespace

void addArguments(CLI::App& verb, DecodeArguments& arguments) {
  addSource(verb, arguments.source);
  addFrame(verb, arguments.source);
  addComponent(verb, arguments.source);
  CLI::Option* const size = addGround(verb, arguments);
  CLI::Option* const mesh = addMesh(verb, arguments);
  verb.add_option("--level", arguments.level,
                  "Heights and texture at 1/2^K of their resolution: 1 half, 2 a quarter, …")
      ->check(wholeNumber())
      ->type_name("K")
      ->excludes(mesh)
      ->excludes(size);
  verb.add_option("--window", arguments.window,
                  "Only these samples of the level, and the texels over them")
      ->delimiter(',')
      ->expected(4)
      ->check(wholeNumber())
      ->option_text("X,Y,W,H")  // the type's name would stand before "x 4"
      ->excludes(mesh)
      ->excludes(size)
      ->excludes("--normal-map");
  addThreads(verb, arguments.threads);
  addForce(verb, arguments.force);
}

Status checkArguments(const DecodeArguments& arguments) {
  std::vector<std::string> names;
  for (const std::string* name : {&arguments.height, &arguments.texture, &arguments.normal_map})
    if (!name->empty()) names.push_back(*name);
  if (!arguments.mesh.empty())
    for (std::string& name : meshFiles(arguments.mesh)) names.push_back(std::move(name));
  if (names.empty())
    return Status(TKS_USAGE, "nothing to write: give --height, --texture, --mesh or --normal-map");
  if (arguments.exaggeration == 0)
    return Status(TKS_USAGE, "--exaggeration 0 would leave no relief: give another number");
  if (arguments.json && std::find(names.begin(), names.end(), "-") != names.end())
    return Status(TKS_USAGE, "--json and an output cannot both be on standard output");
  return checkDistinct(names);
}

}  // namespace tetrakis::tools
