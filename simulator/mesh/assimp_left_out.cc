#include "simulator/mesh/assimp_left_out.h"

#include <assimp/material.h>

#include "simulator/mesh/left_out.h"

namespace aisle::sim {
namespace {

/// Textures of a material that are for anything but its colour.
unsigned OtherTextures(const aiMaterial& material) {
  unsigned count = 0;
  for (int type = aiTextureType_SPECULAR; type <= aiTextureType_UNKNOWN; ++type) {
    count += material.GetTextureCount(static_cast<aiTextureType>(type));
  }
  return count;
}

bool IsTransparent(const aiMaterial& material) {
  float opacity = 1;
  return material.Get(AI_MATKEY_OPACITY, opacity) == aiReturn_SUCCESS && opacity < 1;
}

}  // namespace

std::vector<std::string> LeftOutOf(const aiScene& scene) {
  std::size_t thin = 0, colours = 0, textures = 0, transparent = 0;
  for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
    const aiMesh& mesh = *scene.mMeshes[i];
    bool has_thin = false;
    for (unsigned k = 0; k < mesh.mNumFaces; ++k) has_thin |= mesh.mFaces[k].mNumIndices < 3;
    thin += has_thin ? 1 : 0;
    colours += mesh.HasVertexColors(0) ? 1 : 0;
  }
  for (unsigned i = 0; i < scene.mNumMaterials; ++i) {
    textures += OtherTextures(*scene.mMaterials[i]);
    transparent += IsTransparent(*scene.mMaterials[i]) ? 1 : 0;
  }
  LeftOut out;
  out.Add(scene.mNumCameras, "camera");
  out.Add(scene.mNumLights, "light");
  out.Add(thin, "bundle of points or lines", "bundles of points or lines");
  out.Add(colours, "set of vertex colours", "sets of vertex colours");
  out.Add(textures, "texture for more than colour", "textures for more than colour");
  out.Add(transparent, "material's transparency", "materials' transparency");
  return out.Take();
}

}  // namespace aisle::sim
