#include <fcntl.h>
#include <io.h>
#include <windows.h>

#include <algorithm>
#include <cerrno>
#include <climits>

#include "io/platform.hpp"

namespace jam::inside {
namespace platform {
namespace {

std::wstring wide(const std::string &text) {
  const int size = ::MultiByteToWideChar(CP_UTF8, 0, text.data(), static_cast<int>(text.size()), nullptr, 0);
  std::wstring out(static_cast<size_t>(size), L'\0');
  ::MultiByteToWideChar(CP_UTF8, 0, text.data(), static_cast<int>(text.size()), &out[0], size);
  return out;
}

std::string narrow(const std::wstring &text) {
  const int length = static_cast<int>(text.size());
  const int size = ::WideCharToMultiByte(CP_UTF8, 0, text.data(), length, nullptr, 0, nullptr, nullptr);
  std::string out(static_cast<size_t>(size), '\0');
  ::WideCharToMultiByte(CP_UTF8, 0, text.data(), length, &out[0], size, nullptr, nullptr);
  return out;
}

// errno for the last error of the system.
void set_errno() {
  switch (::GetLastError()) {
    case ERROR_FILE_NOT_FOUND:
    case ERROR_PATH_NOT_FOUND:
    case ERROR_INVALID_NAME:
    case ERROR_BAD_PATHNAME:
      errno = ENOENT;
      break;
    case ERROR_FILE_EXISTS:
    case ERROR_ALREADY_EXISTS:
      errno = EEXIST;
      break;
    case ERROR_ACCESS_DENIED:
    case ERROR_SHARING_VIOLATION:
    case ERROR_WRITE_PROTECT:
      errno = EACCES;
      break;
    case ERROR_DISK_FULL:
      errno = ENOSPC;
      break;
    case ERROR_TOO_MANY_OPEN_FILES:
      errno = EMFILE;
      break;
    default:
      errno = EIO;
  }
}

struct Handle {
  HANDLE handle;
  explicit Handle(HANDLE h) : handle(h) {}
  ~Handle() {
    if (there()) ::CloseHandle(handle);
  }
  Handle(const Handle &) = delete;
  Handle &operator=(const Handle &) = delete;
  bool there() const { return handle != INVALID_HANDLE_VALUE; }
};

HANDLE handle_of(int file) { return reinterpret_cast<HANDLE>(::_get_osfhandle(file)); }

// A descriptor of bytes, which closes the handle.
int descriptor_of(HANDLE handle, int flags) {
  if (handle == INVALID_HANDLE_VALUE) {
    set_errno();
    return -1;
  }
  const int file = ::_open_osfhandle(reinterpret_cast<intptr_t>(handle), flags | _O_BINARY | _O_NOINHERIT);
  if (file < 0) ::CloseHandle(handle);
  return file;
}

size_t end_of_folder(const std::string &file) {
  const size_t end = file.find_last_of("/\\:");
  return end == std::string::npos ? 0 : end + 1;
}

}  // namespace

const size_t at_once = 4096;

Kind kind_of(const char *path) {
  const Handle there(::CreateFileW(wide(path).c_str(), 0, FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE,
                                   nullptr, OPEN_EXISTING, FILE_FLAG_BACKUP_SEMANTICS, nullptr));
  BY_HANDLE_FILE_INFORMATION about;
  if (!there.there()) {
    set_errno();
    return errno == EACCES ? Kind::file : Kind::none;  // one that no other process may open is there
  }
  if (::GetFileType(there.handle) != FILE_TYPE_DISK || !::GetFileInformationByHandle(there.handle, &about))
    return Kind::other;
  return about.dwFileAttributes & FILE_ATTRIBUTE_DIRECTORY ? Kind::folder : Kind::file;
}

bool may_write(const char *path) { return ::_waccess(wide(path).c_str(), 2) == 0; }

std::string folder_of(const std::string &file) {
  const size_t end = end_of_folder(file);
  return end == 0 ? "./" : file.substr(0, end);
}

std::string name_of(const std::string &file) { return file.substr(end_of_folder(file)); }

std::vector<std::string> names_in(const std::string &folder) {
  std::vector<std::string> names;
  WIN32_FIND_DATAW entry;
  const HANDLE search = ::FindFirstFileW(wide(folder + "*").c_str(), &entry);
  if (search == INVALID_HANDLE_VALUE) return names;
  do names.push_back(narrow(entry.cFileName));
  while (::FindNextFileW(search, &entry));
  ::FindClose(search);
  return names;
}

Target follow_links(std::string path) {
  Target target;
  target.file = path;
  const Handle there(::CreateFileW(wide(path).c_str(), 0, FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE,
                                   nullptr, OPEN_EXISTING, FILE_FLAG_BACKUP_SEMANTICS, nullptr));
  if (!there.there() || ::GetFileType(there.handle) != FILE_TYPE_DISK) return target;
  wchar_t real[4096];
  const DWORD length = ::GetFinalPathNameByHandleW(there.handle, real, 4096, FILE_NAME_NORMALIZED | VOLUME_NAME_DOS);
  if (length > 0 && length < 4096) target.file = narrow(real);
  return target;
}

int open_input(const char *path) {
  return descriptor_of(
      ::CreateFileW(wide(path).c_str(), GENERIC_READ, FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE, nullptr,
                    OPEN_EXISTING, FILE_ATTRIBUTE_NORMAL, nullptr),
      _O_RDONLY);
}

int open_in_place(const Target &target, const char *path) {
  if (target.descriptor >= 0) return ::_dup(target.descriptor);
  return descriptor_of(::CreateFileW(wide(path).c_str(), FILE_APPEND_DATA, FILE_SHARE_READ | FILE_SHARE_WRITE, nullptr,
                                     OPEN_EXISTING, FILE_ATTRIBUTE_NORMAL, nullptr),
                       _O_WRONLY | _O_APPEND);
}

void pause(int milliseconds) { ::Sleep(static_cast<DWORD>(milliseconds)); }

// A pipe without a writer is at its end, which read() finds.
bool readable(int file, int milliseconds) {
  if (::GetFileType(handle_of(file)) != FILE_TYPE_PIPE) return true;
  for (int waited = 0;; ++waited) {
    DWORD bytes = 0;
    if (!::PeekNamedPipe(handle_of(file), nullptr, 0, nullptr, &bytes, nullptr) || bytes > 0) return true;
    if (waited >= milliseconds) return false;
    ::Sleep(1);
  }
}
bool writable(int, int) { return true; }  // the system does not say how much a pipe takes
std::ptrdiff_t read(int file, char *to, size_t size) {
  return ::_read(file, to, static_cast<unsigned>(std::min<size_t>(size, INT_MAX)));
}
std::ptrdiff_t write(int file, const char *from, size_t size) {
  return ::_write(file, from, static_cast<unsigned>(std::min<size_t>(size, INT_MAX)));
}
bool sync(int file) { return ::_commit(file) == 0; }
bool close(int file) { return ::_close(file) == 0; }

// The lock: no other process may open it to write while it is open here.
int create_locked(const std::string &name) {
  return descriptor_of(::CreateFileW(wide(name).c_str(), GENERIC_WRITE | DELETE, FILE_SHARE_READ | FILE_SHARE_DELETE,
                                     nullptr, CREATE_NEW, FILE_ATTRIBUTE_NORMAL, nullptr),
                       _O_WRONLY);
}

void take_permissions(int, const char *) {}  // a new file has those of its folder

// By its handle, since another writer may take a closed one for an orphan.
bool rename_locked(int file, const std::string &, const std::string &onto) {
  const std::wstring name = wide(onto);
  const size_t bytes = name.size() * sizeof(wchar_t);
  std::vector<char> room(sizeof(FILE_RENAME_INFO) + bytes);
  const auto rename = reinterpret_cast<FILE_RENAME_INFO *>(room.data());
  rename->ReplaceIfExists = TRUE;
  rename->FileNameLength = static_cast<DWORD>(bytes);
  std::copy(name.begin(), name.end(), rename->FileName);
  if (::SetFileInformationByHandle(handle_of(file), FileRenameInfo, rename, static_cast<DWORD>(room.size())))
    return true;
  set_errno();
  return false;
}

void sync_folder_of(const std::string &) {}  // the system keeps a journal of names

void remove(const std::string &name) { ::DeleteFileW(wide(name).c_str()); }

void remove_unlocked(const std::string &name) {
  // Who opens it to write needs the right that its writer does not share.
  const Handle orphan(::CreateFileW(wide(name).c_str(), GENERIC_WRITE | DELETE, FILE_SHARE_READ | FILE_SHARE_DELETE,
                                    nullptr, OPEN_EXISTING, FILE_FLAG_OPEN_REPARSE_POINT, nullptr));
  if (orphan.there()) ::DeleteFileW(wide(name).c_str());
}

long process() { return static_cast<long>(::GetCurrentProcessId()); }

}  // namespace platform
}  // namespace jam::inside
