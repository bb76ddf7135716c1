#include "exchange/gltf_instances.h"

#include <algorithm>
#include <cmath>

namespace bosquet::exchange {
namespace {

constexpr std::size_t kMostVertices = 64;  // of a piece
constexpr std::size_t kMostCards = 32;     // of a mesh
// A piece that is no copy of another gains nothing.
constexpr std::size_t kLeastCopies = 4;

// Triangles [first, last) with the vertices [low, high).
struct Piece {
  std::size_t first = 0, last = 0;
  std::uint32_t low = 0, high = 0;
};

// Runs of triangles that share no vertex with those before; nothing when one is too large.
std::optional<std::vector<Piece>> pieces_of(const TriangleMesh& mesh) {
  const auto fits = [&](std::size_t n) { return n == 0 || n == mesh.positions.size(); };
  if (!fits(mesh.normals.size()) || !fits(mesh.uvs.size()) || !fits(mesh.colours.size())) return std::nullopt;
  for (std::uint32_t index : mesh.indices)
    if (index >= mesh.positions.size()) return std::nullopt;
  std::vector<Piece> pieces;
  for (std::size_t t = 0; t < mesh.triangles(); ++t) {
    const std::uint32_t* c = &mesh.indices[3 * t];
    const auto [low, high] = std::minmax({c[0], c[1], c[2]});
    if (pieces.empty() || low >= pieces.back().high) {
      pieces.push_back({t, t + 1, low, high + 1});
    } else {
      Piece& piece = pieces.back();
      if (low < piece.low) return std::nullopt;
      piece.last = t + 1;
      piece.high = std::max(piece.high, high + 1);
    }
    if (pieces.back().high - pieces.back().low > kMostVertices) return std::nullopt;
  }
  return pieces;
}

struct Frame {
  Mat3 axes{1.0f};  ///< columns
  Vec3 origin{0.0f};
  float size = 0.0f;
};

// Of vertices about equally far the first is taken, so that rounding cannot choose another one in another copy.
std::optional<Frame> frame_of(const TriangleMesh& mesh, const Piece& piece) {
  Frame frame;
  frame.origin = mesh.positions[piece.low];
  const auto farthest = [&](const auto& squared_distance, float near_enough) {
    float most = 0.0f;
    for (std::uint32_t v = piece.low; v < piece.high; ++v) most = std::max(most, squared_distance(v));
    std::uint32_t v = piece.low;
    while (squared_distance(v) < near_enough * most) ++v;
    return v;
  };
  const auto from_origin = [&](std::uint32_t v) { return mesh.positions[v] - frame.origin; };
  const Vec3 to =
      from_origin(farthest([&](std::uint32_t v) { return glm::dot(from_origin(v), from_origin(v)); }, 0.998f));
  frame.size = std::sqrt(glm::dot(to, to));
  if (!(frame.size > 1e-6f)) return std::nullopt;
  const Vec3 x = to / frame.size;
  const auto normal_by = [&](std::uint32_t v) { return glm::cross(x, from_origin(v)); };
  const Vec3 normal = normal_by(farthest([&](std::uint32_t v) { return glm::dot(normal_by(v), normal_by(v)); }, 0.5f));
  const float length = std::sqrt(glm::dot(normal, normal));
  if (!(length > 1e-4f * frame.size)) return std::nullopt;
  const Vec3 z = normal / length;
  frame.axes = Mat3(x, glm::cross(z, x), z);
  return frame;
}

// The rotation's quaternion (Shepperd 1978): the largest of its numbers first, so nothing is divided by a small one.
Vec4 quaternion(const Mat3& m) {
  const float xx = m[0][0], yy = m[1][1], zz = m[2][2], trace = xx + yy + zz;
  Vec4 q;
  if (trace >= std::max({xx, yy, zz})) {
    q.w = 1.0f + trace;
    q = {m[1][2] - m[2][1], m[2][0] - m[0][2], m[0][1] - m[1][0], q.w};
  } else if (xx >= std::max(yy, zz)) {
    q = {1.0f + xx - yy - zz, m[0][1] + m[1][0], m[2][0] + m[0][2], m[1][2] - m[2][1]};
  } else if (yy >= zz) {
    q = {m[0][1] + m[1][0], 1.0f - xx + yy - zz, m[1][2] + m[2][1], m[2][0] - m[0][2]};
  } else {
    q = {m[2][0] + m[0][2], m[1][2] + m[2][1], 1.0f - xx - yy + zz, m[0][1] - m[1][0]};
  }
  return q / std::sqrt(glm::dot(q, q));
}

bool same(Vec2 a, Vec2 b) { return std::abs(a.x - b.x) < 1e-5f && std::abs(a.y - b.y) < 1e-5f; }
bool same(const Vec3& a, const Vec3& b) {
  const Vec3 d = glm::abs(a - b);
  return d.x < kSameShape && d.y < kSameShape && d.z < kSameShape;
}

// A card being found; its normals are still sums.
struct Found {
  TriangleMesh card;
  std::vector<Instance> instances;
};

bool is_copy(const TriangleMesh& card, const TriangleMesh& mesh, const Piece& piece, const Frame& frame) {
  const std::size_t n = piece.high - piece.low;
  if (card.positions.size() != n || card.triangles() != piece.last - piece.first) return false;
  for (std::size_t i = 0; i < card.indices.size(); ++i)
    if (card.indices[i] != mesh.indices[3 * piece.first + i] - piece.low) return false;
  for (std::size_t k = 0; k < n; ++k) {
    if (!mesh.uvs.empty() && !same(card.uvs[k], mesh.uvs[piece.low + k])) return false;
    const Vec3 local = (mesh.positions[piece.low + k] - frame.origin) * frame.axes / frame.size;
    if (!same(card.positions[k], local)) return false;
  }
  return true;
}

Found new_card(const TriangleMesh& mesh, const Piece& piece, const Frame& frame) {
  Found found;
  for (std::uint32_t v = piece.low; v < piece.high; ++v) {
    found.card.positions.push_back((mesh.positions[v] - frame.origin) * frame.axes / frame.size);
    if (!mesh.normals.empty()) found.card.normals.emplace_back(0.0f);
    if (!mesh.uvs.empty()) found.card.uvs.push_back(mesh.uvs[v]);
  }
  for (std::size_t i = 3 * piece.first; i < 3 * piece.last; ++i)
    found.card.indices.push_back(mesh.indices[i] - piece.low);
  return found;
}

Vec3 face_normal(const TriangleMesh& card) {
  const Vec3 a = card.positions[card.indices[0]], b = card.positions[card.indices[1]],
             c = card.positions[card.indices[2]];
  return glm::normalize(glm::cross(b - a, c - a));
}

}  // namespace

std::optional<std::vector<InstancedCard>> find_instances(const TriangleMesh& mesh) {
  const auto pieces = pieces_of(mesh);
  if (!pieces || pieces->empty()) return std::nullopt;
  std::vector<Found> all;
  std::size_t last = 0;
  for (const Piece& piece : *pieces) {
    const auto frame = frame_of(mesh, piece);
    if (!frame) return std::nullopt;
    // Neighbours are often alike: begin with the card of the piece before.
    std::size_t which = all.size();
    for (std::size_t k = 0; k < all.size() && which == all.size(); ++k) {
      const std::size_t candidate = (last + k) % all.size();
      if (is_copy(all[candidate].card, mesh, piece, *frame)) which = candidate;
    }
    if (which == all.size()) {
      if (all.size() == kMostCards) return std::nullopt;
      all.push_back(new_card(mesh, piece, *frame));
    }
    last = which;
    Found& found = all[which];
    // Within a piece the colour is the same; where it is not, the first vertex speaks for it.
    found.instances.push_back({frame->origin, quaternion(frame->axes), frame->size,
                               mesh.colours.empty() ? Rgba8(255) : mesh.colours[piece.low]});
    for (std::size_t v = 0; v < found.card.normals.size(); ++v)
      found.card.normals[v] += mesh.normals[piece.low + v] * frame->axes;
  }
  if (pieces->size() < kLeastCopies * all.size()) return std::nullopt;

  std::vector<InstancedCard> out;
  for (Found& found : all) {
    for (Vec3& n : found.card.normals) {
      const float length2 = glm::dot(n, n);
      n = length2 > 1e-6f ? n / std::sqrt(length2) : face_normal(found.card);
    }
    out.push_back({std::make_shared<const TriangleMesh>(std::move(found.card)), std::move(found.instances)});
  }
  return out;
}

void CardStock::share(std::vector<InstancedCard>& found) {
  for (InstancedCard& own : found) {
    const TriangleMesh& a = *own.card;
    const auto known = std::find_if(cards_.begin(), cards_.end(), [&](const auto& card) {
      const TriangleMesh& b = *card;
      return a.indices == b.indices && a.normals.size() == b.normals.size() &&
             std::equal(a.positions.begin(), a.positions.end(), b.positions.begin(), b.positions.end(),
                        [](const Vec3& p, const Vec3& q) { return same(p, q); }) &&
             std::equal(a.uvs.begin(), a.uvs.end(), b.uvs.begin(), b.uvs.end(),
                        [](Vec2 p, Vec2 q) { return same(p, q); });
    });
    if (known == cards_.end())
      cards_.push_back(own.card);
    else
      own.card = *known;
  }
}

}  // namespace bosquet::exchange
