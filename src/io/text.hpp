// Lines and numbers, the same in every locale of the host program.
#pragma once
#include <cstdint>
#include <string_view>

#include "io/input_file.hpp"
#include "jam/jam.h"

namespace jam::inside {

// Reads a file, gzip's or not, line by line in bounded memory; errors are thrown with the path and errno's text. Lines
// end by LF, CRLF or CR. The mark of UTF-8 at the beginning is skipped.
class LineReader {
 public:
  explicit LineReader(const char *path);
  // The first 64 KiB, less of a shorter file: they decide the format. Before the first next().
  std::string_view head() const { return {buffer_.data() + begin_, end_ - begin_}; }
  // The next line without its end in `line`; false at the end of the file. A last line without an end is refused, as
  // the file may be cut inside its last number, unless the caller tests cut_short() itself.
  bool next(std::string_view &line, bool looks = false);
  // As next, skipping blank lines.
  bool next_filled(std::string_view &line, bool looks = false);
  // The line read last has no end, and no checksum says that the file is whole.
  bool cut_short() const { return cut_short_; }
  [[noreturn]] void fail_cut_short() const;
  int64_t number() const { return number_; }  // of the line read last, from 1
  const std::string &path() const { return file_.path(); }
  // Throws with the path and the line read last, if any, before the text.
  [[noreturn]] void fail(jam_status code, const char *format, ...) const __attribute__((format(printf, 3, 4)));

 private:
  bool refill();
  InputFile file_;
  std::vector<char> buffer_;
  size_t begin_ = 0, end_ = 0;
  std::string line_;
  int64_t number_ = 0;
  bool cut_short_ = false, after_return_ = false;
};

// Splits at blanks and tabs.
void split(std::string_view line, std::vector<std::string_view> &words);
// The same for columns, which commas may part instead: "1, 2, 3". Throws JAM_E_FORMAT where commas and blanks both part
// columns, since a comma may then be a decimal point.
void split_columns(const LineReader &in, std::string_view line, std::vector<std::string_view> &words);
// The whole word as a number, with the D of Fortran's exponents too. Errors name the file, the line and the word:
// JAM_E_FORMAT, JAM_E_NONFINITE for nan and inf.
double parse_number(const LineReader &in, std::string_view word);
int64_t parse_count(const LineReader &in, std::string_view word, const char *what);
bool is_count(std::string_view word);   // digits, with a sign or without
bool is_number(std::string_view word);  // as parse_number takes it
bool is_name(std::string_view word);    // a letter comes first, perhaps behind a quote
// In small letters.
std::string lower(std::string_view word);
// A word of a file, cut and cleaned for an error text.
std::string shown(std::string_view word);

// A path for an error text, which has room for 400 bytes: the middle of a long one is left out, so that the reason
// stays.
std::string shown_path(const std::string &path);

// Bytes of the character of UTF-8 at the beginning of text (RFC 3629); 0 where none begins.
size_t character_length(std::string_view text);

// Appends x with 17 significant digits: enough for every double to come back with the same bits.
void append_number(std::string &out, double x);

}  // namespace jam::inside
