#include <zlib.h>

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
  int flush = Z_NO_FLUSH;
};

Packer::Packer(const std::string &) : stream_(std::make_unique<Stream>()), packed_(platform::chunk) {
  constexpr int memory_level = 8;
  if (::deflateInit2(&stream_->z, Z_DEFAULT_COMPRESSION, Z_DEFLATED, with_gzip_header, memory_level,
                     Z_DEFAULT_STRATEGY) != Z_OK)
    throw std::bad_alloc();
}
Packer::~Packer() { ::deflateEnd(&stream_->z); }

void Packer::begin(const std::string &text, bool finish) {
  z_stream &s = stream_->z;
  s.next_in = reinterpret_cast<Bytef *>(const_cast<char *>(text.data()));
  s.avail_in = static_cast<uInt>(text.size());
  stream_->flush = finish ? Z_FINISH : Z_NO_FLUSH;
}

size_t Packer::next(bool &more) {
  z_stream &s = stream_->z;
  s.next_out = packed_.data();
  s.avail_out = static_cast<uInt>(packed_.size());
  ::deflate(&s, stream_->flush);
  more = s.avail_out == 0;
  return packed_.size() - s.avail_out;
}

}  // namespace jam::inside
