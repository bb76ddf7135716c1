// Picture: a model drawn without a window into a .png.
#pragma once

#include <filesystem>
#include <optional>

#include "cli/options.h"
#include "core/result.h"
#include "scene/grown_scene.h"
#include "scene/model_builder.h"

namespace bosquet::cli {

/// Draws by the options' camera, sun and size, with the document's figures and the options'. Without --camera: the recipe's first camera, else the whole site from
/// the south at 30 degrees.
Result<void> write_picture(const scene::BuiltModel& built, const scene::GrownScene& grown, const Options& options,
                           const std::filesystem::path& target);

/// The camera that a picture of trees is drawn with, as far as it is known before anything is grown.
std::optional<scene::Camera> picture_camera(const scene::Document& document, const Options& options);

/// What --camera and --sun say, checked before anything is grown.
Result<void> check_picture_options(const scene::Document& document, const Options& options);

/// The model of a view other than trees: shapes, regions, arrows or plan.
Result<scene::Model> view_model(const scene::GrownScene& grown, const Options& options);

}  // namespace bosquet::cli
