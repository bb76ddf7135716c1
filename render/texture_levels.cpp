#include "render/texture_levels.h"

#include <algorithm>
#include <utility>

#include "core/parallel.h"

namespace bosquet::render {

TextureUse colour_use(const scene::Material& m) {
  return {m.base_colour, TextureKind::colour, m.mask ? m.alpha_cutoff : 0.0f, !m.mask};
}

TextureUse normal_use(const scene::Material& m) { return {m.normal, TextureKind::normal, 0.0f, !m.mask}; }

MaterialLevels make_levels(std::vector<scene::Material> materials) {
  MaterialLevels levels;
  levels.materials = std::move(materials);
  for (const scene::Material& m : levels.materials)
    for (TextureUse use : {colour_use(m), normal_use(m)})
      if (use.image && !use.image->empty() &&
          std::find(levels.uses.begin(), levels.uses.end(), use) == levels.uses.end())
        levels.uses.push_back(std::move(use));
  levels.chains.resize(levels.uses.size());
  parallel_for(levels.uses.size(), [&](std::size_t i) {
    const TextureUse& use = levels.uses[i];
    levels.chains[i] = mip_chain(*use.image, use.kind, use.cutoff);
  });
  return levels;
}

}  // namespace bosquet::render
