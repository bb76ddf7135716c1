#include "exchange/mesh_order.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <cassert>
#include <limits>

namespace bosquet::exchange {
namespace {

constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();

// Vertices numbered by first use in `indices`, which are renumbered alike.
MeshOrder by_first_use(std::vector<std::uint32_t> indices, std::size_t vertex_count) {
  MeshOrder order;
  std::vector<std::uint32_t> fresh(vertex_count, kUnused);
  order.vertices.reserve(vertex_count);
  for (std::uint32_t& index : indices) {
    if (fresh[index] == kUnused) {
      fresh[index] = static_cast<std::uint32_t>(order.vertices.size());
      order.vertices.push_back(index);
    }
    index = fresh[index];
  }
  order.indices = std::move(indices);
  return order;
}

// Small pieces one after the other that share no vertices, as cards of leaves: any order of them is as good.
bool is_run_of_pieces(const TriangleMesh& mesh) {
  constexpr std::uint32_t kMostVertices = 16;
  std::uint32_t low = 0, high = 0;  // of the piece, vertices [low, high)
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const std::uint32_t a = mesh.indices[i], b = mesh.indices[i + 1], c = mesh.indices[i + 2];
    const std::uint32_t least = std::min({a, b, c}), most = std::max({a, b, c});
    if (least >= high) low = least;
    high = std::max(high, most + 1);
    if (least < low || high - low > kMostVertices) return false;
  }
  return true;
}

template <class T>
std::vector<T> gathered(const std::vector<T>& values, const std::vector<std::uint32_t>& from) {
  std::vector<T> out;
  if (values.empty()) return out;
  out.reserve(from.size());
  for (std::uint32_t i : from) out.push_back(values[i]);
  return out;
}

}  // namespace

MeshOrder best_order(const TriangleMesh& mesh) {
  assert(mesh.indices.size() % 3 == 0);
  if (is_run_of_pieces(mesh)) return by_first_use(mesh.indices, mesh.positions.size());
  std::vector<std::uint32_t> indices(mesh.indices.size());
  meshopt_optimizeVertexCache(indices.data(), mesh.indices.data(), mesh.indices.size(), mesh.positions.size());
  return by_first_use(std::move(indices), mesh.positions.size());
}

MeshOrder present_order(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> fresh(mesh.positions.size(), kUnused);
  for (std::uint32_t index : mesh.indices) fresh[index] = 0;
  MeshOrder order;
  for (std::uint32_t v = 0; v < fresh.size(); ++v) {
    if (fresh[v] == kUnused) continue;
    fresh[v] = static_cast<std::uint32_t>(order.vertices.size());
    order.vertices.push_back(v);
  }
  order.indices.reserve(mesh.indices.size());
  for (std::uint32_t index : mesh.indices) order.indices.push_back(fresh[index]);
  return order;
}

TriangleMesh optimise(const TriangleMesh& mesh) {
  MeshOrder order = best_order(mesh);
  TriangleMesh out;
  out.positions = gathered(mesh.positions, order.vertices);
  out.normals = gathered(mesh.normals, order.vertices);
  out.uvs = gathered(mesh.uvs, order.vertices);
  out.colours = gathered(mesh.colours, order.vertices);
  out.wind = gathered(mesh.wind, order.vertices);
  out.indices = std::move(order.indices);
  return out;
}

}  // namespace bosquet::exchange
