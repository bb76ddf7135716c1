#include "core/letters.h"

#include <gtest/gtest.h>

#include "core/random.h"

namespace bosquet {
namespace {

TEST(Letters, MarksAreTakenOffAndUmlautsSpelledOut) {
  EXPECT_EQ(folded_letters("S\xc3\xa4ulen-EICHE"), "saeulen-eiche");
  EXPECT_EQ(folded_letters("\xc3\x89pic\xc3\xa9"
                           "a de Sibérie"),
            "epicea de siberie");
  EXPECT_EQ(folded_letters("Tilia \xc3\x97 europaea"), "tilia x europaea");
  EXPECT_EQ(folded_letters("\xe2\x80\x98Globosum\xe2\x80\x99"), "'globosum'");
  EXPECT_EQ(folded_letters("Wei\xc3\x9f"
                           "buche"),
            "weissbuche");
}

TEST(Letters, DecomposedTextIsTheSameName) {
  EXPECT_EQ(folded_letters("Ho\xcc\x88he"), folded_letters("H\xc3\xb6he"));
  EXPECT_EQ(folded_letters("che\xcc\x82ne"), folded_letters("ch\xc3\xaane"));
}

TEST(Letters, WordsAreJoinedBySingleUnderscores) {
  EXPECT_EQ(folded_words("  Crown \xc3\x98 (m) "), "crown_o_m");
  EXPECT_EQ(folded_words("--"), "");
}

TEST(Letters, FoldingTwiceIsFoldingOnce) {
  RandomStream stream(3, 4, Purpose::statistics);
  for (int i = 0; i < 2000; ++i) {
    std::string text;
    for (std::uint32_t n = stream.below(12); n > 0; --n) {
      const std::uint32_t code = 1 + stream.below(0x36f);
      if (code >= 0x80) text += static_cast<char>(0xc0 | code >> 6);
      text += static_cast<char>(code < 0x80 ? code : 0x80 | (code & 0x3f));
    }
    const std::string words = folded_words(text);
    EXPECT_EQ(folded_words(words), words);
  }
}

}  // namespace
}  // namespace bosquet
