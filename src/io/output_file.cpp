#include "io/output_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <system_error>

#include "core/call_scope.hpp"
#include "core/host_thread.hpp"
#include "core/rng.hpp"
#include "io/input_file.hpp"
#include "io/platform.hpp"
#include "io/text.hpp"

namespace jam::inside {
namespace {

// Names may have 255 bytes, on some file systems 143: the target's own is cut to this many, and as much comes behind.
constexpr size_t longest_begin = 64;
constexpr char part[] = ".part-";
constexpr size_t mark_digits = 16;

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

}  // namespace

void OutputFile::fail_errno(const char *what) const {
  const int code = errno;
  fail(JAM_E_IO, "cannot %s %s: %s", what, path_.c_str(), std::generic_category().message(code).c_str());
}

OutputFile::OutputFile(const char *path) : path_(shown_path(path)) {
  text_.reserve(platform::chunk + 1024);
  if (path_.size() > 3 && path_.compare(path_.size() - 3, 3, ".gz") == 0) gzip_ = std::make_unique<Packer>(path_);
  const platform::Target target = platform::follow_links(path);
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
  if (fd_ >= 0 && temporary_.empty() && begun_) CallScope::note_part_written();
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
    begun_ = begun_ || done > 0;
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

int open_part(const std::string &target, std::string &name) {
  const std::string own = platform::name_of(target),
                    beside = target.substr(0, target.size() - own.size()) + begin_of(own);
  const long long stamp = static_cast<long long>(now_seconds() * 1e9);
  int fd = -1;
  for (int attempt = 0; attempt < 100 && fd < 0; ++attempt) {
    const std::string writer = std::to_string(platform::process()) + "-" + std::to_string(stamp + attempt);
    name = beside + writer + "-" + mark_of(own, writer);
    fd = platform::create_locked(name);
    if (fd < 0 && errno != EEXIST) break;
  }
  return fd;
}

// A part that can be locked has no writer: its process was killed. Locks fall with their process, on other machines
// too.
void remove_orphans(const std::string &target) {
  const std::string folder = platform::folder_of(target), own = platform::name_of(target);
  for (const std::string &name : platform::names_in(folder))
    if (is_ours(name, own)) platform::remove_unlocked(folder + name);
}

}  // namespace jam::inside
