// A file that appears whole or not at all.
#pragma once
#include <memory>
#include <string>

namespace jam::inside {

class Packer;

// Text goes to a new file beside the target, which commit() renames onto it. Without commit nothing changes.
// A symbolic link keeps pointing where it points. What is no regular file under a name of its own is written in place:
// a pipe, a device, and descriptors (/dev/stdout, /dev/fd/N), whatever is open there. Under a name that ends in .gz the
// text is compressed. Every failure throws JAM_E_IO with the path and errno's text. The call may be left by Cancelled.
// New files that killed writers of the same target have left are removed first.
class OutputFile {
 public:
  explicit OutputFile(const char *path);
  ~OutputFile();
  OutputFile(const OutputFile &) = delete;
  OutputFile &operator=(const OutputFile &) = delete;
  std::string &text() { return text_; }  // append here, then call flush_if_full now and then
  void flush_if_full();
  void commit();

 private:
  void flush(bool finish);
  void put(const char *from, size_t left);
  [[noreturn]] void fail_errno(const char *what) const;
  std::string path_, target_, temporary_;  // path_: as texts show it
  std::string text_;
  std::unique_ptr<Packer> gzip_;  // NULL: the text is written as it is
  int fd_ = -1;
  bool begun_ = false;  // bytes were written
};

// Files that are being written, beside their target under a name of their own.

// Makes a new file beside `target` under a lock, and returns its descriptor: -1 with errno where that fails.
int open_part(const std::string &target, std::string &name);
// Removes what killed writers of this target have left. A file is one of theirs when its name holds the checksum that
// only libjam puts there, this user owns it, and no process has its lock. What fails here is no error.
void remove_orphans(const std::string &target);

}  // namespace jam::inside
