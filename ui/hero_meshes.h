// Hero meshes: hero trees as triangles, made in the background once for each skeleton.
//
// Model     a skeleton is fixed, so its mesh is made when it is first asked for and kept while a hero tree has it
// Frame     tree frame
// Threads   one asks; the meshes are made on threads of their own
#pragma once

#include <future>
#include <map>
#include <memory>

#include "scene/document.h"
#include "scene/pipeline.h"

namespace bosquet::ui {

class HeroMeshes {
 public:
  /// Null while it is being made.
  std::shared_ptr<const scene::TreeMeshes> of(const scene::Document& document, const scene::HeroTree& hero);
  /// Lets go of what the document's hero trees do not have.
  void keep(const scene::Document& document);
  bool making() const;

 private:
  struct Made {
    std::shared_ptr<const growth::Skeleton> skeleton;
    std::shared_ptr<const scene::Species> species;
    std::future<std::shared_ptr<const scene::TreeMeshes>> coming;
    std::shared_ptr<const scene::TreeMeshes> meshes;
  };
  std::map<const growth::Skeleton*, Made> made_;
};

}  // namespace bosquet::ui
