// Plain text, and tables of columns.
#include <algorithm>

#include "io/read_helpers.hpp"
#include "io/recognise.hpp"

namespace jam::inside {
namespace {

// Files that name no box mean a side of 1. Positions beyond it would be wrapped, and a box of another size lost. Six
// digits round to the face itself.
void check_inside(const LineReader &in, double x, const ReadOptions &options) {
  constexpr double rounding = 1e-6;
  if (options.box != 1.0 || (x >= -rounding && x <= 1.0 + rounding)) return;
  in.fail(JAM_E_FORMAT,
          "the coordinate %g lies outside the box [0, 1], and the file names no box: write 'box <side>' behind the "
          "diameter on line 3, or give the option box",
          x);
}

// The third line: `<diameter>` or `diameters`, then perhaps `box <L>`. Returns whether each sphere has its own.
bool read_diameter_line(LineReader &in, FileContent &content) {
  std::string_view line;
  std::vector<std::string_view> words;
  if (!next_text(in, line, words)) in.fail(JAM_E_FORMAT, "the file ends before the diameter");
  if (words.size() != 1 && !(words.size() == 3 && words[1] == "box"))
    in.fail(JAM_E_FORMAT, "'%s' is neither '<diameter>' nor 'diameters', with 'box <side>' or without",
            shown(line).c_str());
  const bool each = words[0] == "diameters";
  if (!each) content.diameter.push_back(positive(in, words[0], "diameter"));
  if (words.size() == 3) content.box = take_box(in, words[2]);
  return each;
}

// The columns of a table: coordinates x, y, z or x1, x2, ...; a size; others, which are not read.
struct TableColumns {
  std::vector<size_t> axis;
  SizeColumn size;
  size_t total = 0;
  bool assumed = false;
  std::vector<std::string> unread;
};

// False when the words name no coordinates.
bool name_columns(const LineReader &in, const std::vector<std::string_view> &words, TableColumns &columns) {
  static constexpr std::string_view axes[] = {"x", "y", "z"};
  std::vector<std::pair<size_t, size_t>> axis;  // number of the coordinate, column
  for (size_t k = 0; k < words.size(); ++k) {
    std::string name = lower(words[k]);
    const size_t letter = static_cast<size_t>(std::find(axes, axes + 3, name) - axes);
    if (letter < 3)
      axis.emplace_back(letter, k);
    else if (name.size() == 2 && name[0] == 'x' && name[1] >= '1' && name[1] <= '8')
      axis.emplace_back(static_cast<size_t>(name[1] - '1'), k);
    else if (!columns.size.take(in, name == "r" ? "radius" : name == "d" || name == "sigma" ? "diameter" : name, k))
      columns.unread.emplace_back(words[k]);
  }
  std::sort(axis.begin(), axis.end());
  for (size_t k = 0; k < axis.size(); ++k)
    if (axis[k].first != k) return false;
  if (axis.size() < 2) return false;
  if (!columns.size.found())
    in.fail(JAM_E_FORMAT, "the columns have no size: name one of them radius or diameter (r or d)");
  for (const auto &a : axis) columns.axis.push_back(a.second);
  columns.total = words.size();
  return true;
}

// Without names: d coordinates and the radius.
void assume_columns(const LineReader &in, const std::vector<std::string_view> &words, const ReadOptions &options,
                    FileContent &content, TableColumns &columns) {
  const size_t d = static_cast<size_t>(options.dim);
  columns.total = words.size();
  if (columns.total != d + 1)
    in.fail(JAM_E_FORMAT,
            "%zu columns, a table without names has %zu in d = %d (coordinates and radius): name the columns on the "
            "first line (x y z radius), or give the option dim",
            columns.total, d + 1, options.dim);
  for (size_t c = 0; c < d; ++c) columns.axis.push_back(c);
  columns.size.take(in, "radius", d);
  columns.assumed = true;
  content.notes.warn("the file does not name its %zu columns: %zu coordinates and the radius were assumed", d + 1, d);
}

void refuse_counting(const LineReader &in, const FileContent &content) {
  const std::vector<double> &x = content.position;
  const size_t d = static_cast<size_t>(content.dim), n = x.size() / d;
  if (n < 3 || (x[0] != 0.0 && x[0] != 1.0)) return;
  for (size_t k = 0; k < n; ++k)
    if (x[k * d] != x[0] + static_cast<double>(k)) return;
  in.fail(JAM_E_FORMAT, "the first column counts the rows, so it is not a coordinate: name the columns on line 1");
}

// Reads the lines before the first row of numbers. Names stand on the last of them, or in a comment of as many words as
// the row has.
TableColumns find_names(LineReader &in) {
  const auto parted = [](std::string line) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::replace(line.begin(), line.end(), '#', ' ');
    return line;
  };
  const Head head(in.head(), "");
  const size_t first = head.first;
  std::vector<std::string_view> row, words;
  const std::string text = parted(std::string(head.lines[first]));
  split(text, row);
  const bool named = !is_number(row[0]);
  TableColumns columns;
  std::string_view line;
  for (size_t k = 0; k < first + (named ? 1 : 0); ++k) {
    in.next(line);
    const std::string names = parted(std::string(line));
    split(names, words);
    if (k < first && (named || words.size() != row.size())) continue;  // a comment
    TableColumns found;
    if (name_columns(in, words, found))
      columns = std::move(found);
    else if (k == first)
      in.fail(JAM_E_FORMAT, "'%s' names no columns: x, y, z and radius or diameter are needed", shown(line).c_str());
  }
  return columns;
}

}  // namespace

