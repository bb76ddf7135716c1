#include "ui/script.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

namespace bosquet::ui {
namespace {

std::string problem_of(const std::string& text) {
  const auto script = parse_script(text, "s.script");
  return script ? "" : script.error().message;
}

TEST(Script, LinesAreWordsWithoutCommentsAndKeepTheirNumbers) {
  const auto script = parse_script("# a session\n\nkey Ctrl+Z  # back\ndrag 1 2 3 4 right\n", "s.script");
  ASSERT_TRUE(script) << script.error().message;
  ASSERT_EQ(script->lines.size(), 2u);
  EXPECT_EQ(script->lines[0].number, 3);
  EXPECT_EQ(script->lines[0].words, (std::vector<std::string>{"key", "Ctrl+Z"}));
  EXPECT_EQ(script->lines[1].words.back(), "right");
}

TEST(Script, AMistakeIsToldWithItsLineAndWhatIsAllowed) {
  const std::string unknown = problem_of("wait 1\njump 3\n");
  EXPECT_NE(unknown.find("s.script:2"), std::string::npos) << unknown;
  EXPECT_NE(unknown.find("'jump' is no command"), std::string::npos) << unknown;
  EXPECT_NE(unknown.find("drag"), std::string::npos) << unknown;
  EXPECT_NE(problem_of("move 3\n").find("takes 2 words"), std::string::npos);
  EXPECT_NE(problem_of("scroll up\n").find("'up' is not a number"), std::string::npos);
}

TEST(Script, TheGuideExplainsEveryCommandAndItsExampleIsAScript) {
  std::ifstream in(std::string(BOSQUET_SOURCE_DIR) + "/docs/guide.md");
  std::ostringstream text;
  text << in.rdbuf();
  const std::string guide = text.str();
  // The message about an unknown command names them all.
  std::string all = problem_of("jump\n");
  all = all.substr(all.find("there are: ") + 11);
  std::istringstream names(all);
  for (std::string name; names >> name;) {
    if (name.back() == ',') name.pop_back();
    EXPECT_NE(guide.find("\n| `" + name), std::string::npos) << name;
  }
  const std::size_t begin = guide.rfind("\n```\n", guide.rfind("\n```\n") - 1) + 5;
  EXPECT_EQ(problem_of(guide.substr(begin, guide.rfind("\n```\n") + 1 - begin)), "");
}

}  // namespace
}  // namespace bosquet::ui
