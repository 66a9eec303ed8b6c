// The one table of the formats of files: readers, writers, error texts, the program and Python go by its rows.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "core/packing.hpp"
#include "io/files.hpp"
#include "network/contact_network.hpp"

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

}  // namespace jam::inside
