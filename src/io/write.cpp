#include <string_view>

#include "core/error.hpp"
#include "io/files.hpp"
#include "io/output_file.hpp"
#include "io/text.hpp"

namespace jam {
namespace {

void write_plain(const Packing &p, OutputFile &file) {
  std::string &out = file.text();
  bool each = false;
  for (double s : p.diameter) each = each || s != p.diameter[0];
  out += std::to_string(p.dim) + "\n" + std::to_string(p.n()) + "\n";
  if (each)
    out += "diameters";
  else
    append_number(out, p.diameter[0]);
  if (p.cell.side() != 1.0) {
    out += " box ";
    append_number(out, p.cell.side());
  }
  out += '\n';
  for (size_t i = 0; i < p.n(); ++i) {
    for (int c = 0; c < p.dim; ++c) {
      if (c) out += ' ';
      append_number(out, p.position[i * p.dim + c]);
    }
    if (each) {
      out += ' ';
      append_number(out, p.diameter[i]);
    }
    out += '\n';
    file.flush_if_full();
  }
}

// The first `width` cell vectors; those that the dimension does not have are `box` along their axis.
void write_cell(const Packing &p, int width, std::string &out) {
  for (int row = 0; row < width; ++row)
    for (int column = 0; column < width; ++column) {
      if (row + column > 0) out += ' ';
      if (row == column)
        append_number(out, row < p.dim ? p.cell.edge(row) : p.cell.side());
      else if (row < p.dim && column < row && p.cell.row(row)[column] != 0.0)
        append_number(out, p.cell.row(row)[column]);
      else
        out += '0';
    }
}

// d = 2 gets a third coordinate 0, because OVITO and ASE expect three. `dim` tells readers.
void write_xyz(const Packing &p, const std::vector<int32_t> *coordination, OutputFile &file) {
  std::string &out = file.text();
  const int columns = p.dim == 2 ? 3 : p.dim;
  out += std::to_string(p.n()) + "\nLattice=\"";
  write_cell(p, 3, out);
  if (p.dim > 3 && !p.cell.cube()) {  // Lattice has room for three vectors only
    out += "\" cell=\"";
    write_cell(p, p.dim, out);
  }
  out += "\" Properties=id:I:1:pos:R:" + std::to_string(columns) + ":radius:R:1";
  if (coordination) out += ":contacts:I:1";
  out += p.dim == 2 ? " pbc=\"T T F\"" : " pbc=\"T T T\"";
  out += " dim=" + std::to_string(p.dim);
  if (p.non_additivity != 0.0) {
    out += " non_additivity=";
    append_number(out, p.non_additivity);
  }
  out += '\n';
  for (size_t i = 0; i < p.n(); ++i) {
    out += std::to_string(i);
    for (int c = 0; c < columns; ++c) {
      out += ' ';
      if (c < p.dim)
        append_number(out, p.position[i * p.dim + c]);
      else
        out += '0';
    }
    out += ' ';
    append_number(out, 0.5 * p.diameter[i]);
    if (coordination) out += ' ' + std::to_string((*coordination)[i]);
    out += '\n';
    file.flush_if_full();
  }
}

// Whether a name asks for extended XYZ. Names of other programs' formats are refused: plain text under the name x.gsd
// would mislead. Without an ending, or with one of digits alone (run.12), a name means plain text.
bool xyz_by_name(std::string_view path) {
  const std::string_view name = path.substr(path.find_last_of('/') + 1);
  const size_t dot = name.find_last_of('.');
  const std::string_view ending = dot == std::string_view::npos || dot == 0 ? "" : name.substr(dot + 1);
  if (ending == "xyz" || ending == "extxyz") return true;
  if (ending == "dat" || ending == "txt" || ending.find_first_not_of("0123456789") == std::string_view::npos)
    return false;
  fail(JAM_E_ARGUMENT,
       "%.200s: no format is known by the ending .%.20s: write .xyz or .extxyz (extended XYZ), .dat or .txt (plain "
       "text), "
       "or name the format",
       std::string(path).c_str(), std::string(ending).c_str());
}

}  // namespace

void write_file(const Packing &p, const std::vector<int32_t> *coordination, const char *path, int32_t format) {
  if (format != JAM_FORMAT_AUTO && format != JAM_FORMAT_PLAIN && format != JAM_FORMAT_XYZ)
    fail(JAM_E_ARGUMENT, "format is %d, not a jam_format", format);
  const bool xyz = format == JAM_FORMAT_XYZ || (format == JAM_FORMAT_AUTO && xyz_by_name(path));
  if (!xyz && p.non_additivity != 0.0)
    fail(JAM_E_UNSUPPORTED, "plain text cannot hold non_additivity = %g: write extended XYZ or a checkpoint",
         p.non_additivity);
  if (!xyz && !p.cell.cube())
    fail(JAM_E_UNSUPPORTED, "plain text cannot hold a cell that is no cube: write extended XYZ or a checkpoint");
  OutputFile file(path);
  if (xyz)
    write_xyz(p, coordination, file);
  else
    write_plain(p, file);
  file.commit();
}

}  // namespace jam
