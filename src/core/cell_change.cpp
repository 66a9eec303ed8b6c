#include "core/cell_change.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "core/container.hpp"
#include "core/error.hpp"
#include "core/math.hpp"

namespace jam::inside {

void enter_cell(Packing &p, const NormalCell &normal) {
  p.cell = normal.cell;
  if (p.container) enclose(p, {p.container.kind(), p.container.flat()});
  normal.turn(p.position), normal.turn(p.velocity);
  if (!p.position.empty()) wrap_positions(p);
}

namespace {

// Mari-Kurchan shifts are fractions of the cell vectors: with other vectors the system is another one.
bool keeps_shifts(const Packing &p, const NormalCell &normal) {
  return p.model != JAM_MODEL_MK || normal.same_vectors();
}

void say_once(Notes &notes, const std::string &line) {
  if (notes.text().find(line) == std::string::npos) notes.say("%s", line.c_str());
}

void note_other_vectors(double most_defect, Notes &notes) {
  char line[200];
  std::snprintf(line, sizeof line,
                "the cell vectors were replaced by shorter ones of the same lattice: the product of their lengths was "
                "over %g V",
                most_defect);
  say_once(notes, line);
}

}  // namespace

void note_cell(const NormalCell &normal, bool spheres, Notes &notes) {
  if (!normal.same_vectors()) note_other_vectors(normal.most_defect, notes);
  if (normal.rotated)
    say_once(notes, spheres ? "the spheres were rotated with the cell, whose vectors are lower-triangular now"
                            : "the cell was rotated: its vectors are lower-triangular now");
}

std::optional<NormalCell> shorten_cell(Packing &p, Notes &notes) {
  if (p.container) return {};  // the vectors lie along its walls
  NormalCell normal = normal_cell(p.dim, p.cell.rows().data(), 0.5 * defect_max(p.dim));
  if (normal.same_vectors() || !keeps_shifts(p, normal)) return {};
  enter_cell(p, normal);
  note_cell(normal, true, notes);
  return normal;
}

void straighten_cell(Packing &p, Notes &notes) {
  if (p.model == JAM_MODEL_MK || orthogonality_defect(p.cell) <= defect_max(p.dim)) return;
  p.cell = upright(p.cell);
  note_other_vectors(defect_max(p.dim), notes);
}

NormalCell strain_affinely(Packing &p, const double *strain) {
  const int d = p.dim;
  for (int a = 0; a < d; ++a)
    for (int b = 0; b < d; ++b)
      if (((p.container.closed() >> a | p.container.closed() >> b) & 1) != 0 && strain[a * d + b] != 0.0)
        fail(JAM_E_UNSUPPORTED, "strain[%d] is %g: axes that walls close keep their lengths and directions", a * d + b,
             strain[a * d + b]);
  const auto deform = [&](const double *x, double *y) {
    for (int a = 0; a < d; ++a) {
      y[a] = x[a];
      for (int b = 0; b < d; ++b) y[a] += strain[a * d + b] * x[b];
    }
  };
  std::vector<double> rows(static_cast<size_t>(d) * d);
  for (int c = 0; c < d; ++c) deform(p.cell.row(c), &rows[c * d]);
  for (size_t i = 0; i < p.n(); ++i) {
    Cell::Vector y{};
    deform(&p.position[i * d], y.data());
    std::copy(y.begin(), y.begin() + d, p.position.begin() + i * d);
  }
  NormalCell normal = normal_cell(d, rows.data());
  if (!keeps_shifts(p, normal))
    fail(JAM_E_UNSUPPORTED, "so large a strain gives the cell other vectors, and with them other Mari-Kurchan shifts");
  enter_cell(p, normal);
  return normal;
}

void take_strained_cell(Packing &p, std::vector<double> rows) {
  const double least = least_cell_entry * Cell::from_triangle(p.dim, rows.data()).side();
  for (double &x : rows)
    if (std::fabs(x) < least) x = 0.0;
  p.cell = Cell::from_triangle(p.dim, rows.data());
  if (p.container) enclose(p, {p.container.kind(), p.container.flat()});
}

void strain_at_fixed_volume(Packing &p, PairList &pairs, const std::vector<double> &strain, double kept) {
  const int d = p.dim;
  const uint32_t closed = p.container.closed();
  double volume = kept > 0.0 ? p.cell.volume() / kept : 1.0;
  for (int c = 0; c < d; ++c) volume *= 1.0 + strain[c * (d + 1)];
  const double back = math::pow(volume, -1.0 / (p.container ? p.container.open_axes() : d));
  const auto deform = [&](double *x) {  // upper-triangular: component a needs those from a on
    for (int a = 0; a < d; ++a) {
      if (closed >> a & 1) continue;
      double sum = x[a];
      for (int b = a; b < d; ++b) sum += strain[a * d + b] * x[b];
      x[a] = back * sum;
    }
  };
  for (size_t k = 0; k < p.position.size(); k += d) deform(&p.position[k]);
  for (size_t k = 0; k < pairs.offset.size(); k += d) deform(&pairs.offset[k]);
  std::vector<double> rows = p.cell.rows();
  for (int c = 0; c < d; ++c) deform(&rows[c * d]);
  take_strained_cell(p, std::move(rows));
}

void move_packing(Packing &p, PairList &pairs, const double *s, double length, double growth,
                  const std::vector<double> &strain) {
  if (!strain.empty()) strain_at_fixed_volume(p, pairs, strain);
  for (size_t k = 0; k < p.position.size(); ++k) p.position[k] += length * s[k];
  for (double &sigma : p.diameter) sigma *= growth;
  p.given = {};  // positions have all digits now
  wrap_positions(p, pairs);
}

}  // namespace jam::inside
