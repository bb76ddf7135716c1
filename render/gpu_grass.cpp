#include "render/gpu_grass.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "render/frustum.h"

namespace bosquet::render {
namespace {

struct TuftVertex {
  Vec3 position;
  Vec2 uv;
};

/// As it lies in the instance buffer.
struct TuftInstance {
  Vec4 place;             ///< relative to the patch, height
  Vec4 turn;              ///< cosine, sine; metres that it can be told from; patchiness of its ground
  Rgba8 colour;           ///< alpha 0: not of the ground's colour
  std::int8_t normal[4];  ///< of the ground
};

constexpr float kLawnPatchiness = 0.35f;

std::int8_t signed_byte(float v) { return static_cast<std::int8_t>(std::lround(std::clamp(v, -1.0f, 1.0f) * 127.0f)); }

TuftInstance instance_of(const geometry::Tuft& tuft, const Vec3& origin) {
  const float reach =
      std::min(geometry::kFullGrassM / std::sqrt(std::max(tuft.rank, 1e-6f)), geometry::kFarthestGrassM);
  const bool flower = tuft.shape >= geometry::kFirstFlower;
  const Vec3 c = glm::clamp(tuft.colour, 0.0f, 1.0f) * 255.0f + 0.5f;
  return {Vec4(tuft.at - origin, tuft.height_m),
          Vec4(tuft.turn, reach, tuft.lawn ? kLawnPatchiness : 1.0f),
          Rgba8(static_cast<std::uint8_t>(c.x), static_cast<std::uint8_t>(c.y), static_cast<std::uint8_t>(c.z),
                flower ? 0 : 255),
          {signed_byte(tuft.normal.x), signed_byte(tuft.normal.y), signed_byte(tuft.normal.z), 0}};
}

const void* at_offset(std::size_t offset) { return reinterpret_cast<const void*>(offset); }

}  // namespace

void GpuGrass::set_season(geometry::Season season) {
  if (!shapes_.front().array)
    for (std::size_t s = 0; s < shapes_.size(); ++s) {
      const TriangleMesh mesh = geometry::grass_tuft(static_cast<int>(s));
      std::vector<TuftVertex> vertices(mesh.positions.size());
      for (std::size_t v = 0; v < vertices.size(); ++v) vertices[v] = {mesh.positions[v], mesh.uvs[v]};
      Shape& shape = shapes_[s];
      shape.array = GlVertexArray::make(), shape.vertices = GlBuffer::make(), shape.indices = GlBuffer::make();
      shape.count = static_cast<GLsizei>(mesh.indices.size());
      glBindVertexArray(shape.array.name());
      glBindBuffer(GL_ARRAY_BUFFER, shape.vertices.name());
      glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size() * sizeof(TuftVertex)), vertices.data(),
                   GL_STATIC_DRAW);
      glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, shape.indices.name());
      glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(mesh.indices.size() * sizeof(std::uint32_t)),
                   mesh.indices.data(), GL_STATIC_DRAW);
      glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(TuftVertex), at_offset(offsetof(TuftVertex, position)));
      glVertexAttribPointer(1, 2, GL_FLOAT, GL_FALSE, sizeof(TuftVertex), at_offset(offsetof(TuftVertex, uv)));
      for (GLuint i = 0; i < 6; ++i) glEnableVertexAttribArray(i);
      for (GLuint i = 2; i < 6; ++i) glVertexAttribDivisor(i, 1);
    }
  glBindVertexArray(0);
  const Image picture = geometry::grass_picture(season);
  picture_ = GlTexture::make();
  glBindTexture(GL_TEXTURE_2D, picture_.name());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_SRGB8, picture.width, picture.height, 0, GL_RGB, GL_UNSIGNED_BYTE,
               picture.pixels.data());
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
}

void GpuGrass::put(std::uint64_t key, const scene::GrassPatch& given) {
  std::vector<const geometry::Tuft*> tufts;
  for (const geometry::Tuft& tuft : given.tufts) tufts.push_back(&tuft);
  std::sort(tufts.begin(), tufts.end(), [](const auto* a, const auto* b) {
    return std::tuple(a->shape, a->rank, a) < std::tuple(b->shape, b->rank, b);
  });
  Patch patch;
  for (const geometry::Tuft* tuft : tufts) {
    patch.box.add(tuft->at - tuft->height_m);
    patch.box.add(tuft->at + 1.5f * tuft->height_m);
  }
  patches_.erase(key);
  if (tufts.empty()) return;
  patch.origin = patch.box.centre();
  std::vector<TuftInstance> instances;
  for (const geometry::Tuft* tuft : tufts) {
    if (patch.runs.empty() || patch.runs.back().shape != tuft->shape)
      patch.runs.push_back({tuft->shape, instances.size(), {}});
    patch.runs.back().ranks.push_back(tuft->rank);
    instances.push_back(instance_of(*tuft, patch.origin));
  }
  patch.instances = GlBuffer::make();
  glBindBuffer(GL_ARRAY_BUFFER, patch.instances.name());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(instances.size() * sizeof(TuftInstance)), instances.data(),
               GL_STATIC_DRAW);
  patches_.emplace(key, std::move(patch));
}

GpuGrass::Drawn GpuGrass::draw(const Program& program, const Mat4& relative_to_clip, const Vec3& eye,
                               float reach) const {
  Drawn drawn;
  glActiveTexture(GL_TEXTURE0 + kUnitColour);
  glBindTexture(GL_TEXTURE_2D, picture_.name());
  glUniform1f(program.uniform("reach"), reach);
  const GLint offset = program.uniform("offset");
  for (const auto& [key, patch] : patches_) {
    const Box3 box{patch.box.low - eye, patch.box.high - eye};
    const float nearest = glm::length(glm::max(glm::max(box.low, -box.high), Vec3(0.0f)));
    if (nearest > reach * geometry::kFarthestGrassM || !may_be_seen(relative_to_clip, box)) continue;
    const float rank = geometry::full_rank(nearest / reach);
    const Vec3 from_eye = patch.origin - eye;
    glUniform3fv(offset, 1, &from_eye[0]);
    glBindBuffer(GL_ARRAY_BUFFER, patch.instances.name());
    for (const Run& run : patch.runs) {
      const auto count = std::upper_bound(run.ranks.begin(), run.ranks.end(), rank) - run.ranks.begin();
      if (count == 0) continue;
      const Shape& shape = shapes_[run.shape];
      glBindVertexArray(shape.array.name());
      const std::size_t first = run.first * sizeof(TuftInstance);
      constexpr GLsizei kStride = sizeof(TuftInstance);
      glVertexAttribPointer(2, 4, GL_FLOAT, GL_FALSE, kStride, at_offset(first + offsetof(TuftInstance, place)));
      glVertexAttribPointer(3, 4, GL_FLOAT, GL_FALSE, kStride, at_offset(first + offsetof(TuftInstance, turn)));
      glVertexAttribPointer(4, 4, GL_UNSIGNED_BYTE, GL_TRUE, kStride,
                            at_offset(first + offsetof(TuftInstance, colour)));
      glVertexAttribPointer(5, 3, GL_BYTE, GL_TRUE, kStride, at_offset(first + offsetof(TuftInstance, normal)));
      glDrawElementsInstanced(GL_TRIANGLES, shape.count, GL_UNSIGNED_INT, nullptr, static_cast<GLsizei>(count));
      drawn.triangles += static_cast<std::size_t>(shape.count) / 3 * static_cast<std::size_t>(count);
      ++drawn.draws;
    }
  }
  glBindVertexArray(0);
  return drawn;
}

}  // namespace bosquet::render
