#include <algorithm>

#include "core/cell_reduction.hpp"
#include "core/error.hpp"
#include "core/limits.hpp"
#include "io/files.hpp"
#include "io/read_helpers.hpp"
#include "io/text.hpp"

namespace jam {
namespace {

void check_end(LineReader &in, int64_t n) {
  std::string_view line;
  if (in.next_filled(line))
    in.fail(JAM_E_FORMAT, "there is more after the %lld spheres that the header announces: '%s'",
            static_cast<long long>(n), shown(line).c_str());
}

// The third line: `<diameter>` or `diameters`, then perhaps `box <L>`. Returns whether each sphere has its own.
bool read_diameter_line(LineReader &in, FileContent &content) {
  std::string_view line;
  std::vector<std::string_view> words;
  if (!in.next_filled(line)) in.fail(JAM_E_FORMAT, "the file ends before the diameter");
  split(line, words);
  if (words.size() != 1 && !(words.size() == 3 && words[1] == "box"))
    in.fail(JAM_E_FORMAT, "'%s' is neither '<diameter>' nor 'diameters', with 'box <side>' or without",
            shown(line).c_str());
  const bool each = words[0] == "diameters";
  if (!each) content.diameter.push_back(positive(in, words[0], "diameter"));
  if (words.size() == 3) content.box = take_box(in, words[2]);
  return each;
}

FileContent read_plain(LineReader &in, int dim, std::string_view count_line) {
  FileContent content;
  content.dim = dim;
  std::vector<std::string_view> words;
  split(count_line, words);
  if (words.size() != 1) in.fail(JAM_E_FORMAT, "'%s' is not one number of spheres", shown(count_line).c_str());
  const int64_t n = take_count(in, parse_count(in, words[0], "a number of spheres"));
  const bool each = read_diameter_line(in, content);
  const size_t columns = static_cast<size_t>(content.dim) + (each ? 1 : 0);
  std::string_view line;
  for (int64_t k = 0; k < n; ++k) {
    if (!in.next_filled(line)) ends_early(in, k, n);
    split(line, words);
    if (words.size() != columns)
      in.fail(JAM_E_FORMAT, "%zu columns, %zu are needed (%s)", words.size(), columns,
              each ? "coordinates and diameter" : "coordinates");
    for (int c = 0; c < content.dim; ++c) content.position.push_back(parse_number(in, words[c]));
    if (each) content.diameter.push_back(positive(in, words.back(), "diameter"));
  }
  check_end(in, n);
  return content;
}

// The value of key= on the comment line, with quotes or without; false when the key is not there.
bool find_key(const LineReader &in, std::string_view comment, std::string_view key, std::string_view &value) {
  size_t k = 0;
  while (k < comment.size()) {
    while (k < comment.size() && (comment[k] == ' ' || comment[k] == '\t')) ++k;
    const size_t start = k;
    while (k < comment.size() && comment[k] != '=' && comment[k] != ' ' && comment[k] != '\t') ++k;
    const std::string_view name = comment.substr(start, k - start);
    if (k >= comment.size() || comment[k] != '=') continue;  // a bare word
    const bool quoted = ++k < comment.size() && (comment[k] == '"' || comment[k] == '\'');
    const char quote = quoted ? comment[k++] : ' ';
    size_t stop = comment.find(quote, k);
    if (stop == std::string_view::npos) {
      if (quoted) in.fail(JAM_E_FORMAT, "the quote after '%s=' is not closed", shown(name).c_str());
      stop = comment.size();
    }
    value = comment.substr(k, stop - k);
    k = stop + 1;
    if (name == key) return true;
  }
  return false;
}

struct Columns {
  size_t total = 0, pos = 0, pos_count = 0, radius = 0;
  bool has_pos = false, has_radius = false;
};

Columns read_properties(const LineReader &in, std::string_view properties) {
  std::vector<std::string_view> part;
  for (size_t k = 0; k <= properties.size();) {
    const size_t stop = std::min(properties.find(':', k), properties.size());
    part.push_back(properties.substr(k, stop - k));
    k = stop + 1;
  }
  if (part.size() % 3) in.fail(JAM_E_FORMAT, "Properties is not a list of name:type:columns");
  Columns columns;
  for (size_t k = 0; k < part.size(); k += 3) {
    const int64_t count = parse_count(in, part[k + 2], "a number of columns");
    if (count < 1 || count > 1000)
      in.fail(JAM_E_FORMAT, "property '%s' has %lld columns", shown(part[k]).c_str(), static_cast<long long>(count));
    if (part[k] == "pos" && part[k + 1] == "R") {
      columns.has_pos = true;
      columns.pos = columns.total;
      columns.pos_count = static_cast<size_t>(count);
    } else if (part[k] == "radius" && part[k + 1] == "R" && count == 1) {
      columns.has_radius = true;
      columns.radius = columns.total;
    }
    columns.total += static_cast<size_t>(count);
  }
  if (!columns.has_pos || !columns.has_radius)
    in.fail(JAM_E_FORMAT, "Properties has no %s column", columns.has_pos ? "radius:R:1" : "pos:R");
  return columns;
}

// The d vectors of a cell in rows of `width` numbers; what does not belong to them must be 0 (d = 2 in three columns,
// its third vector aside). A cube along the axes becomes content.box.
void read_cell(const LineReader &in, std::string_view text, const char *name, size_t width, FileContent &content) {
  std::vector<std::string_view> words;
  split(text, words);
  if (words.size() != width * width)
    in.fail(JAM_E_FORMAT, "%s has %zu numbers, %zu are needed", name, words.size(), width * width);
  const size_t d = std::min(width, static_cast<size_t>(content.dim));
  bool cube = true;
  for (size_t row = 0; row < width; ++row)
    for (size_t column = 0; column < width; ++column) {
      const double x = parse_number(in, words[width * row + column]);
      if (row < d && column < d) {
        content.cell.push_back(x);
        cube = cube && x == (row == column ? content.cell.front() : 0.0);
      } else if ((row < d || column < d) && x != 0.0) {
        in.fail(JAM_E_UNSUPPORTED, "%s '%s' leaves the plane of the packing", name, shown(text).c_str());
      }
    }
  if (!cube && d < static_cast<size_t>(content.dim))
    in.fail(JAM_E_UNSUPPORTED, "%s '%s' is not a cube: in d = %d the %d vectors are needed as cell=", name,
            shown(text).c_str(), content.dim, content.dim);
  if (!cube) return at_line(in, [&] { reduce_cell(content.dim, content.cell.data()); });
  content.cell.clear();
  content.box = take_box(in, words[0]);
}

// Every direction must be periodic, as T, True or 1; in d = 2 the third one is ignored.
void check_periodic(const LineReader &in, std::string_view pbc, int dim) {
  std::vector<std::string_view> words;
  split(pbc, words);
  for (size_t k = 0; k < words.size() && k < static_cast<size_t>(dim); ++k)
    if (words[k] != "T" && words[k] != "True" && words[k] != "true" && words[k] != "1")
      in.fail(JAM_E_UNSUPPORTED, "pbc='%s': the box must be periodic in every direction", shown(pbc).c_str());
}

FileContent read_xyz(LineReader &in, int64_t n, std::string_view comment) {
  take_count(in, n);
  std::string_view value;
  FileContent content;
  if (!find_key(in, comment, "Properties", value)) in.fail(JAM_E_FORMAT, "no Properties=");
  const Columns columns = read_properties(in, value);
  int64_t dim = static_cast<int64_t>(columns.pos_count);
  if (find_key(in, comment, "dim", value)) dim = parse_count(in, value, "a dimension");
  content.dim = take_dim(in, dim);
  if (dim != static_cast<int64_t>(columns.pos_count) && !(dim == 2 && columns.pos_count == 3))
    in.fail(JAM_E_FORMAT, "dim is %d but pos has %zu columns", content.dim, columns.pos_count);
  if (!find_key(in, comment, "Lattice", value)) in.fail(JAM_E_FORMAT, "no Lattice=");
  std::string_view whole;
  if (content.dim > 3 && find_key(in, comment, "cell", whole))
    read_cell(in, whole, "cell", static_cast<size_t>(content.dim), content);
  else
    read_cell(in, value, "Lattice", 3, content);
  if (find_key(in, comment, "pbc", value)) check_periodic(in, value, content.dim);
  if (find_key(in, comment, "non_additivity", value)) {
    content.non_additivity = parse_number(in, value);
    content.has_non_additivity = true;
    at_line(in, [&] { check_non_additivity(content.non_additivity); });
  }
  std::string_view line;
  std::vector<std::string_view> words;
  for (int64_t k = 0; k < n; ++k) {
    if (!in.next_filled(line)) ends_early(in, k, n);
    split(line, words);
    if (words.size() != columns.total)
      in.fail(JAM_E_FORMAT, "%zu columns, Properties announces %zu", words.size(), columns.total);
    for (int c = 0; c < content.dim; ++c) content.position.push_back(parse_number(in, words[columns.pos + c]));
    content.diameter.push_back(2.0 * positive(in, words[columns.radius], "radius"));
  }
  check_end(in, n);
  return content;
}

}  // namespace

FileContent read_file(const char *path) {
  LineReader in(path);
  std::string_view line;
  std::vector<std::string_view> words;
  if (!in.next_filled(line)) fail(JAM_E_FORMAT, "%s is empty", path);
  split(line, words);
  const std::string ending = file_ending(path);
  if (words[0] == "LAMMPS" || ending == "data" || ending == "lmp") return read_lammps(in);
  if (words.size() != 1)
    in.fail(JAM_E_FORMAT, "'%s' is not one number (a dimension, or the spheres of an XYZ file)", shown(line).c_str());
  const int64_t first = parse_count(in, words[0], "a dimension or a number of spheres");
  const int64_t first_line = in.number();
  if (!in.next(line)) in.fail(JAM_E_FORMAT, "the file ends before the number of spheres");
  const std::string second(line);  // the number of spheres in a plain file, key=value pairs in XYZ
  if (second.find('=') != std::string::npos) return read_xyz(in, first, second);
  if (first < 2 || first > JAM_MAX_DIM)
    fail(JAM_E_DIMENSION, "%s line %lld: dim is %lld, supported are 2..%d", path, static_cast<long long>(first_line),
         static_cast<long long>(first), JAM_MAX_DIM);
  return read_plain(in, static_cast<int>(first), second);
}

}  // namespace jam
