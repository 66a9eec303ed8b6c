#include "io/part_file.hpp"

#include <cerrno>
#include <cstdio>

#include "core/monitor.hpp"
#include "core/rng.hpp"
#include "io/platform.hpp"

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
