#include "io/output_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <cerrno>
#include <cstdlib>
#include <memory>
#include <system_error>
#include <vector>

#include "core/error.hpp"
#include "core/monitor.hpp"

namespace jam {
namespace {

constexpr size_t chunk = 1 << 16;

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

// Makes a rename outlive a crash of the machine. The new file is whole either way, so what fails here is no error.
void sync_folder(const std::string &file) {
  const size_t slash = file.rfind('/');
  const std::string folder = slash == std::string::npos ? "." : file.substr(0, slash + 1);
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
  const long long stamp = static_cast<long long>(now_seconds() * 1e9);
  for (int attempt = 0; attempt < 100 && fd_ < 0; ++attempt) {
    temporary_ = target_ + ".part-" + std::to_string(::getpid()) + "-" + std::to_string(stamp + attempt);
    fd_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
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
  const int fd = fd_;
  fd_ = -1;
  if (::close(fd) != 0) fail_errno("write");
  if (temporary_.empty()) return;
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) fail_errno("rename onto");
  temporary_.clear();
  sync_folder(target_);
}

}  // namespace jam
