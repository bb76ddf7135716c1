// File chooser: a dialog in which a file is found or named, the same on every desktop.
//
// Model     lists one folder, folders first; typing a path works too. Saving over a file asks first
// Errors    a folder that cannot be read is said in the dialog
// Context   a frame of Dear ImGui begun
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace bosquet::ui {

/// The file under a name that ends in one of `endings`: its own, or with the first in place of that one's last part.
std::filesystem::path with_ending(const std::filesystem::path& file, const std::vector<std::string>& endings);

class FileChooser {
 public:
  enum class Mode { open, save };

  /// Opens the dialog; `chosen` is called once with the path when one is chosen. `endings` (".toml") filter what is
  /// listed; a name to save under that has none of them gets the first.
  void ask(Mode mode, std::string title, std::vector<std::string> endings, std::string name,
           std::function<void(const std::filesystem::path&)> chosen);
  bool open() const { return open_; }
  void draw(float scale);

  /// Of the folder shown: changed by who knows a better one.
  void set_folder(const std::filesystem::path& folder);
  const std::filesystem::path& folder() const { return folder_; }

 private:
  struct Entry {
    std::string name;
    bool folder;
    std::uintmax_t bytes;
  };
  void list();
  void choose(const std::filesystem::path& path);

  bool open_ = false, begun_ = false;
  Mode mode_ = Mode::open;
  std::string title_, name_, problem_;
  std::vector<std::string> endings_;
  std::function<void(const std::filesystem::path&)> chosen_;
  std::filesystem::path folder_, replace_;
  std::vector<Entry> entries_;
};

}  // namespace bosquet::ui
