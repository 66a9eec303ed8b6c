#include "core/limits.hpp"
#include "io/formats.hpp"
#include "io/platform.hpp"
#include "io/vtp.hpp"

namespace jam::inside {

void write_plain(const Packing &p, const Beside &, OutputFile &file) {
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

namespace {

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

// `walls` names what pbc cannot: axes beyond three, and the caps of a cylinder.
std::string walls_word(const Packing &p) {
  std::string word;
  for (int c = 0; c < p.dim; ++c) word += std::string(c ? " " : "") + (p.container.flat() >> c & 1 ? 'T' : 'F');
  return word;
}
std::string container_keys(const Packing &p) {
  return p.container ? std::string(" container=") + p.container.word() + " walls=\"" + walls_word(p) + '"' : "";
}

// As ASE reads it: three by three numbers, positive in tension.
void append_stress(int dim, const std::vector<double> &stress, std::string &out) {
  out += " stress=\"";
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) {
      if (a + b > 0) out += ' ';
      append_number(out, a < dim && b < dim ? 0.0 - stress[a * dim + b] : 0.0);
    }
  out += '"';
}

}  // namespace

// d = 2 gets a third coordinate 0, because OVITO and ASE expect three. Readers go by `dim`.
void write_xyz(const Packing &p, const Beside &beside, OutputFile &file) {
  const std::vector<int32_t> *const coordination = beside.coordination;
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
  out += " pbc=\"";
  for (int c = 0; c < 3; ++c) {
    if (c) out += ' ';
    out += c < p.dim && p.cell.repeats(c) ? 'T' : 'F';
  }
  out += "\" dim=" + std::to_string(p.dim) + container_keys(p);
  if (p.non_additivity != 0.0) {
    out += " non_additivity=";
    append_number(out, p.non_additivity);
  }
  if (p.dim <= 3 && !beside.stress.empty()) append_stress(p.dim, beside.stress, out);
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

// Contacts of each sphere as classes: 0 rattler, 1 buckler, 2 other.
void write_points(const Packing &p, const Beside &beside, OutputFile &file) {
  const std::vector<int32_t> *const coordination = beside.coordination;
  const size_t d = static_cast<size_t>(p.dim);
  std::vector<double> points;
  for (size_t i = 0; i < p.n(); ++i)
    for (size_t c = 0; c < 3; ++c) points.push_back(c < d ? p.position[i * d + c] : 0.0);
  VtpFile spheres(std::move(points), 1);
  spheres.add_point_data("diameter", p.diameter);
  if (coordination) {
    std::vector<int64_t> contacts(coordination->begin(), coordination->end()), kind;
    for (const int64_t z : contacts) kind.push_back(z == 0 ? 0 : z == p.dim + 1 ? 1 : 2);
    spheres.add_point_data("contacts", std::move(contacts));
    spheres.add_point_data("kind", std::move(kind));
  }
  if (p.container) {
    spheres.add_field_text("container", p.container.word());
    spheres.add_field_text("walls", walls_word(p));
    std::vector<double> edges;
    for (int c = 0; c < p.dim; ++c) edges.push_back(p.cell.edge(c));
    spheres.add_field_data("edges", edges);
  } else {
    spheres.add_field_data("cell", p.cell.rows());
  }
  spheres.write(file);
}

void write_lammps(const Packing &p, const Beside &beside, OutputFile &file) {
  const LammpsBox box = lammps_box(p);
  std::string &out = file.text();
  out += std::string(lammps_title) + ", atom_style sphere, dimension " + std::to_string(p.dim) + container_keys(p) +
         "\n\n" + std::to_string(p.n()) + " atoms\n1 atom types\n\n";
  for (size_t c = 0; c < 3; ++c) {
    append_number(out, box.low[c]);
    out += ' ';
    append_number(out, box.high[c]);
    const char axis = "xyz"[c];
    out += std::string(" ") + axis + "lo " + axis + "hi\n";
  }
  if (box.tilted) {
    for (const double t : box.tilt) {
      append_number(out, t);
      out += ' ';
    }
    out += "xy xz yz\n";
  }
  out += "\nAtoms # sphere\n\n";
  for (size_t i = 0; i < p.n(); ++i) {
    out += std::to_string(i + 1) + " 1 ";
    append_number(out, p.diameter[i]);
    out += ' ';
    append_number(out, beside.density);
    for (int c = 0; c < 3; ++c) {
      out += ' ';
      append_number(out, c < p.dim ? p.position[i * p.dim + c] : 0.0);
    }
    out += '\n';
    file.flush_if_full();
  }
}

std::string file_ending(const char *path) {
  std::string name = platform::name_of(path);
  if (name.size() > 3 && name.compare(name.size() - 3, 3, ".gz") == 0) name.resize(name.size() - 3);
  const size_t dot = name.find_last_of('.');
  return dot == std::string::npos || dot == 0 ? "" : name.substr(dot + 1);
}

Packing scaled(const Packing &p, double scale) {
  Packing made = p;
  std::vector<double> rows = p.cell.rows();
  for (double &x : rows) x *= scale;
  made.cell = p.cell.cube() ? Cell(p.dim, p.cell.side() * scale) : Cell::from_triangle(p.dim, rows.data());
  if (p.container) enclose(made, {p.container.kind(), p.container.flat()});
  for (double &x : made.position) x *= scale;
  for (double &s : made.diameter) s *= scale;
  check_box(made.cell.side());
  return made;
}

void write_file(const Packing &p, const Beside &beside, const char *path, int32_t format) {
  check_enum(format, JAM_FORMAT_AUTO, JAM_FORMAT_VTP, "format", "jam_format");
  const Format &row = format_to_write(Content::packing, path, format);
  check_fits(p, row, beside.density);
  OutputFile file(path);
  row.write(p, beside, file);
  file.commit();
}

}  // namespace jam::inside
