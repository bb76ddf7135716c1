// A thousand random edits, in one pipeline, against whole runs; and ten thousand edits of a document without its scene.
#include <gtest/gtest.h>

#include "scene/document_digest.h"
#include "scene/history.h"
#include "tests/scene/pipeline_edits.h"

namespace bosquet::scene {
namespace {

TEST(ManyEdits, AThousandGiveTheSameBitsAsWholeRuns) { edit_and_compare(1000, 100); }

TEST(ManyEdits, TenThousandWithUndoEndWhereTheyBegan) {
  RandomStream random(8, 1, Purpose::statistics);
  PlantingGround ground;
  History history(small_grove(), "Open", 10'000, std::size_t{1} << 30);
  const SectionDigests first = digest(*history.current());
  for (int n = 0; n < 10'000; ++n) {
    history.add(random_edit(*history.current(), ground, random), "edit");
    if (random.below(4) == 0 && history.can_undo()) history.undo();
  }
  while (history.can_undo()) history.undo();
  EXPECT_EQ(digest(*history.current()), first);
}

}  // namespace
}  // namespace bosquet::scene
