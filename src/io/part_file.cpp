#include "io/part_file.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "core/monitor.hpp"
#include "core/rng.hpp"

namespace jam {
namespace {

// Names may have 255 bytes, on some file systems 143: the target's own is cut to this many, and as much comes behind.
constexpr size_t longest_begin = 64;
constexpr char part[] = ".part-";
constexpr size_t mark_digits = 16;

std::string name_of(const std::string &file) { return file.substr(file.rfind('/') + 1); }

// The target's name, cut between two characters of UTF-8.
std::string begin_of(const std::string &name) {
  size_t length = name.size();
  if (length > longest_begin)
    for (length = longest_begin; length > 0 && (name[length] & 0xc0) == 0x80;) --length;
  return name.substr(0, length) + part;
}

// Checksum of the whole target name and of who writes when, in hexadecimal digits: no other program makes it.
std::string mark_of(const std::string &name, const std::string &writer) {
  uint64_t sum = 0x6a616d70617274;
  for (const char c : name + part + writer) sum = mix64(sum ^ static_cast<unsigned char>(c));
  char digits[mark_digits + 1];
  std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(sum));
  return digits;
}

// `entry` is BEGIN.part-PROCESS-STAMP-MARK of this target.
bool is_ours(const std::string &entry, const std::string &name) {
  const std::string begin = begin_of(name);
  if (entry.size() <= begin.size() + mark_digits || entry.compare(0, begin.size(), begin) != 0) return false;
  const size_t mark = entry.size() - mark_digits;
  if (entry[mark - 1] != '-') return false;
  return entry.substr(mark) == mark_of(name, entry.substr(begin.size(), mark - 1 - begin.size()));
}

// A new file under a lock, or -1 with errno. EEXIST: another name is to be tried.
int open_locked(const std::string &name) {
  const int fd = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (fd < 0) return fd;
  struct stat there;
  // File systems without locks refuse them otherwise. Before the lock another writer may have taken it for an orphan.
  const bool taken = ::flock(fd, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  if (!taken && ::fstat(fd, &there) == 0 && there.st_nlink > 0) return fd;
  ::close(fd);
  errno = EEXIST;
  return -1;
}

}  // namespace

std::string folder_of(const std::string &file) {
  const size_t slash = file.rfind('/');
  return slash == std::string::npos ? "./" : file.substr(0, slash + 1);
}

int open_part(const std::string &target, std::string &name) {
  const std::string own = name_of(target), beside = target.substr(0, target.size() - own.size()) + begin_of(own);
  const long long stamp = static_cast<long long>(now_seconds() * 1e9);
  int fd = -1;
  for (int attempt = 0; attempt < 100 && fd < 0; ++attempt) {
    const std::string writer = std::to_string(::getpid()) + "-" + std::to_string(stamp + attempt);
    name = beside + writer + "-" + mark_of(own, writer);
    fd = open_locked(name);
    if (fd < 0 && errno != EEXIST) break;
  }
  return fd;
}

// A part that can be locked has no writer: its process was killed. Locks fall with their process, on other machines
// too.
void remove_orphans(const std::string &target) {
  const std::string folder = folder_of(target), own = name_of(target);
  const std::unique_ptr<DIR, int (*)(DIR *)> entries(::opendir(folder.c_str()), ::closedir);
  if (!entries) return;
  while (const dirent *entry = ::readdir(entries.get())) {
    if (!is_ours(entry->d_name, own)) continue;
    const std::string orphan = folder + entry->d_name;
    const int fd = ::open(orphan.c_str(), O_RDWR | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK);
    if (fd < 0) continue;
    struct stat there;
    const bool mine = ::fstat(fd, &there) == 0 && S_ISREG(there.st_mode) && there.st_uid == ::geteuid();
    if (mine && ::flock(fd, LOCK_EX | LOCK_NB) == 0) ::unlink(orphan.c_str());
    ::close(fd);
  }
}

}  // namespace jam
