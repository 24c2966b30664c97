// What a power cut, a full disk and a disk gone read-only look like to a program: a library for LD_PRELOAD, for ./dev torture.
// It counts the calls that change files below SPALL_TORTURE_FOLDER and strikes at one of them:
//   SPALL_TORTURE_CUT=rename:3   SIGKILL in place of the third rename, when the file is written and flushed, not yet in place;
//               =flushed:3       after the third fsync; =open:3 after the third file is opened for writing, empty as it is;
//               =write:3         when half of the third write is done
//   SPALL_TORTURE_FULL=N         after N bytes there is "No space left on device"
//   SPALL_TORTURE_READ_ONLY=N    from the N-th opening on there is "Read-only file system"
//   SPALL_TORTURE_COUNTS=FILE    at the end: renames, fsyncs, openings, writes, bytes, seconds from opening a checkpoint to its
//                                place in the folder, checkpoints
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/types.h>
#include <time.h>
#include <unistd.h>

enum { renames, flushes, openings, writes, kinds, most_files = 4096 };
static const char* const names[kinds] = {"rename", "flushed", "open", "write"};
static atomic_long counts[kinds], bytes, checkpoints;
static _Atomic double checkpoint_seconds, opened_at;
static atomic_bool watched[most_files];

static double now(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static int concerns(const char* path) {
  const char* folder = getenv("SPALL_TORTURE_FOLDER");
  return folder != NULL && path != NULL && strncmp(path, folder, strlen(folder)) == 0;
}

static int is_watched(int file) { return file >= 0 && file < most_files && watched[file]; }

static long number_in(const char* name) {
  const char* text = getenv(name);
  return text == NULL ? -1 : atol(text);
}

// Whether this, the so many-th call of its kind, is the one to strike at.
static int is_the_one(int kind) {
  const long count = atomic_fetch_add(&counts[kind], 1) + 1;
  const char* cut = getenv("SPALL_TORTURE_CUT");
  const size_t length = strlen(names[kind]);
  return cut != NULL && strncmp(cut, names[kind], length) == 0 && cut[length] == ':' && atol(cut + length + 1) == count;
}

static void cut_power(void) {
  for (;;) kill(getpid(), SIGKILL);
}

static int opened(int file, const char* path, int flags) {
  if (file < 0 || file >= most_files) return file;
  watched[file] = (flags & O_ACCMODE) != O_RDONLY && concerns(path);
  if (!watched[file]) return file;
  if (strstr(path, "checkpoint") != NULL) opened_at = now();
  if (is_the_one(openings)) cut_power();
  return file;
}

// Nothing can be made or changed any more.
static int refused(const char* path, int flags) {
  const long from = number_in("SPALL_TORTURE_READ_ONLY");
  if (from < 0 || !concerns(path) || ((flags & O_ACCMODE) == O_RDONLY && (flags & O_CREAT) == 0)) return 0;
  if (counts[openings] + 1 < from) return 0;
  errno = EROFS;
  return 1;
}

#define OPEN(name)                                              \
  int name(const char* path, int flags, ...) {                  \
    static int (*next)(const char*, int, ...);                  \
    if (next == NULL) *(void**)&next = dlsym(RTLD_NEXT, #name); \
    va_list more;                                               \
    va_start(more, flags);                                      \
    const mode_t mode = va_arg(more, mode_t);                   \
    va_end(more);                                               \
    if (refused(path, flags)) return -1;                        \
    return opened(next(path, flags, mode), path, flags);        \
  }
OPEN(open)
OPEN(open64)

int rename(const char* from, const char* to) {
  static int (*next)(const char*, const char*);
  if (next == NULL) *(void**)&next = dlsym(RTLD_NEXT, "rename");
  if (!concerns(to)) return next(from, to);
  if (refused(to, O_WRONLY)) return -1;
  if (is_the_one(renames)) cut_power();
  const int result = next(from, to);
  if (strstr(to, "checkpoint") != NULL) {
    checkpoint_seconds = checkpoint_seconds + (now() - opened_at);
    atomic_fetch_add(&checkpoints, 1);
  }
  return result;
}

int fsync(int file) {
  static int (*next)(int);
  if (next == NULL) *(void**)&next = dlsym(RTLD_NEXT, "fsync");
  const int result = next(file);
  if (is_the_one(flushes)) cut_power();
  return result;
}

// How much of a write happens; -1: none, the disk is full.
static ssize_t allowed(int file, size_t size, int* cut) {
  if (!is_watched(file)) return (ssize_t)size;
  const long room = number_in("SPALL_TORTURE_FULL");
  const long before = atomic_fetch_add(&bytes, (long)size);
  if (room >= 0 && before + (long)size > room) {
    errno = ENOSPC;
    return -1;
  }
  *cut = is_the_one(writes);
  return (ssize_t)(*cut ? size / 2 : size);
}

ssize_t write(int file, const void* data, size_t size) {
  static ssize_t (*next)(int, const void*, size_t);
  if (next == NULL) *(void**)&next = dlsym(RTLD_NEXT, "write");
  int cut = 0;
  const ssize_t part = allowed(file, size, &cut);
  if (part < 0) return -1;
  const ssize_t result = next(file, data, (size_t)part);
  if (cut) cut_power();
  return result;
}

#define PWRITE(name, offset_type)                                             \
  ssize_t name(int file, const void* data, size_t size, offset_type place) {  \
    static ssize_t (*next)(int, const void*, size_t, offset_type);            \
    if (next == NULL) *(void**)&next = dlsym(RTLD_NEXT, #name);               \
    int cut = 0;                                                              \
    const ssize_t part = allowed(file, size, &cut);                           \
    if (part < 0) return -1;                                                  \
    const ssize_t result = next(file, data, (size_t)part, place);             \
    if (cut) cut_power();                                                     \
    return result;                                                            \
  }
PWRITE(pwrite, off_t)
PWRITE(pwrite64, off64_t)

__attribute__((destructor)) static void tell(void) {
  const char* file = getenv("SPALL_TORTURE_COUNTS");
  if (file == NULL) return;
  FILE* out = fopen(file, "w");
  if (out == NULL) return;
  fprintf(out, "%ld %ld %ld %ld %ld %.9g %ld\n", counts[renames], counts[flushes], counts[openings], counts[writes], bytes,
          checkpoint_seconds, checkpoints);
  fclose(out);
}
