#include "io/output_file.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <climits>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <system_error>
#include <vector>

#include "core/call_scope.hpp"
#include "core/error.hpp"
#include "io/part_file.hpp"

namespace jam {
namespace {

constexpr size_t chunk = 1 << 16;
constexpr int silence = 50;  // milliseconds that a full pipe may keep the call from looking

// Where a path leads: to a file, which a rename replaces, or to something open that is written in place.
struct Target {
  std::string file;     // behind all links; it need not exist
  int descriptor = -1;  // of this process: /dev/stdout, /dev/fd/N, /proc/self/fd/N
  bool open = false;    // of another process: /proc/PROCESS/fd/N
};

// The folder without links, "" where there is none.
std::string real_folder(const std::string &folder) {
  const std::unique_ptr<char, void (*)(void *)> real(::realpath(folder.c_str(), nullptr), std::free);
  return real ? real.get() : "";
}

bool ends_with(const std::string &text, const char *end) {
  const size_t length = std::strlen(end);
  return text.size() >= length && text.compare(text.size() - length, length, end) == 0;
}

// Follows symbolic links; relative ones start from their own folder. Those of /proc to open files are no names: what
// they name may be a pipe, or a file that the shell appends to.
Target follow_links(std::string path) {
  Target target;
  for (int depth = 0; depth < 40; ++depth) {
    const std::string folder = folder_of(path), name = path.substr(path.rfind('/') + 1);
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

OutputFile::OutputFile(const char *path) : path_(path) {
  text_.reserve(chunk + 1024);
  if (path_.size() > 3 && path_.compare(path_.size() - 3, 3, ".gz") == 0) gzip_ = std::make_unique<Gzip>();
  const Target target = follow_links(path_);
  target_ = target.file;
  struct stat there;
  const bool exists = ::stat(path, &there) == 0;
  if (exists && S_ISDIR(there.st_mode)) {
    errno = EISDIR;
    fail_errno("write");
  }
  if (target.descriptor >= 0 || target.open || (exists && !S_ISREG(there.st_mode))) {
    // A copy of the descriptor goes on where its host stands, and appends where that does.
    fd_ = target.descriptor >= 0 ? ::fcntl(target.descriptor, F_DUPFD_CLOEXEC, 0)
                                 : ::open(path, O_WRONLY | O_APPEND | O_CLOEXEC);
    if (fd_ < 0) fail_errno("open");
    return;
  }
  // Renaming would bypass a write protection that the user set.
  if (exists && ::access(path, W_OK) != 0) fail_errno("write");
  remove_orphans(target_);
  fd_ = open_part(target_, temporary_);
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

// Into a pipe only as much as it takes at once, so that a reader who is slow does not keep the call from looking.
void OutputFile::put(const char *from, size_t left) {
  const bool in_place = temporary_.empty();
  while (left > 0) {
    CallScope::look();
    pollfd ready{fd_, POLLOUT, 0};
    if (in_place && ::poll(&ready, 1, silence) == 0) continue;
    const ssize_t done = ::write(fd_, from, in_place ? std::min<size_t>(left, PIPE_BUF) : left);
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
