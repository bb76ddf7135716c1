#include "crowns/vdb.h"

#include <fmt/format.h>
#include <openvdb/Grid.h>
#include <openvdb/io/File.h>
#include <openvdb/openvdb.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <exception>
#include <fstream>
#include <mutex>
#include <system_error>

#include "core/parallel.h"
#include "core/write_protection.h"

namespace bosquet::crowns {
namespace {

using Grid = openvdb::Int32Grid;
using Leaf = Grid::TreeType::LeafNodeType;

constexpr const char* kGridName = "trees";
constexpr std::int32_t kLeafEdge = 8, kLeavesAcross = kTileEdge / kLeafEdge;

void initialize_once() {
  static std::once_flag once;
  std::call_once(once, [] { openvdb::initialize(); });
}

// A new grid through the registry: Grid::create() would make this file compile three times as long.
Grid::Ptr new_grid() {
  initialize_once();
  return openvdb::gridPtrCast<Grid>(openvdb::GridBase::createGrid(Grid::gridType()));
}

openvdb::Coord coord(IVec3 voxel) { return {voxel.x, voxel.y, -1 - voxel.z}; }

std::string metadata_key(std::int32_t id) { return fmt::format("{} {}", id < 0 ? "standing" : "tree", id); }

// One leaf of a tile: 8 x 8 columns from (i0, j0) inside the tile, 8 layers from `layer0`. Null when all are free.
Leaf* fill_leaf(const CrownSpace& space, const SpaceTile& tile, std::int32_t i0, std::int32_t j0, std::int32_t layer0) {
  Leaf* leaf = nullptr;
  const IVec2 corner = tile.tile * kTileEdge + IVec2{i0, j0};
  // z runs south, so the leaf's origin is its northernmost row.
  const openvdb::Coord origin(corner.x, layer0, -kLeafEdge - corner.y);
  for (std::int32_t y = 0; y < kLeafEdge; ++y) {
    if (!tile.has(layer0 + y)) continue;
    const std::int32_t* owner = tile.owner.data() + tile.offset(layer0 + y);
    for (std::int32_t j = 0; j < kLeafEdge; ++j)
      for (std::int32_t i = 0; i < kLeafEdge; ++i) {
        const std::int32_t held = owner[(j0 + j) * kTileEdge + i0 + i];
        if (held == kFree) continue;
        if (!leaf) leaf = new Leaf(origin, 0);
        const auto offset = static_cast<openvdb::Index>((i << 6) | (y << 3) | (kLeafEdge - 1 - j));
        leaf->setValueOn(offset, held < 0 ? id_of_owner(held)
                                          : space.claimants()[static_cast<std::size_t>(space.claimant_of(held))].id);
      }
  }
  return leaf;
}

// Archive's checked writing: io::File never looks whether its stream failed, so a full disk would go unseen.
class StreamArchive : public openvdb::io::Archive {
 public:
  void write_to(std::ostream& out, const Grid::ConstPtr& grid) const {
    Archive::write(out, openvdb::GridCPtrVec{grid}, true);
  }
};

struct RemoveUnlessKept {
  std::filesystem::path path;
  bool keep = false;
  ~RemoveUnlessKept() {
    std::error_code ignored;
    if (!keep) std::filesystem::remove(path, ignored);
  }
};

Error cannot_write(const std::filesystem::path& path, const std::string& why) {
  return cannot_finish(fmt::format("cannot write {}: {}", path.string(), why));
}

}  // namespace

struct TreeGrid::Impl {
  Grid::ConstPtr grid;
};

std::size_t TreeGrid::active_voxels() const { return static_cast<std::size_t>(impl_->grid->activeVoxelCount()); }

std::int32_t TreeGrid::id(IVec3 voxel) const { return impl_->grid->tree().getValue(coord(voxel)); }

float TreeGrid::voxel_m() const { return static_cast<float>(impl_->grid->voxelSize().x()); }
float TreeGrid::layer_m() const { return static_cast<float>(impl_->grid->voxelSize().y()); }

Vec3 TreeGrid::world_centre(IVec3 voxel) const {
  const openvdb::Vec3d p = impl_->grid->indexToWorld(coord(voxel));
  return {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())};
}

std::string TreeGrid::name(std::int32_t id) const {
  const auto held = impl_->grid->getMetadata<openvdb::StringMetadata>(metadata_key(id));
  return held ? held->value() : std::string();
}

