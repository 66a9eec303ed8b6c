// The one table of the formats of files: readers, writers, error texts, the program and Python go by its rows.
#pragma once
#include <array>

#include "io/files.hpp"
#include "io/output_file.hpp"
#include "io/text.hpp"

namespace jam::inside {

class LineReader;
class OutputFile;

// What a file contains.
enum class Content { packing, contacts, image };

// What a file of a format can store beside positions and diameters. Cells: other than cubes.
namespace stores {
constexpr uint32_t walls = 1, cells = 2, non_additivity = 4, density = 8, scene = walls | cells | non_additivity;
}

struct Format {
  Content content;
  int32_t number;       // jam_format or jam_contact_format; 0: it cannot be chosen by number
  const char *word;     // one word for it, as in the enum
  const char *name;     // in sentences
  const char *endings;  // of names, parted by blanks; "-" is a name without an ending
  int most_dim;
  uint32_t what;                                           // sum of `stores`
  bool frames;                                             // a file may contain several packings
  FileContent (*read)(LineReader &, const ReadOptions &);  // NULL: written only
  void (*write)(const Packing &, const Beside &, OutputFile &);
  void (*write_contacts)(const Packing &, const ContactNetwork &, OutputFile &);
};

// The row of this name, which must be there.
const Format &format_of_name(const char *name);
// The row to write `content` by: that of the number, or for 0 that of the ending of `path`. JAM_E_ARGUMENT, naming all
// endings, where none fits.
const Format &format_to_write(Content content, const char *path, int32_t number);
// JAM_E_UNSUPPORTED, naming the formats that can, where this one cannot hold the packing: nothing is left out.
void check_fits(const Packing &p, const Format &format, double density = 1.0);
// All rows as text: see jam_formats in jam.h.
const char *formats_text();

// The one table of what begins a file: formats that are read, and others, each with its way out.

// The beginning of a file, as text where it is text.
struct Head {
  std::string_view bytes;
  std::vector<std::string_view> lines;  // the first ones, without their ends
  std::string_view ending;              // of the file's name
  size_t first = 0;                     // the first line that is neither blank nor a comment
  explicit Head(std::string_view start, std::string_view name_ending);
  // The words of line k before its comment, none beyond the last line.
  std::vector<std::string_view> words(size_t k) const;
};

struct KnownFile {
  const char *name;  // of a row of formats.cpp, where the file is read
  bool (*is)(const Head &);
  const char *way_out;  // NULL: it is read
};

// The first row of the table that fits; NULL when none does.
const KnownFile *recognise(const Head &head);

// The writers of the table of formats (formats.cpp).
void write_plain(const Packing &p, const Beside &beside, OutputFile &file);
void write_xyz(const Packing &p, const Beside &beside, OutputFile &file);
void write_lammps(const Packing &p, const Beside &beside, OutputFile &file);
void write_points(const Packing &p, const Beside &beside, OutputFile &file);  // VTP

void write_contacts_csv(const Packing &p, const ContactNetwork &net, OutputFile &file);
void write_contacts_dump(const Packing &p, const ContactNetwork &net, OutputFile &file);
void write_contacts_vtp(const Packing &p, const ContactNetwork &net, OutputFile &file);

// What LAMMPS calls the box: one place for its data files and its dumps.

// How the titles of our data files begin. Such a file has no place for walls but its title, where LAMMPS takes any
// text.
constexpr std::string_view lammps_title = "LAMMPS data file by libjam";

// The cell vectors are (x, 0, 0), (xy, y, 0), (xz, yz, z): our lower triangle. In d = 2 z goes from -1/2 to 1/2 of
// V^(1/2), and all spheres lie at z = 0.
struct LammpsBox {
  std::array<double, 3> low{}, high{}, tilt{};  // tilt: xy, xz, yz
  bool tilted = false;
};
LammpsBox lammps_box(const Packing &p);  // of d = 2 and 3

}  // namespace jam::inside
