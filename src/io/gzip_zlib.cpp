#include <zlib.h>

#include <algorithm>
#include <limits>
#include <new>

#include "core/error.hpp"
#include "io/input_file.hpp"
#include "io/platform.hpp"

namespace jam::inside {
namespace {

constexpr int with_gzip_header = 15 + 16;

}  // namespace

struct Unpacker::Stream {
  explicit Stream(const std::string &of) : path(of) {}
  const std::string &path;
  z_stream z{};
  bool inside = true;
};

bool can_pack() { return true; }

Unpacker::Unpacker(const std::string &path) : stream_(std::make_unique<Stream>(path)) {
  if (::inflateInit2(&stream_->z, with_gzip_header) != Z_OK) throw std::bad_alloc();
}
Unpacker::~Unpacker() { ::inflateEnd(&stream_->z); }
bool Unpacker::inside() const { return stream_->inside; }

Unpacker::Done Unpacker::unpack(const char *from, size_t size, char *to, size_t room) {
  z_stream &s = stream_->z;
  if (!stream_->inside) {  // another member follows
    ::inflateReset(&s);
    stream_->inside = true;
  }
  s.next_in = reinterpret_cast<Bytef *>(const_cast<char *>(from));
  s.avail_in = static_cast<uInt>(size);
  s.next_out = reinterpret_cast<Bytef *>(to);
  s.avail_out = static_cast<uInt>(room);
  const int code = ::inflate(&s, Z_NO_FLUSH);
  if (code == Z_MEM_ERROR) throw std::bad_alloc();
  if (code == Z_STREAM_END) stream_->inside = false;
  if (code != Z_OK && code != Z_STREAM_END && code != Z_BUF_ERROR)
    fail(JAM_E_FORMAT, "%s: not a valid gzip file: %s", stream_->path.c_str(), s.msg ? s.msg : "damaged");
  return {size - s.avail_in, room - s.avail_out};
}

struct Packer::Stream {
  z_stream z{};
  const char *rest = nullptr;  // text that zlib has not been given yet: it counts in 32 bits
  size_t left = 0;
  bool finish = false;
};

Packer::Packer(const std::string &) : stream_(std::make_unique<Stream>()), packed_(platform::chunk) {
  constexpr int memory_level = 8;
  if (::deflateInit2(&stream_->z, Z_DEFAULT_COMPRESSION, Z_DEFLATED, with_gzip_header, memory_level,
                     Z_DEFAULT_STRATEGY) != Z_OK)
    throw std::bad_alloc();
}
Packer::~Packer() { ::deflateEnd(&stream_->z); }

void Packer::begin(const std::string &text, bool finish) {
  stream_->rest = text.data();
  stream_->left = text.size();
  stream_->finish = finish;
}

size_t Packer::next(bool &more) {
  z_stream &s = stream_->z;
  if (s.avail_in == 0) {
    s.next_in = reinterpret_cast<Bytef *>(const_cast<char *>(stream_->rest));
    s.avail_in = static_cast<uInt>(std::min<size_t>(stream_->left, std::numeric_limits<uInt>::max()));
    stream_->rest += s.avail_in;
    stream_->left -= s.avail_in;
  }
  s.next_out = packed_.data();
  s.avail_out = static_cast<uInt>(packed_.size());
  ::deflate(&s, stream_->finish && stream_->left == 0 ? Z_FINISH : Z_NO_FLUSH);
  more = s.avail_out == 0 || stream_->left > 0;
  return packed_.size() - s.avail_out;
}

}  // namespace jam::inside
