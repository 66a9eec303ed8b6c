// Tables of columns: blanks or commas part them, names are on the first line, in a comment, or nowhere.
#include <algorithm>

#include "io/formats.hpp"
#include "io/read_helpers.hpp"

namespace jam::inside {
namespace {

// The columns of a table: coordinates x, y, z or x1, x2, ...; a size; others, which are not read.
struct TableColumns {
  std::vector<size_t> axis;
  SizeColumn size;
  size_t total = 0;
  bool assumed = false;
  std::string sized;  // the column of sizes, where its name says neither radius nor diameter
  std::vector<std::string> unread;
};

// What programs write beside the letter of a coordinate: "X-Coordinate", "x_coord", "Position:0", "Points:0".
constexpr std::string_view fillers[] = {"particle", "position", "positions", "pos",    "coordinate", "coordinates",
                                        "coord",    "points",   "point",     "centre", "center"};

// The number of the coordinate that a column of this name holds; -1: none.
int axis_of(const std::string &name) {
  std::string parted(name);
  std::replace_if(
      parted.begin(), parted.end(), [](char c) { return c == '_' || c == ':' || c == '-' || c == '.'; }, ' ');
  std::vector<std::string_view> words;
  split(parted, words);
  int axis = -1;
  bool filled = false;
  for (const std::string_view word : words) {
    if (std::find(std::begin(fillers), std::end(fillers), word) != std::end(fillers)) {
      filled = true;
      continue;
    }
    int here = -1;
    if (word.size() == 1 && word[0] >= 'x' && word[0] <= 'z') here = word[0] - 'x';
    if (word.size() == 2 && word[0] == 'x' && word[1] >= '1' && word[1] <= '8') here = word[1] - '1';
    if (word.size() == 1 && word[0] >= '0' && word[0] <= '7' && words.size() > 1) here = word[0] - '0';
    if (here < 0 || axis >= 0) return -1;
    axis = here;
  }
  const bool number = !words.empty() && words.back().size() == 1 && words.back()[0] <= '9';
  return number && !filled ? -1 : axis;
}

// Rocky calls the diameter of a sphere so.
bool is_size_of_rocky(const std::string &name) { return name == "particle size"; }

// What SizeColumn calls a size of this name.
std::string size_of(const std::string &name) {
  if (name == "r" || name == "radii" || name == "particle radius" || name == "particle_radius") return "radius";
  if (name == "d" || name == "sigma" || name == "diameters" || name == "particle diameter" ||
      name == "particle_diameter" || is_size_of_rocky(name))
    return "diameter";
  return name;
}

std::string_view trim(std::string_view s) {
  const size_t from = s.find_first_not_of(" \t\"'"), to = s.find_last_not_of(" \t\"'");
  return from == std::string_view::npos ? std::string_view() : s.substr(from, to - from + 1);
}

// A name as it counts: in small letters, without quotes and without the unit behind it, "X [m]" or "r (mm)".
std::string plain_name(std::string_view name) {
  name = trim(name);
  const size_t unit = name.find_first_of("[(");
  if (unit != std::string_view::npos && unit > 0) name = trim(name.substr(0, unit));
  return lower(name);
}

std::string_view unit_of(std::string_view name) {
  const size_t from = name.find_last_of("[(");
  if (from == std::string_view::npos) return {};
  name.remove_prefix(from + 1);
  return trim(name.substr(0, name.find_first_of("])")));
}

// Coordinates and sizes are lengths of one unit, which is not converted. Units that are not named may be any.
void refuse_two_units(const LineReader &in, const std::vector<std::string> &lengths) {
  const std::string *first = nullptr;
  for (const std::string &name : lengths) {
    if (unit_of(name).empty()) continue;
    if (first && unit_of(name) != unit_of(*first))
      in.fail(JAM_E_FORMAT, "the columns '%s' and '%s' have two units: write all lengths in one unit",
              shown(trim(*first)).c_str(), shown(trim(name)).c_str());
    if (!first) first = &name;
  }
}

// False when the names have no coordinates.
bool name_columns(const LineReader &in, const std::vector<std::string> &names, TableColumns &columns) {
  std::vector<std::pair<size_t, size_t>> axis;  // number of the coordinate, column
  std::vector<std::string> lengths;
  for (size_t k = 0; k < names.size(); ++k) {
    const std::string name = plain_name(names[k]);
    const int coordinate = axis_of(name);
    if (coordinate >= 0)
      axis.emplace_back(coordinate, k);
    else if (!columns.size.take(in, size_of(name), k)) {
      columns.unread.emplace_back(names[k]);
      continue;
    }
    lengths.push_back(names[k]);
    if (is_size_of_rocky(name)) columns.sized = names[k];
  }
  std::sort(axis.begin(), axis.end());
  for (size_t k = 0; k < axis.size(); ++k) {
    if (k > 0 && axis[k].first == axis[k - 1].first)
      in.fail(JAM_E_FORMAT, "two columns are coordinate %zu, '%s' and '%s': say which by columns=", axis[k].first + 1,
              shown(names[axis[k - 1].second]).c_str(), shown(names[axis[k].second]).c_str());
    if (axis[k].first != k) return false;
  }
  if (axis.size() < 2) return false;
  if (!columns.size.found())
    in.fail(JAM_E_FORMAT, "the columns have no size: name one of them radius or diameter (r or d)");
  refuse_two_units(in, lengths);
  for (const auto &a : axis) columns.axis.push_back(a.second);
  columns.total = names.size();
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
            "first line (x y z radius), or by the option columns",
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

// Yade writes the sides of a periodic cell into a comment, "##PERIODIC:: 5 5 8", and the columns into another,
// "#format x_y_z_r_matId". True where this comment was one of these.
bool read_yade(const LineReader &in, std::string_view comment, FileContent &content, std::vector<std::string> &names) {
  comment.remove_prefix(std::min(comment.find_first_not_of("# \t"), comment.size()));
  std::vector<std::string_view> words;
  split(comment, words);
  if (words.size() == 2 && words[0] == "format" && words[1].find('_') != std::string_view::npos) {
    names = column_names(std::string(words[1]), '_');
    return true;
  }
  if (words.size() != 4 || words[0] != "PERIODIC::") return false;
  std::vector<double> rows(9, 0.0);
  for (size_t c = 0; c < 3; ++c) rows[4 * c] = positive(in, words[c + 1], "side of the periodic cell");
  content.dim = 3;
  at_line(in, [&] { take_rows(std::move(rows), content); });
  content.knows_walls = true;
  return true;
}

// Reads the lines before the first row of numbers. Names are on the last of them, or in a comment of as many words as
// the row has.
TableColumns find_names(LineReader &in, FileContent &content) {
  const Head head(in.head(), "");
  const size_t first = head.first;
  const std::vector<std::string> row = column_names(before_comment(head.lines[first]));
  const bool named = is_heading(head.lines[first]);
  TableColumns columns;
  std::string_view line;
  for (size_t k = 0; k < first + (named ? 1 : 0); ++k) {
    in.next(line);
    std::vector<std::string> names;
    if (k < first && !read_yade(in, line, content, names)) {
      const size_t behind = line.find_first_not_of("# \t");
      names = column_names(behind == std::string_view::npos ? "" : line.substr(behind));
    } else if (k == first) {
      names = row;
    }
    if (k < first && (named || names.size() != row.size())) continue;  // a comment
    TableColumns found;
    if (name_columns(in, names, found))
      columns = std::move(found);
    else if (k == first)
      in.fail(JAM_E_FORMAT, "'%s' names no columns: x, y, z and radius or diameter are needed, or the option columns",
              shown(line).c_str());
  }
  return columns;
}

// Skips the lines before the first row, whose columns the caller names.
TableColumns take_names(LineReader &in, const std::vector<std::string> &names, FileContent &content) {
  TableColumns columns;
  if (!name_columns(in, names, columns))
    fail(JAM_E_ARGUMENT, "columns names no coordinates x, y, z (or x1, x2, ...), one column each");
  const Head head(in.head(), "");
  std::string_view line;
  std::vector<std::string> unused;
  for (size_t k = 0; k < head.first; ++k) {
    in.next(line);
    read_yade(in, line, content, unused);
  }
  if (is_heading(head.lines[head.first])) {
    in.next(line);
    content.notes.say("line %zu, '%s', has no number and was taken as a heading, in place of which columns= counts",
                      head.first + 1, shown(line).c_str());
  }
  return columns;
}

// Spheres in one plane are disks, as in the files of LAMMPS, unless the caller speaks of a third direction.
void take_disks(const ReadOptions &options, FileContent &content) {
  const size_t cell = options.layout.cell.size(), n = content.diameter.size();
  const bool third = cell == 3 || cell == 9 || content.has_box() || options.enclosure.needs_space() ||
                     options.layout.origin.size() == 3;
  const std::vector<double> &x = content.position;
  if (content.dim != 3 || third || (n < 2 && options.dim != 2)) return;
  for (size_t k = 2; k < x.size(); k += 3)
    if (x[k] != x[2]) return;
  const double height = x[2];
  std::vector<double> flat;
  for (size_t i = 0; i < n; ++i) flat.insert(flat.end(), {x[3 * i], x[3 * i + 1]});
  content.dim = 2;
  content.position = std::move(flat);
  content.notes.say(
      "all spheres lie at z = %g: they were read as disks, d = 2, without z; the option cell with three sides keeps d "
      "= "
      "3",
      height);
}

}  // namespace

bool names_coordinates(std::string_view line) {
  for (const std::string &name : column_names(line))
    if (axis_of(plain_name(name)) == 0) return true;
  return false;
}

bool is_heading(std::string_view line) {
  const std::vector<std::string> words = column_names(before_comment(line));
  return std::none_of(words.begin(), words.end(), [](const std::string &word) { return is_number(plain_name(word)); });
}

FileContent read_table(LineReader &in, const ReadOptions &options) {
  FileContent content;
  const std::vector<std::string> &named = options.layout.columns;
  TableColumns columns = named.empty() ? find_names(in, content) : take_names(in, named, content);
  std::vector<std::string_view> words;
  Rows rows(in, true);
  while (rows.next(words)) {
    if (columns.total == 0) assume_columns(in, words, options, content, columns);
    if (words.size() != columns.total)
      in.fail(JAM_E_FORMAT, "%zu columns, %s %zu", words.size(),
              named.empty() ? "the first rows have" : "columns names", columns.total);
    for (const size_t column : columns.axis) {
      const double x = parse_number(in, words[column]);
      if (!content.has_box() && !is_inside(x, options)) refuse_outside(in, in.number(), x);
      content.position.push_back(x);
    }
    content.diameter.push_back(columns.size.diameter(in, words));
  }
  if (content.diameter.empty()) in.fail(JAM_E_FORMAT, "the file ends before the first row");
  content.dim = take_dim(in, static_cast<int64_t>(columns.axis.size()));
  if (content.has_box() && content.dim != 3)
    in.fail(JAM_E_FORMAT, "the columns have %d coordinates, but the comment PERIODIC:: names three sides", content.dim);
  if (columns.assumed) refuse_counting(in, content);
  take_disks(options, content);
  say_unread(content, columns.unread);
  if (!columns.sized.empty())
    content.notes.say("the column '%s' was taken as the diameter", shown(trim(columns.sized)).c_str());
  if (!content.has_box() && options.layout.cell.empty())
    content.notes.say("the file names no box: its side is taken as %.17g", options.box);
  return content;
}

}  // namespace jam::inside
