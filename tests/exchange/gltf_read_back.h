// A glTF file as tinygltf reads it: an oracle that shares no code with the writer.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/vec.h"

namespace bosquet::exchange {

struct ReadPrimitive {
  std::vector<Vec3> positions, normals;
  std::vector<Vec4> tangents, colours, wind;  ///< colours and wind 0..1
  std::vector<Vec2> uvs;
  std::vector<std::uint32_t> indices;
  bool short_indices = false, short_uvs = false;
  std::size_t position_accessor = 0;
  DVec3 low{0.0}, high{0.0};
  int material = -1;
};

struct ReadMaterial {
  std::string name, alpha_mode;
  double alpha_cutoff = 0, roughness = 0, metallic = 0;
  bool double_sided = false, has_colour = false, has_normal = false;
  std::string colour_mime;
  int colour_wrap = 0, colour_width = 0;
  std::string extras;
};

struct ReadNode {
  std::string name;
  DVec3 translation{0.0};
  glm::dvec4 rotation{0, 0, 0, 1};  ///< x, y, z, w
  int mesh = -1, camera = -1;
  bool light = false;
  std::string species;
  double height_m = 0, id = 0;
};

struct ReadBack {
  std::string error, warning, generator, scene_seed;
  std::vector<std::vector<ReadPrimitive>> meshes;
  std::vector<ReadNode> nodes;
  std::vector<ReadMaterial> materials;
  std::vector<double> camera_fov;  ///< radians
  std::size_t images = 0, scene_nodes = 0;
};

ReadBack read_back(const std::filesystem::path& path);

}  // namespace bosquet::exchange
