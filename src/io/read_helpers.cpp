#include "io/read_helpers.hpp"

#include <cmath>

#include "core/cell_reduction.hpp"

namespace jam::inside {
namespace {

// Characters behind the decimal point, those of an exponent too.
size_t behind_point(std::string_view word) {
  const size_t point = word.find('.');
  return point == std::string_view::npos ? 0 : word.size() - point;
}

}  // namespace

bool next_text(LineReader &in, std::string_view &line, std::vector<std::string_view> &words) {
  while (in.next(line)) {
    split(before_comment(line), words);
    if (!words.empty()) return true;
  }
  return false;
}

void check_end(LineReader &in, int64_t n) {
  std::string_view line;
  std::vector<std::string_view> words;
  if (next_text(in, line, words))
    in.fail(JAM_E_FORMAT, "there is more after the %lld spheres that the header announces: '%s'",
            static_cast<long long>(n), shown(line).c_str());
}

bool Rows::next(std::vector<std::string_view> &words) {
  std::string_view line;
  do {
    if (!in_.next_filled(line, true)) return false;
    const char last = line.back();
    const std::string_view text = comments_ ? before_comment(line) : line;
    if (comments_ && text.size() < line.size() && in_.cut_short()) in_.fail_cut_short();
    split_columns(in_, text, words);
    if (words.empty()) continue;
    check_last(words, last == ' ' || last == '\t');
  } while (words.empty());
  if (++count_ % 4096 == 0) {
    // Arrays grow to twice their length, and the packing has positions, velocities and diameters of its own.
    const double d = static_cast<double>(std::min<size_t>(words.size(), JAM_MAX_DIM));
    CallScope::need_memory(8.0 * (4.0 * d + 3.0) * static_cast<double>(count_),
                           ("the spheres of " + in_.path()).c_str());
  }
  return true;
}

void Rows::check_last(const std::vector<std::string_view> &words, bool blank_behind) {
  const size_t length = behind_point(words.back());
  if (in_.cut_short() && !blank_behind) {
    size_t whole = longest_;
    if (first_)
      for (size_t k = 0; k + 1 < words.size(); ++k) whole = std::max(whole, behind_point(words[k]));
    if (whole == 0 || length < whole) in_.fail_cut_short();
  }
  first_ = false;
  longest_ = std::max(longest_, length);
}

bool SizeColumn::take(const LineReader &in, std::string_view name, size_t column) {
  const std::string word = lower(name);
  const bool radius = word == "radius", diameter = word == "diameter";
  if (!radius && !diameter) return false;
  if (found_) in.fail(JAM_E_FORMAT, "two columns give sizes: keep one of radius and diameter");
  found_ = true;
  radius_ = radius;
  column_ = column;
  return true;
}

double SizeColumn::diameter(const LineReader &in, const std::vector<std::string_view> &words) const {
  const double x = positive(in, words[column_], radius_ ? "radius" : "diameter");
  return radius_ ? 2.0 * x : x;
}

void say_unread(FileContent &content, const std::vector<std::string> &names, const char *parts) {
  if (names.empty()) return;
  std::string all;
  for (const std::string &name : names) all += (all.empty() ? "" : ", ") + shown(name);
  content.notes.say("%s of the file that were not read: %s", parts, all.c_str());
}

void measure_from_corner(const double *corner, FileContent &content) {
  const size_t d = static_cast<size_t>(content.dim);
  std::string at;
  bool moved = false;
  for (size_t c = 0; c < d; ++c) {
    moved = moved || corner[c] != 0.0;
    at += ' ';
    append_number(at, corner[c]);
  }
  if (!moved) return;
  content.origin.assign(corner, corner + d);
  for (size_t k = 0; k < content.position.size(); ++k) content.position[k] -= corner[k % d];
  content.notes.say("the corner of the cell is at%s in the file: positions are measured from there", at.c_str());
}

void take_cell(const LineReader &in, std::vector<double> rows, FileContent &content) {
  at_line(in, [&] { take_rows(std::move(rows), content); });
}

void take_cell_of_lammps(const LineReader &in, const std::array<double, 9> &cell, FileContent &content) {
  const size_t d = static_cast<size_t>(content.dim);
  if (d == 2 && (cell[2] != 0.0 || cell[5] != 0.0 || cell[6] != 0.0 || cell[7] != 0.0))
    in.fail(JAM_E_UNSUPPORTED, "all spheres lie at z = 0, but the cell leaves that plane");
  std::vector<double> rows;
  for (size_t r = 0; r < d; ++r) rows.insert(rows.end(), &cell[3 * r], &cell[3 * r] + d);
  take_cell(in, std::move(rows), content);
}

void take_rows(std::vector<double> rows, FileContent &content) {
  const size_t d = static_cast<size_t>(content.dim);
  bool cube = true;
  for (size_t k = 0; k < rows.size(); ++k) cube = cube && rows[k] == (k % (d + 1) == 0 ? rows[0] : 0.0);
  if (cube && rows[0] > 0.0) {
    check_box(rows[0]);
    content.box = rows[0];
    return;
  }
  normal_cell(content.dim, rows.data());
  content.cell = std::move(rows);
}

std::vector<std::string> column_names(std::string_view line, char comma) {
  std::vector<std::string> names;
  if (line.find(comma) == std::string_view::npos) {
    std::vector<std::string_view> words;
    split(line, words);
    bool open = false;  // a unit in brackets belongs to the name before it, with blanks within too
    for (const std::string_view word : words) {
      const bool unit = open || (!names.empty() && (word[0] == '(' || word[0] == '['));
      if (unit)
        names.back().append(" ").append(word);
      else
        names.emplace_back(word);
      open = unit && word.find_first_of("])") == std::string_view::npos;
    }
    return names;
  }
  for (size_t k = 0; k <= line.size();) {
    const size_t stop = std::min(line.find(comma, k), line.size());
    names.emplace_back(line.substr(k, stop - k));
    k = stop + 1;
  }
  return names;
}

bool is_inside(double x, const ReadOptions &options) {
  constexpr double rounding = 1e-6;  // six digits round to the face itself
  return options.says_box() || (x >= -rounding && x <= 1.0 + rounding);
}

void refuse_outside(const LineReader &in, int64_t line, double x) {
  inside::fail(JAM_E_FORMAT,
               "%s line %lld: the coordinate %g lies outside the box [0, 1], and the file names no box: write 'box "
               "<side>' behind the diameter on line 3 of plain text, or give the option box or cell",
               in.path().c_str(), static_cast<long long>(line), x);
}

void take_plane(const std::vector<double> &positions, double low, double high, FileContent &content, double height,
                double resolution) {
  content.dim = 3;
  bool flat = low < height && high > height;
  for (size_t k = 2; k < positions.size(); k += 3) flat = flat && std::fabs(positions[k] - height) <= resolution;
  if (!flat) {
    content.position = positions;
    return;
  }
  content.dim = 2;
  for (size_t k = 0; k < positions.size(); k += 3)
    content.position.insert(content.position.end(), {positions[k], positions[k + 1]});
}

std::string plain_list(std::string_view value) {
  std::string plain(value);
  if (plain.compare(0, 5, "_JSON") == 0) plain.erase(0, 5);
  std::replace_if(
      plain.begin(), plain.end(), [](char c) { return c == '[' || c == ']' || c == ','; }, ' ');
  return plain;
}

bool is_true(std::string_view word) {
  const std::string w = lower(word);
  return w == "t" || w == "true" || w == "1";
}

size_t read_container(const LineReader &in, CommentKeys &keys, Enclosure &enclosure) {
  std::string_view value;
  const bool named = keys.find("container", value);
  if (named) enclosure.container = container_of_word(std::string(value).c_str());
  if (enclosure.container < 0)
    in.fail(JAM_E_FORMAT, "container is '%s', known are %s", shown(value).c_str(), container_words().c_str());
  if (!keys.find("walls", value)) {  // walls alone are those of a brick
    if (!named) return 0;
    in.fail(JAM_E_FORMAT, "container= without walls=, a word T or F for each axis");
  }
  const std::string plain = plain_list(value);
  std::vector<std::string_view> words;
  split(plain, words);
  if (words.empty() || words.size() > JAM_MAX_DIM)
    in.fail(JAM_E_FORMAT, "walls has %zu words, it must have one for each axis, at most %d", words.size(), JAM_MAX_DIM);
  for (size_t c = 0; c < words.size(); ++c) {
    if (is_true(words[c]))
      enclosure.walls |= 1 << c;
    else if (const std::string w = lower(words[c]); w != "f" && w != "false" && w != "0")
      in.fail(JAM_E_FORMAT, "walls='%s': a word for each axis must be T or F", shown(value).c_str());
  }
  return words.size();
}

}  // namespace jam::inside
