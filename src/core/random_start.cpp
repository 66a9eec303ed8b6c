// Random starts: sequential addition, uniform points, planted Mari-Kurchan systems.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/call_scope.hpp"
#include "core/cell_reduction.hpp"
#include "core/create.hpp"
#include "core/error.hpp"
#include "core/limits.hpp"
#include "core/math.hpp"
#include "core/pair_rule.hpp"
#include "core/pairs.hpp"
#include "core/rng.hpp"
#include "core/size_laws.hpp"
#include "core/tuning.hpp"

namespace jam::inside {
namespace {

// Cells at least as wide as the largest diameter, as linked lists, since spheres are added one by one.
class GrowingCells {
 public:
  GrowingCells(const Packing &p, double cutoff) : p_(p), basis_(upright(p.cell)) {
    const double fit = basis_.height_min() / cutoff,
                 enough = std::ceil(math::pow(static_cast<double>(p.n()), 1.0 / p.dim));
    side_ = std::max<int64_t>(1, static_cast<int64_t>(std::min(fit * (1.0 - 1e-12), enough)));
    if (side_ < 3) side_ = 1;
    int64_t cells = 1;
    for (int c = 0; c < p.dim; ++c) cells *= side_;
    head_.assign(static_cast<size_t>(cells), -1);
    next_.assign(p.n(), -1);
  }
  void add(int32_t i) {
    const int64_t cell = cell_of(&p_.position[static_cast<size_t>(i) * p_.dim]);
    next_[i] = head_[cell];
    head_[cell] = i;
  }
  // True when sphere i at x would overlap a sphere that is already placed.
  bool blocked(const double *x, int32_t i) const {
    if (side_ == 1) return in_cell(0, x, i);
    Cell::Vector s{};
    basis_.fraction(x, s.data());
    return visit(p_.dim - 1, 0, s.data(), x, i);
  }

 private:
  int64_t index(double s) const {
    return std::min(static_cast<int64_t>(wrap(s, 1.0) * static_cast<double>(side_)), side_ - 1);
  }
  int64_t cell_of(const double *x) const {
    Cell::Vector s{};
    basis_.fraction(x, s.data());
    int64_t cell = 0;
    for (int c = p_.dim - 1; c >= 0; --c) cell = cell * side_ + index(s[c]);
    return cell;
  }
  bool visit(int c, int64_t cell, const double *s, const double *x, int32_t i) const {
    if (c < 0) return in_cell(cell, x, i);
    for (int64_t step = -1; step <= 1; ++step)
      if (visit(c - 1, cell * side_ + (index(s[c]) + step + side_) % side_, s, x, i)) return true;
    return false;
  }
  bool in_cell(int64_t cell, const double *x, int32_t i) const {
    for (int32_t j = head_[cell]; j >= 0; j = next_[j]) {
      const double touch = contact_distance(p_, i, j);
      Cell::Vector dx{};
      for (int c = 0; c < p_.dim; ++c) dx[c] = x[c] - p_.position[static_cast<size_t>(j) * p_.dim + c];
      bool near = false;
      if (side_ > 1) {  // then the nearest image alone is within reach
        p_.cell.nearest(dx.data());
        double r2 = 0.0;
        for (int c = 0; c < p_.dim; ++c) r2 += dx[c] * dx[c];
        near = r2 < touch * touch;
      } else {
        p_.cell.images(dx.data(), touch, [&](const double *) { near = true; });
      }
      if (near) return true;
    }
    return false;
  }
  const Packing &p_;
  const Cell basis_;
  int64_t side_;
  std::vector<int32_t> head_, next_;
};

// The brick of the cell repeats as the cell does, so a uniform point of it will do. Of a container: where a sphere of
// this radius fits between flat walls.
void random_point(const Packing &p, Rng &rng, double radius, double *x) {
  if (p.container) return p.container.random_point(p.cell, rng, radius, x);
  for (int c = 0; c < p.dim; ++c) x[c] = wrap(p.cell.edge(c) * rng.uniform(), p.cell.edge(c));
}

// Mixtures pack more densely than equal spheres: they are tried up to the density at which they jam.
void check_below_saturation(const Packing &p) {
  const double wanted = packing_fraction(p), end = sequential_fraction(p.dim);
  // Finite systems differ from each other by less than 1 / sqrt(n).
  if (wanted <= end * (1.0 + 1.0 / std::sqrt(static_cast<double>(p.n())))) return;
  const auto [least, most] = std::minmax_element(p.diameter.begin(), p.diameter.end());
  if (*least == *most)
    fail(JAM_E_UNPLACEABLE,
         "packing fraction %g: random sequential addition ends near %g in d = %d; grow the spheres from a lower one",
         wanted, end, p.dim);
  if (p.non_additivity == 0.0) check_reach(p.dim, p.diameter, wanted);
}

void report_placed(double fraction, int64_t spheres, size_t all) {
  jam_progress q = progress_of(JAM_PHASE_CREATE);
  q.packing_fraction = fraction;
  q.fraction = static_cast<double>(spheres) / static_cast<double>(all);
  q.steps = spheres;
  CallScope::report(q);
}

void refuse_unplaceable(const Packing &p) {
  if (p.container) refuse_too_wide(p, JAM_E_UNPLACEABLE);
  if (fitting_factor(p) < 1.0)
    fail(JAM_E_UNPLACEABLE,
         "spheres of packing fraction %g, the largest of diameter %g, do not fit a cell of volume %g and "
         "shortest period %g; packing fraction reached: 0",
         packing_fraction(p), diameter_max(p), p.cell.volume(), p.cell.shortest());
}

}  // namespace

void place_at_random(Packing &p) {
  const size_t n = p.n();
  const int d = p.dim;
  p.position.assign(n * d, 0.0);
  refuse_unplaceable(p);
  check_below_saturation(p);
  std::vector<int32_t> order(n);
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int32_t a, int32_t b) { return p.diameter[a] > p.diameter[b]; });
  GrowingCells cells(p, contact_distance_max(p));
  Rng rng(p.seed, Stream::rsa_positions);
  double placed = 0.0;
  const double share = p.container ? p.cell.volume() / scene_volume(p) : 1.0;
  const int64_t most_total = PlaceTuning::tries_per_sphere * static_cast<int64_t>(n) + PlaceTuning::most_tries;
  int64_t total = 0, spheres = 0;
  for (int32_t i : order) {
    double *x = &p.position[static_cast<size_t>(i) * d];
    int64_t tries = 0;
    do {
      if (++tries > PlaceTuning::most_tries || ++total > most_total)
        fail(JAM_E_UNPLACEABLE,
             "random sequential addition reached packing fraction %.6f of the requested %.6f: start at a lower "
             "packing_fraction, and grow the spheres",
             placed, packing_fraction(p));
      // A try takes long where one large sphere leaves few cells, and each of them holds many small ones.
      if (total % PlaceTuning::tries_between_looks == 0) CallScope::look();
      if (total % PlaceTuning::tries_between_reports == 0) report_placed(placed, spheres, n);
      random_point(p, rng, 0.5 * p.diameter[i], x);
    } while (!p.container.holds(x, 0.5 * p.diameter[i]) || cells.blocked(x, i));
    cells.add(i);
    ++spheres;
    placed += unit_sphere_volume(d) * math::pow(p.diameter[i] / p.cell.side(), d) * share;
  }
}

