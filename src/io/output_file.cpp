#include "io/output_file.hpp"

#include <algorithm>
#include <cerrno>
#include <memory>
#include <system_error>

#include "core/call_scope.hpp"
#include "core/error.hpp"
#include "core/host_thread.hpp"
#include "io/gzip.hpp"
#include "io/part_file.hpp"
#include "io/platform.hpp"

namespace jam::inside {

void OutputFile::fail_errno(const char *what) const {
  const int code = errno;
  fail(JAM_E_IO, "cannot %s %s: %s", what, path_.c_str(), std::generic_category().message(code).c_str());
}

OutputFile::OutputFile(const char *path) : path_(path) {
  text_.reserve(platform::chunk + 1024);
  if (path_.size() > 3 && path_.compare(path_.size() - 3, 3, ".gz") == 0) gzip_ = std::make_unique<Packer>(path_);
  const platform::Target target = platform::follow_links(path_);
  target_ = target.file;
  const platform::Kind there = platform::kind_of(path);
  const bool exists = there != platform::Kind::none;
  if (there == platform::Kind::folder) {
    errno = EISDIR;
    fail_errno("write");
  }
  if (target.descriptor >= 0 || target.open || there == platform::Kind::other) {
    while ((fd_ = platform::open_in_place(target, path)) < 0 && (errno == EAGAIN || errno == EINTR)) {
      const bool waits = errno == EAGAIN;  // for a reader of the pipe
      CallScope::look();
      HostThread::take_cancellation();
      if (waits) platform::pause(platform::silence);
    }
    if (fd_ < 0) fail_errno("open");
    return;
  }
  // Renaming would bypass a write protection that the user set.
  if (exists && !platform::may_write(path)) fail_errno("write");
  remove_orphans(target_);
  fd_ = open_part(target_, temporary_);
  if (fd_ < 0) {
    temporary_.clear();
    fail_errno("write");
  }
  if (exists) platform::take_permissions(fd_, path);
}

OutputFile::~OutputFile() {
  if (fd_ >= 0) platform::close(fd_);
  if (!temporary_.empty()) platform::remove(temporary_);
}

// Into a pipe only as much as it takes at once, so that a reader who is slow does not keep the call from looking.
void OutputFile::put(const char *from, size_t left) {
  const bool in_place = temporary_.empty();
  while (left > 0) {
    CallScope::look();
    if (in_place) HostThread::take_cancellation();
    if (in_place && !platform::writable(fd_, platform::silence)) continue;
    const std::ptrdiff_t done = platform::write(fd_, from, in_place ? std::min(left, platform::at_once) : left);
    if (done < 0 && (errno == EINTR || errno == EAGAIN)) continue;
    if (done < 0) fail_errno("write");
    from += done;
    left -= static_cast<size_t>(done);
  }
}

void OutputFile::flush(bool finish) {
  if (gzip_)
    gzip_->pack(text_, finish, [&](const char *from, size_t size) { put(from, size); });
  else
    put(text_.data(), text_.size());
  text_.clear();
}

void OutputFile::flush_if_full() {
  if (text_.size() >= platform::chunk) flush(false);
}

void OutputFile::commit() {
  flush(true);
  // Without fsync a crash of the machine soon after the rename can leave an empty file in place of the old one.
  if (!temporary_.empty() && !platform::sync(fd_)) fail_errno("write");
  // The lock holds until the file has its name. What fsync has taken, close cannot lose.
  if (!temporary_.empty() && !platform::rename_locked(fd_, temporary_, target_)) fail_errno("rename onto");
  const bool renamed = !temporary_.empty();
  temporary_.clear();
  const int fd = fd_;
  fd_ = -1;
  const bool closed = platform::close(fd);
  if (!renamed && !closed) fail_errno("write");
  if (!renamed) return;
  platform::sync_folder_of(target_);
}

}  // namespace jam::inside
