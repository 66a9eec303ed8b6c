// Extended XYZ, one frame or several.
#include <algorithm>

#include "io/read_helpers.hpp"

namespace jam::inside {
namespace {

constexpr std::string_view own_numbers_of_contacts = "contacts";  // libjam writes them, and a network gives them

struct XyzColumns {
  size_t total = 0, pos = 0, pos_count = 0, id = 0;
  bool has_pos = false, has_id = false;
  SizeColumn size;
  std::vector<std::string> unread;
  std::vector<double> origin;  // the corner of the cell
};

XyzColumns read_properties(const LineReader &in, std::string_view properties) {
  std::vector<std::string_view> part;
  for (size_t k = 0; k <= properties.size();) {
    const size_t stop = std::min(properties.find(':', k), properties.size());
    part.push_back(properties.substr(k, stop - k));
    k = stop + 1;
  }
  if (part.size() % 3) in.fail(JAM_E_FORMAT, "Properties is not a list of name:type:columns");
  XyzColumns columns;
  for (size_t k = 0; k < part.size(); k += 3) {
    const int64_t count = parse_count(in, part[k + 2], "a number of columns");
    if (count < 1 || count > 1000)
      in.fail(JAM_E_FORMAT, "property '%s' has %lld columns", shown(part[k]).c_str(), static_cast<long long>(count));
    const bool number = part[k + 1] == "R" || part[k + 1] == "I";
    if (part[k] == "pos" && number) {
      if (columns.has_pos) in.fail(JAM_E_FORMAT, "Properties has pos twice");
      columns.has_pos = true;
      columns.pos = columns.total;
      columns.pos_count = static_cast<size_t>(count);
    } else if (part[k] == "id" && part[k + 1] == "I" && count == 1) {
      columns.has_id = true;
      columns.id = columns.total;
    } else if (!(number && count == 1 && columns.size.take(in, part[k], columns.total)) &&
               part[k] != own_numbers_of_contacts) {
      columns.unread.emplace_back(part[k]);
    }
    columns.total += static_cast<size_t>(count);
  }
  if (!columns.has_pos) in.fail(JAM_E_FORMAT, "Properties has no pos:R column");
  if (!columns.size.found())
    in.fail(JAM_E_FORMAT, "Properties has no radius:R:1 or diameter:R:1 column: spheres need sizes");
  return columns;
}

// The d vectors of a cell in rows of `width` numbers; what does not belong to them must be 0 (d = 2 in three columns,
// its third vector aside).
void read_cell(const LineReader &in, std::string_view text, const char *name, size_t width, FileContent &content) {
  const std::string plain = plain_list(text);
  std::vector<std::string_view> words;
  split(plain, words);
  if (words.size() != width * width)
    in.fail(JAM_E_FORMAT, "%s has %zu numbers, %zu are needed", name, words.size(), width * width);
  const size_t d = std::min(width, static_cast<size_t>(content.dim));
  std::vector<double> rows;
  bool cube = true;
  for (size_t row = 0; row < width; ++row)
    for (size_t column = 0; column < width; ++column) {
      const double x = parse_number(in, words[width * row + column]);
      if (row < d && column < d) {
        rows.push_back(x);
        cube = cube && x == (row == column ? rows.front() : 0.0);
      } else if ((row < d || column < d) && x != 0.0) {
        in.fail(JAM_E_UNSUPPORTED, "%s '%s' leaves the plane of the packing", name, shown(text).c_str());
      }
    }
  if (d == static_cast<size_t>(content.dim)) return take_cell(in, std::move(rows), content);
  if (!cube)
    in.fail(JAM_E_UNSUPPORTED, "%s '%s' is not a cube: in d = %d the %d vectors are needed as cell=", name,
            shown(text).c_str(), content.dim, content.dim);
  content.box = take_box(in, words[0]);
}

// Every direction without walls must be periodic, as T, True or 1; in d = 2 the third one is ignored, from d = 4 on
// three are named. Files of other programs do not say whether walls stand where nothing repeats: the caller may.
void check_periodic(const LineReader &in, std::string_view pbc, const FileContent &content) {
  const int dim = content.dim;
  const std::string plain = plain_list(pbc);
  std::vector<std::string_view> words;
  split(plain, words);
  const size_t needed = static_cast<size_t>(std::min(dim, 3));
  bool periodic = words.size() >= needed;
  for (size_t k = 0; k < std::min(words.size(), static_cast<size_t>(dim)); ++k) {
    if (is_true(words[k]) && content.enclosure.closes(static_cast<int>(k)))
      in.fail(JAM_E_FORMAT, "pbc='%s': axis %zu is periodic there, but container= and walls= close it",
              shown(pbc).c_str(), k);
    periodic = periodic && (is_true(words[k]) || content.enclosure.closes(static_cast<int>(k)));
  }
  if (periodic) return;
  const bool plane = dim == 3 && words.size() == 3 && lower(words[2])[0] != 't' && words[2] != "1";
  in.fail(JAM_E_UNSUPPORTED,
          "pbc='%s': the box must be periodic in every direction, or the options walls and container name the walls%s",
          shown(pbc).c_str(), plane ? "; a packing of disks needs dim=2 on this line" : "");
}

// Lattice, the cell vectors; beyond three dimensions `cell` when it is no cube, whose first three are those of Lattice.
void read_cells(const LineReader &in, CommentKeys &keys, FileContent &content) {
  std::string_view lattice, whole;
  if (!keys.find("Lattice", lattice))
    in.fail(JAM_E_FORMAT, "no Lattice=, the cell vectors, such as Lattice=\"L 0 0 0 L 0 0 0 L\" for a cube");
  if (content.dim <= 3 || !keys.find("cell", whole)) return read_cell(in, lattice, "Lattice", 3, content);
  const size_t d = static_cast<size_t>(content.dim);
  read_cell(in, whole, "cell", d, content);
  const std::string plain_lattice = plain_list(lattice), plain_cell = plain_list(whole);
  std::vector<std::string_view> of_lattice, of_cell;
  split(plain_lattice, of_lattice);
  split(plain_cell, of_cell);
  bool same = of_lattice.size() == 9;
  for (size_t k = 0; k < 9 && same; ++k)
    same = parse_number(in, of_lattice[k]) == parse_number(in, of_cell[d * (k / 3) + k % 3]);
  if (!same)
    in.fail(JAM_E_FORMAT, "Lattice and cell differ: Lattice gives three components of the first three vectors");
}

// Where the corner of the cell is, as OVITO writes it.
std::vector<double> read_origin(const LineReader &in, CommentKeys &keys, int dim) {
  std::string_view text;
  std::vector<double> origin(static_cast<size_t>(std::max(dim, 3)), 0.0);
  if (!keys.find("Origin", text)) return origin;
  const std::string plain = plain_list(text);
  std::vector<std::string_view> words;
  split(plain, words);
  if (words.size() != 3 && words.size() != static_cast<size_t>(dim))
    in.fail(JAM_E_FORMAT, "Origin has %zu numbers, 3 are needed", words.size());
  if (words.size() < static_cast<size_t>(dim))
    in.fail(JAM_E_UNSUPPORTED, "Origin has 3 numbers, d = %d needs %d", dim, dim);
  for (size_t k = 0; k < words.size(); ++k) origin[k] = parse_number(in, words[k]);
  return origin;
}

// What line 2 says of the frame.
XyzColumns read_keys(const LineReader &in, CommentKeys &keys, const ReadOptions &options, FileContent &content) {
  std::string_view value;
  if (!keys.find("Properties", value))
    in.fail(JAM_E_FORMAT, "no Properties=, such as Properties=species:S:1:pos:R:3:radius:R:1 for these columns");
  XyzColumns columns = read_properties(in, value);
  int64_t dim = static_cast<int64_t>(columns.pos_count);
  if (keys.find("dim", value))
    dim = parse_count(in, value, "a dimension");
  else if (dim == 3 && options.dim == 2)
    dim = 2;
  content.dim = take_dim(in, dim);
  if (dim != static_cast<int64_t>(columns.pos_count) && !(dim == 2 && columns.pos_count == 3))
    in.fail(JAM_E_FORMAT, "dim is %d but pos has %zu columns", content.dim, columns.pos_count);
  read_cells(in, keys, content);
  columns.origin = read_origin(in, keys, content.dim);
  content.knows_origin = keys.has("Origin");
  const size_t axes = read_container(in, keys, content.enclosure);
  if (axes > 0 && axes != static_cast<size_t>(content.dim))
    in.fail(JAM_E_FORMAT, "walls has %zu words, %d are needed", axes, content.dim);
  if (axes == 0) content.enclosure = options.enclosure;
  content.knows_walls = true;  // without pbc and container= a cell is periodic, by the format
  if (keys.find("pbc", value)) check_periodic(in, value, content);
  keys.find("stress", value);  // libjam writes it, and the forces of a packing give it
  if (keys.find("non_additivity", value)) {
    content.non_additivity = parse_number(in, value);
    content.has_non_additivity = true;
    at_line(in, [&] { check_non_additivity(content.non_additivity); });
  }
  return columns;
}

// The rows of a frame; in d = 2 a third coordinate must be the same for all disks.
void read_rows(LineReader &in, int64_t n, const XyzColumns &columns, FileContent &content) {
  std::vector<std::string_view> words;
  const size_t d = static_cast<size_t>(content.dim);
  Rows rows(in, false);
  double height = 0.0;
  bool sorted = true;
  int64_t before = 0;
  for (int64_t k = 0; k < n; ++k) {
    if (!rows.next(words)) ends_early(in, k, n);
    if (words.size() != columns.total)
      in.fail(JAM_E_FORMAT, "%zu columns, Properties announces %zu", words.size(), columns.total);
    for (size_t c = 0; c < d; ++c) content.position.push_back(parse_number(in, words[columns.pos + c]));
    for (size_t c = d; c < columns.pos_count; ++c) {
      const double x = parse_number(in, words[columns.pos + c]);
      if (k == 0) height = x;
      if (x != height)
        in.fail(JAM_E_UNSUPPORTED, "the third coordinate is %g, that of the first disk %g: disks need one plane", x,
                height);
    }
    content.diameter.push_back(columns.size.diameter(in, words));
    if (!columns.has_id) continue;
    const int64_t id = parse_count(in, words[columns.id], "the number of a sphere");
    sorted = sorted && (k == 0 || id == before + 1);
    before = id;
  }
  if (!sorted) content.notes.say("the ids of the file do not count up: spheres keep its order, ids are not kept");
  if (height != 0.0) content.notes.say("the third coordinate, %g of every disk, was omitted", height);
  measure_from_corner(columns.origin.data(), content);
}

// Frame k; false at the end of the file.
bool read_frame(LineReader &in, const ReadOptions &options, int64_t k, int64_t &n, FileContent &content) {
  std::string_view line;
  std::vector<std::string_view> words;
  if (!in.next_filled(line)) return false;
  while (k == 0 && line[line.find_first_not_of(" \t")] == '#')
    if (!in.next_filled(line)) return false;
  split(line, words);
  if (k > 0 && (words.size() != 1 || !is_count(words[0])))
    in.fail(JAM_E_FORMAT, "there is more after the %lld spheres that the header announces: '%s'",
            static_cast<long long>(n), shown(line).c_str());
  n = take_count_of_frame(in, parse_count(in, words[0], "a number of spheres"));
  if (!in.next(line)) in.fail(JAM_E_FORMAT, "the file ends before the line of keys");
  if (n == 0) return true;
  const std::string comment(line);
  CommentKeys keys(in, comment);
  const XyzColumns columns = read_keys(in, keys, options, content);
  read_rows(in, n, columns, content);
  say_unread(content, columns.unread);
  say_unread(content, keys.unread(), "keys");
  return true;
}

}  // namespace

FileContent read_xyz(LineReader &in, const ReadOptions &options) {
  int64_t n = 0;
  return choose_frame(in, options.frame,
                      [&](FileContent &content, int64_t k) { return read_frame(in, options, k, n, content); });
}

}  // namespace jam::inside
