#include "io/text.hpp"

#include <zlib.h>

#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdarg>
#include <cstring>
#include <system_error>

#include "core/error.hpp"

namespace jam {
namespace {
constexpr size_t buffer_size = 1 << 16;
constexpr size_t longest_line = 1 << 16;  // a binary file has no line ends and must not be read whole
bool is_blank(char c) { return c == ' ' || c == '\t'; }
}  // namespace

void LineReader::Close::operator()(gzFile_s *f) const { ::gzclose(f); }

LineReader::LineReader(const char *path) : path_(path), buffer_(buffer_size) {
  errno = 0;
  file_.reset(::gzopen(path, "rb"));  // reads what is not compressed as it is
  if (!file_ && errno == 0) throw std::bad_alloc();
  if (!file_) jam::fail(JAM_E_IO, "cannot open %s: %s", path, std::generic_category().message(errno).c_str());
}

void LineReader::fail(jam_status code, const char *format, ...) const {
  char text[300];
  va_list args;
  va_start(args, format);
  std::vsnprintf(text, sizeof text, format, args);
  va_end(args);
  jam::fail(code, "%s line %lld: %s", path_.c_str(), static_cast<long long>(number_), text);
}

bool LineReader::refill() {
  begin_ = end_ = 0;
  const int got = ::gzread(file_.get(), buffer_.data(), static_cast<unsigned>(buffer_.size()));
  if (got > 0) end_ = static_cast<size_t>(got);
  int code = Z_OK;
  const char *text = ::gzerror(file_.get(), &code);
  if (code == Z_ERRNO)
    jam::fail(JAM_E_IO, "cannot read %s: %s", path_.c_str(), std::generic_category().message(errno).c_str());
  if (code == Z_MEM_ERROR) throw std::bad_alloc();
  if (got < 0 || (end_ == 0 && code != Z_OK)) {
    if (code == Z_BUF_ERROR) jam::fail(JAM_E_FORMAT, "%s: the compressed file is cut short", path_.c_str());
    jam::fail(JAM_E_FORMAT, "%s: not a sound gzip file: %s", path_.c_str(), text);
  }
  return end_ > 0;
}

bool LineReader::next(std::string_view &line) {
  line_.clear();
  ++number_;
  for (;;) {
    if (begin_ == end_ && !refill()) {
      if (line_.empty()) return false;
      fail(JAM_E_FORMAT, "the file ends inside a line: it is cut short, or its last newline is missing");
    }
    const char *start = buffer_.data() + begin_;
    const char *stop = static_cast<const char *>(std::memchr(start, '\n', end_ - begin_));
    const size_t length = stop ? static_cast<size_t>(stop - start) : end_ - begin_;
    if (line_.size() + length > longest_line)
      fail(JAM_E_FORMAT, "longer than %zu characters, no packing file", longest_line);
    line_.append(start, length);
    begin_ += length + (stop ? 1 : 0);
    if (stop) break;
  }
  if (!line_.empty() && line_.back() == '\r') line_.pop_back();
  line = line_;
  return true;
}

bool LineReader::next_filled(std::string_view &line) {
  while (next(line))
    for (char c : line)
      if (!is_blank(c)) return true;
  return false;
}

void split(std::string_view line, std::vector<std::string_view> &words) {
  words.clear();
  size_t k = 0;
  while (k < line.size()) {
    while (k < line.size() && is_blank(line[k])) ++k;
    const size_t start = k;
    while (k < line.size() && !is_blank(line[k])) ++k;
    if (k > start) words.push_back(line.substr(start, k - start));
  }
}

std::string shown(std::string_view word) {
  std::string out;
  for (char c : word.substr(0, 40)) out += (c >= ' ' && c <= '~') ? c : '?';
  if (word.size() > 40) out += "...";
  return out;
}

double parse_number(const LineReader &in, std::string_view word) {
  std::string_view digits = word;
  if (digits.size() > 1 && digits[0] == '+' && digits[1] != '-')
    digits.remove_prefix(1);  // from_chars knows no plus sign
  double x = 0.0;
  const auto [end, code] = std::from_chars(digits.data(), digits.data() + digits.size(), x);
  if (code == std::errc::result_out_of_range)
    in.fail(JAM_E_FORMAT, "'%s' is outside the range of a double", shown(word).c_str());
  if (code != std::errc() || end != digits.data() + digits.size())
    in.fail(JAM_E_FORMAT, "'%s' is not a number", shown(word).c_str());
  if (!std::isfinite(x)) in.fail(JAM_E_NONFINITE, "'%s' is not finite", shown(word).c_str());
  return x;
}

int64_t parse_count(const LineReader &in, std::string_view word, const char *what) {
  int64_t x = 0;
  const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), x);
  if (code != std::errc() || end != word.data() + word.size())
    in.fail(JAM_E_FORMAT, "'%s' is not %s", shown(word).c_str(), what);
  return x;
}

void append_number(std::string &out, double x) {
  char digits[40];
  const auto result = std::to_chars(digits, digits + sizeof digits, x, std::chars_format::general, 17);
  out.append(digits, result.ptr);
}

}  // namespace jam
