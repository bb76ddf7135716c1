// Desktop: an X server of its own, the window in it, and xdotool as the hand that moves pointer and keys.
//
// Who       tests of whole tasks; what the window shows is read from its state file (ui/state_file.h)
// Decision  software OpenGL on every machine, so that the same pictures are looked at everywhere
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "core/image.h"
#include "core/vec.h"
#include "exchange/image_file.h"

namespace bosquet::ui::test {

using Json = nlohmann::json;

inline void rest(double seconds) { std::this_thread::sleep_for(std::chrono::duration<double>(seconds)); }

inline bool on_path(const std::string& program) {
  return std::system(("command -v " + program + " >/dev/null 2>&1").c_str()) == 0;
}

/// A program that was started, ended with it.
class Started {
 public:
  Started(std::vector<std::string> words, const std::vector<std::string>& environment, const std::string& said) {
    pid_ = ::fork();
    if (pid_ != 0) return;
    for (const std::string& e : environment) {
      const std::size_t is = e.find('=');
      is == std::string::npos ? ::unsetenv(e.c_str()) : ::setenv(e.substr(0, is).c_str(), e.c_str() + is + 1, 1);
    }
    const int out = ::open(said.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0644);
    ::dup2(out, 1), ::dup2(out, 2);
    std::vector<char*> raw;
    for (std::string& word : words) raw.push_back(word.data());
    raw.push_back(nullptr);
    ::execvp(raw[0], raw.data());
    ::_exit(127);
  }
  ~Started() {
    if (pid_ > 0) ::kill(pid_, SIGKILL), ::waitpid(pid_, nullptr, 0);
  }
  Started(const Started&) = delete;
  Started& operator=(const Started&) = delete;

  void kill_now() { ::kill(pid_, SIGKILL), ::waitpid(pid_, nullptr, 0), pid_ = -1; }
  /// Its exit status when it ends in time.
  std::optional<int> ended(double at_most_s) {
    for (double waited = 0; waited < at_most_s; waited += 0.05) {
      int status = 0;
      if (::waitpid(pid_, &status, WNOHANG) == pid_) {
        pid_ = -1;
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
      }
      rest(0.05);
    }
    return {};
  }

 private:
  pid_t pid_ = -1;
};

class Desktop : public ::testing::Test {
 protected:
  static constexpr int kWidth = 1100, kHeight = 700;

  void SetUp() override {
    for (const char* program : {"Xvfb", "xdotool"})
      if (!on_path(program)) GTEST_SKIP() << program << " is not installed; scripts/setup.sh test installs it";
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() / ("bosquet-window-" + std::string(test->name()));
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
    int ends[2];
    ASSERT_EQ(::pipe(ends), 0);
    const std::string screen = std::to_string(kWidth) + "x" + std::to_string(kHeight) + "x24";
    server_ = std::make_unique<Started>(
        std::vector<std::string>{"Xvfb", "-displayfd", std::to_string(ends[1]), "-screen", "0", screen, "-noreset",
                                 "-nolisten", "tcp", "-fbdir", folder_.string()},
        std::vector<std::string>{}, (folder_ / "xvfb.log").string());
    ::close(ends[1]);
    std::string number;
    for (char letter = 0; ::read(ends[0], &letter, 1) == 1 && letter != '\n';) number += letter;
    ::close(ends[0]);
    ASSERT_FALSE(number.empty()) << "Xvfb does not start";
    display_ = ":" + number;
    ::setenv("DISPLAY", display_.c_str(), 1);
  }
  void TearDown() override {
    window_.reset();
    server_.reset();
    if (!HasFailure() && !folder_.empty()) std::filesystem::remove_all(folder_);
  }

  std::vector<std::string> environment() const {
    return {"XDG_STATE_HOME=" + (folder_ / "state").string(), "XDG_CACHE_HOME=" + (folder_ / "cache").string(),
            "LIBGL_ALWAYS_SOFTWARE=1", "DISPLAY=" + display_, "WAYLAND_DISPLAY"};
  }
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }

  /// Opens the window and waits until it shows its first frames.
  void open(const std::vector<std::string>& arguments = {}, const std::string& state = "state.json") {
    std::vector<std::string> words{BOSQUET_PROGRAM, "ui"};
    words.insert(words.end(), arguments.begin(), arguments.end());
    state_ = folder_ / state;
    std::filesystem::remove(state_);
    words.insert(words.end(), {"--state", state_.string(), "--size", "1100x700"});
    window_ = std::make_unique<Started>(words, environment(), (folder_ / "window.log").string());
    ASSERT_TRUE(wait([](const Json& s) { return s["view"][2] > 100; })) << said();
  }
  std::string said() const {
    std::ifstream in(folder_ / "window.log");
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
  }

