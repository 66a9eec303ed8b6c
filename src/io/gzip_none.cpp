#include "core/error.hpp"
#include "io/input_file.hpp"

namespace jam::inside {

struct Unpacker::Stream {};
struct Packer::Stream {};

bool can_pack() { return false; }

Unpacker::Unpacker(const std::string &path) {
  fail(JAM_E_UNSUPPORTED, "%s is a gzip file, which this build of libjam cannot unpack: unpack it first", path.c_str());
}
Unpacker::~Unpacker() = default;
bool Unpacker::inside() const { return false; }
Unpacker::Done Unpacker::unpack(const char *, size_t, char *, size_t) { return {}; }

Packer::Packer(const std::string &path) {
  fail(JAM_E_UNSUPPORTED, "this build of libjam cannot write %s: choose a name without .gz", path.c_str());
}
Packer::~Packer() = default;
void Packer::begin(const std::string &, bool) {}
size_t Packer::next(bool &more) {
  more = false;
  return 0;
}

}  // namespace jam::inside
