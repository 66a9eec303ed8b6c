// LAMMPS data files of the atom styles that have diameters.
#include <algorithm>

#include "io/formats.hpp"
#include "io/read_helpers.hpp"

namespace jam::inside {
namespace {
using Words = std::vector<std::string_view>;

struct Header {
  int64_t atoms = -1, types = -1;
  std::array<double, 3> low{}, high{}, tilt{};
  std::array<double, 9> general{};  // avec, bvec, cvec
  std::array<bool, 3> bounds{}, vectors{};
  bool tilted = false;
};

// Counts that a header may hold besides that of the atoms; those of `shapes` must be 0.
constexpr std::string_view counts[] = {"bonds", "angles", "dihedrals", "impropers"},
                           shapes[] = {"ellipsoids", "lines", "triangles", "bodies"},
                           kinds[] = {"atom", "bond", "angle", "dihedral", "improper"};
template <size_t N>
bool is_one_of(std::string_view word, const std::string_view (&list)[N]) {
  return std::find(list, list + N, word) != list + N;
}

bool matches(const Words &words, size_t at, std::initializer_list<std::string_view> names) {
  return words.size() >= at + names.size() &&
         std::equal(names.begin(), names.end(), words.begin() + static_cast<std::ptrdiff_t>(at));
}

void once(const LineReader &in, bool already, const char *what) {
  if (already) in.fail(JAM_E_FORMAT, "%s is given twice in the header", what);
}

// Takes a line of the header. Returns how many of its words were understood, 0 for none: LAMMPS takes text behind them.
size_t take_header(const LineReader &in, const Words &words, Header &header) {
  static constexpr std::string_view lows[] = {"xlo", "ylo", "zlo"}, highs[] = {"xhi", "yhi", "zhi"},
                                    vectors[] = {"avec", "bvec", "cvec"};
  const auto number = [&](size_t k) { return parse_number(in, words[k]); };
  for (size_t c = 0; c < 3; ++c) {
    if (matches(words, 2, {lows[c], highs[c]})) {
      once(in, header.bounds[c], "a bound of the box");
      header.low[c] = number(0);
      header.high[c] = number(1);
      header.bounds[c] = true;
      if (!(header.high[c] > header.low[c])) in.fail(JAM_E_FORMAT, "the box has no extent along %c", "xyz"[c]);
      return 4;
    }
    if (matches(words, 3, {vectors[c]})) {
      once(in, header.vectors[c], "a cell vector");
      for (size_t k = 0; k < 3; ++k) header.general[3 * c + k] = number(k);
      header.vectors[c] = true;
      return 4;
    }
  }
  if (matches(words, 3, {"xy", "xz", "yz"})) {
    once(in, header.tilted, "the tilt");
    for (size_t c = 0; c < 3; ++c) header.tilt[c] = number(c);
    header.tilted = true;
    return 6;
  }
  if (matches(words, 3, {"abc", "origin"})) {
    for (size_t c = 0; c < 3; ++c) header.low[c] = number(c);
    return 5;
  }
  if (words.size() < 2 || !is_count(words[0])) return 0;
  if (words[1] == "atoms") {
    once(in, header.atoms >= 0, "the number of atoms");
    header.atoms = take_count(in, parse_count(in, words[0], "a number of atoms"));
    return 2;
  }
  if (is_one_of(words[1], shapes) && parse_count(in, words[0], "a number") != 0)
    in.fail(JAM_E_UNSUPPORTED, "%s are no spheres", shown(words[1]).c_str());
  if (is_one_of(words[1], counts) || is_one_of(words[1], shapes)) return 2;
  if (matches(words, 1, {"extra"}) && words.size() >= 5) return words.size();
  if (words.size() < 3 || !is_one_of(words[1], kinds) || words[2] != "types") return 0;
  if (words[1] == "atom") header.types = parse_count(in, words[0], "a number of types");
  return 3;
}

bool is_section(const Words &words) {
  static constexpr std::string_view names =
      " Atoms Velocities Masses Ellipsoids Lines Triangles Bodies Bonds Angles Dihedrals Impropers Pair PairIJ Bond "
      "Angle Dihedral Improper Atom BondBond BondAngle AngleAngle AngleAngleTorsion MiddleBondTorsion EndBondTorsion "
      "AngleTorsion BondBond13 CMAP ";
  const std::string name = " " + std::string(words[0]) + " ";
  return names.find(name) != names.npos && (words.size() == 1 || !is_number(words[1]));
}

// Atom styles whose spheres have diameters: the columns of a row without image counts, and where it has what.
struct Style {
  std::string_view name;
  size_t columns, type, diameter, density, x;
};
constexpr Style styles[] = {{"sphere", 7, 1, 2, 3, 4}, {"bpm/sphere", 8, 2, 3, 4, 5}};

struct Atom {
  int64_t id;
  double diameter;
  std::array<double, 3> x;
};

// The style behind `Atoms #`; that of granular matter where none is named.
const Style &find_style(const LineReader &in, std::string_view line, bool &named) {
  Words words;
  const size_t comment = line.find('#');
  if (comment != std::string_view::npos) split(line.substr(comment + 1), words);
  named = !words.empty();
  if (!named) return styles[0];
  for (const Style &style : styles)
    if (style.name == words[0]) return style;
  in.fail(JAM_E_UNSUPPORTED, "atom_style '%s' has no diameters: write the data with atom_style sphere",
          shown(words[0]).c_str());
}

// Rows of a section without a name that may be those of atom_style full: there the third column is a type.
class StyleDoubt {
 public:
  explicit StyleDoubt(int64_t types) : types_(types) {}
  void look(const LineReader &in, const Words &words) {
    if (!is_count(words[1])) in.fail(JAM_E_FORMAT, "'%s' is not an atom type", shown(words[1]).c_str());
    const int64_t type = parse_count(in, words[1], "a type");
    if (types_ > 0 && (type < 1 || type > types_))
      in.fail(JAM_E_FORMAT, "the type %lld is not one of the %lld types of the header: is the atom_style sphere?",
              static_cast<long long>(type), static_cast<long long>(types_));
    if (!is_count(words[2])) return void(sure_ = true);
    const int64_t third = parse_count(in, words[2], "a number");
    sure_ = sure_ || third < 1 || (types_ > 0 && third > types_);
  }
  bool sure() const { return sure_; }

