#include "io/formats.hpp"

#include <algorithm>

#include "core/decimal.hpp"
#include "io/read_helpers.hpp"

namespace jam::inside {
namespace {
using Words = std::vector<std::string_view>;

template <size_t N>
bool begins(const Head &h, const char (&bytes)[N], size_t at = 0) {
  return h.bytes.size() >= at + N - 1 && h.bytes.compare(at, N - 1, bytes, N - 1) == 0;
}

bool first_word_is_one_of(const Head &h, std::initializer_list<std::string_view> names) {
  const Words words = h.words(h.first);
  return !words.empty() && std::find(names.begin(), names.end(), words[0]) != names.end();
}

bool all_numbers(const Words &words) { return std::all_of(words.begin(), words.end(), is_number); }

// Line k, counted from the first one that says something, is one whole number.
bool count_at(const Head &h, size_t k) {
  const Words words = h.words(h.first + k);
  return words.size() == 1 && is_count(words[0]);
}

// The header of LAMMPS data, under any name and title.
bool is_lammps_data(const Head &h) {
  if (first_word_is_one_of(h, {"LAMMPS"})) return true;
  for (size_t k = 1; k < h.lines.size(); ++k) {
    const Words words = h.words(k);
    if (words.size() >= 4 && (words[2] == "xlo" || words[3] == "avec")) return true;
    if (words.size() >= 2 && is_count(words[0]) && words[1] == "atoms" && !count_at(h, 0)) return true;
  }
  return false;
}

bool has_keys(const Head &h) {
  return count_at(h, 0) && h.lines.size() > h.first + 1 && h.lines[h.first + 1].find('=') != std::string_view::npos;
}

bool is_skoge_donev(const Head &h) {
  const Words counts = h.words(h.first + 1);
  return count_at(h, 0) && counts.size() == 2 && is_count(counts[0]) && is_count(counts[1]);
}

bool is_edmd(const Head &h) {
  const Words edges = h.words(h.first + 1), row = h.words(h.first + 2);
  return count_at(h, 0) && edges.size() == 3 && all_numbers(edges) && row.size() == 5 && !is_number(row[0]);
}

// A count, then any text, then rows.
bool is_basic_xyz(const Head &h) { return count_at(h, 0) && !count_at(h, 1) && h.words(h.first + 2).size() >= 4; }

bool is_plain(const Head &h) { return count_at(h, 0); }

// Whether the words are a count, a time and two corners of a box.
bool begins_frame_of_mercury(const Words &words) {
  const size_t d = words.size() / 2 - 1;
  bool wide = is_count(words[0]);
  for (size_t c = 0; c < d; ++c) {
    double low = 0.0, high = 0.0;
    from_decimal(words[2 + c], low);
    from_decimal(words[2 + d + c], high);
    wide = wide && high > low;
  }
  return wide;
}

// The head of a frame; then rows of fourteen numbers, in d = 2 of eight, or after an empty frame the next head. A table
// whose first column begins with 0 looks like the latter, but has no box.
bool is_mercury(const Head &h) {
  const Words header = h.words(h.first), row = h.words(h.first + 1);
  if ((header.size() != 6 && header.size() != 8) || !is_count(header[0]) || !all_numbers(header) || !all_numbers(row))
    return false;
  if (row.size() == header.size())
    return header[0] == "0" && begins_frame_of_mercury(header) && begins_frame_of_mercury(row);
  return row.size() == (header.size() == 6 ? 8 : 14);
}

// Rows of numbers, perhaps under a line that names the columns.
bool is_table(const Head &h) {
  if (h.first == h.lines.size()) return false;
  std::string line(h.lines[h.first]);
  std::replace(line.begin(), line.end(), ',', ' ');
  Words words;
  split(line, words);
  return all_numbers(words) ? words.size() >= 3 : names_coordinates(h.lines[h.first]);
}

// The same with semicolons, as where a comma is the decimal point.
bool is_semicolon_table(const Head &h) {
  if (h.first == h.lines.size() || h.lines[h.first].find(';') == std::string_view::npos) return false;
  const std::vector<std::string> parts = column_names(h.lines[h.first], ';');
  bool numbers = true;
  for (std::string part : parts) {
    std::replace(part.begin(), part.end(), ',', '.');
    Words words;
    split(part, words);
    numbers = numbers && words.size() == 1 && is_number(words[0]);
    if (names_coordinates(part)) return true;
  }
  return numbers;
}

bool is_binary(const Head &h) { return h.bytes.find('\0') != std::string_view::npos; }

constexpr const char *own_arrays = "read its arrays in Python (numpy, h5py, scipy) and give them to System.from_arrays";
constexpr const char *unpack = "unpack it, then read the content; only gzip is unpacked automatically";
constexpr const char *with_keys =
    "make line 2 Lattice=\"Lx 0 0 0 Ly 0 0 0 Lz\" Properties=species:S:1:pos:R:3:radius:R:1, with the box and the "
    "columns of the file";
constexpr const char *no_diameters = "it has no diameters and few digits; jam.files.read_ase of Python takes diameters";

// Order: bytes that are no text, and VTK, whose arrays may be binary; then text, the particular before the general.
constexpr KnownFile table[] = {
    {"a packing of System.save", [](const Head &h) { return begins(h, "jam packing file"); },
     "jam.load of Python reads it"},
    {"HDF5", [](const Head &h) { return begins(h, "\x89HDF\r\n\x1a\n"); },
     "jam.load of Python reads what System.save wrote; read others with h5py and System.from_arrays"},
    {"GSD of HOOMD-blue", [](const Head &h) { return begins(h, "\xdf\x65\xdf\x65\xdf\x65\xdf\x65"); },
     "System.read of Python reads it where its name ends in .gsd, with Python's package gsd"},
    {"a checkpoint of libjam", [](const Head &h) { return begins(h, "jamstat"); }, "jam_read_checkpoint reads it"},
    {"an array of numpy (npy)", [](const Head &h) { return begins(h, "\x93NUMPY"); }, own_arrays},
    {"a zip archive (or npz of numpy)", [](const Head &h) { return begins(h, "PK\x03\x04"); },
     "unpack it; arrays of an npz go to System.from_arrays in Python"},
    {"packed twice by gzip", [](const Head &h) { return begins(h, "\x1f\x8b"); }, unpack},
    {"packed by bzip2", [](const Head &h) { return begins(h, "BZh"); }, unpack},
    {"packed by xz",
     [](const Head &h) {
       return begins(h,
                     "\xfd"
                     "7zXZ");
     },
     unpack},
    {"packed by zstd", [](const Head &h) { return begins(h, "\x28\xb5\x2f\xfd"); }, unpack},
    {"packed by 7z", [](const Head &h) { return begins(h, "7z\xbc\xaf"); }, unpack},
    {"a tar archive", [](const Head &h) { return begins(h, "ustar", 257); }, unpack},
    {"NetCDF", [](const Head &h) { return begins(h, "CDF\x01") || begins(h, "CDF\x02"); }, own_arrays},
    {"MATLAB", [](const Head &h) { return begins(h, "MATLAB "); }, own_arrays},
    {"a pickle of Python", [](const Head &h) { return begins(h, "\x80\x04\x95") || begins(h, "\x80\x05\x95"); },
     "load it in Python, if you trust it"},
    {"a DCD trajectory", [](const Head &h) { return begins(h, "CORD", 4); }, no_diameters},
    {"a trajectory of GROMACS", [](const Head &h) { return begins(h, "\0\0\x07\xcb") || begins(h, "\0\0\x07\xc9"); },
     no_diameters},
    {"a binary dump of LAMMPS", [](const Head &h) { return begins(h, "DUMPATOM", 8) || begins(h, "DUMPCUSTOM", 8); },
     "let LAMMPS write the dump as text: dump custom with id radius x y z, in a file not named .bin"},
    {"a restart file of LAMMPS", [](const Head &h) { return begins(h, "LammpS RestartT"); },
     "turn it into data: lmp -restart2data FILE out.data"},
    {"a picture or a document", [](const Head &h) { return begins(h, "\x89PNG") || begins(h, "%PDF"); },
     "it contains no packing"},
    {"text in UTF-16", [](const Head &h) { return begins(h, "\xff\xfe") || begins(h, "\xfe\xff"); },
     "save it as plain text (ASCII or UTF-8)"},
    {"VTK", [](const Head &h) { return begins(h, "# vtk") || begins(h, "<?xml") || begins(h, "<VTKFile"); },
     "such files are written only: write extended XYZ beside them"},
    {"a binary file of an unknown format", is_binary, own_arrays},
    {"a LAMMPS dump", [](const Head &h) { return first_word_is_one_of(h, {"ITEM:"}); }, nullptr},
    {"LAMMPS data", is_lammps_data, nullptr},
    {"extended XYZ", has_keys, nullptr},
    {"a file of the code of Skoge and Donev", is_skoge_donev,
     "of equal spheres `sed -e 2d -e 5,6d FILE` makes plain text: dimension, number, diameter, then the positions; "
     "with "
     "several species give positions, and the diameters of each species, to System.from_arrays in Python"},
    {"a snapshot of EDMD (.sph)", is_edmd, with_keys},
    {"particle input of MFIX", [](const Head &h) { return begins(h, "Version 2.0") || begins(h, "Version 3.0"); },
     "its rows are a table: take away the lines above them (`sed 1,34d FILE` in version 2.0), and name the columns by "
     "the option columns"},
    {"XYZ without keys on line 2", is_basic_xyz, with_keys},
    {"plain text", is_plain, nullptr},
    {"PDB",
     [](const Head &h) {
       return first_word_is_one_of(h, {"HEADER", "ATOM", "HETATM", "CRYST1", "REMARK", "MODEL", "COMPND"});
     },
     no_diameters},
    {"CIF", [](const Head &h) { return begins(h, "data_"); }, no_diameters},
    {"a page in HTML", [](const Head &h) { return begins(h, "<!") || begins(h, "<html"); },
     "a page only shows a packing: read the packing file that was written with it"},
    {"JSON", [](const Head &h) { return begins(h, "{") || begins(h, "["); },
     "it contains no packing: read the packing file that was written with it"},
    {"a table whose columns are parted by semicolons", is_semicolon_table,
     "part them by commas, with decimal points: sed -e 's/,/./g' -e 's/;/,/g' FILE"},
    {"data of MercuryDPM", is_mercury, nullptr},
    {"a table of columns", is_table, nullptr},
    {"LAMMPS data", [](const Head &h) { return h.ending == "data" || h.ending == "lmp"; }, nullptr},
};

}  // namespace

Head::Head(std::string_view start, std::string_view name_ending) : bytes(start), ending(name_ending) {
  constexpr size_t most = 100;  // lines: more than the header of LAMMPS data has
  while (!start.empty() && lines.size() < most) {
    const size_t stop = std::min(start.find_first_of("\r\n"), start.size());
    lines.push_back(start.substr(0, stop));
    start.remove_prefix(std::min(stop + (start.compare(stop, 2, "\r\n") == 0 ? 2 : 1), start.size()));
  }
  while (first < lines.size() && words(first).empty()) ++first;
}

std::vector<std::string_view> Head::words(size_t k) const {
  Words found;
  if (k < lines.size()) split(before_comment(lines[k]), found);
  return found;
}

const KnownFile *recognise(const Head &head) {
  for (const KnownFile &row : table)
    if (row.is(head)) return &row;
  return nullptr;
}

}  // namespace jam::inside