  Json state() const {
    for (int i = 0; i < 50; ++i) {
      std::ifstream in(state_);
      const Json json = Json::parse(in, nullptr, false);
      if (!json.is_discarded()) return json;
      rest(0.05);
    }
    return {};
  }
  /// Waits until the state is so; false when it takes longer than `at_most_s`.
  bool wait(const std::function<bool(const Json&)>& so, double at_most_s = 300) const {
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(at_most_s);
    while (std::chrono::steady_clock::now() < end) {
      std::error_code ec;
      if (std::filesystem::exists(state_, ec)) {
        const Json now = state();
        if (!now.is_null() && so(now)) return true;
      }
      rest(0.05);
    }
    return false;
  }
  bool settle() const {
    rest(0.3);
    return wait([](const Json& s) { return s["settled"].get<bool>(); });
  }

  // The hand.
  void hand(const std::string& line) const {
    ASSERT_EQ(std::system(("xdotool " + line).c_str()), 0) << "xdotool " << line;
  }
  static std::string at(Vec2 p) {
    return std::to_string(static_cast<int>(p.x)) + " " + std::to_string(static_cast<int>(p.y));
  }
  void click(Vec2 p) const { hand("mousemove " + at(p) + " sleep 0.1 mousedown 1 sleep 0.1 mouseup 1 sleep 0.1"); }
  void drag(Vec2 from, Vec2 to, int steps = 8) const {
    std::string line = "mousemove " + at(from) + " sleep 0.1 mousedown 1 sleep 0.05";
    for (int i = 1; i <= steps; ++i)
      line += " mousemove " + at(glm::mix(from, to, static_cast<float>(i) / static_cast<float>(steps))) + " sleep 0.04";
    hand(line + " sleep 0.05 mouseup 1 sleep 0.1");
  }
  void key(const std::string& name) const { hand("key " + name + " sleep 0.15"); }
  void type(const std::string& text) const { hand("type --delay 15 '" + text + "'"); }
  /// Takes a tool by its key.
  void take(const std::string& letter, const std::string& tool) const {
    key(letter);
    ASSERT_TRUE(wait([&](const Json& s) { return s["tool"] == tool; }, 60)) << state()["tool"];
  }
  /// The middle of a widget, when it rests.
  Vec2 widget(const std::string& name) const {
    Json box, before;
    const bool rests = wait(
        [&](const Json& s) {
          before = std::exchange(box, s["widgets"].value(name, Json()));
          if (box.is_null() || box != before) rest(0.15);
          return !box.is_null() && box == before;
        },
        60);
    if (!rests) {
      ADD_FAILURE() << "no widget '" << name << "' is shown";
      return Vec2(0.0f);
    }
    return {box[0].get<float>() + 0.5f * box[2].get<float>(), box[1].get<float>() + 0.5f * box[3].get<float>()};
  }
  /// Clicks a widget once it stays where it is: a dialog that has just come may still move.
  void press(const std::string& name) const {
    Vec2 at = widget(name);
    for (int turn = 0; turn < 20; ++turn) {
      std::this_thread::sleep_for(std::chrono::milliseconds(250));
      const Vec2 now = widget(name);
      if (now == at) break;
      at = now;
    }
    click(at);
  }
  /// Where a point of the scene is on the screen, as a share of the scene's part of the window.
  Vec2 scene(float x, float y) const {
    const Json view = state()["view"];
    return {view[0].get<float>() + x * view[2].get<float>(), view[1].get<float>() + y * view[3].get<float>()};
  }
  /// Foot of a tree on the screen.
  Vec2 foot(int id) const {
    const Json now = state();
    for (const Json& place : now["places"])
      if (place["id"] == id) return {place["x"].get<float>(), place["y"].get<float>()};
    ADD_FAILURE() << "tree " << id << " is not seen";
    return Vec2(0.0f);
  }

  /// What the screen shows now; kept as NAME.png where BOSQUET_SCREENSHOTS names a folder.
  Image screen(const std::string& name) const {
    // The server keeps its screen in a file of the X window dump format: a head of 32-bit words, the highest byte first,
    // a colour map, then the rows.
    std::ifstream in(folder_ / "Xvfb_screen0", std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(in)), {});
    const auto word = [&](std::size_t i) {
      std::uint32_t v = 0;
      for (std::size_t b = 0; b < 4; ++b) v = v << 8 | static_cast<unsigned char>(bytes.at(4 * i + b));
      return v;
    };
    Image image(static_cast<int>(word(4)), static_cast<int>(word(5)), 3);
    const std::size_t first = word(0) + 12 * word(19), line = word(12);
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x)
        for (std::size_t c = 0; c < 3; ++c)
          image.at(x, y)[c] = static_cast<std::uint8_t>(
              bytes.at(first + static_cast<std::size_t>(y) * line + 4 * static_cast<std::size_t>(x) + 2 - c));
    if (const char* keep = std::getenv("BOSQUET_SCREENSHOTS")) {
      EXPECT_TRUE(exchange::write_image(std::filesystem::path(keep) / (name + ".png"), image));
    }
    return image;
  }

  std::filesystem::path folder_, state_;
  std::string display_;
  std::unique_ptr<Started> server_, window_;
};

}  // namespace bosquet::ui::test
