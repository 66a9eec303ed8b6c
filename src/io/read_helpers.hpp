// What the readers of all formats share. Errors name the file and the line.
#pragma once
#include <algorithm>
#include <array>
#include <deque>

#include "core/call_scope.hpp"
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
// The cell of a file of LAMMPS, which has three rows also where the spheres lie in a plane.
void take_cell_of_lammps(const LineReader &in, const std::array<double, 9> &cell, FileContent &content);

// Whether all spheres lie in one plane, that of LAMMPS's z = 0, and the box reaches to both sides of it, as LAMMPS has
// d = 2; then their third coordinates go, and the file's dimension is 2. positions: (n, 3), which have the plane at
// `height` to `resolution`.
void take_plane(const std::vector<double> &positions, double low, double high, FileContent &content,
                double height = 0.0, double resolution = 0.0);

FileContent read_plain(LineReader &in, const ReadOptions &options);
FileContent read_table(LineReader &in, const ReadOptions &options);
FileContent read_xyz(LineReader &in, const ReadOptions &options);
FileContent read_lammps(LineReader &in, const ReadOptions &options);
FileContent read_dump(LineReader &in, const ReadOptions &options);
FileContent read_mercury(LineReader &in, const ReadOptions &options);

// The frame that was requested. read_one(content, k) reads frame k, false where the file ends before it.
template <class ReadOne>
FileContent choose_frame(LineReader &in, int64_t frame, ReadOne &&read_one) {
  std::deque<FileContent> kept;  // the last frames, as many as a negative number reaches back
  double bytes = 0.0;            // of their numbers
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
    const auto bytes_of = [](const FileContent &one) {
      return static_cast<double>(sizeof one + sizeof(double) * (one.position.capacity() + one.diameter.capacity()));
    };
    if (kept.size() == most) bytes -= bytes_of(kept.front()), kept.pop_front();
    bytes += bytes_of(content);
    kept.push_back(std::move(content));
    CallScope::need_memory(bytes, ("the frames of " + in.path()).c_str());
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

// Keys on a line of comment, as extended XYZ has them, and what they say of the container.

// The keys of a line; words without = are comments.
class CommentKeys {
 public:
  // key=value, the value in quotes, in brackets, in braces or bare; as for ASE there may be blanks around =, a
  // character after a \ does not close quotes, braces or brackets, and brackets may be nested. The \ stays in the
  // value.
  CommentKeys(const LineReader &in, std::string_view comment) : in_(in) {
    const auto skip_blanks = [&](size_t k) { return std::min(comment.find_first_not_of(" \t", k), comment.size()); };
    for (size_t k = 0; k < comment.size();) {
      const size_t start = k = skip_blanks(k);
      while (k < comment.size() && comment[k] != '=' && comment[k] != ' ' && comment[k] != '\t') ++k;
      const std::string_view name = comment.substr(start, k - start);
      const size_t equals = skip_blanks(k);
      if (equals >= comment.size() || comment[equals] != '=') continue;
      k = skip_blanks(equals + 1);
      const char opens = k < comment.size() ? comment[k] : ' ';
      const bool quoted = opens == '"' || opens == '\'' || opens == '{' || opens == '[';
      if (quoted) ++k;
      size_t stop = quoted ? closing(comment, k, opens) : comment.find_first_of(" \t", k);
      if (stop == std::string_view::npos) {
        if (quoted) in.fail(JAM_E_FORMAT, "the quote after '%s=' is not closed", shown(name).c_str());
        stop = comment.size();
      }
      const std::string_view next = comment.substr(skip_blanks(stop), 1);
      if (!quoted && k > equals + 1 && (next == "=" || comment.substr(k, stop - k).find('=') != comment.npos))
        stop = k = equals + 1;  // another key follows: this one has no value
      keys_.push_back({name, comment.substr(k, stop - k), false});
      k = stop + 1;
    }
  }
  // Once only. From then on the key counts as read.
  bool find(std::string_view name, std::string_view &value) {
    bool found = false;
    for (Key &key : keys_) {
      if (key.name != name) continue;
      if (found) in_.fail(JAM_E_FORMAT, "'%s=' is there twice", shown(name).c_str());
      found = key.read = true;
      value = key.value;
    }
    return found;
  }
  bool has(std::string_view name) const {
    return std::any_of(keys_.begin(), keys_.end(), [&](const Key &key) { return key.name == name; });
  }
  std::vector<std::string> unread() const {
    std::vector<std::string> names;
    for (const Key &key : keys_)
      if (!key.read) names.emplace_back(key.name);
    return names;
  }

 private:
  // Where what was opened before k is closed.
  static size_t closing(std::string_view line, size_t k, char opens) {
    const char closes = opens == '{' ? '}' : opens == '[' ? ']' : opens;
    for (int depth = 1; k < line.size(); ++k) {
      if (line[k] == '\\')
        ++k;
      else if (line[k] == closes && --depth == 0)
        return k;
      else if (line[k] == opens && opens == '[')
        ++depth;
    }
    return std::string_view::npos;
  }
  struct Key {
    std::string_view name, value;
    bool read;
  };
  const LineReader &in_;
  std::vector<Key> keys_;
};

// A list with blanks alone between its words: ASE writes _JSON [false, true], others [1, 0, 0] or 1,0,0.
std::string plain_list(std::string_view value);
// Whether the word of a truth value is T, True or 1.
bool is_true(std::string_view word);
// container=, and walls= with a word for each axis: what container_keys writes; walls= alone are those of a brick. The
// number of these words; 0 without walls=.
size_t read_container(const LineReader &in, CommentKeys &keys, Enclosure &enclosure);

}  // namespace jam::inside
