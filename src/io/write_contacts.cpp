// Contact networks as files: a table, a LAMMPS dump local, lines for ParaView.
#include <algorithm>
#include <cmath>

#include "core/limits.hpp"
#include "core/pair_rule.hpp"
#include "io/formats.hpp"
#include "io/vtp.hpp"

namespace jam::inside {
namespace {

// Contacts by distance have none, and their files no column of them.
bool has_forces(const ContactNetwork &net) { return net.size() == 0 || !std::isnan(net.force[0]); }

// Rows of both text formats; first: the number of the first sphere.
void put_rows(const Packing &p, const ContactNetwork &net, int first, char between, OutputFile &file) {
  std::string &out = file.text();
  const size_t d = static_cast<size_t>(p.dim);
  for (size_t k = 0; k < net.size(); ++k) {
    (out += std::to_string(net.pairs.i[k] + first)) += between;
    out += std::to_string(net.pairs.wall(k) ? net.pairs.j[k] : net.pairs.j[k] + first);
    for (size_t c = 0; c < d + (has_forces(net) ? 2 : 1); ++c) {
      out += between;
      append_number(out, c < d ? net.vector[k * d + c] : c == d ? net.gap[k] : net.force[k]);
    }
    out += '\n';
    file.flush_if_full();
  }
}

}  // namespace

void write_contacts_csv(const Packing &p, const ContactNetwork &net, OutputFile &file) {
  file.text() += "i,j";
  for (int c = 0; c < p.dim; ++c) file.text() += ",n" + std::to_string(c + 1);
  file.text() += has_forces(net) ? ",gap,force\n" : ",gap\n";
  put_rows(p, net, 0, ',', file);
}

// A dump of a tilted cell names the smallest brick around it.
void write_contacts_dump(const Packing &p, const ContactNetwork &net, OutputFile &file) {
  const LammpsBox box = lammps_box(p);
  std::string &out = file.text();
  out += "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ENTRIES\n" + std::to_string(net.size()) + "\nITEM: BOX BOUNDS ";
  if (box.tilted) out += "xy xz yz ";
  for (int c = 0; c < 3; ++c) out += std::string(c < p.dim && !p.cell.repeats(c) ? "ff" : "pp") + (c < 2 ? ' ' : '\n');
  const double xy = box.tilt[0], xz = box.tilt[1], yz = box.tilt[2];
  const std::array<double, 3> below{std::min({0.0, xy, xz, xy + xz}), std::min(0.0, yz), 0.0};
  const std::array<double, 3> above{std::max({0.0, xy, xz, xy + xz}), std::max(0.0, yz), 0.0};
  for (size_t c = 0; c < 3; ++c) {
    append_number(out, box.low[c] + below[c]);
    out += ' ';
    append_number(out, box.high[c] + above[c]);
    if (box.tilted) {
      out += ' ';
      append_number(out, box.tilt[c]);
    }
    out += '\n';
  }
  out += "ITEM: ENTRIES i j";
  for (int c = 0; c < p.dim; ++c) out += std::string(" n") + "xyz"[c];
  out += has_forces(net) ? " gap force\n" : " gap\n";
  put_rows(p, net, 1, ' ', file);
}

void write_contacts_vtp(const Packing &p, const ContactNetwork &net, OutputFile &file) {
  const size_t d = static_cast<size_t>(p.dim);
  std::vector<double> points, force, gap;
  std::vector<int64_t> contact;
  for (const int end : {0, 1})
    for (size_t k = 0; k < net.size(); ++k) {
      const int32_t i = net.pairs.i[k], j = net.pairs.j[k];
      const double half = 0.5 * contact_distance(p, i, j) * (1.0 + net.gap[k]);
      const double *x = &p.position[static_cast<size_t>(end == 0 || j < 0 ? i : j) * d];
      for (const double step : {j < 0 && end == 1 ? -2.0 * half : 0.0, end == 0 || j < 0 ? -half : half})
        for (size_t c = 0; c < 3; ++c) points.push_back(c < d ? x[c] + step * net.vector[k * d + c] : 0.0);
      force.push_back(net.force[k]);
      gap.push_back(net.gap[k]);
      contact.push_back(static_cast<int64_t>(k));
    }
  std::vector<double> at_points;  // ParaView's filter Tube takes its radius from data of points
  for (const double f : force) at_points.insert(at_points.end(), {f, f});
  VtpFile lines(std::move(points), 2);
  if (has_forces(net)) {
    lines.add_point_data("force", std::move(at_points));
    lines.add_cell_data("force", std::move(force));
  }
  lines.add_cell_data("gap", std::move(gap));
  lines.add_cell_data("contact", std::move(contact));
  lines.write(file);
}

void write_contacts(const Packing &p, const ContactNetwork &net, const char *path, int32_t format) {
  check_enum(format, JAM_CONTACTS_AUTO, JAM_CONTACTS_VTP, "format", "jam_contact_format");
  const Format &row = format_to_write(Content::contacts, path, format);
  check_fits(p, row);
  OutputFile file(path);
  row.write_contacts(p, net, file);
  file.commit();
}

}  // namespace jam::inside
