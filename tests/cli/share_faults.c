/* A stand-in for a share over NFS, loaded before a program (LD_PRELOAD): what lies below $SHARE_FOLDER is reached as over
   a network whose server restarts, whose files other clients replace, and whose disk is full now and then. One call in
   $SHARE_ODDS fails, chosen by $SHARE_SEED and the process. Reads and writes take what they like of what is asked. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { most_files = 4096 };
static char shared[most_files]; /* descriptors of files on the share */

#define REAL(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))

static unsigned chance(void) {
  static unsigned long long state;
  if (state == 0) {
    const char* seed = getenv("SHARE_SEED");
    state = 0x9e3779b97f4a7c15ull * (strtoull(seed ? seed : "1", 0, 10) * 65536 + (unsigned)getpid()) + 1;
  }
  unsigned long long x = __atomic_add_fetch(&state, 0x9e3779b97f4a7c15ull, __ATOMIC_RELAXED);
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return (unsigned)(x >> 33);
}

static int fails(void) {
  const char* odds = getenv("SHARE_ODDS");
  const unsigned one_in = odds ? (unsigned)atoi(odds) : 0;
  return one_in > 0 && chance() % one_in == 0;
}

static int on_share(const char* path) {
  const char* folder = getenv("SHARE_FOLDER");
  char here[4096];
  if (!folder || !path) return 0;
  if (path[0] == '/') return strncmp(path, folder, strlen(folder)) == 0;
  if (!getcwd(here, sizeof here)) return 0;
  const size_t length = strlen(here);
  return strncmp(folder, here, length) == 0 && folder[length] == '/' &&
         strncmp(path, folder + length + 1, strlen(folder) - length - 1) == 0;
}

static int is_shared(int file) { return file >= 0 && file < most_files && shared[file]; }

static int refuse(int reason) {
  errno = reason;
  return -1;
}

static int opened(const char* path, int file) {
  if (file >= 0 && file < most_files) shared[file] = (char)on_share(path);
  return file;
}

int open(const char* path, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = flags & (O_CREAT | O_TMPFILE) ? va_arg(rest, mode_t) : 0;
  va_end(rest);
  if (on_share(path) && fails()) return refuse(chance() % 2 ? ESTALE : EIO);
  return opened(path, REAL(open)(path, flags, mode));
}

int open64(const char* path, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = flags & (O_CREAT | O_TMPFILE) ? va_arg(rest, mode_t) : 0;
  va_end(rest);
  return open(path, flags, mode);
}

int mkstemp(char* path) {
  if (on_share(path) && fails()) return refuse(EIO);
  return opened(path, REAL(mkstemp)(path));
}

ssize_t read(int file, void* to, size_t bytes) {
  if (is_shared(file)) {
    if (fails()) return refuse(ESTALE); /* another client has replaced it */
    if (bytes > 1 && chance() % 3 == 0) bytes = 1 + chance() % bytes;
  }
  return REAL(read)(file, to, bytes);
}

ssize_t write(int file, const void* from, size_t bytes) {
  if (is_shared(file)) {
    if (fails()) return refuse(chance() % 2 ? EDQUOT : EIO);
    if (bytes > 1 && chance() % 3 == 0) bytes = 1 + chance() % bytes;
  }
  return REAL(write)(file, from, bytes);
}

int fsync(int file) { return is_shared(file) && fails() ? refuse(EIO) : REAL(fsync)(file); }

int close(int file) { /* where a server says that what was written did not fit */
  const int late = is_shared(file) && fails();
  if (file >= 0 && file < most_files) shared[file] = 0;
  const int result = REAL(close)(file);
  return late ? refuse(EDQUOT) : result;
}

int rename(const char* from, const char* to) {
  if (!on_share(to) || !fails()) return REAL(rename)(from, to);
  if (chance() % 2) return refuse(EIO);
  REAL(rename)(from, to); /* done, but the answer is lost, and asked again there is nothing to rename */
  return refuse(ENOENT);
}

int unlink(const char* path) { return on_share(path) && fails() ? refuse(EIO) : REAL(unlink)(path); }

int mkdir(const char* path, mode_t mode) { return on_share(path) && fails() ? refuse(ESTALE) : REAL(mkdir)(path, mode); }

int lstat(const char* path, struct stat* status) {
  const int result = REAL(lstat)(path, status);
  if (result == 0 && on_share(path)) status->st_mtime -= (time_t)(chance() % 60); /* as it was up to a minute ago */
  return result;
}
