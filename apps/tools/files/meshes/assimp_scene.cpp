// SPDX-License-Identifier: Apache-2.0
// The meshes of a scene, joined: points that several triangles share are one again, whether or not
// the format or Assimp has a point for each corner (STL, OBJ).
#include "apps/tools/files/meshes/assimp_scene.hpp"

#include <assimp/scene.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <unordered_map>
#include <utility>

namespace tetrakis::tools {
namespace {

using Position = std::array<double, 3>;

/// An affine map: what is added, and three columns.
struct Placement {
  std::array<Position, 3> columns{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  Position origin{0, 0, 0};

  Position turned(const Position& p) const {
    Position out{};
    for (size_t row = 0; row < 3; ++row)
      out[row] = columns[0][row] * p[0] + columns[1][row] * p[1] + columns[2][row] * p[2];
    return out;
  }
  Position operator()(const Position& p) const {
    const Position t = turned(p);
    return {t[0] + origin[0], t[1] + origin[1], t[2] + origin[2]};
  }
  /// Of what is placed in what this places.
  Placement with(const Placement& inner) const {
    Placement both;
    for (size_t i = 0; i < 3; ++i) both.columns[i] = turned(inner.columns[i]);
    both.origin = (*this)(inner.origin);
    return both;
  }
  bool mirrors() const {
    const auto& [a, b, c] = columns;
    return a[0] * (b[1] * c[2] - b[2] * c[1]) - b[0] * (a[1] * c[2] - a[2] * c[1]) +
               c[0] * (a[1] * b[2] - a[2] * b[1]) <
           0;
  }
};

Placement placementOf(const aiNode& node) {
  const aiMatrix4x4& m = node.mTransformation;
  return {{{{m.a1, m.b1, m.c1}, {m.a2, m.b2, m.c2}, {m.a3, m.b3, m.c3}}}, {m.a4, m.b4, m.c4}};
}

struct PositionHash {
  size_t operator()(const Position& p) const {
    uint64_t h = 0;
    for (const double axis : p) {
      h = (h ^ std::bit_cast<uint64_t>(axis)) * 0x9e3779b97f4a7c15u;
      h ^= h >> 29;
    }
    return static_cast<size_t>(h);
  }
};

/// A mesh of the scene at one of its places.
struct Part {
  const aiMesh* mesh;
  Placement placement;
};

/// Nodes from the root down, children in order.
std::vector<Part> partsOf(const aiScene& scene) {
  std::vector<Part> parts;
  std::vector<std::pair<const aiNode*, Placement>> open{{scene.mRootNode, {}}};
  while (!open.empty()) {
    const auto [node, around] = open.back();
    open.pop_back();
    const Placement placement = around.with(placementOf(*node));
    for (unsigned i = 0; i < node->mNumMeshes; ++i)
      parts.push_back({scene.mMeshes[node->mMeshes[i]], placement});
    for (unsigned i = node->mNumChildren; i-- > 0;)
      open.emplace_back(node->mChildren[i], placement);
  }
  return parts;
}

uint64_t trianglesOf(const aiMesh& mesh) {
  return static_cast<uint64_t>(
      std::count_if(mesh.mFaces, mesh.mFaces + mesh.mNumFaces,
                    [](const aiFace& face) { return face.mNumIndices == 3; }));
}

class Joiner {
 public:
  explicit Joiner(MeshImport& mesh) : mesh_(mesh) {}

  /// texcoords: which of the part's place the texture. with_colours: its corners have colours.
  void add(const Part& part, unsigned texcoords, bool with_colours) {
    if (with_colours) mesh_.corner_colours.resize(3 * mesh_.triangles.size(), {1, 1, 1, 1});
    colours_ = with_colours ? part.mesh->mColors[0] : nullptr;
    places_.assign(part.mesh->mNumVertices, kNone);
    const bool mirrors = part.placement.mirrors();
    const aiVector3D* const coordinates =
        part.mesh->HasTextureCoords(texcoords) ? part.mesh->mTextureCoords[texcoords] : nullptr;
    if (coordinates) mesh_.texcoords.resize(3 * mesh_.triangles.size());
    for (unsigned i = 0; i < part.mesh->mNumFaces && mesh_.failure.empty(); ++i) {
      const aiFace& face = part.mesh->mFaces[i];
      if (face.mNumIndices != 3) {
        mesh_.facts.dropped += face.mNumIndices < 3;
        continue;
      }
      std::array<unsigned, 3> corners{face.mIndices[0], face.mIndices[1], face.mIndices[2]};
      if (mirrors) std::swap(corners[1], corners[2]);
      addTriangle(part, corners, coordinates);
    }
    if (!mesh_.texcoords.empty()) mesh_.texcoords.resize(3 * mesh_.triangles.size());
    if (!mesh_.corner_colours.empty())
      mesh_.corner_colours.resize(3 * mesh_.triangles.size(), {1, 1, 1, 1});
  }

