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
  const std::string &path() const { return path_; }  // as texts show it
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

// gzip's format, by zlib. A build without zlib (JAM_ZLIB=OFF) has gzip_none.cpp, whose constructors refuse the file.

// Whether this build writes gzip's format.
bool can_pack();

// One member of gzip's format after the other. `path` is for the text of errors and outlives it.
class Unpacker {
 public:
  explicit Unpacker(const std::string &path);
  ~Unpacker();
  Unpacker(const Unpacker &) = delete;
  Unpacker &operator=(const Unpacker &) = delete;
  bool inside() const;  // a member has begun and has not ended
  // Unpacks from [from, from + size) to [to, to + room): what is used of the former, and what is given of the latter.
  struct Done {
    size_t used, given;
  };
  Done unpack(const char *from, size_t size, char *to, size_t room);

 private:
  struct Stream;
  std::unique_ptr<Stream> stream_;
};

// gzip's header has the time 0: the same text gives the same bytes.
class Packer {
 public:
  explicit Packer(const std::string &path);
  ~Packer();
  Packer(const Packer &) = delete;
  Packer &operator=(const Packer &) = delete;
  // Calls put(bytes, their number) with what comes out; `finish`: no more text comes.
  template <class Put>
  void pack(const std::string &text, bool finish, const Put &put) {
    begin(text, finish);
    for (bool more = true; more;) {
      const size_t size = next(more);
      put(reinterpret_cast<const char *>(packed_.data()), size);
    }
  }

 private:
  struct Stream;
  void begin(const std::string &text, bool finish);
  size_t next(bool &more);
  std::unique_ptr<Stream> stream_;
  std::vector<unsigned char> packed_;
};

}  // namespace jam::inside
