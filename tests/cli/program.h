// Program: runs the bosquet command in a folder of its own and keeps what it printed.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

namespace bosquet {

inline std::string file_text(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return std::move(text).str();
}

struct Ran {
  int status = -1;
  std::string out, err;
};

class ProgramTest : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() /
              ("bosquet-" + std::string(test->test_suite_name()) + "-" + test->name());
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  /// A shell line run in the test's folder.
  Ran shell(const std::string& line) const {
    const std::string command = "cd '" + folder_.string() + "' && (" + line + ") >.out 2>.err </dev/null";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), file_text(folder_ / ".out"),
            file_text(folder_ / ".err")};
  }
  Ran bosquet(const std::string& arguments) const {
    return shell(std::string("'") + BOSQUET_PROGRAM + "' " + arguments);
  }

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }
  nlohmann::json json(const std::string& name) const { return nlohmann::json::parse(file_text(folder_ / name)); }
  static std::string source(const std::string& path) { return std::string(BOSQUET_SOURCE_DIR) + "/" + path; }

  std::filesystem::path folder_;
};

}  // namespace bosquet
