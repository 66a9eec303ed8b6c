// Files where there is no file system, in WebAssembly: bytes in memory under a name, which the bindings put and take by
// the calls at the end. No other process can open them, so there are no links, pipes, locks or permissions.
#include <algorithm>
#include <cerrno>
#include <cstring>
#include <map>
#include <memory>

#include "core/call_scope.hpp"
#include "io/platform.hpp"
#include "jam/jam.h"

namespace jam::inside {
namespace platform {
namespace {

using Bytes = std::shared_ptr<std::string>;

struct Open {
  Bytes bytes;  // NULL: closed
  size_t at = 0;
};

std::map<std::string, Bytes> &files() {
  static std::map<std::string, Bytes> all;
  return all;
}
std::vector<Open> &opened() {
  static std::vector<Open> all;
  return all;
}

std::string plain(std::string name) {
  while (name.compare(0, 2, "./") == 0) name.erase(0, 2);
  return name;
}

int open(const Bytes &bytes) {
  std::vector<Open> &all = opened();
  const auto free = std::find_if(all.begin(), all.end(), [](const Open &one) { return !one.bytes; });
  const auto place = free == all.end() ? all.emplace(free) : free;
  *place = Open{bytes};
  return static_cast<int>(place - all.begin());
}

}  // namespace

const size_t at_once = chunk;

Kind kind_of(const char *path) {
  const std::string name = plain(path);
  if (files().count(name)) return Kind::file;
  const std::string inside = name.empty() || name.back() == '/' ? name : name + '/';
  const auto first = files().lower_bound(inside);
  const bool folder = inside == name || (first != files().end() && first->first.compare(0, inside.size(), inside) == 0);
  return folder ? Kind::folder : Kind::none;
}

bool may_write(const char *) { return true; }

std::string folder_of(const std::string &file) {
  const size_t slash = file.rfind('/');
  return slash == std::string::npos ? "./" : file.substr(0, slash + 1);
}

std::string name_of(const std::string &file) { return file.substr(file.rfind('/') + 1); }

std::vector<std::string> names_in(const std::string &folder) {
  std::vector<std::string> names;
  const std::string inside = plain(folder);
  for (const auto &file : files())
    if (file.first.compare(0, inside.size(), inside) == 0 && file.first.find('/', inside.size()) == std::string::npos)
      names.push_back(file.first.substr(inside.size()));
  return names;
}

Target follow_links(std::string path) {
  Target target;
  target.file = std::move(path);
  return target;
}

int open_input(const char *path) {
  const auto file = files().find(plain(path));
  if (file != files().end()) return open(file->second);
  errno = kind_of(path) == Kind::folder ? EISDIR : ENOENT;
  return -1;
}

int open_in_place(const Target &, const char *path) { return open_input(path); }
void pause(int) {}
bool readable(int, int) { return true; }
bool writable(int, int) { return true; }

std::ptrdiff_t read(int file, char *to, size_t size) {
  Open &one = opened()[static_cast<size_t>(file)];
  const size_t give = std::min(size, one.bytes->size() - one.at);
  std::memcpy(to, one.bytes->data() + one.at, give);
  one.at += give;
  return static_cast<std::ptrdiff_t>(give);
}

std::ptrdiff_t write(int file, const char *from, size_t size) {
  opened()[static_cast<size_t>(file)].bytes->append(from, size);
  return static_cast<std::ptrdiff_t>(size);
}

bool sync(int) { return true; }

bool close(int file) {
  opened()[static_cast<size_t>(file)].bytes.reset();
  return true;
}

int create_locked(const std::string &name) {
  const auto [file, made] = files().emplace(plain(name), std::make_shared<std::string>());
  if (made) return open(file->second);
  errno = EEXIST;
  return -1;
}

void take_permissions(int, const char *) {}

bool rename_locked(int, const std::string &from, const std::string &onto) {
  const auto file = files().find(plain(from));
  const Bytes bytes = file->second;
  files().erase(file);
  files()[plain(onto)] = bytes;
  return true;
}

void sync_folder_of(const std::string &) {}
void remove(const std::string &name) { files().erase(plain(name)); }
void remove_unlocked(const std::string &name) {
  const auto file = files().find(plain(name));
  if (file != files().end() && file->second.use_count() == 1) files().erase(file);  // it is open nowhere
}
long process() { return 1; }

}  // namespace platform

// The module may grow to 4 GiB, the most that its pointers reach; half of it, as elsewhere.
double default_memory_limit() { return 0.5 * 4294967296.0; }

}  // namespace jam::inside

// Room for a file of so many bytes, which the caller fills; NULL: no memory.
extern "C" JAM_API char *jam_wasm_put(const char *name, size_t size) try {
  auto bytes = std::make_shared<std::string>(size, '\0');
  char *const room = &(*bytes)[0];
  jam::inside::platform::files()[jam::inside::platform::plain(name)] = std::move(bytes);
  return room;
} catch (...) {
  return nullptr;
}
// The bytes of a file and their number, valid until it is written or removed; NULL: there is none.
extern "C" JAM_API const char *jam_wasm_get(const char *name, size_t *size) {
  const auto file = jam::inside::platform::files().find(jam::inside::platform::plain(name));
  if (file == jam::inside::platform::files().end()) return nullptr;
  *size = file->second->size();
  return file->second->data();
}
extern "C" JAM_API void jam_wasm_remove(const char *name) { jam::inside::platform::remove(name); }
