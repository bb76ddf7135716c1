// glTF images: the pictures of a model's materials, each once, as PNG or JPEG.
//
// Decision  JPEG for colour that is not cut out (4:2:0) and for normal maps (4:4:4); PNG where alpha is tested
// Cost      in parallel; with a cache only what is not found there is encoded
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/image.h"
#include "exchange/image_file.h"
#include "exchange/texture_cache.h"
#include "scene/model.h"

namespace bosquet::exchange {

enum class ImageUse { colour, cut_out, normal };

struct GltfImage {
  const Image* image = nullptr;
  ImageUse use = ImageUse::colour;
  std::string name;  ///< from the first material: letters, digits, - and _ only; unique
  ImageFormat format = ImageFormat::png;
  Bytes bytes;

  const char* mime_type() const { return format == ImageFormat::png ? "image/png" : "image/jpeg"; }
  const char* ending() const { return format == ImageFormat::png ? ".png" : ".jpg"; }
};

/// How a material uses its base colour.
inline ImageUse colour_use(const scene::Material& material) {
  return material.mask ? ImageUse::cut_out : ImageUse::colour;
}

/// Whether a material's normal map is written; that of a cut-out one only with `leaf_normal_maps`.
inline bool uses_normal_map(const scene::Material& material, bool leaf_normal_maps) {
  return material.normal && !material.normal->empty() && (!material.mask || leaf_normal_maps);
}

/// All images of the materials in `used`, encoded, in order of first use.
std::vector<GltfImage> encode_images(const std::vector<scene::Material>& materials, std::span<const std::size_t> used,
                                     bool leaf_normal_maps, const TextureCache* cache);

}  // namespace bosquet::exchange
