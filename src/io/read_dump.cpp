// Dumps of LAMMPS: dump atom and dump custom as text, with radius or diameter, one frame or several.
#include <algorithm>
#include <limits>

#include "core/math.hpp"
#include "io/read_helpers.hpp"

namespace jam::inside {
namespace {
using Words = std::vector<std::string_view>;

// The lines of a box: cell vectors as rows, and where they begin.
struct Box {
  std::array<double, 9> rows{};
  std::array<double, 3> low{};
  bool bounded = false, flat = false;  // boundaries are named; that of z is periodic
};

// A boundary other than pp is no wall of LAMMPS's own: there the caller must name one. In a plane the third direction
// repeats, whatever `given` closes: its dimension is not known yet.
void check_boundaries(const LineReader &in, const Words &boundaries, const Enclosure &given) {
  if (!boundaries.empty() && boundaries.size() != 3)
    in.fail(JAM_E_FORMAT, "BOX BOUNDS names %zu boundaries instead of three", boundaries.size());
  for (size_t c = 0; c < boundaries.size(); ++c) {
    const bool repeats = boundaries[c] == "pp", closes = c < 3 && given.closes(static_cast<int>(c));
    if (!repeats && !closes)
      in.fail(JAM_E_UNSUPPORTED,
              "the boundary is '%s': the box must be periodic (pp) in every direction, or the options walls and "
              "container name the walls",
              shown(boundaries[c]).c_str());
    if (repeats && closes && c < 2)
      in.fail(JAM_E_FORMAT, "the boundary of %c is 'pp', periodic, but container and walls close it", "xyz"[c]);
  }
}

// behind: the words after `BOX BOUNDS`. Tilts, the bounds then being those of the parallelepiped; or `abc origin`; then
// perhaps a boundary for each direction.
Box read_box(LineReader &in, Words behind, const Enclosure &given) {
  const bool general = behind.size() >= 2 && behind[0] == "abc" && behind[1] == "origin";
  const bool tilted = behind.size() >= 3 && behind[0] == "xy" && behind[1] == "xz" && behind[2] == "yz";
  behind.erase(behind.begin(), behind.begin() + (general ? 2 : tilted ? 3 : 0));
  check_boundaries(in, behind, given);
  std::string_view line;
  Words words;
  std::array<std::array<double, 4>, 3> x{};
  const size_t columns = general ? 4 : tilted ? 3 : 2;
  for (auto &row : x) {
    if (!in.next(line)) in.fail(JAM_E_FORMAT, "the file ends inside the box");
    split(line, words);
    if (words.size() != columns)
      in.fail(JAM_E_FORMAT, "a line of the box has %zu numbers, %zu are needed", words.size(), columns);
    for (size_t c = 0; c < columns; ++c) row[c] = parse_number(in, words[c]);
  }
  Box box;
  box.bounded = !behind.empty();
  box.flat = behind.size() > 2 && behind[2] == "pp";
  if (general) {
    for (size_t r = 0; r < 3; ++r) {
      for (size_t c = 0; c < 3; ++c) box.rows[3 * r + c] = x[r][c];
      box.low[r] = x[r][3];
    }
    return box;
  }
  const double xy = x[0][2], xz = x[1][2], yz = x[2][2];
  x[0][0] -= std::min({0.0, xy, xz, xy + xz});
  x[0][1] -= std::max({0.0, xy, xz, xy + xz});
  x[1][0] -= std::min(0.0, yz);
  x[1][1] -= std::max(0.0, yz);
  for (size_t c = 0; c < 3; ++c) {
    box.low[c] = x[c][0];
    box.rows[4 * c] = x[c][1] - x[c][0];
    if (!(box.rows[4 * c] > 0.0)) in.fail(JAM_E_FORMAT, "the box has no extent along %c", "xyz"[c]);
  }
  box.rows[3] = xy;
  box.rows[6] = xz;
  box.rows[7] = yz;
  return box;
}

struct DumpColumns {
  size_t total = 0, id = 0, count = 0;  // count: of coordinates
  bool has_id = false, scaled = false;
  std::array<size_t, 3> axis{};
  SizeColumn size;
  std::vector<std::string> unread;
};

DumpColumns read_columns(const LineReader &in, const Words &names) {
  DumpColumns columns;
  columns.total = names.size();
  const auto place = [&](const std::string &name) {
    return static_cast<size_t>(std::find(names.begin(), names.end(), name) - names.begin());
  };
  std::vector<bool> used(names.size(), false);
  for (const char *kind : {"", "u", "s", "su"}) {  // x in the box, unwrapped, over the edges, both
    while (columns.count < 3) {
      const size_t at = place("xyz"[columns.count] + std::string(kind));
      if (at == names.size()) break;
      columns.axis[columns.count++] = at;
    }
    if (columns.count >= 2) {
      columns.scaled = kind[0] == 's';
      break;
    }
    columns.count = 0;
  }
  if (columns.count < 2)
    in.fail(JAM_E_FORMAT, "the columns have no positions: x y z, xu yu zu, xs ys zs or xsu ysu zsu are needed");
  for (size_t c = 0; c < columns.count; ++c) used[columns.axis[c]] = true;
  for (size_t k = 0; k < names.size(); ++k) {
    if (used[k] || columns.size.take(in, names[k], k)) continue;
    if (names[k] == "id") {
      columns.has_id = true;
      columns.id = k;
    } else {
      columns.unread.emplace_back(names[k]);
    }
  }
  if (!columns.size.found())
    in.fail(JAM_E_FORMAT, "the columns have no sizes: dump id radius x y z (or diameter) with LAMMPS");
  return columns;
}

// How finely a file writes fractions of the edges: to as many decimals, or to as many digits, as its longest one has.
class Fineness {
 public:
  void look_at(std::string_view word) {
    word = word.substr(0, word.find_first_of("eEdD"));
    const size_t point = std::min(word.find('.'), word.size()), first = word.find_first_of("123456789");
    decimals_ = std::max(decimals_, static_cast<int>(word.size() - std::min(point + 1, word.size())));
    if (first != std::string_view::npos)
      digits_ = std::max(digits_, static_cast<int>(word.size() - first - (first < point && point < word.size())));
  }
  // Half a unit of the last digit of x, 0 < x < 1.
  double half_unit(double x) const {
    double leading = 1.0;
    while (leading > x) leading /= 10.0;
    return 0.5 * std::max(math::pow(10.0, -decimals_), leading * math::pow(10.0, 1 - digits_));
  }

