#include "io/input_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>

#include "core/call_scope.hpp"
#include "core/host_thread.hpp"
#include "io/platform.hpp"

namespace jam::inside {
namespace {

constexpr unsigned char gzip_mark[] = {0x1f, 0x8b};

}  // namespace

void InputFile::fail_errno(const char *what) const {
  const int code = errno;
  fail(JAM_E_IO, "cannot %s %s: %s", what, path_.c_str(), std::generic_category().message(code).c_str());
}

// Opening a pipe would wait for its writer, deaf to all: so it is opened at once, and read() waits.
InputFile::InputFile(const char *path) : path_(path) {
  if ((fd_ = platform::open_input(path)) < 0) fail_errno("open");
}

InputFile::~InputFile() {
  if (fd_ >= 0) platform::close(fd_);
}

size_t InputFile::read(char *to, size_t size) {
  for (;;) {
    CallScope::look();
    HostThread::take_cancellation();
    if (!platform::readable(fd_, platform::silence)) continue;
    const std::ptrdiff_t got = platform::read(fd_, to, std::min(size, platform::chunk));
    if (got >= 0) return static_cast<size_t>(got);
    if (errno != EINTR && errno != EAGAIN) fail_errno("read");
  }
}

bool InputFile::fill() {
  if (begin_ < end_) return true;
  packed_.resize(platform::chunk);
  begin_ = 0;
  end_ = read(packed_.data(), packed_.size());
  return end_ > 0;
}

size_t InputFile::read_unpacked(char *to, size_t size) {
  if (!begun_) {
    begun_ = true;
    while (end_ < sizeof gzip_mark) {  // a pipe may give one byte at a time
      packed_.resize(platform::chunk);
      const size_t got = read(packed_.data() + end_, packed_.size() - end_);
      if (got == 0) break;
      end_ += got;
    }
    if (end_ >= sizeof gzip_mark && std::memcmp(packed_.data(), gzip_mark, sizeof gzip_mark) == 0)
      gzip_ = std::make_unique<Unpacker>(path_);
  }
  if (gzip_) return unpack(to, size);
  if (begin_ == end_) return read(to, size);
  const size_t give = std::min(size, end_ - begin_);
  std::memcpy(to, packed_.data() + begin_, give);
  begin_ += give;
  return give;
}

size_t InputFile::unpack(char *to, size_t size) {
  size_t given = 0;
  while (given == 0) {
    if (!fill()) {
      if (gzip_->inside()) fail(JAM_E_FORMAT, "%s: the compressed file is cut short", path_.c_str());
      return 0;
    }
    const Unpacker::Done done =
        gzip_->unpack(packed_.data() + begin_, end_ - begin_, to, std::min(size, platform::chunk));
    begin_ += done.used;
    given = done.given;
    CallScope::look();
  }
  return given;
}

}  // namespace jam::inside