void place_uniformly(Packing &p) {
  apply_overlap_policy(p, JAM_OVERLAP_ALLOW);
  refuse_too_wide(p, JAM_E_UNPLACEABLE);
  p.position.resize(p.n() * static_cast<size_t>(p.dim));
  Rng rng(p.seed, Stream::rsa_positions);
  for (size_t i = 0; i < p.n(); ++i) {
    double *x = &p.position[i * static_cast<size_t>(p.dim)];
    do random_point(p, rng, 0.5 * p.diameter[i], x);
    while (!p.container.holds(x, 0.5 * p.diameter[i]));
  }
}

void plant(Packing &p) {
  const int32_t n = static_cast<int32_t>(p.n()), d = p.dim;
  refuse_unplaceable(p);
  p.position.resize(p.n() * static_cast<size_t>(d));
  Rng rng(p.seed, Stream::rsa_positions);
  for (size_t i = 0; i < p.n(); ++i) random_point(p, rng, 0.0, &p.position[i * static_cast<size_t>(p.dim)]);
  p.mk_redrawn.clear();
  const MkShifts quenched(p);
  double shift[JAM_MAX_DIM];
  for (int32_t i = 0; i < n; ++i) {
    report_placed(std::numeric_limits<double>::quiet_NaN(), i, p.n());
    for (int32_t j = i + 1; j < n; ++j) {
      const double touch = contact_distance(p, i, j);
      int32_t attempt = 0;
      for (;; ++attempt) {
        if (attempt == PlaceTuning::most_draws)
          fail(JAM_E_UNPLACEABLE,
               "planting found no shift for spheres %d and %d: %g of the box, packing fraction %g, mk_zeta %g", i, j,
               touch / p.cell.side(), packing_fraction(p), p.mk_zeta);
        quenched.draw(i, j, attempt, 1.0, shift);
        Cell::Vector x{};
        p.cell.combine(shift, x.data());
        for (int c = 0; c < d; ++c)
          x[c] += p.position[static_cast<size_t>(i) * d + c] - p.position[static_cast<size_t>(j) * d + c];
        bool near = false;
        p.cell.images(x.data(), touch, [&](const double *) { near = true; });
        if (!near) break;
      }
      if (attempt > 0) p.mk_redrawn.push_back({i, j, attempt});
    }
  }
}

double default_packing_fraction(int dim) { return std::ldexp(start_fraction_3d, -std::max(0, dim - 3)); }

namespace {

// A random start at this packing fraction, with the ratios of the diameters.
void start_at(Packing &p, double wanted) {
  const double scale = math::pow(wanted / packing_fraction(p), 1.0 / p.dim);
  for (double &s : p.diameter) s *= scale;
  check_diameters(p.diameter, p.cell);
  if (p.overlap_allowed)
    place_uniformly(p);
  else if (p.model == JAM_MODEL_MK && p.mk_zeta > 0.0)
    plant(p);
  else
    place_at_random(p);
}

// A random start at the usual packing fraction, or where the spheres find no place in a narrow scene at a lower one.
void start_below(Packing &p, double usual, Notes *notes) {
  const std::vector<double> ratios = p.diameter;
  for (double wanted = usual;; wanted *= 0.5) {
    try {
      p.diameter = ratios;
      start_at(p, wanted);
      if (notes && wanted < usual)
        notes->say("the random start has the packing fraction %.4g: at the usual %g these spheres found no place",
                   wanted, usual);
      return;
    } catch (const Error &e) {
      const bool no_place = e.code() == JAM_E_UNPLACEABLE || e.code() == JAM_E_OVERLAP;
      if (!no_place || wanted < 1e-6 * usual) throw;
    }
  }
}

}  // namespace

void start_at_random(Packing &p, double packing_fraction, Notes *notes) {
  if (packing_fraction > 0.0)
    start_at(p, packing_fraction);
  else
    start_below(p, default_packing_fraction(p.dim), notes);
}

}  // namespace jam::inside
