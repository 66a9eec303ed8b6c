// The bytes of a file, compressed or not. While it is read the call can be stopped, also where a pipe is silent.
#pragma once
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace jam::inside {

class Unpacker;

// Errors are thrown with the path and errno's text: JAM_E_IO, and JAM_E_FORMAT for damaged gzip. A signal does not end
// a read.
class InputFile {
 public:
  explicit InputFile(const char *path);
  ~InputFile();
  InputFile(const InputFile &) = delete;
  InputFile &operator=(const InputFile &) = delete;
  const std::string &path() const { return path_; }
  // Up to `size` bytes as they are in the file; 0 at its end.
  size_t read(char *to, size_t size);
  // The same of what is packed where the file is one of gzip's, as its first bytes show. Use one of both.
  size_t read_unpacked(char *to, size_t size);
  bool packed() const { return gzip_ != nullptr; }  // after a first read_unpacked()

 private:
  bool fill();
  size_t unpack(char *to, size_t size);
  [[noreturn]] void fail_errno(const char *what) const;
  std::string path_;
  int fd_ = -1;
  std::vector<char> packed_;  // read, but not given yet: [begin_, end_)
  size_t begin_ = 0, end_ = 0;
  bool begun_ = false;
  std::unique_ptr<Unpacker> gzip_;  // NULL: the text is not packed
};

}  // namespace jam::inside
