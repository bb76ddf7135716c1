#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <utility>

#include "core/hash.h"
#include "ui/panels/panels.h"
#include "ui/widgets/slider.h"

// The export dialog: what is written, how large it will be, and where.
namespace bosquet::ui {
namespace {

// The grown scene of the session as it stands, for files.
scene::GrownScene grown_scene(App& app) {
  scene::GrownScene grown;
  grown.given = *app.session().document();
  grown.document = scene::without_removed(grown.given);
  // What could not be grown is in no file.
  std::vector<scene::Tree> there;
  for (const scene::Tree& tree : *grown.document.trees) {
    const auto found = app.view().grown().find(tree.id);
    if (found == app.view().grown().end() || !found->second.grown.skeleton) continue;
    there.push_back(tree);
    grown.trees.push_back(found->second.grown);
  }
  if (const auto around = app.session().pipeline().surroundings()) grown.space = around->space;
  if (there.size() < grown.document.trees->size())
    grown.document.trees = std::make_shared<const scene::Trees>(std::move(there));
  return grown;
}

exchange::SceneFileOptions file_options(Session& session) {
  exchange::SceneFileOptions options{session.name(), {}};
  if (const scene::Tree* tree = session.selected_tree()) options.tree = tree->id;
  return options;
}

// As wide as was asked for, as high as the scene's part of the window.
IVec2 picture_size(const App& app, int width) {
  const Vec2 seen = app.view_size();
  return {width, std::max(1, static_cast<int>(static_cast<float>(width) * seen.y / std::max(1.0f, seen.x) + 0.5f))};
}

}  // namespace

void App::export_to(const std::filesystem::path& file) {
  ExportOrder order;
  order.scene = grown_scene(*this);
  order.options = file_options(*session_);
  order.settings = export_settings_;
  order.show = view_->show;
  order.slice_m = view_->slice_m;
  order.target = file;
  const IVec2 size = picture_size(*this, export_settings_.picture_width);
  order.view.camera = session_->rig.camera();
  order.view.orthographic_height_m = session_->rig.plan_height_m();
  order.view.look = view_->look;
  order.view.width = size.x, order.view.height = size.y;
  if (is_flat(view_->show)) order.view.shading = render::Shading::flat, order.view.sky = false;
  // Triangles go where a picture shows them.
  if (is_picture(file)) order.scene.document.cameras = {order.view.camera};
  export_.start(std::move(order));
}

namespace {

void scene_fields(ExportSettings& e) {
  int preset = static_cast<int>(e.preset);
  ImGui::SetNextItemWidth(-1);
  if (ImGui::Combo("##preset", &preset, "For everything\0For Blender\0For Unreal / Unity\0For the web\0"))
    e.preset = static_cast<ExportPreset>(preset);
  static constexpr std::array<const char*, 4> kPresets{
      "Opens everywhere: plain meshes and textures.", "Plain meshes, as Blender reads them.",
      "Plain, each tree with its levels of detail as nodes, and with wind weights (_WIND) for shaders.",
      "Small: leaves instanced, everything packed. Needs a viewer that knows meshopt, such as three.js."};
  ImGui::TextWrapped("%s", kPresets[static_cast<std::size_t>(preset)]);
}

}  // namespace

void Panels::export_dialog(App& app, const Layout& layout) {
  Session& s = *app.session_;
  if (!begin_dialog("Export", layout, 430, &app.show_export_)) return;
  ExportSettings& e = app.export_settings_;
  const ExportKindInfo& kind = export_kind(e.kind);
  ImGui::SetNextItemWidth(-1);
  if (ImGui::BeginCombo("##kind", kind.name.data(), ImGuiComboFlags_HeightLarge)) {
    for (int k = 0; k < kExportKinds; ++k)
      if (const auto one = static_cast<ExportKind>(k); ImGui::Selectable(export_kind(one).name.data(), one == e.kind))
        e.kind = one;
    ImGui::EndCombo();
  }
  mark(app, "Export kind");
  const bool scene = e.kind == ExportKind::scene, picture = e.kind == ExportKind::picture;
  if (scene)
    scene_fields(e);
  else
    ImGui::TextWrapped("%s", kind.meaning.data());
  if (picture) {
    ImGui::SetNextItemWidth(-1);
    slider("Width", e.picture_width, 640, 7680, "%d pixels", ImGuiSliderFlags_Logarithmic);
  }
  if (scene || (picture && app.view_->show == Show::trees)) {
    ImGui::SetNextItemWidth(-1);
    slider("Triangles at most", e.max_triangles, 50'000, 20'000'000, "%d", ImGuiSliderFlags_Logarithmic);
  }
  const bool lacks_tree = e.kind == ExportKind::tree && !s.selected_tree();
  const bool ready = s.pipeline().idle() && !lacks_tree;
  const std::uint64_t asked = Hasher()
                                  .add(s.revision())
                                  .add(s.growth().year.value_or(0.0f))
                                  .add(static_cast<std::uint64_t>(e.kind))
                                  .add(static_cast<std::uint64_t>(e.preset))
                                  .add(static_cast<std::uint64_t>(e.max_triangles))
                                  .add(static_cast<std::uint64_t>(s.selected_tree() ? s.selected_tree()->id : 0))
                                  .digest();
  if (lacks_tree) {
    ImGui::TextDisabled("Select one tree first.");
  } else if (!ready) {
    ImGui::TextDisabled("The trees are still growing...");
  } else if (scene) {
    // Asked once for each answer: it looks at every tree.
    static std::uint64_t told = 0;
    static ExportSize size;
    if (std::exchange(told, asked) != asked) size = estimate(grown_scene(app), e);
    ImGui::Text("About %s triangles and %s",
                fmt::format("{:.2f} million", static_cast<double>(size.triangles) / 1e6).c_str(),
                bytes_words(size.bytes).c_str());
  } else if (picture) {
    const IVec2 size = picture_size(app, e.picture_width);
    ImGui::Text("%d x %d pixels, about %s", size.x, size.y, bytes_words(picture_bytes(size)).c_str());
  } else {
    app.export_probe_.ask(
        asked, e.kind, [&app] { return grown_scene(app); }, file_options(s));
    const std::string& words = app.export_probe_.words();
    if (words.empty())
      ImGui::TextDisabled("About ...");
    else
      ImGui::TextWrapped("%s", words.c_str());
  }
  ImGui::BeginDisabled(!ready || app.export_.running());
  const bool chosen = ImGui::Button("Choose file...", {140 * layout.scale, 0});
  mark(app, "Choose file...");
  if (chosen) {
    app.show_export_ = false;
    ImGui::CloseCurrentPopup();
    const std::string ending(kind.ending);
    app.chooser_.ask(FileChooser::Mode::save, "Export",
                     scene ? std::vector<std::string>{".glb", ".gltf"} : std::vector<std::string>{ending},
                     s.name() + ending, [&app](const std::filesystem::path& file) { app.export_to(file); });
  }
  ImGui::EndDisabled();
  ImGui::SameLine();
  const bool cancel = ImGui::Button("Cancel", {90 * layout.scale, 0});
  // Escape in the list of kinds closes that list alone.
  if (cancel || (ImGui::IsKeyPressed(kKeyEscape, false) && ImGui::IsWindowFocused()))
    app.show_export_ = false, ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
}

}  // namespace bosquet::ui
