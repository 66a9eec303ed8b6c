#include <dirent.h>
#include <fcntl.h>
#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>

#include "io/platform.hpp"

namespace jam::inside {
namespace platform {
namespace {

// The folder without links, "" where there is none.
std::string real_folder(const std::string &folder) {
  const std::unique_ptr<char, void (*)(void *)> real(::realpath(folder.c_str(), nullptr), std::free);
  return real ? real.get() : "";
}

bool ends_with(const std::string &text, const char *end) {
  const size_t length = std::strlen(end);
  return text.size() >= length && text.compare(text.size() - length, length, end) == 0;
}

bool wait_for(int file, short event, int milliseconds) {
  pollfd ready{file, event, 0};
  const int waited = ::poll(&ready, 1, milliseconds);
  return waited > 0 || (waited < 0 && errno != EINTR);  // what is wrong shows when it is read or written
}

}  // namespace

const size_t at_once = PIPE_BUF;

Kind kind_of(const char *path) {
  struct stat there;
  if (::stat(path, &there) != 0) return Kind::none;
  return S_ISDIR(there.st_mode) ? Kind::folder : S_ISREG(there.st_mode) ? Kind::file : Kind::other;
}

bool may_write(const char *path) { return ::access(path, W_OK) == 0; }

std::string folder_of(const std::string &file) {
  const size_t slash = file.rfind('/');
  return slash == std::string::npos ? "./" : file.substr(0, slash + 1);
}

std::string name_of(const std::string &file) { return file.substr(file.rfind('/') + 1); }

std::vector<std::string> names_in(const std::string &folder) {
  std::vector<std::string> names;
  const std::unique_ptr<DIR, int (*)(DIR *)> entries(::opendir(folder.c_str()), ::closedir);
  if (!entries) return names;
  while (const dirent *entry = ::readdir(entries.get())) names.emplace_back(entry->d_name);
  return names;
}

// Relative links start from their own folder. Those of /proc to open files are no names: what they name may be a pipe,
// or a file that the shell appends to.
Target follow_links(std::string path) {
  Target target;
  for (int depth = 0; depth < 40; ++depth) {
    const std::string folder = folder_of(path), name = name_of(path);
    const bool number = !name.empty() && name.size() < 10 && name.find_first_not_of("0123456789") == std::string::npos;
    if (number) {
      const std::string real = real_folder(folder);
      if (real.compare(0, 6, "/proc/") == 0 && ends_with(real, "/fd")) {
        const bool own = real == real_folder("/proc/self/fd") || real == real_folder("/proc/thread-self/fd");
        if (own) target.descriptor = std::stoi(name);
        target.open = !own;
        break;
      }
    }
    char link[4096];
    const ssize_t length = ::readlink(path.c_str(), link, sizeof link);
    if (length <= 0 || static_cast<size_t>(length) >= sizeof link) break;
    const std::string to(link, static_cast<size_t>(length));
    path = to[0] == '/' ? to : path.substr(0, path.size() - name.size()) + to;
  }
  target.file = path;
  return target;
}

int open_input(const char *path) {
  int file;
  do file = ::open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  while (file < 0 && errno == EINTR);
  return file;
}

int open_in_place(const Target &target, const char *path) {
  if (target.descriptor >= 0) return ::fcntl(target.descriptor, F_DUPFD_CLOEXEC, 0);
  struct stat there;
  const bool pipe = ::stat(path, &there) == 0 && S_ISFIFO(there.st_mode);
  const int file = ::open(path, O_WRONLY | O_APPEND | O_CLOEXEC | (pipe ? O_NONBLOCK : 0));
  if (file < 0 && pipe && errno == ENXIO) errno = EAGAIN;
  return file;
}

void pause(int milliseconds) { (void)::poll(nullptr, 0, milliseconds); }

bool readable(int file, int milliseconds) { return wait_for(file, POLLIN, milliseconds); }
bool writable(int file, int milliseconds) { return wait_for(file, POLLOUT, milliseconds); }
std::ptrdiff_t read(int file, char *to, size_t size) { return ::read(file, to, size); }

// Both signals are ones of the thread that writes: they are blocked there, and taken back where the write raised one.
std::ptrdiff_t write(int file, const char *from, size_t size) {
  sigset_t own, before, waiting, raised;
  sigemptyset(&own);
  sigaddset(&own, SIGPIPE);
  sigaddset(&own, SIGXFSZ);
  pthread_sigmask(SIG_BLOCK, &own, &before);
  sigpending(&waiting);
  const std::ptrdiff_t done = ::write(file, from, size);
  const int error = errno;
  if (done < 0 && (error == EPIPE || error == EFBIG)) {
    const int number = error == EPIPE ? SIGPIPE : SIGXFSZ;
    sigpending(&raised);
    if (sigismember(&raised, number) == 1 && sigismember(&waiting, number) == 0) {
      int taken = 0;
      sigemptyset(&own);
      sigaddset(&own, number);
      sigwait(&own, &taken);
    }
  }
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  errno = error;
  return done;
}
bool sync(int file) { return ::fsync(file) == 0; }
bool close(int file) { return ::close(file) == 0; }

int create_locked(const std::string &name) {
  const int file = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (file < 0) return file;
  struct stat there;
  // File systems without locks refuse them otherwise. Before the lock another writer may have taken it for an orphan.
  const bool taken = ::flock(file, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  if (!taken && ::fstat(file, &there) == 0 && there.st_nlink > 0) return file;
  ::close(file);
  errno = EEXIST;
  return -1;
}

void take_permissions(int file, const char *of) {
  struct stat there, now;
  if (::stat(of, &there) != 0 || ::fstat(file, &now) != 0) return;
  mode_t mode = there.st_mode & 0777;
  if (there.st_uid != now.st_uid) (void)!::fchown(file, there.st_uid, static_cast<gid_t>(-1));
  // Rights of a group that the file cannot be given are no rights of another group.
  if (there.st_gid != now.st_gid && ::fchown(file, static_cast<uid_t>(-1), there.st_gid) != 0)
    mode = (mode & ~mode_t{070}) | (mode & 07) << 3;
  (void)!::fchmod(file, mode);
}

bool rename_locked(int, const std::string &from, const std::string &onto) {
  return ::rename(from.c_str(), onto.c_str()) == 0;
}

void sync_folder_of(const std::string &file) {
  const int folder = ::open(folder_of(file).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder < 0) return;
  (void)::fsync(folder);
  ::close(folder);
}

void remove(const std::string &name) { ::unlink(name.c_str()); }

void remove_unlocked(const std::string &name) {
  const int file = ::open(name.c_str(), O_RDWR | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK);
  if (file < 0) return;
  struct stat there;
  const bool mine = ::fstat(file, &there) == 0 && S_ISREG(there.st_mode) && there.st_uid == ::geteuid();
  if (mine && ::flock(file, LOCK_EX | LOCK_NB) == 0) ::unlink(name.c_str());
  ::close(file);
}

long process() { return ::getpid(); }

}  // namespace platform
}  // namespace jam::inside
