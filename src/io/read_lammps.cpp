// LAMMPS data files of atom_style sphere.
#include <algorithm>
#include <array>

#include "core/cell_reduction.hpp"
#include "io/read_helpers.hpp"

namespace jam {
namespace {

// A line without its comment; false at the end of the file.
bool next_line(LineReader &in, std::string_view &line, std::vector<std::string_view> &words) {
  while (in.next(line)) {
    split(line.substr(0, line.find('#')), words);
    if (!words.empty()) return true;
  }
  return false;
}

struct Header {
  int64_t atoms = -1;
  std::array<double, 3> low{-0.5, -0.5, -0.5}, high{0.5, 0.5, 0.5}, tilt{};  // as LAMMPS takes what is not named
};

// A line of the header; false: it is the name of a section.
bool take_header(const LineReader &in, const std::vector<std::string_view> &words, Header &header) {
  static constexpr std::string_view lows[] = {"xlo", "ylo", "zlo"}, highs[] = {"xhi", "yhi", "zhi"};
  const bool number = words[0].find_first_not_of("+-.0123456789eE") == std::string_view::npos;
  if (!number) return false;
  if (words.size() == 2 && words[1] == "atoms") {
    header.atoms = take_count(in, parse_count(in, words[0], "a number of atoms"));
  } else if (words.size() == 4) {
    for (size_t c = 0; c < 3; ++c)
      if (words[2] == lows[c] && words[3] == highs[c]) {
        header.low[c] = parse_number(in, words[0]);
        header.high[c] = parse_number(in, words[1]);
        if (!(header.high[c] > header.low[c])) in.fail(JAM_E_FORMAT, "the box has no extent along %c", "xyz"[c]);
      }
  } else if (words.size() == 6 && words[3] == "xy" && words[4] == "xz" && words[5] == "yz") {
    for (size_t c = 0; c < 3; ++c) header.tilt[c] = parse_number(in, words[c]);
  }
  return true;  // other counts, of types and bonds, say nothing about spheres
}

struct Atom {
  int64_t id;
  double diameter;
  std::array<double, 3> x;
};

// id, type, diameter, density, x, y, z and perhaps three image counts.
std::vector<Atom> read_atoms(LineReader &in, int64_t n) {
  std::vector<Atom> atoms;
  std::string_view line;
  std::vector<std::string_view> words;
  for (int64_t k = 0; k < n; ++k) {
    if (!next_line(in, line, words)) ends_early(in, k, n);
    if (words.size() != 7 && words.size() != 10)
      in.fail(JAM_E_FORMAT, "%zu columns, atom_style sphere has 7 or, with image counts, 10", words.size());
    Atom atom{parse_count(in, words[0], "the number of an atom"), positive(in, words[2], "diameter"), {}};
    for (size_t c = 0; c < 3; ++c) atom.x[c] = parse_number(in, words[4 + c]);
    atoms.push_back(atom);
  }
  std::sort(atoms.begin(), atoms.end(), [](const Atom &a, const Atom &b) { return a.id < b.id; });
  for (size_t k = 1; k < atoms.size(); ++k)
    if (atoms[k].id == atoms[k - 1].id)
      in.fail(JAM_E_FORMAT, "atom %lld is there twice", static_cast<long long>(atoms[k].id));
  return atoms;
}

// Two dimensions when all spheres lie at z = 0, as LAMMPS demands of them.
FileContent make_content(const LineReader &in, const Header &header, const std::vector<Atom> &atoms) {
  FileContent content;
  const bool flat = std::all_of(atoms.begin(), atoms.end(), [](const Atom &a) { return a.x[2] == 0.0; });
  content.dim = flat && header.low[2] < 0.0 && header.high[2] > 0.0 ? 2 : 3;
  const size_t d = static_cast<size_t>(content.dim);
  std::array<double, 3> edge;
  for (size_t c = 0; c < 3; ++c) edge[c] = header.high[c] - header.low[c];
  const std::array<double, 9> rows{edge[0], 0, 0, header.tilt[0], edge[1], 0, header.tilt[1], header.tilt[2], edge[2]};
  bool cube = true;
  for (size_t r = 0; r < d; ++r)
    for (size_t c = 0; c < d; ++c) {
      content.cell.push_back(rows[3 * r + c]);
      cube = cube && rows[3 * r + c] == (r == c ? edge[0] : 0.0);
    }
  if (cube) {
    content.cell.clear();
    content.box = edge[0];
    at_line(in, [&] { check_box(edge[0]); });
  } else {
    at_line(in, [&] { reduce_cell(content.dim, content.cell.data()); });
  }
  for (const Atom &atom : atoms) {
    content.diameter.push_back(atom.diameter);
    for (size_t c = 0; c < d; ++c) content.position.push_back(atom.x[c] - header.low[c]);
  }
  return content;
}

}  // namespace

FileContent read_lammps(LineReader &in) {
  Header header;
  std::string_view line;
  std::vector<std::string_view> words;
  while (next_line(in, line, words)) {
    if (take_header(in, words, header)) continue;
    if (words[0] != "Atoms") continue;  // other sections, with their lines
    const size_t comment = line.find('#');
    std::vector<std::string_view> style;
    if (comment != std::string_view::npos) split(line.substr(comment + 1), style);
    if (!style.empty() && style[0] != "sphere")
      in.fail(JAM_E_UNSUPPORTED, "atom_style '%s' has no diameters: write the data with atom_style sphere",
              shown(style[0]).c_str());
    if (header.atoms < 0) in.fail(JAM_E_FORMAT, "no line '<N> atoms' stands before the atoms");
    return make_content(in, header, read_atoms(in, header.atoms));
  }
  in.fail(JAM_E_FORMAT, "the file ends before the section Atoms");
}

}  // namespace jam