 private:
  int64_t types_;
  bool sure_ = false;
};

// The rows of the section Atoms: id, type, diameter, density, x, y, z and perhaps three image counts.
std::vector<Atom> read_atoms(LineReader &in, const Header &header, const Style &style, bool named, Notes &notes) {
  std::vector<Atom> atoms;
  Words words;
  Rows rows(in, true);
  StyleDoubt doubt(header.types);
  double first_density = 0.0;
  bool densities_differ = false;
  for (int64_t k = 0; k < header.atoms; ++k) {
    if (!rows.next(words)) ends_early(in, k, header.atoms);
    if (words.size() != style.columns && words.size() != style.columns + 3)
      in.fail(JAM_E_FORMAT, "%zu columns, atom_style %s has %zu or, with image counts, %zu", words.size(),
              std::string(style.name).c_str(), style.columns, style.columns + 3);
    if (!named) doubt.look(in, words);
    for (size_t c = style.columns; c < words.size(); ++c) parse_count(in, words[c], "an image count");
    const double density = parse_number(in, words[style.density]);
    if (k == 0) first_density = density;
    densities_differ = densities_differ || density != first_density;
    if (!(density > 0.0))
      in.fail(JAM_E_FORMAT, "the density is '%s', it must be positive: is the atom_style sphere?",
              shown(words[style.density]).c_str());
    Atom atom{parse_count(in, words[0], "the number of an atom"), positive(in, words[style.diameter], "diameter"), {}};
    for (size_t c = 0; c < 3; ++c) atom.x[c] = parse_number(in, words[style.x + c]);
    atoms.push_back(atom);
  }
  if (!named && !doubt.sure())
    in.fail(JAM_E_FORMAT,
            "the section Atoms names no style, and its rows may be those of sphere or of full: write 'Atoms # sphere'");
  const auto by_id = [](const Atom &a, const Atom &b) { return a.id < b.id; };
  if (!std::is_sorted(atoms.begin(), atoms.end(), by_id)) notes.say("the atoms were sorted by their ids");
  std::sort(atoms.begin(), atoms.end(), by_id);
  for (size_t k = 1; k < atoms.size(); ++k)
    if (atoms[k].id == atoms[k - 1].id)
      in.fail(JAM_E_FORMAT, "atom %lld is there twice", static_cast<long long>(atoms[k].id));
  if (densities_differ) notes.say("the densities of the atoms were not read: masses are equal, or as the volumes");
  if (!named) notes.warn("the section Atoms names no style: atom_style sphere was assumed");
  return atoms;
}

// The rows of the cell vectors. Bounds that are missing would be taken as -0.5 and 0.5 by LAMMPS.
std::array<double, 9> cell_rows(const LineReader &in, Header &header, bool flat) {
  const auto &v = header.vectors;
  if (v[0] || v[1] || v[2]) {
    if (header.tilted || header.bounds[0] || header.bounds[1] || header.bounds[2] || !(v[0] && v[1] && v[2]))
      in.fail(JAM_E_FORMAT, "the header needs avec, bvec and cvec, or xlo xhi, ylo yhi and zlo zhi, not parts of both");
    return header.general;
  }
  for (size_t c = 0; c < 3; ++c) {
    if (header.bounds[c]) continue;
    if (c < 2 || !flat) in.fail(JAM_E_FORMAT, "the header has no line '<low> <high> %clo %chi'", "xyz"[c], "xyz"[c]);
    header.low[c] = -0.5, header.high[c] = 0.5;
  }
  const auto &t = header.tilt;
  std::array<double, 3> edge;
  for (size_t c = 0; c < 3; ++c) edge[c] = header.high[c] - header.low[c];
  return {edge[0], 0, 0, t[0], edge[1], 0, t[1], t[2], edge[2]};
}

// Two dimensions when all spheres lie at z = 0, as LAMMPS demands of them.
void make_content(const LineReader &in, Header &header, const std::vector<Atom> &atoms, FileContent &content) {
  const bool flat = std::all_of(atoms.begin(), atoms.end(), [](const Atom &a) { return a.x[2] == 0.0; });
  const std::array<double, 9> cell = cell_rows(in, header, flat);
  std::vector<double> position;
  for (const Atom &atom : atoms) {
    content.diameter.push_back(atom.diameter);
    position.insert(position.end(), atom.x.begin(), atom.x.end());
  }
  const double low = header.low[2];
  if (header.vectors[0])  // the plane z = 0 itself, between its images
    take_plane(position, -1.0, cell[2] == 0.0 && cell[5] == 0.0 && cell[6] == 0.0 && cell[7] == 0.0 ? 1.0 : -1.0,
               content);
  else
    take_plane(position, low, low + cell[8], content);
  measure_from_corner(&header.low[0], content);
  content.knows_origin = true;
  take_cell_of_lammps(in, cell, content);
}

// Skips the rows of a section; true with the name of the next one in `line` and `words`.
bool skip_section(LineReader &in, std::string_view &line, Words &words, const std::string &name, int64_t atoms) {
  while (next_text(in, line, words)) {
    if (is_section(words)) return true;
    if (name == "Atoms")
      in.fail(JAM_E_FORMAT, "there is more after the %lld atoms that the header announces: '%s'",
              static_cast<long long>(atoms), shown(line).c_str());
  }
  return false;
}

// Walls in a title of ours: the number of axes that walls= names, 0 without walls.
size_t read_title(const LineReader &in, const std::string &title, Enclosure &enclosure) {
  if (title.compare(0, lammps_title.size(), lammps_title) != 0) return 0;
  CommentKeys keys(in, title);
  return read_container(in, keys, enclosure);
}

}  // namespace

FileContent read_lammps(LineReader &in, const ReadOptions &) {  // walls: by our title, or not at all
  FileContent content;
  Header header;
  std::string_view line;
  Words words;
  in.next(line);  // the title, which may say anything or nothing
  const std::string title(line);
  const size_t axes = read_title(in, title, content.enclosure);
  content.knows_walls = title.compare(0, lammps_title.size(), lammps_title) == 0;
  bool more = next_text(in, line, words);
  for (; more && !is_section(words); more = next_text(in, line, words)) {
    const size_t understood = take_header(in, words, header);
    if (understood == 0)
      in.fail(JAM_E_FORMAT, "'%s' is no line of a header of LAMMPS data and no section", shown(line).c_str());
    if (understood < words.size())
      content.notes.say("line %lld: text behind '%s' was not read", static_cast<long long>(in.number()),
                        shown(words[understood - 1]).c_str());
  }
  std::vector<Atom> atoms;
  std::string unread;
  while (more) {
    std::string name;
    for (const std::string_view word : words) name += (name.empty() ? "" : " ") + std::string(word);
    if (name == "Atoms") {
      if (header.atoms < 0) in.fail(JAM_E_FORMAT, "there is no line '<N> atoms' before the atoms");
      if (!atoms.empty()) in.fail(JAM_E_FORMAT, "the file has a second section Atoms");
      bool named = false;
      const Style &style = find_style(in, line, named);
      atoms = read_atoms(in, header, style, named, content.notes);
    } else {
      unread += (unread.empty() ? "" : ", ") + shown(name);
    }
    more = skip_section(in, line, words, name, header.atoms);
  }
  if (atoms.empty()) in.fail(JAM_E_FORMAT, "the file ends before the section Atoms");
  if (!unread.empty()) content.notes.say("sections of the file that were not read: %s", unread.c_str());
  make_content(in, header, atoms, content);
  if (axes > 0 && axes != static_cast<size_t>(content.dim))
    fail(JAM_E_FORMAT, "%s line 1: walls has %zu words, %d are needed", in.path().c_str(), axes, content.dim);
  return content;
}

}  // namespace jam::inside