 private:
  static constexpr uint32_t kNone = ~0u;

  void addTriangle(const Part& part, const std::array<unsigned, 3>& corners,
                   const aiVector3D* coordinates) {
    std::array<uint32_t, 3> triangle{};
    for (size_t k = 0; k < 3; ++k) {
      if (corners[k] >= part.mesh->mNumVertices) return fail("names a vertex that does not exist");
      uint32_t& place = places_[corners[k]];
      if (place == kNone) place = pointOf(part, corners[k]);
      if (place == kNone) return fail("has a vertex whose coordinates are not finite");
      triangle[k] = place;
    }
    mesh_.triangles.push_back(triangle);
    for (size_t k = 0; coordinates && k < 3; ++k) addTexcoord(coordinates[corners[k]]);
    for (size_t k = 0; colours_ && k < 3; ++k) addColour(colours_[corners[k]]);
  }
  /// Triangles count from 1, as vertices of files do.
  void fail(const char* what) {
    mesh_.failure = "triangle " + std::to_string(mesh_.triangles.size() + 1) + " " + what;
  }
  uint32_t pointOf(const Part& part, unsigned vertex) {
    const aiVector3D& v = part.mesh->mVertices[vertex];
    Position p = part.placement({v.x, v.y, v.z});
    if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2])) return kNone;
    for (double& axis : p) axis += 0.0;  // -0 becomes 0
    const auto [found, is_new] =
        numbers_.try_emplace(p, static_cast<uint32_t>(mesh_.points.size()));
    if (is_new) mesh_.points.push_back(p);
    return found->second;
  }
  void addTexcoord(const aiVector3D& at) {
    const bool finite = std::isfinite(at.x) && std::isfinite(at.y);
    mesh_.facts.unplaced += !finite;
    mesh_.texcoords.push_back(finite ? std::array{at.x, at.y} : std::array{0.0F, 0.0F});
  }

  void addColour(const aiColor4D& colour) {
    const auto known = [](float value) { return std::isfinite(value) ? value : 0.0F; };
    mesh_.corner_colours.push_back(
        {known(colour.r), known(colour.g), known(colour.b), known(colour.a)});
  }

  MeshImport& mesh_;
  const aiColor4D* colours_ = nullptr;  ///< of the vertices of the part
  std::unordered_map<Position, uint32_t, PositionHash> numbers_{};
  std::vector<uint32_t> places_{};  ///< of the vertices of a part among the points
};

/// The materials of the parts.
std::vector<SceneMaterial> materialsOf(const aiScene& scene, const std::vector<Part>& parts,
                                       bool is_gltf) {
  std::vector<SceneMaterial> materials;
  for (const Part& part : parts) {
    const unsigned index = part.mesh->mMaterialIndex;
    materials.push_back(index < scene.mNumMaterials ? materialOf(*scene.mMaterials[index], is_gltf)
                                                    : SceneMaterial{});
  }
  return materials;
}

/// By what materials are told apart: the texture of the colour, or of one without it the maps.
std::string nameOf(const SceneMaterial& material) {
  if (!material.texture.path.empty()) return material.texture.path;
  std::string name;
  for (const SceneTexture& map : material.maps) name += '\n' + map.path;
  return name;
}

/// How many triangles have each texture, with the material of the first part that has it.
struct TextureUse {
  SceneMaterial material;
  uint64_t triangles = 0, parts = 0, other_maps = 0;
};

std::vector<TextureUse> texturesOf(const std::vector<Part>& parts,
                                   const std::vector<SceneMaterial>& materials) {
  std::vector<TextureUse> uses;
  std::unordered_map<std::string, size_t> places;
  for (size_t i = 0; i < parts.size(); ++i) {
    const auto [place, is_new] = places.try_emplace(nameOf(materials[i]), uses.size());
    if (is_new) uses.push_back({materials[i]});
    TextureUse& use = uses[place->second];
    use.triangles += trianglesOf(*parts[i].mesh);
    ++use.parts;
    use.other_maps += !use.material.hasSameMaps(materials[i]);
  }
  return uses;
}

ImportedTexture imported(const aiScene& scene, const SceneTexture& texture) {
  ImportedTexture found{texture.path};
  if (texture.path.empty()) return found;
  const aiTexture* const embedded = scene.GetEmbeddedTexture(texture.path.c_str());
  if (!embedded || embedded->mHeight != 0)  // with a height: texels, which no format has
    return found;
  const auto* const bytes = reinterpret_cast<const std::byte*>(embedded->pcData);
  found.file.assign(bytes, bytes + embedded->mWidth);
  return found;
}

MapFault faultOf(const SceneTexture& map, const SceneTexture& leading) {
  if (map.path.empty()) return MapFault::kNone;
  if (map.texcoords != leading.texcoords) return MapFault::kOtherTexcoords;
  return isSame(map.transform, leading.transform) ? MapFault::kNone : MapFault::kOtherTransform;
}