void TreeGrid::for_each(const std::function<void(IVec3, std::int32_t)>& visit) const {
  for (auto leaf = impl_->grid->tree().cbeginLeaf(); leaf; ++leaf)
    for (auto value = leaf->cbeginValueOn(); value; ++value) {
      const openvdb::Coord c = value.getCoord();
      visit({c.x(), c.y(), -1 - c.z()}, *value);
    }
}

TreeGrid build_grid(const CrownSpace& space) {
  Grid::Ptr grid = new_grid();
  grid->setName(kGridName);
  grid->setGridClass(openvdb::GRID_UNKNOWN);
  const double voxel = static_cast<double>(space.voxel_m()), layer = static_cast<double>(space.layer_m());
  auto transform = openvdb::math::Transform::createLinearTransform(1.0);
  transform->postScale(openvdb::Vec3d(voxel, layer, voxel));
  transform->postTranslate(openvdb::Vec3d(0.5 * voxel, 0.5 * layer, 0.5 * voxel));
  grid->setTransform(transform);

  // Inserting is not safe from several threads, filling leaves is: a task is one leaf's height of a tile.
  struct Slab {
    const SpaceTile* tile;
    std::int32_t layer0;
  };
  std::vector<Slab> slabs;
  for (const auto& tile : space.tiles())
    for (std::int32_t k = tile->first_layer & ~(kLeafEdge - 1); k < tile->first_layer + tile->layers; k += kLeafEdge)
      slabs.push_back({tile.get(), k});
  constexpr auto kPerSlab = static_cast<std::size_t>(kLeavesAcross * kLeavesAcross);
  std::vector<Leaf*> leaves(slabs.size() * kPerSlab, nullptr);
  parallel_for(slabs.size(), [&](std::size_t s) {
    for (std::size_t n = 0; n < kPerSlab; ++n) {
      const auto across = static_cast<std::int32_t>(n);
      leaves[s * kPerSlab + n] = fill_leaf(space, *slabs[s].tile, across % kLeavesAcross * kLeafEdge,
                                           across / kLeavesAcross * kLeafEdge, slabs[s].layer0);
    }
  });
  for (Leaf* leaf : leaves)
    if (leaf) grid->tree().addLeaf(leaf);
  return TreeGrid(std::make_shared<const TreeGrid::Impl>(TreeGrid::Impl{grid}));
}

Result<void> write_vdb(const TreeGrid& grid, const std::filesystem::path& path,
                       const std::vector<std::pair<std::int32_t, std::string>>& names) {
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  std::error_code status;
  if (!std::filesystem::is_directory(folder, status))
    return Error{fmt::format("cannot write {}: there is no folder {}", path.string(), folder.string())};
  if (std::filesystem::is_directory(path, status))
    return Error{fmt::format("cannot write {}: it is a folder", path.string())};
  if (auto fine = check_replaceable(path); !fine) return fine;

  // A shallow copy carries the names; it shares the tree.
  Grid::Ptr named = new_grid();
  named->setTree(std::const_pointer_cast<Grid::TreeType>(grid.impl().grid->treePtr()));
  named->setTransform(grid.impl().grid->transform().copy());
  named->setName(kGridName);
  for (const auto& [id, name] : names) named->insertMeta(metadata_key(id), openvdb::StringMetadata(name));

  RemoveUnlessKept part{folder / ("." + path.filename().string() + ".part")};
  try {
    std::ofstream out(part.path, std::ios::binary | std::ios::trunc);
    if (!out) return Error{fmt::format("cannot write {}: {}", path.string(), std::strerror(errno))};
    StreamArchive().write_to(out, named);
    out.close();
    if (!out) return cannot_write(path, "the disk is full or failed");
  } catch (const std::exception& e) {
    return cannot_write(path, e.what());
  }
  std::filesystem::rename(part.path, path, status);
  if (status) return cannot_write(path, status.message());
  part.keep = true;
  return {};
}

Result<TreeGrid> read_vdb(const std::filesystem::path& path) {
  initialize_once();
  try {
    openvdb::io::File file(path.string());
    file.open(false);  // whole, so that the file may change or go afterwards
    auto grid = openvdb::gridPtrCast<Grid>(file.readGrid(kGridName));
    if (!grid) return Error{fmt::format("{}: its grid \"{}\" does not hold tree ids", path.string(), kGridName)};
    return TreeGrid(std::make_shared<const TreeGrid::Impl>(TreeGrid::Impl{grid}));
  } catch (const std::exception& e) {
    return Error{fmt::format("cannot read {}: {}", path.string(), e.what())};
  }
}

}  // namespace bosquet::crowns
