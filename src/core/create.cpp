#include "core/create.hpp"

#include <algorithm>
#include <cmath>

#include "core/call_scope.hpp"
#include "core/cell_change.hpp"
#include "core/decimal.hpp"
#include "core/limits.hpp"
#include "core/pair_rule.hpp"
#include "core/tuning.hpp"

namespace jam::inside {
namespace {

void check_options(const jam_create_options &o) {
  check_dim(o.dim);
  if (o.n != 0) check_n(o.n);  // 0: taken from the arrays
  check_box(o.box);
  check_non_additivity(o.non_additivity);
  check_enum(o.overlap, JAM_OVERLAP_REFUSE, JAM_OVERLAP_ALLOW, "overlap", "jam_overlap_policy");
  check_enum(o.model, JAM_MODEL_EUCLID, JAM_MODEL_MK, "model", "jam_model");
  check_enum(o.masses, JAM_MASSES_EQUAL, JAM_MASSES_VOLUME, "masses", "jam_masses");
  if (!(o.shrink_min >= 0.0 && o.shrink_min <= 1.0))
    fail(JAM_E_ARGUMENT, "shrink_min is %g, supported are 0..1", o.shrink_min);
  check_create_limits(o);
  if (o.model == JAM_MODEL_MK && !is_mk_zeta(o.mk_zeta))
    fail(JAM_E_ARGUMENT, "mk_zeta is %g, supported are 0..%g and infinity", o.mk_zeta, limits::mk_zeta_max);
}

size_t count_spheres(const jam_create_options &o, size_t positions_len, size_t diameters_len) {
  size_t n = static_cast<size_t>(o.n);
  if (positions_len % static_cast<size_t>(o.dim))
    fail(JAM_E_ARGUMENT, "positions has %zu numbers, not a multiple of dim %d", positions_len, o.dim);
  if (n == 0) n = positions_len ? positions_len / o.dim : diameters_len;
  if (n == 0) fail(JAM_E_ARGUMENT, "n is 0 and no arrays are given");
  check_n(static_cast<int64_t>(n));
  if (positions_len && positions_len != n * o.dim)
    fail(JAM_E_ARGUMENT, "positions has %zu numbers, n * dim is %zu", positions_len, n * o.dim);
  if (diameters_len > 1 && diameters_len != n)
    fail(JAM_E_ARGUMENT, "diameters has %zu numbers, it must have 1 or n = %zu", diameters_len, n);
  if (positions_len && diameters_len == 0) fail(JAM_E_ARGUMENT, "positions are given without diameters");
  return n;
}

// An array that is given and empty would otherwise be one that is left out.
void check_start(const char *name, const double *array, size_t len) {
  if (len && !array) fail(JAM_E_NULL, "%s is NULL but its length is %zu", name, len);
  if (array && !len) fail(JAM_E_ARGUMENT, "%s has no numbers: NULL leaves it out", name);
}

std::vector<double> take_diameters(size_t n, const double *diameters, size_t len) {
  for (size_t k = 0; k < len; ++k)
    if (!(diameters[k] > 0.0) || !std::isfinite(diameters[k]))
      fail(std::isfinite(diameters[k]) ? JAM_E_ARGUMENT : JAM_E_NONFINITE,
           "diameters[%zu] is %g, it must be positive and finite", k, diameters[k]);
  if (len == n) return {diameters, diameters + n};
  return std::vector<double>(n, len == 1 ? diameters[0] : 1.0);
}

[[noreturn]] void refuse_unfitting(const Packing &p) {
  const auto widest = std::max_element(p.diameter.begin(), p.diameter.end());
  if (*widest > p.cell.shortest())
    fail(JAM_E_OVERLAP, "sphere %td of diameter %g overlaps its own image: the shortest period of the cell is %g",
         widest - p.diameter.begin(), *widest, p.cell.shortest());
  fail(JAM_E_OVERLAP, "the spheres cannot fit into a volume of %g: largest diameter %g, packing fraction %g",
       p.cell.volume(), *widest, packing_fraction(p));
}

}  // namespace

double fitting_factor(const Packing &p) {
  double widest = 0.0, other = 0.0;  // the two largest diameters that differ
  for (double s : p.diameter) {
    if (s > widest)
      other = widest, widest = s;
    else if (s < widest && s > other)
      other = s;
  }
  double scale = widest / p.cell.shortest();
  const double unlike = 0.5 * (1.0 + p.non_additivity) * (widest + other);
  // Nearest images are no farther apart than half the diagonal; in a container points are up to the diagonal apart.
  const double apart = p.container ? 2.0 * p.cell.half_diagonal() : p.cell.half_diagonal();
  if (other > 0.0) scale = std::max(scale, unlike / apart);
  if (p.model == JAM_MODEL_EUCLID) {
    double volume = 0.0;  // of the spheres, in units of widest^d: no overflow whatever the diameters are
    for (double s : p.diameter) volume += unit_sphere_volume(p.dim) * math::pow(s / widest, p.dim);
    const double core = 1.0 + std::min(0.0, p.non_additivity);
    const double side = p.container ? math::pow(scene_volume(p), 1.0 / p.dim) : p.cell.side();
    scale = std::max(scale, core * math::pow(volume, 1.0 / p.dim) * widest / side);
  }
  return scale > 1.0 + overlap_tolerance ? 1.0 / scale : 1.0;
}

jam_create_options default_create_options() {
  jam_create_options o{};
  o.struct_size = sizeof o;
  o.dim = 3;
  o.seed = 1;
  o.box = 1.0;
  o.overlap = JAM_OVERLAP_REFUSE;
  o.model = JAM_MODEL_EUCLID;
  o.frame = -1;
  o.shrink_min = 1e-3;
  o.mk_zeta = o.wall_time = std::numeric_limits<double>::infinity();
  return o;
}

void check_create_limits(const jam_create_options &o) {
  check_positive(o.wall_time, "wall_time");
  if (!(o.memory_limit >= 0.0)) fail(JAM_E_ARGUMENT, "memory_limit is %g, it must not be negative", o.memory_limit);
}

// Spheres so near are two lines for one sphere, or the two faces of a box.
static bool same_centre(const ClosestPair &pair) { return pair.gap <= -1.0 + 1e-12; }

double overlap_of_long_flights(const Packing &p) {
  double longest = 0.0;
  for (int c = 0; c < p.dim; ++c) longest = std::max(longest, p.cell.edge(c));
  const double ratio = longest / *std::min_element(p.diameter.begin(), p.diameter.end());
  return std::min(FlightTuning::most, FlightTuning::sharp * ratio * ratio);
}

static void refuse_wall_overlaps(const Packing &p, double tolerance) {
  const ClosestWall worst = closest_wall(p);
  if (worst.gap >= -tolerance) return;
  const std::string wall = p.container[worst.w].name();
  if (p.overlap_allowed)
    fail(JAM_E_OVERLAP,
         "sphere %d overlaps %s by %.3g of its radius: this call is for hard spheres; jam_scale_diameters(sys, %.17g) "
         "leads to contact",
         worst.sphere, wall.c_str(), -worst.gap, (1.0 + worst.gap) * (1.0 - 1e-15));
  fail(JAM_E_OVERLAP, "sphere %d overlaps %s by %.3g of its radius", worst.sphere, wall.c_str(), -worst.gap);
}

void refuse_overlaps(const Packing &p, double tolerance) {
  tolerance = std::max(tolerance, overlap_of_long_flights(p));
  if (p.container) refuse_wall_overlaps(p, tolerance);
  const ClosestPair worst = closest_pair(p);
  if (worst.gap >= -tolerance) return;
  if (p.overlap_allowed)
    fail(JAM_E_OVERLAP,
         "spheres %d and %d overlap by %.3g of their contact distance: this call is for hard spheres; jam_decompress "
         "leads to jamming, jam_scale_diameters(sys, %.17g) to contact",
         worst.i, worst.j, -worst.gap, (1.0 + worst.gap) * (1.0 - 1e-15));
  fail(JAM_E_OVERLAP, "spheres %d and %d overlap by %.3g of their contact distance%s", worst.i, worst.j, -worst.gap,
       same_centre(worst) ? ": they have the same centre" : "");
}

void apply_overlap_policy(Packing &p, int32_t policy) {
  check_diameters(p.diameter, p.cell);
  if (p.container && !p.position.empty()) refuse_outside(p, wrong_origin);
  if (p.container) refuse_too_wide(p, JAM_E_OVERLAP);
  if (policy == JAM_OVERLAP_ALLOW) {
    if (diameter_max(p) > p.cell.shortest() * (1.0 + overlap_tolerance))
      refuse_unfitting(p);  // overlaps of a sphere with its own images are not moved
    return;
  }
  if (fitting_factor(p) < 1.0) refuse_unfitting(p);
  refuse_overlaps(p, overlap_tolerance);
}

void shrink_to_contact(Packing &p, double least, Notes *notes) {
  check_diameters(p.diameter, p.cell);
  if (p.container) refuse_outside(p, wrong_origin);
  const double before = packing_fraction(p), fit = fitting_factor(p);
  double factor = fit;
  for (double &s : p.diameter) s *= fit;
  const ClosestPair worst = closest_pair(p);
  if (same_centre(worst))
    fail(JAM_E_OVERLAP,
         "spheres %d and %d have the same centre: no shrinking helps; remove one of them; some files list a sphere "
         "on both faces of the box",
         worst.i, worst.j);
  const bool overlap = worst.gap < -overlap_tolerance;
  if (overlap) {
    factor *= 1.0 + worst.gap;
    for (double &s : p.diameter) s *= 1.0 + worst.gap;
  }
  const ClosestWall wall = closest_wall(p);
  const bool at_wall = wall.gap < -overlap_tolerance;
  if (at_wall) {
    factor *= 1.0 + wall.gap;
    for (double &s : p.diameter) s *= 1.0 + wall.gap;
  }
  if (factor == 1.0) return;
  char cause[100] = "they did not fit the cell";
  if (overlap)
    std::snprintf(cause, sizeof cause, "spheres %d and %d overlapped by %.3g of their contact distance", worst.i,
                  worst.j, 1.0 - (1.0 + worst.gap) * fit);
  if (at_wall)
    std::snprintf(cause, sizeof cause, "sphere %d overlapped %s", wall.sphere, p.container[wall.w].name().c_str());
  if (factor < least)
    fail(JAM_E_OVERLAP,
         "%s: to shrink means to multiply all diameters by %.3g, less than shrink_min %g; leave one of two duplicates "
         "out, or correct the unit of the diameters",
         cause, factor, least);
  check_diameters(p.diameter, p.cell);
  if (notes)
    notes->warn("all diameters were multiplied by %.17g: %s; packing fraction %.12g, before %.12g", factor, cause,
                packing_fraction(p), before);
}

Packing make_packing(const jam_create_options &o, const double *positions, size_t positions_len,
                     const double *diameters, size_t diameters_len, const double *cell, Notes *notes) {
  check_options(o);
  const Enclosure enclosure{o.container, o.walls};
  const bool walled = enclosure.any();
  check_start("positions", positions, positions_len);
  check_start("diameters", diameters, diameters_len);
  const size_t n = count_spheres(o, positions_len, diameters_len);
  for (size_t k = 0; k < positions_len; ++k)
    if (!std::isfinite(positions[k]))
      fail(JAM_E_NONFINITE, "positions[%zu] is %g (sphere %zu, component %zu)", k, positions[k], k / o.dim, k % o.dim);
  Packing p;
  p.set_cube(o.dim, o.box);
  p.seed = o.seed;
  p.model = o.model;
  p.mk_zeta = o.mk_zeta;
  p.non_additivity = o.non_additivity;
  p.masses = o.masses;
  p.overlap_allowed = o.overlap == JAM_OVERLAP_ALLOW;
  p.diameter = take_diameters(n, diameters, diameters_len);
  if (positions_len) {
    p.position.resize(n * o.dim);
    p.position.assign(positions, positions + positions_len);
    const std::vector<double> rows = p.cell.rows();
    p.given = digits_of(p.dim, p.position, p.diameter, cell ? std::vector<double>(cell, cell + rows.size()) : rows);
    if (walled) {
      if (cell) p.cell = walled_cell(p.dim, cell, enclosure);
      enclose(p, enclosure);
      wrap_positions(p);
    } else if (cell) {
      const NormalCell normal = normal_cell(p.dim, cell);
      if (notes) note_cell(normal, true, *notes);
      enter_cell(p, normal);
    } else {
      wrap_positions(p);
    }
    if (o.overlap == JAM_OVERLAP_SHRINK)
      shrink_to_contact(p, o.shrink_min, notes);
    else
      apply_overlap_policy(p, o.overlap);
  } else {
    if (walled) {
      if (cell) p.cell = walled_cell(p.dim, cell, enclosure);
      enclose(p, enclosure);
    } else if (cell) {
      const NormalCell normal = normal_cell(p.dim, cell);
      if (notes) note_cell(normal, false, *notes);
      p.cell = normal.cell;
    }
    if (!(o.packing_fraction >= 0.0) || !std::isfinite(o.packing_fraction))
      fail(JAM_E_ARGUMENT, "packing_fraction is %g, it must be positive and finite, or 0 for the default",
           o.packing_fraction);
    start_at_random(p, o.packing_fraction, notes);
  }
  p.velocity.assign(n * o.dim, 0.0);
  return p;
}

void check_packing(const Packing &p, jam_status code) {
  check_dim(p.dim);
  check_box(p.cell.side());
  check_non_additivity(p.non_additivity);
  const size_t n = p.n(), d = static_cast<size_t>(p.dim);
  if (n == 0 || p.position.size() != n * d || p.velocity.size() != n * d)
    fail(code, "%zu diameters, %zu coordinates and %zu velocity components in d = %zu", n, p.position.size(),
         p.velocity.size(), d);
  for (size_t k = 0; k < n * d; ++k)
    if (!(p.position[k] >= 0.0 && (p.position[k] < p.cell.edge(static_cast<int>(k % d)) ||
                                   (p.position[k] == p.cell.edge(static_cast<int>(k % d)) && p.container &&
                                    !p.cell.repeats(static_cast<int>(k % d))))))
      fail(code, "positions[%zu] is %.17g, outside of 0 to %g", k, p.position[k], p.cell.edge(static_cast<int>(k % d)));
  for (size_t i = 0; i < n; ++i)
    if (!(p.diameter[i] > 0.0)) fail(code, "diameters[%zu] is %g, it must be positive", i, p.diameter[i]);
  refuse_wider_than_periods(p, code);
  check_diameters(p.diameter, p.cell);
  check_velocities(p, p.velocity, code);
}

void refuse_wider_than_periods(const Packing &p, jam_status code) {
  const double widest = p.cell.shortest() * (1.0 + overlap_tolerance);
  for (size_t i = 0; i < p.n(); ++i)
    if (!(p.diameter[i] <= widest))
      fail(code, "diameters[%zu] is %g where the shortest period of the cell is %g", i, p.diameter[i],
           p.cell.shortest());
}

}  // namespace jam::inside
