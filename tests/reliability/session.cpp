// A session that edits and saves a project until it is killed, telling on stdout what it did: session PROJECT STATE SEED
//
// Model     a third of the saves write the whole file anew, as "save as" does
// Format    records of 40 bytes: kind (1 edited, 2 an edit is on the disk, 3 a save begins, 4 a save is done), edit number,
//           nanoseconds of the monotonic clock, and for kind 1 the digest of the document
#include <time.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include "../scene/full_document.h"
#include "edits.h"
#include "scene/document_digest.h"
#include "scene/journal.h"
#include "scene/project_file.h"

namespace {

using namespace bosquet;
using namespace bosquet::scene;

void tell(std::uint64_t kind, std::uint64_t edit, const Digest128& digest = {}) {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  const std::uint64_t record[] = {
      kind, edit, static_cast<std::uint64_t>(now.tv_sec) * 1'000'000'000u + static_cast<std::uint64_t>(now.tv_nsec),
      digest.high, digest.low};
  if (::write(STDOUT_FILENO, record, sizeof record) != sizeof record) std::exit(3);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  const std::filesystem::path path = argv[1];
  RandomStream random(static_cast<std::uint64_t>(std::atoll(argv[3])), 7, Purpose::statistics);
  auto file = std::filesystem::exists(path) ? ProjectFile::open(path) : ProjectFile::create(path, full_document(60));
  if (!file || !file->state().read_only.empty()) return 1;
  Document document = file->document();
  DigestKeeper digests;
  tell(1, 0, digests.of(document).all());
  tell(4, 0);
  auto journal = Journal::start(document, path, argv[2]);
  if (!journal) return 1;
  std::uint64_t durable = 0;
  for (std::uint64_t edit = 1;; ++edit) {
    document = edited(document, random);
    tell(1, edit, digests.of(document).all());
    (*journal)->record(document, edit);
    ::usleep(random.below(3000));
    if (const std::uint64_t now = (*journal)->durable(); now > durable) tell(2, durable = now);
    if (random.below(12) == 0) {
      tell(3, edit);
      if (!(random.below(3) == 0 ? file->save_as(document, path) : file->save(document))) return 1;
      tell(4, edit);
      (*journal)->saved(path, edit);
    }
  }
}
