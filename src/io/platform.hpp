// What files ask of the system: platform_posix.cpp, platform_windows.cpp. Names of files are UTF-8 everywhere. What
// fails returns false, -1 or Kind::none, with errno.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace jam::inside {
namespace platform {

constexpr size_t chunk = 1 << 16;  // bytes of one read or write
constexpr int silence = 50;        // milliseconds that a pipe may keep a call from looking

enum class Kind { none, file, folder, other };  // other: a pipe, a device
Kind kind_of(const char *path);
bool may_write(const char *path);
// The folder of a file, with its last separator; "./" (or what the system has in its place) for a plain name.
std::string folder_of(const std::string &file);
std::string name_of(const std::string &file);
std::vector<std::string> names_in(const std::string &folder);  // none where the folder cannot be read

// Where a path leads: to a file, which a rename replaces, or to something open that is written in place.
struct Target {
  std::string file;     // behind all links; it need not exist
  int descriptor = -1;  // of this process: /dev/stdout, /dev/fd/N, /proc/self/fd/N
  bool open = false;    // of another process: /proc/PROCESS/fd/N
};
Target follow_links(std::string path);

// Opening a pipe does not wait for its writer: readable() does.
int open_input(const char *path);
// A copy of the target's descriptor, which continues where its host stands, or the path opened to append to it. EAGAIN:
// a pipe without a reader.
int open_in_place(const Target &target, const char *path);
void pause(int milliseconds);
// Within so many milliseconds: a read or write of up to at_once bytes will not wait.
bool readable(int file, int milliseconds);
bool writable(int file, int milliseconds);
extern const size_t at_once;
std::ptrdiff_t read(int file, char *to, size_t size);
// A pipe whose reader has gone away is EPIPE, a limit on the size of files EFBIG, without the signals of both, which
// would end the process of the host.
std::ptrdiff_t write(int file, const char *from, size_t size);
bool sync(int file);  // to the disk
bool close(int file);

// A new file under a lock, which falls with its process. EEXIST: another name is to be tried.
int create_locked(const std::string &name);
// Owner, where the system lets it, and permissions of the file that a new one replaces. Never the bits that lend its
// owner's rights to who runs it: a plain rewrite takes them off too.
void take_permissions(int file, const char *of);
// Renames an open file from create_locked onto another; a crash of the machine soon after keeps one of the two.
bool rename_locked(int file, const std::string &from, const std::string &onto);
void sync_folder_of(const std::string &file);
void remove(const std::string &name);
// Removes a file of this user that no process has locked.
void remove_unlocked(const std::string &name);
long process();

}  // namespace platform
}  // namespace jam::inside
