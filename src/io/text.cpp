#include "io/text.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdarg>
#include <cstring>
#include <system_error>
#include <utility>

#include "core/call_scope.hpp"
#include "core/decimal.hpp"
#include "core/host_thread.hpp"
#include "io/platform.hpp"

namespace jam::inside {
namespace {

constexpr unsigned char gzip_mark[] = {0x1f, 0x8b};

constexpr size_t buffer_size = 1 << 16;
constexpr size_t longest_line = 1 << 16;  // a binary file has no line ends and must not be read whole
bool is_blank(char c) { return c == ' ' || c == '\t'; }

}  // namespace

LineReader::LineReader(const char *path) : file_(path), buffer_(buffer_size) {
  constexpr std::string_view mark = "\xef\xbb\xbf";
  if (refill() && head().substr(0, mark.size()) == mark) begin_ += mark.size();
}

void LineReader::fail(jam_status code, const char *format, ...) const {
  char text[300];
  va_list args;
  va_start(args, format);
  std::vsnprintf(text, sizeof text, format, args);
  va_end(args);
  if (number_ == 0) jam::inside::fail(code, "%s: %s", path().c_str(), text);
  jam::inside::fail(code, "%s line %lld: %s", path().c_str(), static_cast<long long>(number_), text);
}

bool LineReader::refill() {
  begin_ = end_ = 0;
  for (size_t got = 1; got > 0 && end_ < buffer_.size(); end_ += got)
    got = file_.read_unpacked(buffer_.data() + end_, buffer_.size() - end_);
  return end_ > 0;
}

void LineReader::fail_cut_short() const {
  fail(JAM_E_FORMAT,
       "the file ends inside a line: it is cut short, or its last newline is missing; add it if the line is whole");
}

bool LineReader::next(std::string_view &line, bool looks) {
  line_.clear();
  ++number_;
  for (;;) {
    if (begin_ == end_ && !refill()) {
      if (line_.empty()) return false;
      cut_short_ = !file_.packed();  // gzip's checksum says that nothing is missing
      if (cut_short_ && !looks) fail_cut_short();
      break;
    }
    const char *start = buffer_.data() + begin_;
    if (std::exchange(after_return_, false) && *start == '\n') {
      ++begin_;
      continue;
    }
    const char *stop = static_cast<const char *>(std::memchr(start, '\n', end_ - begin_));
    size_t length = stop ? static_cast<size_t>(stop - start) : end_ - begin_;
    if (const void *const mark = std::memchr(start, '\r', length)) {
      stop = static_cast<const char *>(mark);
      length = static_cast<size_t>(stop - start);
      after_return_ = true;
    }
    if (line_.size() + length > longest_line)
      fail(JAM_E_FORMAT, "longer than %zu characters, no packing file", longest_line);
    line_.append(start, length);
    begin_ += length + (stop ? 1 : 0);
    if (stop) break;
  }
  line = line_;
  return true;
}

bool LineReader::next_filled(std::string_view &line, bool looks) {
  while (next(line, looks))
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

void split_columns(const LineReader &in, std::string_view line, std::vector<std::string_view> &words) {
  split(line, words);
  if (line.find(',') == std::string_view::npos) return;
  std::vector<std::string_view> part, columns;
  for (size_t k = 0; k <= line.size();) {
    const size_t stop = std::min(line.find(',', k), line.size());
    split(line.substr(k, stop - k), part);
    if (part.empty()) in.fail(JAM_E_FORMAT, "column %zu is empty", columns.size() + 1);
    std::string_view whole = line.substr(k, stop - k);
    whole = whole.substr(static_cast<size_t>(part[0].data() - whole.data()));
    whole = whole.substr(0, static_cast<size_t>(part.back().data() + part.back().size() - whole.data()));
    const bool quoted = whole.size() >= 2 && whole.front() == '"' && whole.back() == '"';
    if (part.size() != 1 && !quoted)
      in.fail(JAM_E_FORMAT,
              "'%s' has a comma: write decimal points, and separate columns only by blanks or only by commas",
              shown(*std::find_if(words.begin(), words.end(), [](std::string_view w) {
                return w.find(',') != std::string_view::npos;
              })).c_str());
    columns.push_back(quoted ? whole.substr(1, whole.size() - 2) : whole);
    k = stop + 1;
  }
  words = columns;
}

bool is_count(std::string_view word) {
  if (!word.empty() && (word[0] == '-' || word[0] == '+')) word.remove_prefix(1);
  return !word.empty() && word.find_first_not_of("0123456789") == std::string_view::npos;
}

std::string lower(std::string_view word) {
  std::string out(word);
  for (char &c : out)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return out;
}

std::string shown(std::string_view word) {
  std::string out;
  for (char c : word.substr(0, 40)) out += (c >= ' ' && c <= '~') ? c : '?';
  if (word.size() > 40) out += "...";
  return out;
}

std::string shown_path(const std::string &path) {
  constexpr size_t begin = 40, end = 120;
  if (path.size() <= begin + end) return path;
  size_t cut = begin, behind = path.size() - end;
  while (cut > 0 && (path[cut] & 0xc0) == 0x80) --cut;
  while (behind < path.size() && (path[behind] & 0xc0) == 0x80) ++behind;
  return path.substr(0, cut) + "..." + path.substr(behind);
}

size_t character_length(std::string_view text) {
  const auto byte = [&](size_t k) { return k < text.size() ? static_cast<unsigned char>(text[k]) : 0u; };
  const unsigned first = byte(0);
  if (text.empty() || first < 0x80) return text.empty() ? 0 : 1;
  const size_t length = first >= 0xc2 && first < 0xe0   ? 2
                        : (first & 0xf0u) == 0xe0       ? 3
                        : first >= 0xf0 && first < 0xf5 ? 4
                                                        : 0;
  for (size_t k = 1; k < length; ++k)
    if ((byte(k) & 0xc0u) != 0x80) return 0;
  // Longer forms than needed, halves of UTF-16 and numbers above 0x10ffff
  const unsigned second = byte(1);
  const bool wrong = (first == 0xe0 && second < 0xa0) || (first == 0xed && second > 0x9f) ||
                     (first == 0xf0 && second < 0x90) || (first == 0xf4 && second > 0x8f);
  return wrong ? 0 : length;
}

namespace {
std::errc convert(std::string_view word, double &x) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);  // from_chars knows no plus sign
  char digits[64];
  const size_t mark = word.find_first_of("dD");  // 1.5D-01, as Fortran writes it
  const bool fortran = mark != std::string_view::npos && mark > 0 && word.size() < sizeof digits;
  if (fortran) {
    std::copy(word.begin(), word.end(), digits);
    digits[mark] = 'e';
    word = {digits, word.size()};
  }
  const auto [end, code] = from_decimal(word, x);
  return end == word.data() + word.size() ? code : std::errc::invalid_argument;
}
}  // namespace

