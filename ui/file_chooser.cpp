#include "ui/file_chooser.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cstdlib>

#include "core/letters.h"

namespace bosquet::ui {
namespace {

namespace fs = std::filesystem;

std::string size_words(std::uintmax_t bytes) {
  char buffer[32];
  if (bytes >= 1'000'000)
    std::snprintf(buffer, sizeof buffer, "%.1f MB", static_cast<double>(bytes) / 1e6);
  else
    std::snprintf(buffer, sizeof buffer, "%.1f kB", static_cast<double>(bytes) / 1e3);
  return buffer;
}

}  // namespace

fs::path with_ending(const fs::path& file, const std::vector<std::string>& endings) {
  const std::string name = folded_letters(file.filename().string());
  if (endings.empty() || std::any_of(endings.begin(), endings.end(), [&](const std::string& ending) {
        return name.ends_with(ending) && name != ending;
      }))
    return file;
  const std::string last = fs::path("x" + endings.front()).extension().string();
  const fs::path bare = name.ends_with(last) && name != last ? file.parent_path() / file.stem() : file;
  return bare.string() + endings.front();
}

void FileChooser::set_folder(const fs::path& folder) {
  std::error_code ec;
  const fs::path whole = fs::absolute(folder, ec).lexically_normal();
  folder_ = ec ? folder : whole;
  list();
}

void FileChooser::ask(Mode mode, std::string title, std::vector<std::string> endings, std::string name,
                      std::function<void(const fs::path&)> chosen) {
  mode_ = mode;
  title_ = std::move(title);
  endings_ = std::move(endings);
  name_ = std::move(name);
  chosen_ = std::move(chosen);
  open_ = true;
  begun_ = false;
  replace_.clear();
  if (folder_.empty()) {
    std::error_code ec;
    const char* home = std::getenv("HOME");
    set_folder(fs::current_path(ec) == "/" && home ? fs::path(home) : fs::current_path(ec));
  } else {
    list();
  }
}

void FileChooser::list() {
  entries_.clear();
  problem_.clear();
  std::error_code ec;
  for (fs::directory_iterator it(folder_, fs::directory_options::skip_permission_denied, ec), end; !ec && it != end;
       it.increment(ec)) {
    const std::string name = it->path().filename().string();
    std::error_code ignored;
    const bool folder = it->is_directory(ignored);
    if (name.starts_with('.')) continue;
    if (!folder && !endings_.empty() && std::none_of(endings_.begin(), endings_.end(), [&](const std::string& ending) {
          return folded_letters(name).ends_with(ending);
        }))
      continue;
    entries_.push_back({name, folder, folder ? 0 : it->file_size(ignored)});
  }
  if (ec) problem_ = "This folder cannot be read: " + ec.message();
  std::sort(entries_.begin(), entries_.end(),
            [](const Entry& a, const Entry& b) { return a.folder != b.folder ? a.folder : a.name < b.name; });
}

void FileChooser::choose(const fs::path& path) {
  std::error_code ec;
  fs::path whole = path.is_absolute() ? path : folder_ / path;
  if (fs::is_directory(whole, ec)) {
    name_.clear();
    set_folder(whole);
    return;
  }
  if (mode_ == Mode::save) {
    whole = with_ending(whole, endings_);
    if (fs::exists(whole, ec) && replace_ != whole) {
      replace_ = whole;
      return;
    }
  } else if (!fs::exists(whole, ec)) {
    problem_ = whole.filename().string() + " does not exist here";
    return;
  }
  open_ = false;
  folder_ = whole.parent_path();
  if (chosen_) chosen_(whole);
}

void FileChooser::draw(float scale) {
  if (!open_) return;
  const std::string label = title_ + "###chooser";
  if (!begun_) ImGui::OpenPopup(label.c_str());
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowSize({std::min(640.0f * scale, 0.9f * screen.x), std::min(460.0f * scale, 0.9f * screen.y)},
                           ImGuiCond_Appearing);
  ImGui::SetNextWindowPos({0.5f * screen.x, 0.5f * screen.y}, ImGuiCond_Appearing, {0.5f, 0.5f});
  if (!ImGui::BeginPopupModal(label.c_str(), &open_, ImGuiWindowFlags_NoCollapse)) return;
  if (ImGui::Button("Up") && folder_.has_parent_path()) set_folder(folder_.parent_path());
  ImGui::SameLine();
  ImGui::TextUnformatted(folder_.string().c_str());

  const float below = ImGui::GetFrameHeightWithSpacing() * (problem_.empty() && replace_.empty() ? 2.0f : 3.2f);
  ImGui::BeginChild("entries", {0, -below}, true);
  std::string clicked;
  bool twice = false;
  for (const Entry& entry : entries_) {
    const std::string shown = entry.folder ? entry.name + "/" : entry.name;
    if (ImGui::Selectable(shown.c_str(), entry.name == name_, ImGuiSelectableFlags_AllowDoubleClick)) {
      clicked = entry.name;
      twice = entry.folder || ImGui::IsMouseDoubleClicked(0);
    }
    if (!entry.folder) {
      const std::string bytes = size_words(entry.bytes);
      ImGui::SameLine(ImGui::GetWindowWidth() - ImGui::CalcTextSize(bytes.c_str()).x - 24.0f * scale);
      ImGui::TextDisabled("%s", bytes.c_str());
    }
  }
  if (entries_.empty() && problem_.empty()) ImGui::TextDisabled("Nothing here");
  ImGui::EndChild();

  if (!problem_.empty()) ImGui::TextWrapped("%s", problem_.c_str());
  if (!replace_.empty()) ImGui::TextWrapped("%s exists. Replace it?", replace_.filename().string().c_str());
  const char* act = !replace_.empty() ? "Replace" : mode_ == Mode::save ? "Save" : "Open";
  ImGui::SetNextItemWidth(-190.0f * scale);
  if (!begun_) ImGui::SetKeyboardFocusHere();
  const bool entered = ImGui::InputText("##name", &name_, ImGuiInputTextFlags_EnterReturnsTrue);
  ImGui::SameLine();
  const bool pressed = ImGui::Button(act, {86.0f * scale, 0});
  ImGui::SameLine();
  if (ImGui::Button("Cancel", {86.0f * scale, 0})) open_ = false;
  begun_ = true;
  if (!clicked.empty()) {
    if (clicked != name_) replace_.clear();
    name_ = clicked;
    problem_.clear();
    if (twice) choose(clicked);
  } else if ((entered || pressed) && !name_.empty()) {
    choose(name_);
  }
  if (!open_) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
}

}  // namespace bosquet::ui
