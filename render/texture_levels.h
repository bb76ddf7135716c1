// Texture levels: the images of materials with all their smaller levels, made without OpenGL, so on any thread.
//
// Model     each image once for each use of it: what its channels mean, where its alpha is cut (render/alpha_mips.h)
// Cost      some hundredths of a second a species, in parallel
#pragma once

#include <memory>
#include <vector>

#include "core/image.h"
#include "render/alpha_mips.h"
#include "scene/model.h"

namespace bosquet::render {

struct TextureUse {
  std::shared_ptr<const Image> image;
  TextureKind kind = TextureKind::colour;
  float cutoff = 0.0f;
  bool anisotropic = false;  ///< seen at grazing angles

  bool operator==(const TextureUse&) const = default;
};

struct MaterialLevels {
  std::vector<scene::Material> materials;
  std::vector<TextureUse> uses;
  std::vector<std::vector<Image>> chains;  ///< of each use
};

/// How a material uses its colours and its normals.
TextureUse colour_use(const scene::Material& material);
TextureUse normal_use(const scene::Material& material);

MaterialLevels make_levels(std::vector<scene::Material> materials);

}  // namespace bosquet::render
