// Grass on the graphics card: a few tufts, drawn many times where a scene's grass stands.
//
// Model     a patch (scene/grass.h) is a list of instances, sorted by shape and by rank; of each only those that can be told
//           from the distance of its nearest corner are drawn. The vertex shader shrinks a tuft into the ground as it comes
//           to the end of its own reach, so that grass has no edge. Light is that of the ground at the tuft's foot, found
//           once a vertex
// Frame     instances are relative to their patch's origin
// Decision  tufts take shadows and throw none: their own would be finer than the maps' texels
// Context   made, used and freed with the same context current
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "core/vec.h"
#include "geometry/grass_tuft.h"
#include "geometry/season.h"
#include "render/gl.h"
#include "render/shaders.h"
#include "scene/grass.h"

namespace bosquet::render {

class GpuGrass {
 public:
  /// What the tufts are like from now on; those that are there stay.
  void set_season(geometry::Season season);
  /// Sets the patch with a key, in place of an earlier one with it. A season must be set.
  void put(std::uint64_t key, const scene::GrassPatch& patch);
  void remove(std::uint64_t key) { patches_.erase(key); }
  void clear() { patches_.clear(); }
  bool empty() const { return patches_.empty(); }

  struct Drawn {
    std::size_t triangles = 0;
    int draws = 0;
  };
  /// With the program in use. `reach` as scene::grass_reach().
  Drawn draw(const Program& program, const Mat4& relative_to_clip, const Vec3& eye, float reach) const;

 private:
  struct Shape {
    GlVertexArray array;
    GlBuffer vertices, indices;
    GLsizei count = 0;
  };
  struct Run {
    std::size_t shape = 0, first = 0;
    std::vector<float> ranks;  ///< rising
  };
  struct Patch {
    Vec3 origin{0.0f};
    Box3 box;  ///< world, with what grows up from it
    GlBuffer instances;
    std::vector<Run> runs;
  };

  std::array<Shape, geometry::kTuftShapes> shapes_;
  GlTexture picture_;
  std::unordered_map<std::uint64_t, Patch> patches_;
};

}  // namespace bosquet::render
