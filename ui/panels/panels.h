// Panels: the parts of the window around the scene. A panel shows the session and asks it for edits; nothing is computed
// here.
//
// Context   a frame of Dear ImGui begun
#pragma once

#include "ui/app.h"
#include "ui/import_files.h"

namespace bosquet::ui {

/// Where panels lie, in pixels.
struct Layout {
  float scale = 1;
  float menu = 0, top = 0, left = 0, right = 0, bottom = 0;  ///< thicknesses
  Vec2 screen{0.0f};
  bool two_rows = false;  ///< the tools' settings stand below them, where the window is narrow
};

struct Panels {
  static void menu(App& app, Layout& layout);
  static void toolbar(App& app, const Layout& layout);
  static void species_bar(App& app, const Layout& layout);
  static void inspector(App& app, const Layout& layout);
  static void status(App& app, const Layout& layout);
  static void history(App& app, const Layout& layout);
  static void export_dialog(App& app, const Layout& layout);
  static void questions(App& app, const Layout& layout);
  static void shortcuts(App& app, const Layout& layout);
  static void first_run(App& app, const Layout& layout);
  static void toast(App& app, const Layout& layout);

  /// Notes where the widget drawn last lies.
  static void mark(App& app, std::string_view name);

  /// What the menu and the shortcuts do alike.
  static void ask_open(App& app);
  static void ask_import(App& app, ImportKind kind);
  static void ask_hero(App& app);
  static void ask_save_as(App& app, std::function<void()> then = {});
  static void save(App& app, std::function<void()> then = {});
  static void keep_as_hero(App& app);

 private:
  static void tree_page(App& app);
  static void trees_page(App& app);
  static void hero_page(App& app);
  static void underlay_fields(App& app);
  static void site_page(App& app);
  static void sun_fields(App& app);
  static void growth_widgets(App& app, const scene::Tree& tree);
};

/// Begins a panel fixed at a place; one that `scrolls` gets a bar when it is too small.
bool begin_panel(const char* name, Vec2 low, Vec2 size, bool scrolls = true);
void end_panel();

/// Begins a dialog in the middle of the window, which takes all input; `open`: its cross may close it.
bool begin_dialog(const char* title, const Layout& layout, float width, bool* open = nullptr);

}  // namespace bosquet::ui
