#include "failing_vfs.h"

#include <sqlite3.h>

#include <cstring>

namespace bosquet::scene {
namespace {

struct Shim {
  sqlite3_vfs vfs{};
  sqlite3_vfs* real = nullptr;
  int operations = 0, fail_at = 0;
  bool for_good = false, failed = false;
  int code = SQLITE_IOERR;
} shim;

// Whether this operation is the one.
bool fails() {
  ++shim.operations;
  if (shim.fail_at == 0 || shim.operations < shim.fail_at || (shim.operations > shim.fail_at && !shim.for_good))
    return false;
  return shim.failed = true;
}

int fault(int io_code) { return shim.code == SQLITE_FULL ? SQLITE_FULL : io_code; }

struct File {
  sqlite3_file base;
  sqlite3_file* real;
};
sqlite3_file* real_of(sqlite3_file* f) { return reinterpret_cast<File*>(f)->real; }

int close_file(sqlite3_file* f) {
  sqlite3_file* real = real_of(f);
  const int code = real->pMethods ? real->pMethods->xClose(real) : SQLITE_OK;
  sqlite3_free(real);
  return code;
}
int read_file(sqlite3_file* f, void* to, int n, sqlite3_int64 at) {
  return real_of(f)->pMethods->xRead(real_of(f), to, n, at);
}
int write_file(sqlite3_file* f, const void* from, int n, sqlite3_int64 at) {
  if (!fails()) return real_of(f)->pMethods->xWrite(real_of(f), from, n, at);
  // A full disk takes a part.
  if (n > 1) real_of(f)->pMethods->xWrite(real_of(f), from, n / 2, at);
  return fault(SQLITE_IOERR_WRITE);
}
int truncate_file(sqlite3_file* f, sqlite3_int64 size) {
  return fails() ? SQLITE_IOERR_TRUNCATE : real_of(f)->pMethods->xTruncate(real_of(f), size);
}
int sync_file(sqlite3_file* f, int flags) {
  return fails() ? fault(SQLITE_IOERR_FSYNC) : real_of(f)->pMethods->xSync(real_of(f), flags);
}
int size_file(sqlite3_file* f, sqlite3_int64* n) { return real_of(f)->pMethods->xFileSize(real_of(f), n); }
int lock_file(sqlite3_file* f, int k) { return real_of(f)->pMethods->xLock(real_of(f), k); }
int unlock_file(sqlite3_file* f, int k) { return real_of(f)->pMethods->xUnlock(real_of(f), k); }
int reserved_file(sqlite3_file* f, int* out) { return real_of(f)->pMethods->xCheckReservedLock(real_of(f), out); }
int control_file(sqlite3_file* f, int op, void* arg) { return real_of(f)->pMethods->xFileControl(real_of(f), op, arg); }
int sector_file(sqlite3_file* f) { return real_of(f)->pMethods->xSectorSize(real_of(f)); }
int traits_file(sqlite3_file* f) { return real_of(f)->pMethods->xDeviceCharacteristics(real_of(f)); }
int shm_map(sqlite3_file* f, int region, int size, int extend, void volatile** p) {
  return real_of(f)->pMethods->xShmMap(real_of(f), region, size, extend, p);
}
int shm_lock(sqlite3_file* f, int offset, int n, int flags) {
  return real_of(f)->pMethods->xShmLock(real_of(f), offset, n, flags);
}
void shm_barrier(sqlite3_file* f) { real_of(f)->pMethods->xShmBarrier(real_of(f)); }
int shm_unmap(sqlite3_file* f, int remove) { return real_of(f)->pMethods->xShmUnmap(real_of(f), remove); }

const sqlite3_io_methods kMethods{2,           close_file, read_file,   write_file,    truncate_file, sync_file,
                                  size_file,   lock_file,  unlock_file, reserved_file, control_file,  sector_file,
                                  traits_file, shm_map,    shm_lock,    shm_barrier,   shm_unmap,     nullptr,
                                  nullptr};

int open_file(sqlite3_vfs*, const char* name, sqlite3_file* f, int flags, int* out) {
  f->pMethods = nullptr;
  if ((flags & SQLITE_OPEN_READWRITE) && fails()) return SQLITE_CANTOPEN;
  auto* real = static_cast<sqlite3_file*>(sqlite3_malloc(shim.real->szOsFile));
  if (!real) return SQLITE_NOMEM;
  std::memset(real, 0, static_cast<std::size_t>(shim.real->szOsFile));
  const int code = shim.real->xOpen(shim.real, name, real, flags, out);
  if (code != SQLITE_OK) {
    sqlite3_free(real);
    return code;
  }
  reinterpret_cast<File*>(f)->real = real;
  f->pMethods = &kMethods;
  return SQLITE_OK;
}

int delete_file(sqlite3_vfs*, const char* name, int sync) {
  return fails() ? SQLITE_IOERR_DELETE : shim.real->xDelete(shim.real, name, sync);
}

}  // namespace

FailingVfs::FailingVfs() {
  shim = {};
  shim.real = sqlite3_vfs_find(nullptr);
  shim.vfs = *shim.real;
  shim.vfs.zName = "failing";
  shim.vfs.szOsFile = sizeof(File);
  shim.vfs.xOpen = open_file;
  shim.vfs.xDelete = delete_file;
  sqlite3_vfs_register(&shim.vfs, 1);
}

FailingVfs::~FailingVfs() {
  sqlite3_vfs_unregister(&shim.vfs);
  sqlite3_vfs_register(shim.real, 1);
}

void FailingVfs::fail_at(int operation, Fault fault, bool for_good) {
  shim.operations = 0, shim.fail_at = operation, shim.for_good = for_good, shim.failed = false;
  shim.code = fault == Fault::disk_full ? SQLITE_FULL : SQLITE_IOERR;
}

void FailingVfs::heal() { shim.operations = 0, shim.fail_at = 0, shim.failed = false; }
int FailingVfs::operations() const { return shim.operations; }
bool FailingVfs::failed() const { return shim.failed; }

}  // namespace bosquet::scene
