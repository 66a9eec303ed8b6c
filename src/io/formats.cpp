#include "io/formats.hpp"

#include <cstdio>
#include <cstring>

#include "io/input_file.hpp"
#include "io/read_helpers.hpp"

namespace jam::inside {
namespace {

constexpr Content packing = Content::packing, contacts = Content::contacts, image = Content::image;
constexpr int any = JAM_MAX_DIM;

constexpr Format table[] = {
    // content, number, word, name, endings, most_dim, what, frames, read, write, write_contacts
    {packing, JAM_FORMAT_XYZ, "xyz", "extended XYZ", "xyz extxyz", any, stores::scene, true, read_xyz, write_xyz,
     nullptr},
    {packing, JAM_FORMAT_LAMMPS, "lammps", "LAMMPS data", "data lmp", 3,
     stores::walls | stores::cells | stores::density, false, read_lammps, write_lammps, nullptr},
    {packing, JAM_FORMAT_VTP, "vtp", "VTP of ParaView", "vtp", 3, stores::walls | stores::cells, false, nullptr,
     write_points, nullptr},
    {packing, JAM_FORMAT_PLAIN, "plain", "plain text", "dat txt -", any, 0, false, read_plain, write_plain, nullptr},
    {packing, 0, "dump", "a LAMMPS dump", "dump lammpstrj", 3, stores::cells, true, read_dump, nullptr, nullptr},
    {packing, 0, "mercury", "data of MercuryDPM", "data", 3, stores::cells, true, read_mercury, nullptr, nullptr},
    {packing, 0, "table", "a table of columns", "csv txt", any, stores::cells, false, read_table, nullptr, nullptr},
    {contacts, JAM_CONTACTS_CSV, "csv", "a table", "csv", any, stores::scene, false, nullptr, nullptr,
     write_contacts_csv},
    {contacts, JAM_CONTACTS_DUMP, "dump", "a LAMMPS dump local", "dump", 3, stores::scene, false, nullptr, nullptr,
     write_contacts_dump},
    {contacts, JAM_CONTACTS_VTP, "vtp", "VTP of ParaView", "vtp", 3, stores::scene, false, nullptr, nullptr,
     write_contacts_vtp},
    {image, 1, "npy", "an array of numpy", "npy", 3, stores::scene, false, nullptr, nullptr, nullptr},
    {image, 2, "mha", "MetaImage", "mha", 3, stores::scene, false, nullptr, nullptr, nullptr},
    {image, 3, "vti", "an image of VTK", "vti", 3, stores::scene, false, nullptr, nullptr, nullptr},
};

constexpr const char *content_words[] = {"packings", "contacts", "images"};

bool written(const Format &row) { return row.write || row.write_contacts || row.content == image; }

// Calls f with each ending of the row.
template <class F>
void each_ending(const Format &row, F &&f) {
  for (const char *at = row.endings; *at;) {
    const size_t length = std::strcspn(at, " ");
    f(std::string(at, length));
    at += length + (at[length] == ' ');
  }
}

// Names of other programs' formats are no endings of the table: plain text under the name x.gsd would mislead. One of
// digits alone (run.12) is none.
bool has_ending(const Format &row, const std::string &ending) {
  const std::string wanted = ending.find_first_not_of("0123456789") == std::string::npos ? "-" : ending;
  bool found = false;
  each_ending(row, [&](const std::string &known) { found = found || known == wanted; });
  return found;
}

// ".xyz or .extxyz (extended XYZ), .data ...": what can be written.
std::string endings_of(Content content) {
  std::string all;
  for (const Format &row : table) {
    if (row.content != content || !written(row)) continue;
    std::string some;
    each_ending(row, [&](const std::string &known) {
      some += (some.empty() ? "" : " or ") + (known == "-" ? std::string("none") : "." + known);
    });
    all += (all.empty() ? "" : ", ") + some + " (" + row.name + ")";
  }
  return all;
}

// "extended XYZ, LAMMPS data": what can store a thing.
std::string alternatives(uint32_t what) {
  std::string all;
  for (const Format &row : table)
    if (row.write && row.read && row.what & what) all += (all.empty() ? "" : ", ") + std::string(row.name);
  return all;
}

}  // namespace

const Format &format_of_name(const char *name) {
  for (const Format &row : table)
    if (std::strcmp(row.name, name) == 0) return row;
  fail(JAM_E_INTERNAL, "no format is called %s", name);
}

const Format &format_to_write(Content content, const char *path, int32_t number) {
  const std::string ending = file_ending(path);
  for (const Format &row : table)
    if (row.content == content && written(row) && (number ? row.number == number : has_ending(row, ending))) return row;
  const jam_status code = content == image ? JAM_E_UNSUPPORTED : JAM_E_ARGUMENT;
  fail(code, "%.200s: no format is known by the ending '%.20s'; of files of %s these are known: %s%s", path,
       ending.c_str(), content_words[static_cast<size_t>(content)], endings_of(content).c_str(),
       can_pack() ? "; each with .gz behind it or without" : "");
}

void check_fits(const Packing &p, const Format &format, double density) {
  if (p.dim > format.most_dim)
    fail(JAM_E_UNSUPPORTED, "%s has d = 2 or d = %d, this packing has d = %d", format.name, format.most_dim, p.dim);
  if (p.non_additivity != 0.0 && !(format.what & stores::non_additivity))
    fail(JAM_E_UNSUPPORTED, "%s cannot store non_additivity = %g: write %s or a checkpoint", format.name,
         p.non_additivity, alternatives(stores::non_additivity).c_str());
  if (density != 1.0 && !(format.what & stores::density))
    fail(JAM_E_UNSUPPORTED, "%s has no place for a density, here %g: write %s", format.name, density,
         alternatives(stores::density).c_str());
  if (p.container && !(format.what & stores::walls))
    fail(JAM_E_UNSUPPORTED, "%s cannot store walls: write %s or a checkpoint", format.name,
         alternatives(stores::walls).c_str());
  if (!p.cell.cube() && !(format.what & stores::cells))
    fail(JAM_E_UNSUPPORTED, "%s cannot store a cell that is no cube: write %s or a checkpoint", format.name,
         alternatives(stores::cells).c_str());
}

const char *formats_text() {
  // No allocation: calls that return a text cannot fail.
  static const struct Text {
    char text[4096] = "";
    Text() {
      size_t used = 0;
      for (const Format &row : table) {
        const int put = std::snprintf(
            text + used, sizeof text - used, "%s\t%d\t%s\t%s\t%s\t%d\tspheres%s%s%s%s\t%s%s%s\n",
            content_words[static_cast<size_t>(row.content)], row.number, row.word, row.name, row.endings, row.most_dim,
            row.what & stores::walls ? " walls" : "", row.what & stores::cells ? " cells" : "",
            row.what & stores::non_additivity ? " non_additivity" : "", row.what & stores::density ? " density" : "",
            row.read ? "read" : "", row.read && written(row) ? " " : "", written(row) ? "write" : "");
        used += put > 0 ? static_cast<size_t>(put) : 0;
        if (used >= sizeof text) break;
      }
    }
  } made;
  return made.text;
}

LammpsBox lammps_box(const Packing &p) {
  LammpsBox box;
  for (int c = 0; c < p.dim; ++c) box.high[c] = p.cell.edge(c);
  if (p.dim == 2) {
    box.low[2] = -0.5 * p.cell.side();
    box.high[2] = 0.5 * p.cell.side();
  }
  if (p.cell.cube()) return box;
  box.tilt[0] = p.cell.row(1)[0];
  if (p.dim == 3) {
    box.tilt[1] = p.cell.row(2)[0];
    box.tilt[2] = p.cell.row(2)[1];
  }
  for (const double t : box.tilt) box.tilted = box.tilted || t != 0.0;
  return box;
}

}  // namespace jam::inside