FileContent read_plain(LineReader &in, const ReadOptions &options) {
  FileContent content;
  std::vector<std::string_view> words;
  std::string_view line;
  next_text(in, line, words);
  content.dim = take_dim(in, parse_count(in, words[0], "a dimension"));
  if (!next_text(in, line, words)) in.fail(JAM_E_FORMAT, "the file ends before the number of spheres");
  if (words.size() != 1) in.fail(JAM_E_FORMAT, "'%s' is not one number of spheres", shown(line).c_str());
  const int64_t n = take_count(in, parse_count(in, words[0], "a number of spheres"));
  const bool each = read_diameter_line(in, content);
  content.enclosure = options.enclosure;
  content.knows_walls = true;  // the format is one of periodic cubes: only the caller can name walls
  const size_t columns = static_cast<size_t>(content.dim) + (each ? 1 : 0);
  Rows rows(in, true);
  for (int64_t k = 0; k < n; ++k) {
    if (!rows.next(words)) ends_early(in, k, n);
    if (words.size() != columns)
      in.fail(JAM_E_FORMAT, "%zu columns, %zu are needed (%s)", words.size(), columns,
              each ? "coordinates and diameter" : "coordinates");
    for (int c = 0; c < content.dim; ++c) {
      const double x = parse_number(in, words[c]);
      if (!content.has_box()) check_inside(in, x, options);
      content.position.push_back(x);
    }
    if (each) content.diameter.push_back(positive(in, words.back(), "diameter"));
  }
  check_end(in, n);
  return content;
}

FileContent read_table(LineReader &in, const ReadOptions &options) {
  FileContent content;
  TableColumns columns = find_names(in);
  std::vector<std::string_view> words;
  Rows rows(in, true);
  while (rows.next(words)) {
    if (columns.total == 0) assume_columns(in, words, options, content, columns);
    if (words.size() != columns.total)
      in.fail(JAM_E_FORMAT, "%zu columns, the first rows have %zu", words.size(), columns.total);
    for (const size_t column : columns.axis) {
      const double x = parse_number(in, words[column]);
      check_inside(in, x, options);
      content.position.push_back(x);
    }
    content.diameter.push_back(columns.size.diameter(in, words));
  }
  if (content.diameter.empty()) in.fail(JAM_E_FORMAT, "the file ends before the first row");
  content.dim = take_dim(in, static_cast<int64_t>(columns.axis.size()));
  if (columns.assumed) refuse_counting(in, content);
  say_unread(content, columns.unread);
  content.notes.say("the file names no box: its side is taken as %.17g", options.box);
  return content;
}

}  // namespace jam::inside
