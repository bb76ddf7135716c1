#include "terrain/line_distance.h"

namespace bosquet::terrain {

std::vector<Piece> pieces(std::span<const Vec2> line) {
  std::vector<Piece> out;
  if (line.size() == 1) out.push_back({line[0], line[0]});
  for (std::size_t n = 1; n < line.size(); ++n) out.push_back({line[n - 1], line[n]});
  return out;
}

float squared_distance(const Piece& piece, Vec2 p) {
  const Vec2 along = piece.to - piece.from, to = p - piece.from;
  const float length2 = along.x * along.x + along.y * along.y;
  const float t = length2 > 0.0f ? std::clamp((to.x * along.x + to.y * along.y) / length2, 0.0f, 1.0f) : 0.0f;
  const float x = to.x - t * along.x, y = to.y - t * along.y;
  return x * x + y * y;
}

bool near_box(const Piece& piece, const Box2& box, float radius) {
  const Vec2 low = glm::min(piece.from, piece.to) - radius, high = glm::max(piece.from, piece.to) + radius;
  if (low.x > box.high.x || low.y > box.high.y || high.x < box.low.x || high.y < box.low.y) return false;
  // Within the box's circumscribed circle widened by the radius; a few tiles too many do no harm.
  const Vec2 half = 0.5f * box.size();
  const float reach = radius + std::sqrt(half.x * half.x + half.y * half.y);
  return squared_distance(piece, box.centre()) <= reach * reach;
}

}  // namespace bosquet::terrain
