// What the readers of all formats share. Errors name the file and the line.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "core/limits.hpp"
#include "io/files.hpp"
#include "io/text.hpp"

namespace jam::inside {

// Runs a check of core/limits.hpp; its error gets the path and the line in front.
template <class Check>
void at_line(const LineReader &in, Check &&check) {
  try {
    check();
  } catch (const Error &e) {
    in.fail(e.code(), "%s", e.what());
  }
}

inline int take_dim(const LineReader &in, int64_t dim) {
  at_line(in, [&] { check_dim(dim); });
  return static_cast<int>(dim);
}

inline int64_t take_count(const LineReader &in, int64_t n) {
  at_line(in, [&] { check_n(n); });
  return n;
}

// Of a frame among others: a run that pours grains begins with none, and choose_frame() skips or names such frames.
inline int64_t take_count_of_frame(const LineReader &in, int64_t n) { return n == 0 ? 0 : take_count(in, n); }

inline double positive(const LineReader &in, std::string_view word, const char *what) {
  const double x = parse_number(in, word);
  if (!(x > 0.0)) in.fail(JAM_E_ARGUMENT, "the %s is %g, it must be positive", what, x);
  return x;
}

inline double take_box(const LineReader &in, std::string_view word) {
  const double side = positive(in, word, "box side");
  at_line(in, [&] { check_box(side); });
  return side;
}

[[noreturn]] inline void ends_early(const LineReader &in, int64_t found, int64_t n) {
  in.fail(JAM_E_FORMAT, "the file ends after %lld of %lld spheres", static_cast<long long>(found),
          static_cast<long long>(n));
}

// What stands before a `#`.
inline std::string_view before_comment(std::string_view line) { return line.substr(0, line.find('#')); }

// The next line that says something besides a comment, split; false at the end of the file.
bool next_text(LineReader &in, std::string_view &line, std::vector<std::string_view> &words);

// Nothing may follow the n spheres that a header announced.
void check_end(LineReader &in, int64_t n);

// The rows of spheres. The last one may lack its newline: its last word then has as many characters behind its point as
// the longest one of that column, or a blank behind it, so that no digit is lost.
class Rows {
 public:
  Rows(LineReader &in, bool comments) : in_(in), comments_(comments) {}
  // The columns of the next row; false at the end of the file. JAM_E_MEMORY where what the rows hold exceeds the memory
  // of the call: the count in a header may lie.
  bool next(std::vector<std::string_view> &words);

 private:
  void check_last(const std::vector<std::string_view> &words, bool blank_behind);
  LineReader &in_;
  bool comments_;
  int64_t count_ = 0;
  size_t longest_ = 0;
  bool first_ = true;
};

// Which columns hold what. Sizes are called radius or diameter, in small or large letters.
class SizeColumn {
 public:
  // Whether a column of this name holds sizes; JAM_E_FORMAT where two do.
  bool take(const LineReader &in, std::string_view name, size_t column);
  bool found() const { return found_; }
  double diameter(const LineReader &in, const std::vector<std::string_view> &words) const;

 private:
  bool found_ = false, radius_ = false;
  size_t column_ = 0;
};

// Says which `parts` (columns, keys) were not read, once for a file.
void say_unread(FileContent &content, const std::vector<std::string> &names, const char *parts = "columns");

// Moves the positions so that the corner of the cell, at `corner` (d numbers or more) in the file, is at 0, and says
// so.
void measure_from_corner(const double *corner, FileContent &content);

// The names of columns on a line, parted by commas where there is one, else by blanks; quotes stay.
std::vector<std::string> column_names(std::string_view line, char comma = ',');

// Whether a first line names coordinates of a table.
bool names_coordinates(std::string_view line);

// A first line without any number. A row may begin with a word, as the name of its sphere.
bool is_heading(std::string_view line);

// Whether a coordinate lies in the box [0, 1], or file or caller say which box it is in: it would be wrapped.
bool is_inside(double x, const ReadOptions &options);
[[noreturn]] void refuse_outside(const LineReader &in, int64_t line, double x);

// Gives a file the cell and the origin that the caller names.
void take_layout(const char *path, const ReadOptions &options, FileContent &content);

// The d rows of cell vectors, of any form: a cube along the axes becomes content.box, other cells are checked.
void take_cell(const LineReader &in, std::vector<double> rows, FileContent &content);
void take_rows(std::vector<double> rows, FileContent &content);  // the same, errors without a line

// Whether all spheres lie in the plane z = 0 and the box reaches to both sides of it, as LAMMPS has d = 2; then their
// third coordinates go, and the file's dimension is 2. positions: (n, 3).
void take_plane(const std::vector<double> &positions, double low, double high, FileContent &content);

FileContent read_plain(LineReader &in, const ReadOptions &options);
FileContent read_table(LineReader &in, const ReadOptions &options);
FileContent read_xyz(LineReader &in, const ReadOptions &options);
FileContent read_lammps(LineReader &in, const ReadOptions &options);
FileContent read_dump(LineReader &in, const ReadOptions &options);
FileContent read_mercury(LineReader &in, const ReadOptions &options);

// The frame that was requested. read_one(content, k) reads frame k, false where the file ends before it.
template <class ReadOne>
FileContent choose_frame(LineReader &in, int64_t frame, ReadOne &&read_one) {
  std::vector<FileContent> kept;  // the last frames, as many as a negative number reaches back
  int64_t count = 0;
  std::string hint;  // which frame could be read instead
  const size_t most = frame < 0 ? static_cast<size_t>(-(frame + 1)) + 1 : 1;
  for (;; ++count) {
    FileContent content;
    try {
      if (!read_one(content, count)) break;
    } catch (const Error &e) {
      if (hint.empty()) throw;
      jam::inside::fail(e.code(), "%s%s", e.what(), hint.c_str());
    }
    if (!content.diameter.empty()) hint = "; frame=" + std::to_string(count) + " can be read";
    if (kept.size() == most) kept.erase(kept.begin());
    kept.push_back(std::move(content));
    if (count == frame) {
      ++count;
      break;
    }
  }
  if ((frame >= 0 && count != frame + 1) || kept.size() < most)
    jam::inside::fail(JAM_E_ARGUMENT, "%s: frame is %lld, the file has %lld (0 to %lld, or -1 for the last)",
                      in.path().c_str(), static_cast<long long>(frame), static_cast<long long>(count),
                      static_cast<long long>(count - 1));
  FileContent &chosen = kept.front();
  if (chosen.diameter.empty())
    jam::inside::fail(JAM_E_FORMAT, "%s: frame %lld has no sphere%s", in.path().c_str(),
                      static_cast<long long>(frame < 0 ? count + frame : frame), hint.c_str());
  if (count > 1 && frame == -1)
    chosen.notes.say("the last of %lld frames was read; frame=0 to %lld read others", static_cast<long long>(count),
                     static_cast<long long>(count - 1));
  return std::move(chosen);
}

}  // namespace jam::inside
