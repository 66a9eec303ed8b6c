#include "io/output_file.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <system_error>
#include <vector>

#include "core/error.hpp"
#include "core/monitor.hpp"

namespace jam {
namespace {

constexpr size_t chunk = 1 << 16;
constexpr char part[] = ".part-";

// The target of a sequence of symbolic links, which need not exist. Relative links start from their own folder.
std::string follow_links(std::string path) {
  for (int depth = 0; depth < 40; ++depth) {
    char link[4096];
    const ssize_t length = ::readlink(path.c_str(), link, sizeof link);
    if (length <= 0 || static_cast<size_t>(length) >= sizeof link) return path;
    const std::string to(link, static_cast<size_t>(length));
    const size_t slash = path.rfind('/');
    path = (to[0] == '/' || slash == std::string::npos) ? to : path.substr(0, slash + 1) + to;
  }
  return path;
}

std::string folder_of(const std::string &file) {
  const size_t slash = file.rfind('/');
  return slash == std::string::npos ? "./" : file.substr(0, slash + 1);
}

// A temporary file that can be locked has no writer: its process was killed. Locks fall with their process, on other
// machines too. What fails here is no error.
void remove_orphans(const std::string &target) {
  const std::string folder = folder_of(target), begin = target.substr(target.rfind('/') + 1) + part;
  const std::unique_ptr<DIR, int (*)(DIR *)> entries(::opendir(folder.c_str()), ::closedir);
  if (!entries) return;
  while (const dirent *entry = ::readdir(entries.get())) {
    if (std::strncmp(entry->d_name, begin.c_str(), begin.size()) != 0) continue;
    if (std::strspn(entry->d_name + begin.size(), "0123456789-") != std::strlen(entry->d_name + begin.size())) continue;
    const std::string orphan = folder + entry->d_name;
    const int fd = ::open(orphan.c_str(), O_RDWR | O_NOFOLLOW | O_CLOEXEC);
    if (fd < 0) continue;
    if (::flock(fd, LOCK_EX | LOCK_NB) == 0) ::unlink(orphan.c_str());
    ::close(fd);
  }
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

// Makes a rename outlive a crash of the machine. The new file is whole either way, so what fails here is no error.
void sync_folder(const std::string &file) {
  const std::string folder = folder_of(file);
  const int fd = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (fd < 0) return;
  (void)::fsync(fd);
  ::close(fd);
}

}  // namespace

// A stream of zlib with gzip's header, whose time is 0: the same packing gives the same bytes.
struct OutputFile::Gzip {
  Gzip() {
    constexpr int with_gzip_header = 15 + 16, memory_level = 8;
    if (::deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, with_gzip_header, memory_level,
                       Z_DEFAULT_STRATEGY) != Z_OK)
      throw std::bad_alloc();
  }
  ~Gzip() { ::deflateEnd(&stream); }
  Gzip(const Gzip &) = delete;
  Gzip &operator=(const Gzip &) = delete;
  z_stream stream{};
  std::vector<unsigned char> packed = std::vector<unsigned char>(chunk);
  bool finish = false;  // no more text comes
};

void OutputFile::fail_errno(const char *what) const {
  const int code = errno;
  fail(JAM_E_IO, "cannot %s %s: %s", what, path_.c_str(), std::generic_category().message(code).c_str());
}

OutputFile::OutputFile(const char *path) : path_(path), target_(follow_links(path)) {
  text_.reserve(chunk + 1024);
  if (path_.size() > 3 && path_.compare(path_.size() - 3, 3, ".gz") == 0) gzip_ = std::make_unique<Gzip>();
  struct stat there;
  const bool exists = ::stat(path, &there) == 0;
  if (exists && S_ISDIR(there.st_mode)) {
    errno = EISDIR;
    fail_errno("write");
  }
  if (exists && !S_ISREG(there.st_mode)) {
    fd_ = ::open(path, O_WRONLY | O_CLOEXEC);
    if (fd_ < 0) fail_errno("open");
    return;
  }
  // Renaming would bypass a write protection that the user set.
  if (exists && ::access(path, W_OK) != 0) fail_errno("write");
  remove_orphans(target_);
  const long long stamp = static_cast<long long>(now_seconds() * 1e9);
  for (int attempt = 0; attempt < 100 && fd_ < 0; ++attempt) {
    temporary_ = target_ + part + std::to_string(::getpid()) + "-" + std::to_string(stamp + attempt);
    fd_ = open_locked(temporary_);
    if (fd_ < 0 && errno != EEXIST) break;
  }
  if (fd_ < 0) {
    temporary_.clear();
    fail_errno("write");
  }
  if (exists) (void)!::fchmod(fd_, there.st_mode & 07777);  // the new file keeps the old one's permissions
}

OutputFile::~OutputFile() {
  if (fd_ >= 0) ::close(fd_);
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void OutputFile::put(const char *from, size_t left) {
  while (left > 0) {
    const ssize_t done = ::write(fd_, from, left);
    if (done < 0 && errno == EINTR) continue;
    if (done < 0) fail_errno("write");
    from += done;
    left -= static_cast<size_t>(done);
  }
}

void OutputFile::flush() {
  if (!gzip_) {
    put(text_.data(), text_.size());
  } else {
    z_stream &s = gzip_->stream;
    s.next_in = reinterpret_cast<Bytef *>(&text_[0]);
    s.avail_in = static_cast<uInt>(text_.size());
    do {
      s.next_out = gzip_->packed.data();
      s.avail_out = static_cast<uInt>(gzip_->packed.size());
      ::deflate(&s, gzip_->finish ? Z_FINISH : Z_NO_FLUSH);
      put(reinterpret_cast<const char *>(gzip_->packed.data()), gzip_->packed.size() - s.avail_out);
    } while (s.avail_out == 0);
  }
  text_.clear();
}

void OutputFile::flush_if_full() {
  if (text_.size() >= chunk) flush();
}

void OutputFile::commit() {
  if (gzip_) gzip_->finish = true;
  flush();
  // Without fsync a crash of the machine soon after the rename can leave an empty file in place of the old one.
  if (!temporary_.empty() && ::fsync(fd_) != 0) fail_errno("write");
  // The lock holds until the file has its name. What fsync has taken, close cannot lose.
  if (!temporary_.empty() && ::rename(temporary_.c_str(), target_.c_str()) != 0) fail_errno("rename onto");
  const bool renamed = !temporary_.empty();
  temporary_.clear();
  const int fd = fd_;
  fd_ = -1;
  const bool closed = ::close(fd) == 0;
  if (!renamed && !closed) fail_errno("write");
  if (!renamed) return;
  sync_folder(target_);
}

}  // namespace jam