bool is_number(std::string_view word) {
  double x = 0.0;
  return convert(word, x) != std::errc::invalid_argument;
}

bool is_name(std::string_view word) {
  if (!word.empty() && (word[0] == '"' || word[0] == '\'')) word.remove_prefix(1);
  const auto first = static_cast<unsigned char>(word.empty() ? '0' : word[0] | 0x20);
  return (first >= 'a' && first <= 'z') || first >= 0x80;
}

double parse_number(const LineReader &in, std::string_view word) {
  double x = 0.0;
  const std::errc code = convert(word, x);
  if (code == std::errc::result_out_of_range)
    in.fail(JAM_E_FORMAT, "'%s' is outside the range of a double", shown(word).c_str());
  if (code != std::errc()) in.fail(JAM_E_FORMAT, "'%s' is not a number", shown(word).c_str());
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
  char digits[32];
  out.append(digits, to_decimal(digits, x));
}

void InputFile::fail_errno(const char *what) const {
  const int code = errno;
  fail(JAM_E_IO, "cannot %s %s: %s", what, path_.c_str(), std::generic_category().message(code).c_str());
}

// Opening a pipe would wait for its writer, deaf to all: so it is opened at once, and read() waits.
InputFile::InputFile(const char *path) : path_(shown_path(path)) {
  if ((fd_ = platform::open_input(path)) < 0) fail_errno("open");
}

InputFile::~InputFile() {
  if (fd_ >= 0) platform::close(fd_);
}

size_t InputFile::read(char *to, size_t size) {
  for (;;) {
    CallScope::look();
    HostThread::take_cancellation();
    if (!platform::readable(fd_, platform::silence)) continue;
    const std::ptrdiff_t got = platform::read(fd_, to, std::min(size, platform::chunk));
    if (got >= 0) return static_cast<size_t>(got);
    if (errno != EINTR && errno != EAGAIN) fail_errno("read");
  }
}

bool InputFile::fill() {
  if (begin_ < end_) return true;
  packed_.resize(platform::chunk);
  begin_ = 0;
  end_ = read(packed_.data(), packed_.size());
  return end_ > 0;
}

size_t InputFile::read_unpacked(char *to, size_t size) {
  if (!begun_) {
    begun_ = true;
    while (end_ < sizeof gzip_mark) {  // a pipe may give one byte at a time
      packed_.resize(platform::chunk);
      const size_t got = read(packed_.data() + end_, packed_.size() - end_);
      if (got == 0) break;
      end_ += got;
    }
    if (end_ >= sizeof gzip_mark && std::memcmp(packed_.data(), gzip_mark, sizeof gzip_mark) == 0)
      gzip_ = std::make_unique<Unpacker>(path_);
  }
  if (gzip_) return unpack(to, size);
  if (begin_ == end_) return read(to, size);
  const size_t give = std::min(size, end_ - begin_);
  std::memcpy(to, packed_.data() + begin_, give);
  begin_ += give;
  return give;
}

size_t InputFile::unpack(char *to, size_t size) {
  size_t given = 0;
  while (given == 0) {
    if (!fill()) {
      if (gzip_->inside()) fail(JAM_E_FORMAT, "%s: the compressed file is cut short", path_.c_str());
      return 0;
    }
    const Unpacker::Done done =
        gzip_->unpack(packed_.data() + begin_, end_ - begin_, to, std::min(size, platform::chunk));
    begin_ += done.used;
    given = done.given;
    CallScope::look();
  }
  return given;
}

}  // namespace jam::inside