 private:
  int decimals_ = 0, digits_ = 0;
};

void read_atoms(LineReader &in, int64_t n, const Box &box, const DumpColumns &columns, FileContent &content) {
  Rows rows(in, false);
  Words words;
  std::vector<double> position;  // fractions are measured from the corner of the box, other coordinates are not
  std::vector<int64_t> ids;
  Fineness fineness;
  for (int64_t k = 0; k < n; ++k) {
    if (!rows.next(words)) ends_early(in, k, n);
    if (words.size() != columns.total)
      in.fail(JAM_E_FORMAT, "%zu columns, ITEM: ATOMS names %zu", words.size(), columns.total);
    std::array<double, 3> x{};
    for (size_t c = 0; c < columns.count; ++c) {
      x[c] = parse_number(in, words[columns.axis[c]]);
      if (columns.scaled) fineness.look_at(words[columns.axis[c]]);
    }
    for (size_t c = 0; c < 3; ++c)
      position.push_back(columns.scaled ? x[0] * box.rows[c] + x[1] * box.rows[3 + c] + x[2] * box.rows[6 + c] : x[c]);
    content.diameter.push_back(columns.size.diameter(in, words));
    if (columns.has_id) ids.push_back(parse_count(in, words[columns.id], "the number of an atom"));
  }
  const double low = box.low[2], edge = box.rows[8], rounding = 4.0 * std::numeric_limits<double>::epsilon();
  content.knows_origin = true;
  if (columns.count == 2)  // z is 0
    take_plane(position, -1.0, 1.0, content);
  else if (columns.scaled && -low > 0.0 && -low < edge)
    take_plane(position, 0.0, edge, content, -low, (fineness.half_unit(-low / edge) + rounding) * edge);
  else
    take_plane(position, low, low + edge, content);
  if (!columns.scaled) measure_from_corner(&box.low[0], content);
  if (!std::is_sorted(ids.begin(), ids.end())) {
    content.notes.say("the ids of the dump do not count up: spheres keep its order, ids are not kept");
    std::sort(ids.begin(), ids.end());
  }
  const auto twice = std::adjacent_find(ids.begin(), ids.end());
  if (twice != ids.end()) in.fail(JAM_E_FORMAT, "atom %lld is there twice", static_cast<long long>(*twice));
}

// The next line that is not blank, with its words; false at the end of the file.
bool next_words(LineReader &in, std::string_view &line, Words &words) {
  if (!in.next_filled(line)) return false;
  split(line, words);
  return true;
}

// Frame k; false at the end of the file.
bool read_frame(LineReader &in, const Enclosure &given, FileContent &content) {
  std::string_view line;
  Words words;
  int64_t n = -1;
  Box box;
  bool begun = false, has_box = false;
  while (next_words(in, line, words)) {
    if (words[0] != "ITEM:" || words.size() < 2)
      in.fail(JAM_E_FORMAT, "'%s' where a line of ITEM: is needed%s", shown(line).c_str(),
              begun ? "" : "; there may be more atoms than NUMBER OF ATOMS says");
    const std::string item(words[1]);
    begun = true;
    if (item == "TIMESTEP" || item == "TIME" || item == "UNITS") {
      if (!in.next(line)) in.fail(JAM_E_FORMAT, "the file ends after ITEM: %s", item.c_str());
    } else if (item == "NUMBER" && words.size() == 4 && words[3] == "ATOMS") {
      if (n >= 0) in.fail(JAM_E_FORMAT, "NUMBER OF ATOMS is given twice in one frame");
      if (!next_words(in, line, words)) in.fail(JAM_E_FORMAT, "the file ends before the number of atoms");
      n = take_count_of_frame(in, parse_count(in, words[0], "a number of atoms"));
    } else if (item == "BOX" && words.size() >= 3 && words[2] == "BOUNDS") {
      if (has_box) in.fail(JAM_E_FORMAT, "BOX BOUNDS are given twice in one frame");
      const std::string kept(line);
      split(kept, words);
      box = read_box(in, Words(words.begin() + 3, words.end()), given);
      has_box = true;
    } else if (item == "ATOMS") {
      if (n < 0 || !has_box) in.fail(JAM_E_FORMAT, "NUMBER OF ATOMS and BOX BOUNDS must come before ITEM: ATOMS");
      const std::string names(line);
      split(names, words);
      if (n == 0) return true;
      const DumpColumns columns = read_columns(in, Words(words.begin() + 2, words.end()));
      read_atoms(in, n, box, columns, content);
      if (content.dim == 3 && box.flat && given.closes(2))
        in.fail(JAM_E_FORMAT, "the boundary of z is 'pp', periodic, but container and walls close it");
      content.knows_walls = box.bounded;
      content.enclosure = given;
      take_cell_of_lammps(in, box.rows, content);
      say_unread(content, columns.unread);
      return true;
    } else {
      in.fail(JAM_E_UNSUPPORTED, "'%s' is no part of a dump of atoms", shown(line).c_str());
    }
  }
  if (begun) in.fail(JAM_E_FORMAT, "the file ends before ITEM: ATOMS");
  return false;
}

}  // namespace

FileContent read_dump(LineReader &in, const ReadOptions &options) {
  return choose_frame(in, options.frame,
                      [&](FileContent &content, int64_t) { return read_frame(in, options.enclosure, content); });
}

}  // namespace jam::inside