void takeMaterial(const aiScene& scene, const SceneMaterial& material, MeshImport& mesh) {
  mesh.facts.base_colour = material.colour;
  mesh.facts.factors = material.factors;
  const SceneTexture* const leading = material.leading();
  if (!leading) return;
  mesh.facts.transformed = !isSame(leading->transform, aiUVTransform());
  mesh.texture = imported(scene, material.texture);
  for (size_t slot = 0; slot < kMapSlots; ++slot) {
    mesh.maps[slot] = imported(scene, material.maps[slot]);
    mesh.facts.map_faults[slot] = faultOf(material.maps[slot], *leading);
  }
}

/// A texture says more than the colours beside it.
bool hasCornerColours(const Part& part, const SceneMaterial& material) {
  return material.texture.path.empty() && part.mesh->HasVertexColors(0);
}

/// What tells looks apart. Of parts with one texture the first says the colour.
using LookKey = std::pair<std::string, std::array<double, 4>>;
LookKey lookOf(const Part& part, const SceneMaterial& material) {
  if (!material.texture.path.empty()) return {material.texture.path, {}};
  return {hasCornerColours(part, material) ? "\n" : "", material.colour};
}

/// The number of the look of each part. One look of all parts, without colours at corners, is said
/// by the mesh itself.
std::vector<size_t> takeLooks(const aiScene& scene, const std::vector<Part>& parts,
                              const std::vector<SceneMaterial>& materials, MeshImport& mesh) {
  std::map<LookKey, size_t> numbers;
  std::vector<size_t> looks;
  for (size_t i = 0; i < parts.size(); ++i) {
    const auto [place, is_new] =
        numbers.try_emplace(lookOf(parts[i], materials[i]), mesh.looks.size());
    looks.push_back(place->second);
    if (!is_new) continue;
    mesh.looks.push_back({materials[i].colour, hasCornerColours(parts[i], materials[i])});
    mesh.look_textures.push_back(imported(scene, materials[i].texture));
  }
  if (mesh.looks.size() == 1 && mesh.looks.front().at_corners == 0) {
    mesh.looks.clear();
    mesh.look_textures.clear();
  }
  for (size_t slot = 0; !mesh.looks.empty() && slot < kMapSlots; ++slot)
    if (!mesh.maps[slot].path.empty()) mesh.facts.map_faults[slot] = MapFault::kSeveralLooks;
  return looks;
}

/// "" where Assimp has made it up (of OBJ and glTF).
std::string nameOf(const aiMesh& mesh) {
  const std::string name = mesh.mName.C_Str();
  return name == "defaultobject" || name.starts_with("meshes[") ? "" : name;
}

/// Parts with triangles; `failure` says why there are none.
std::vector<Part> solidParts(const aiScene& scene, MeshImport& mesh) {
  std::vector<Part> parts = partsOf(scene), solid;
  uint64_t triangles = 0;
  for (const Part& part : parts) {
    const uint64_t own = trianglesOf(*part.mesh);
    if (own > 0)
      solid.push_back(part);
    else
      mesh.facts.dropped += part.mesh->mNumFaces;
    triangles += own;
  }
  mesh.facts.too_large = triangles > kMostTriangles;
  if (mesh.facts.too_large)
    mesh.failure = "it has " + std::to_string(triangles) + " triangles; the most are " +
                   std::to_string(kMostTriangles);
  else if (triangles == 0)
    mesh.failure = "it has no triangles";
  return mesh.failure.empty() ? solid : std::vector<Part>();
}

}  // namespace

void joinScene(const aiScene& scene, MeshImport& mesh) {
  const std::vector<Part> parts = solidParts(scene, mesh);
  if (parts.empty()) return;
  const std::vector<SceneMaterial> materials = materialsOf(scene, parts, mesh.facts.y_is_up);
  const std::vector<TextureUse> uses = texturesOf(parts, materials);
  const TextureUse& most = *std::max_element(
      uses.begin(), uses.end(),
      [](const TextureUse& a, const TextureUse& b) { return a.triangles < b.triangles; });
  takeMaterial(scene, most.material, mesh);
  mesh.facts.parts = parts.size();
  mesh.facts.other_maps = most.other_maps;
  if (parts.size() == 1) mesh.name = nameOf(*parts[0].mesh);
  const std::vector<size_t> looks = takeLooks(scene, parts, materials, mesh);
  Joiner joiner(mesh);
  for (size_t i = 0; i < parts.size(); ++i) {
    const SceneTexture* const leading = materials[i].leading();
    joiner.add(parts[i], leading ? leading->texcoords : 0,
               hasCornerColours(parts[i], materials[i]));
    if (!mesh.looks.empty()) mesh.runs.push_back({mesh.triangles.size(), looks[i]});
  }
}

}  // namespace tetrakis::tools
