#include "ui/app.h"

#include <backends/imgui_impl_opengl3.h>
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "core/heap.h"
#include "core/letters.h"
#include "ui/import_files.h"
#include "ui/panels/panels.h"
#include "ui/pick.h"
#include "ui/tools/standing_edits.h"

namespace bosquet::ui {
namespace {

constexpr float kTopBar = 46, kSecondRow = 36, kOneRow = 1420, kLeftBar = 196, kRightBar = 300, kStatusBar = 28;
constexpr double kMoving_s = 0.25, kRests_s = 0.6;
constexpr float kRadiusStep = 1.15f;
constexpr float kWalk_m = 2.5f;  ///< a second
constexpr double kToast_s = 6;
constexpr float kYearsPerSecond = 6;
constexpr int kMostPasses = 200;
constexpr double kPass_s = 1e-3;
constexpr std::size_t kTrianglesByCard = 6'000'000, kTrianglesBySoftware = 1'200'000;
constexpr float kFinest = 8;

}  // namespace

Result<std::unique_ptr<App>> App::create(const AppOptions& options) {
  std::unique_ptr<App> app(new App);
  auto view = SceneView::create();
  if (!view) return view.error();
  app->view_.emplace(std::move(*view));
  app->thumbnails_.emplace();
  app->session_ = std::make_unique<Session>(options.session);
  app->preferences_ = options.preferences;
  app->session_->settings.units = options.preferences.units;
  app->marking_ = options.marks;
  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;
  io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
  Input::bind_keys();
  if (!ImGui_ImplOpenGL3_Init("#version 330 core"))
    return cannot_finish("the window's panels cannot be drawn by this OpenGL");

  if (!options.file.empty()) {
    if (auto opened = app->session_->open(options.file); !opened) return opened.error();
    note_recent(app->preferences_, options.file);
  } else {
    auto park = make_example();
    if (!park) return park.error();
    app->session_->start(std::move(*park), "Park");
    app->session_->rig.look({"", to_world({36, -14}, 15), to_world({74, 46}, 5), 46});
    const std::filesystem::path folder =
        options.session.recovery_folder.empty() ? scene::recovery_folder() : options.session.recovery_folder;
    if (options.session.journal)
      for (scene::Recovery& r : scene::list_recoveries(folder))
        if (!r.in_use) app->recoveries_.push_back(std::move(r));
    if (!app->recoveries_.empty()) app->ask_ = Ask::recover;
  }
  if (options.first_run && app->ask_ == Ask::nothing) app->overlay_step_ = 0;
  app->say_notes();
  return app;
}

App::~App() {
  if (!ImGui::GetCurrentContext()) return;
  ImGui_ImplOpenGL3_Shutdown();
  ImGui::DestroyContext();
}

std::string App::title() const {
  return fmt::format("{}{}{} - Bosquet", session_->unsaved() ? "*" : "", session_->name(),
                     session_->read_only().empty() ? "" : " (read-only)");
}

Preferences App::preferences() const {
  Preferences now = preferences_;
  now.units = session_->settings.units;
  return now;
}

std::string App::question() const {
  if (chooser_.open()) return "file";
  switch (ask_) {
    case Ask::close:
    case Ask::open:
    case Ask::start:
      return "unsaved";
    case Ask::recover:
      return "recover";
    case Ask::many_trees:
      return "many trees";
    case Ask::nothing:
      break;
  }
  return show_export_ ? "export" : "";
}

bool App::settled() const {
  return session_->pipeline().idle() && view_->settled() && !export_.running() &&
         finer() == session_->growth().fineness;
}

// How fine the trees are best drawn, once all have grown: twice as fine while the picture has room for the triangles,
// coarser again where there came to be too many.
float App::finer() const {
  const float now = session_->growth().fineness;
  const std::size_t triangles = view_->triangles();
  const std::size_t room = render::draws_by_software() ? kTrianglesBySoftware : kTrianglesByCard;
  const bool gains = refined_revision_ != session_->revision() || 5 * triangles > 6 * coarser_triangles_;
  if (view_->grown_trees() == 0) return now;
  if (2 * triangles <= room && now < kFinest && gains) return 2.0f * now;
  if (2 * triangles > 3 * room && now > 1.0f) return 0.5f * now;
  return now;
}

void App::say(std::string message) {
  toast_ = std::move(message);
  toast_until_s_ = time_s_ + kToast_s;
}

void App::say_notes() {
  if (!session_->notes.empty()) say(first_lines(session_->notes));
}

// Does what would lose unsaved work only after it was saved or given up.
void App::run_guarded(std::function<void()> then, Ask why) {
  if (!session_->unsaved()) {
    then();
    return;
  }
  ask_ = why;
  then_ = std::move(then);
}

void App::open_file(const std::filesystem::path& file) {
  const std::string ending = folded_letters(file.extension().string());
  if (ending != ".bosquet" && ending != ".toml") {
    say(fmt::format("{} is neither a project (.bosquet) nor a recipe (.toml)", file.filename().string()));
    return;
  }
  run_guarded(
      [this, file] {
        if (auto opened = session_->open(file); !opened) {
          say(opened.error().message);
          if (std::error_code ec; !std::filesystem::exists(file, ec)) std::erase(preferences_.recent, file);
          return;
        }
        note_recent(preferences_, file);
        say_notes();
      },
      Ask::open);
}

// ---- input --------------------------------------------------------------------------------------------------------

void App::to_camera(const Event& event) {
  CameraRig& rig = session_->rig;
  const terrain::Terrain& ground = *session_->document()->terrain;
  const Vec2 by = event.at - pointer_;
  if (event.kind == Event::Kind::move) {
    if (held_ == Button::middle || (held_ == Button::right && event.modifiers.shift))
      rig.pan(by, view_size_.y);
    else if (held_ == Button::right)
      rig.orbit(by, view_size_.y);
    else
      return;
    rig.keep_above(ground);
    moved_s_ = time_s_;
  }
  if (event.kind == Event::Kind::scroll && !event.modifiers.control) {
    rig.zoom(event.scroll, ground_hit(ground, rig.ray(event.at - view_low_, view_size_)));
    rig.keep_above(ground);
    moved_s_ = time_s_;
  }
}

bool App::shortcut(const Event& e) {
  Session& s = *session_;
  const bool control = e.modifiers.control;
  if (control) {
    switch (e.key) {
      case 'Z':
        e.modifiers.shift ? s.redo() : s.undo();
        return true;
      case 'Y':
        s.redo();
        return true;
      case 'S':
        e.modifiers.shift ? Panels::ask_save_as(*this) : Panels::save(*this);
        return true;
      case 'O':
        Panels::ask_open(*this);
        return true;
      case 'E':
        show_export_ = true;
        return true;
      case 'A': {
        std::vector<std::int32_t> all;
        for (const scene::Tree& tree : *s.document()->trees) all.push_back(tree.id);
        for (const scene::HeroTree& hero : s.document()->heroes) all.push_back(hero.id);
        s.select(std::move(all));
        return true;
      }
      case 'H':
        show_history_ = !show_history_;
        return true;
      case 'Q':
        run_guarded([this] { ended_ = true; }, Ask::close);
        return true;
      case 'L': {
        const bool lock = std::any_of(s.selection().begin(), s.selection().end(), [&](std::int32_t id) {
          const scene::Tree* tree = s.document()->trees->find(id);
          return tree && !tree->locked;
        });
        if (!s.selection().empty()) s.apply(scene::lock_trees(*s.document(), s.selection(), lock));
        return true;
      }
      default:
        return false;
    }
  }
  const Box3 site{{0, 0, -s.document()->terrain->size_m().y}, {s.document()->terrain->size_m().x, 1, 0}};
  const float aspect = view_size_.x / std::max(1.0f, view_size_.y);
  switch (e.key) {
    case '[':
    case ']': {
      float& radius = s.settings.radius_m;
      radius = std::clamp(e.key == ']' ? radius * kRadiusStep : radius / kRadiusStep, kLeastRadius_m, kMostRadius_m);
      return true;
    }
    case kKeyEscape:
      if (s.tool().busy())
        s.tool().cancel();
      else if (!s.selection().empty())
        s.select({});
      else
        s.take(ToolKind::select);
      return true;
    case kKeyF1:
    case '?':
      show_shortcuts_ = !show_shortcuts_;
      return true;
    case 'F': {
      Box3 box;
      for (const std::int32_t id : s.selection())
        if (const scene::Tree* tree = s.document()->trees->find(id)) {
          const Vec3 foot = to_world(tree->at, s.document()->terrain->ground(tree->at));
          const float h = s.document()->mature_height_m(*tree);
          box.add(foot - Vec3(0.4f * h, 0, 0.4f * h));
          box.add(foot + Vec3(0.4f * h, h, 0.4f * h));
        } else if (const scene::HeroTree* hero = find_hero(*s.document(), id)) {
          const Vec3 foot = to_world(hero->at, s.document()->terrain->ground(hero->at));
          const HeroExtent reach = extent_of(*hero->skeleton);
          box.add(foot - Vec3(reach.radius_m, 0, reach.radius_m));
          box.add(foot + Vec3(reach.radius_m, reach.height_m, reach.radius_m));
        }
      s.rig.frame(box.empty() ? site : box, aspect);
      s.rig.keep_above(*s.document()->terrain);
      return true;
    }
    case kKeyNumpad0 + 1:
      s.rig.look(StandardView::south);
      return true;
    case kKeyNumpad0 + 9:
      s.rig.look(StandardView::north);
      return true;
    case kKeyNumpad0 + 3:
      s.rig.look(StandardView::east);
      return true;
    case kKeyNumpad0 + 6:
      s.rig.look(StandardView::west);
      return true;
    case kKeyNumpad0 + 7:
      s.rig.shows_plan() ? s.rig.look(StandardView::oblique) : s.rig.look(StandardView::top);
      return true;
    case kKeyNumpad0 + 5:
      s.rig.look(StandardView::oblique);
      return true;
    case kKeyHome:
      s.rig.frame(site, aspect);
      return true;
    case 'C':
      s.rig.walk(!s.rig.walking(), *s.document()->terrain);
      return true;
    default:
      break;
  }
  for (int k = 0; k < kToolCount; ++k)
    if (tool_info(static_cast<ToolKind>(k)).key == e.key) {
      s.take(static_cast<ToolKind>(k));
      return true;
    }
  return false;
}

// Events over the scene go to camera and tool; panels have had theirs through ImGui.
void App::route(std::span<const Event> events, double time_s) {
  const ImGuiIO& io = ImGui::GetIO();
  const bool dialog = ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
  for (const Event& raw : events) {
    Event event = raw;
    const Vec2 in_view = raw.at - view_low_;
    const bool inside = in_view.x >= 0 && in_view.y >= 0 && in_view.x < view_size_.x && in_view.y < view_size_.y;
    const bool key = raw.kind == Event::Kind::key_press || raw.kind == Event::Kind::key_release;
    if (raw.kind == Event::Kind::text) continue;
    over_scene_ = inside && !io.WantCaptureMouse && !dialog;
    if (key) {
      const auto down = std::find(keys_down_.begin(), keys_down_.end(), raw.key);
      if (raw.kind == Event::Kind::key_release && down != keys_down_.end()) keys_down_.erase(down);
      if (io.WantTextInput || dialog) continue;
      if (raw.kind == Event::Kind::key_press) {
        if (down == keys_down_.end()) keys_down_.push_back(raw.key);
        // Arrows walk while they are held; other keys are the tool's first when it is busy.
        const bool tools_own = raw.key == kKeyEnter || raw.key == kKeyBackspace || raw.key == kKeyDelete;
        if (!tools_own && shortcut(raw)) continue;
      }
    } else if (held_ == Button::none && !over_scene_) {
      pointer_ = raw.at;
      continue;
    }
    if (raw.kind == Event::Kind::press && held_ == Button::none) {
      held_ = raw.button;
      camera_drag_ = raw.button != Button::left;
    }
    to_camera(raw);
    if (!camera_drag_) {
      ToolEvent tool_event;
      event.at = in_view;
      if (raw.time_s <= 0) event.time_s = time_s;
      tool_event.event = event;
      const SightRay ray = session_->rig.ray(in_view, view_size_);
      tool_event.ground = ground_hit(*session_->document()->terrain, ray);
      if (raw.kind == Event::Kind::press) tool_event.tree = tree_hit(*session_->document(), ray);
      if (raw.kind != Event::Kind::move || held_ == Button::left) moved_s_ = time_s;
      session_->send(tool_event, view_size_);
    }
    if (raw.kind == Event::Kind::release && raw.button == held_) held_ = Button::none, camera_drag_ = false;
    pointer_ = raw.at;
  }
}

// ---- drawing ------------------------------------------------------------------------------------------------------

// Brush ring, lines, places, selection: drawn over the picture.
void App::draw_overlays() {
  const ToolScene scene = session_->tool_scene(view_size_);
  const scene::Document& document = *session_->document();
  ImDrawList* draw = ImGui::GetBackgroundDrawList();
  draw->PushClipRect({view_low_.x, view_low_.y}, {view_low_.x + view_size_.x, view_low_.y + view_size_.y});
  const auto place = [&](const Vec3& world) -> std::optional<ImVec2> {
    const auto p = session_->rig.project(world, view_size_);
    if (!p) return {};
    return ImVec2{view_low_.x + p->x, view_low_.y + p->y};
  };
  const auto on_ground = [&](Vec2 plan) { return to_world(plan, document.terrain->ground(plan) + 0.05f); };
  const auto ring = [&](Vec2 centre, float radius, ImU32 colour, float thick) {
    std::vector<ImVec2> points;
    constexpr int kPoints = 64;
    for (int i = 0; i < kPoints; ++i) {
      const SinCos a = sin_cos(2.0f * kPi * static_cast<float>(i) / kPoints);
      if (const auto p = place(on_ground(centre + radius * Vec2(a.cos, a.sin)))) points.push_back(*p);
    }
    draw->AddPolyline(points.data(), static_cast<int>(points.size()), colour, ImDrawFlags_Closed, thick);
  };
  const ImU32 bright = IM_COL32(255, 255, 255, 230), dark = IM_COL32(0, 0, 0, 120),
              green = IM_COL32(150, 220, 110, 255);

  // Words that stand out from snow as from shade.
  const auto write = [&](ImVec2 at, const std::string& words) {
    const ImVec2 size = ImGui::CalcTextSize(words.c_str());
    const float pad = 4 * scale_;
    draw->AddRectFilled({at.x - pad, at.y - 0.5f * pad}, {at.x + size.x + pad, at.y + size.y + 0.5f * pad},
                        IM_COL32(24, 28, 25, 150), 4 * scale_);
    draw->AddText(at, bright, words.c_str());
  };

  constexpr std::size_t kMostRings = 400;
  std::size_t rings = 0;
  for (const std::int32_t id : session_->selection()) {
    if (++rings > kMostRings) break;
    if (const scene::HeroTree* hero = find_hero(document, id)) {
      const float reach = extent_of(*hero->skeleton).radius_m;
      ring(hero->at, reach, dark, 4.0f * scale_);
      ring(hero->at, reach, green, 2.0f * scale_);
    }
    const scene::Tree* tree = document.trees->find(id);
    if (!tree) continue;
    const float radius = 0.5f * tree->scale_width * document.species_of(*tree).shape.crown_width_m;
    ring(tree->at, radius, dark, 4.0f * scale_);
    ring(tree->at, radius, tree->locked ? IM_COL32(230, 180, 90, 255) : green, 2.0f * scale_);
  }

  // Density is seen while it is painted: dots where fewer trees are planted.
  if (session_->tool_kind() == ToolKind::density) {
    constexpr float kAcross = 90;
    const Vec2 size = document.terrain->size_m();
    const float step = std::max(size.x, size.y) / kAcross;
    for (float north = 0.5f * step; north < size.y; north += step)
      for (float east = 0.5f * step; east < size.x; east += step) {
        const float thin = 1.0f - document.terrain->density.at({east, north});
        if (thin < 0.02f) continue;
        if (const auto p = place(on_ground({east, north})))
          draw->AddCircleFilled(*p, (1.0f + 2.0f * thin) * scale_, IM_COL32(235, 150, 60, 220), 8);
      }
  }

  const Preview preview = session_->tool().preview(scene);
  const bool shown = over_scene_ || held_ != Button::none;
  if (preview.ring && shown) {
    ring(preview.ring->centre, preview.ring->radius_m, dark, 3.5f * scale_);
    ring(preview.ring->centre, preview.ring->radius_m, bright, 1.6f * scale_);
    if (tool_info(session_->tool_kind()).has_radius)
      if (const auto p = place(on_ground(preview.ring->centre + Vec2(preview.ring->radius_m, 0.0f))))
        write({p->x + 6 * scale_, p->y}, length_words(preview.ring->radius_m, session_->settings.units));
  }
  std::vector<ImVec2> line;
  for (Vec2 p : preview.line)
    if (const auto seen = place(on_ground(p))) line.push_back(*seen);
  if (line.size() > 1) {
    const ImDrawFlags closed = preview.closed ? ImDrawFlags_Closed : 0;
    draw->AddPolyline(line.data(), static_cast<int>(line.size()), dark, closed, 4.0f * scale_);
    draw->AddPolyline(line.data(), static_cast<int>(line.size()), bright, closed, 2.0f * scale_);
  }
  for (const ImVec2& p : line) draw->AddCircleFilled(p, 3.5f * scale_, bright);
  for (Vec2 p : preview.places)
    if (const auto seen = place(on_ground(p))) draw->AddCircleFilled(*seen, 2.5f * scale_, green);
  if (preview.outline.size() > 1) {
    std::vector<ImVec2> points;
    for (Vec2 p : preview.outline) points.push_back({view_low_.x + p.x, view_low_.y + p.y});
    draw->AddPolyline(points.data(), static_cast<int>(points.size()), bright, ImDrawFlags_Closed, 1.5f * scale_);
  }
  if (!preview.label.empty() && shown) write({pointer_.x + 16 * scale_, pointer_.y + 8 * scale_}, preview.label);
  draw->PopClipRect();
}

void App::frame(const FrameInput& in) {
  const double passed_s = std::clamp(in.time_s - time_s_, 1e-4, 0.25);
  time_s_ = in.time_s;
  if (time_s_ > asked_memory_s_ + 1.0) memory_mb_ = resident_mb(), asked_memory_s_ = time_s_;
  if (in.scale != scale_) {
    scale_ = in.scale;
    fonts_ = load_fonts(scale_);
    apply_theme(preferences_.dark, scale_);
    ImGui_ImplOpenGL3_DestroyFontsTexture();
    ImGui_ImplOpenGL3_CreateFontsTexture();
  }
  ImGuiIO& io = ImGui::GetIO();
  io.DisplaySize = {static_cast<float>(in.size.x), static_cast<float>(in.size.y)};
  for (const std::filesystem::path& file : in.dropped) open_file(file);
  if (in.close) run_guarded([this] { ended_ = true; }, Ask::close);
  thumbnails_->keep(session_->document()->species);
  // What happened since the last frame may be more than one pass of ImGui can see; only the last pass is drawn.
  // One more shows what a click led to.
  pass(in, in.events, passed_s);
  bool shows_all =
      std::all_of(in.events.begin(), in.events.end(), [](const Event& e) { return e.kind == Event::Kind::move; });
  for (int more = 0; (input_.waiting() || !shows_all) && more < kMostPasses; ++more) {
    shows_all = !input_.waiting();
    ImGui::EndFrame();
    pass(in, {}, kPass_s);
  }

  if (time_s_ - moved_s_ > kRests_s) {
    session_->look_from_here();
    // Near trees first, then all of them finer.
    if (session_->pipeline().idle() && view_->settled())
      if (const float fineness = finer(); fineness != session_->growth().fineness) {
        coarser_triangles_ = fineness > session_->growth().fineness ? view_->triangles() : 0;
        refined_revision_ = session_->revision();
        session_->set_fineness(fineness);
      }
  }
  thumbnails_->collect();
  view_->update(*session_);
  if (!view_->problem.empty()) say(std::exchange(view_->problem, {}));
  view_->draw(*session_, IVec2(view_size_), time_s_ - moved_s_ < kMoving_s, in.time_s);
  ImGui::GetBackgroundDrawList()->AddImage(reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(view_->texture())),
                                           {view_low_.x, view_low_.y},
                                           {view_low_.x + view_size_.x, view_low_.y + view_size_.y}, {0, 1}, {1, 0});
  draw_overlays();
  ImGui::Render();
  render::clear_framebuffer(in.framebuffer, in.size, Vec3(0.12f));
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

// Events and panels of one pass.
void App::pass(const FrameInput& in, std::span<const Event> fresh, double passed_s) {
  ImGuiIO& io = ImGui::GetIO();
  io.DeltaTime = static_cast<float>(passed_s);
  const std::vector<Event> events = input_.feed(fresh);
  ImGui_ImplOpenGL3_NewFrame();
  ImGui::NewFrame();

  marks_.clear();
  Layout layout;
  layout.scale = scale_;
  layout.screen = {in.size.x, in.size.y};
  layout.two_rows = layout.screen.x < kOneRow * scale_;
  layout.top = (layout.two_rows ? kTopBar + kSecondRow : kTopBar) * scale_, layout.left = kLeftBar * scale_,
  layout.right = kRightBar * scale_, layout.bottom = kStatusBar * scale_;
  Panels::menu(*this, layout);
  view_low_ = {layout.left, layout.menu + layout.top};
  view_size_ = glm::max(layout.screen - view_low_ - Vec2(layout.right, layout.bottom), Vec2(16.0f));

  // Events before the panels are drawn, so that what they show is what is.
  route(events, in.time_s);
  session_->tick(in.time_s, view_size_);
  if (held_ == Button::left && session_->tool().busy()) moved_s_ = in.time_s;
  const float step = kWalk_m * static_cast<float>(passed_s) * (session_->rig.walking() ? 1.0f : 6.0f);
  for (const int key : keys_down_) {
    const Vec2 way = key == kKeyUp      ? Vec2(0, 1)
                     : key == kKeyDown  ? Vec2(0, -1)
                     : key == kKeyLeft  ? Vec2(-1, 0)
                     : key == kKeyRight ? Vec2(1, 0)
                                        : Vec2(0.0f);
    if (way == Vec2(0.0f) || io.WantTextInput) continue;
    session_->rig.step(step * way.x, step * way.y, *session_->document()->terrain);
    moved_s_ = in.time_s;
  }
  if (playing_) {
    year_ += kYearsPerSecond * static_cast<float>(passed_s);
    if (year_ > 100.0f) playing_ = false, year_ = 100.0f;
    session_->set_year(year_);
  }

  Panels::toolbar(*this, layout);
  Panels::species_bar(*this, layout);
  Panels::inspector(*this, layout);
  Panels::status(*this, layout);
  if (show_history_) Panels::history(*this, layout);
  if (show_export_) Panels::export_dialog(*this, layout);
  if (show_shortcuts_) Panels::shortcuts(*this, layout);
  Panels::questions(*this, layout);
  Panels::first_run(*this, layout);
  chooser_.draw(scale_);
  if (auto done = export_.finished()) say(*done);
  if (!session_->message.empty()) say(std::exchange(session_->message, {}));
  if (session_->asked_trees() > 0) ask_ = Ask::many_trees;
  Panels::toast(*this, layout);
}

}  // namespace bosquet::ui
