// Files of packings and of contact networks (see jam_format and jam_contact_format in jam.h).
#pragma once
#include "core/notes.hpp"
#include "network/contact_network.hpp"

namespace jam::inside {

// What a file says, checked line by line but not yet for overlaps.
struct FileContent {
  int dim = 0;
  double box = 0.0;             // side of a cube; 0 when the file gives none
  std::vector<double> cell;     // (dim, dim) vectors of a cell that is no cube, else empty
  double non_additivity = 0.0;  // of a non-additive mixture
  bool has_non_additivity = false;
  Enclosure enclosure;           // the walls that the file names, else those of the caller
  bool knows_walls = false;      // file or format say along which axes the packing repeats
  std::vector<double> position;  // (n, dim) as written, not wrapped
  std::vector<double> diameter;  // n, or 1 for all
  std::vector<double> origin;    // what the reader has subtracted from the positions of the file; empty: nothing
  bool knows_origin = false;     // the file says where the corner of its cell is
  GivenDigits given() const;     // of the numbers as they are in the file
  Notes notes;                   // what of the file was dropped, wrapped, sorted or assumed
  bool has_box() const { return box > 0.0 || !cell.empty(); }
};

// What the caller says of a file that does not say it.
struct Layout {
  std::vector<double> cell;          // sides or (dim, dim) components; empty: not said
  std::vector<double> origin;        // where the corner of the cell is in the file; empty: not said
  std::vector<std::string> columns;  // of a table, by name; empty: not said
};
// From the text of jam_read_as. JAM_E_ARGUMENT names the word that does not fit.
Layout layout_of(const std::string &text);

// What a reader must know besides the file.
struct ReadOptions {
  int dim = 3;            // of files that do not say it
  double box = 1.0;       // of files that do not say it; 1 is what such a file means, other values the caller gave
  int64_t frame = -1;     // which of several packings, from 0, or from the end where it is negative
  Enclosure enclosure{};  // walls that the caller names, for files that do not
  Layout layout{};
  // Whether the caller has said which box positions refer to.
  bool says_box() const { return box != 1.0 || !layout.cell.empty() || !layout.origin.empty(); }
};

// Goes by the content (recognise.cpp). Memory grows with the data read, never with the count in the header.
FileContent read_file(const char *path, const ReadOptions &options = {});

// What is written beside positions and diameters, by the formats that have a place for it.
struct Beside {
  const std::vector<int32_t> *coordination = nullptr;  // (n) contacts of each sphere, if they are known
  double density = 1.0;                                // of the spheres
  std::vector<double> stress{};                        // (dim, dim), positive in compression; empty: not known
};
// format: a jam_format.
void write_file(const Packing &p, const Beside &beside, const char *path, int32_t format);
// The packing with all lengths times scale.
Packing scaled(const Packing &p, double scale);

// format: a jam_contact_format.
void write_contacts(const Packing &p, const ContactNetwork &net, const char *path, int32_t format);

// What stands behind the last dot of a name, without .gz; "" when there is none.
std::string file_ending(const char *path);

struct ProofScene;
// The exact numbers of a proof: a file that jamproof.py checks.
void write_proof(const ProofScene &scene, const char *path);

// Adds the rows of a table of two columns to `curve`. Comments stand behind #; a first line of words is a heading.
void read_curve(const char *path, std::vector<double> &curve);

// The whole state of a packing in a binary file.

// beside: bytes of the results and of the unfinished work of that packing (capi/results_archive.cpp).
void write_checkpoint(const Packing &p, const std::string &beside, const char *path);
Packing read_checkpoint(const char *path, std::string &beside);
// What such a file contains; of the name errors speak.
std::string bytes_of_state(const Packing &p, const std::string &beside);
Packing packing_of_state(const std::string &all, const char *name, std::string &beside);

}  // namespace jam::inside
