// Random starts: sequential addition, uniform points, planted Mari-Kurchan systems.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/call_scope.hpp"
#include "core/create.hpp"
#include "core/free_room.hpp"
#include "core/limits.hpp"
#include "core/pairs.hpp"
#include "core/size_laws.hpp"
#include "core/tuning.hpp"

namespace jam::inside {
namespace {

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
  FreeRoom room(p, cells);
  Rng rng(p.seed, Stream::rsa_positions);
  double placed = 0.0;
  const double share = p.container ? p.cell.volume() / scene_volume(p) : 1.0;
  const int64_t most_total = PlaceTuning::tries_per_sphere * static_cast<int64_t>(n) + PlaceTuning::most_tries;
  int64_t total = 0, spheres = 0;
  for (size_t at = 0; at < n; ++at) {
    const int32_t i = order[at];
    double *x = &p.position[static_cast<size_t>(i) * d];
    if (room.known() && !room.serves(i)) room.forget();
    int64_t tries = 0, refinements = 0;
    // Whether no place is found: in few dimensions lists say so, in more they would have too many voxels.
    const auto ends = [&] {
      if (d > PlaceTuning::listed_dim) return tries > PlaceTuning::most_tries || total >= most_total;
      return tries % PlaceTuning::tries_of_one_list == 0 &&
             (!room.refine(order, at) || ++refinements == PlaceTuning::most_refinements);
    };
    do {
      ++tries;
      if (ends())
        fail(JAM_E_UNPLACEABLE,
             "random sequential addition reached packing fraction %.6f of the requested %.6f%s: start at a lower "
             "packing_fraction, and grow the spheres",
             placed, packing_fraction(p), d > PlaceTuning::listed_dim || room.known() ? "" : ", and no room is left");
      // A try takes long where one large sphere leaves few cells, and each of them holds many small ones.
      if (++total % PlaceTuning::tries_between_looks == 0) CallScope::look();
      if (total % PlaceTuning::tries_between_reports == 0) report_placed(placed, spheres, n);
      if (room.known())
        room.random_point(rng, x);
      else
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
    int64_t tries = 0;
    do {
      if (tries == PlaceTuning::most_tries)
        fail(JAM_E_UNPLACEABLE,
             "no place for sphere %zu of diameter %g was found between the walls: start at a lower "
             "packing_fraction, and grow the spheres",
             i, p.diameter[i]);
      if (++tries % PlaceTuning::tries_between_looks == 0) CallScope::look();
      random_point(p, rng, 0.5 * p.diameter[i], x);
    } while (!p.container.holds(x, 0.5 * p.diameter[i]));
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

// See free_room.hpp.
void FreeRoom::begin(const std::vector<int32_t> &order, size_t at) {
  // Distances of non-additive spheres need not fall with the diameter.
  const double part = p_.non_additivity == 0.0 ? PlaceTuning::serves : 1.0;
  smallest_ = order[at];
  for (size_t k = at; k < order.size() && p_.diameter[order[k]] >= part * p_.diameter[order[at]]; ++k)
    smallest_ = order[k];
  const size_t d = static_cast<size_t>(p_.dim);
  most_ = std::max(PlaceTuning::fewest_voxels, PlaceTuning::voxels_per_sphere * static_cast<double>(p_.n()));
  double wanted = 1.0;
  const auto parts = [&](size_t c) {
    return std::ceil(p_.cell.edge(c) / (PlaceTuning::voxel * p_.diameter[smallest_]));
  };
  for (size_t c = 0; c < d; ++c) wanted *= parts(c);
  const double coarser = wanted > most_ ? math::pow(most_ / wanted, 1.0 / p_.dim) : 1.0;
  std::vector<uint32_t> number(d), at_voxel(d, 0);
  edge_.resize(d);
  size_t total = 1;
  for (size_t c = 0; c < d; ++c) {
    number[c] = static_cast<uint32_t>(std::max(1.0, std::floor(coarser * parts(c))));
    edge_[c] = p_.cell.edge(c) / number[c];
    total *= number[c];
  }
  voxel_.reserve(total * d);
  for (size_t v = 0; v < total; ++v) {
    voxel_.insert(voxel_.end(), at_voxel.begin(), at_voxel.end());
    for (size_t c = 0; c < d && ++at_voxel[c] == number[c]; ++c) at_voxel[c] = 0;
  }
}

bool FreeRoom::may_fit(const uint32_t *voxel, const std::vector<double> &edge) const {
  Cell::Vector centre{};
  double square = 0.0;
  for (int c = 0; c < p_.dim; ++c) {
    centre[c] = (voxel[c] + 0.5) * edge[c];
    square += edge[c] * edge[c];
  }
  const double around = 0.5 * std::sqrt(square), radius = 0.5 * p_.diameter[smallest_];
  return p_.container.holds(centre.data(), radius - around) && !cells_.blocked(centre.data(), smallest_, around);
}

bool FreeRoom::sift(int halvings) {
  const size_t d = static_cast<size_t>(p_.dim), parts = size_t{1} << (halvings * p_.dim);
  std::vector<uint32_t> kept, part(d);
  std::vector<double> edge(edge_);
  for (double &e : edge) e = std::ldexp(e, -halvings);
  for (size_t v = 0; v < count(); ++v) {
    if (v % PlaceTuning::tries_between_looks == 0) CallScope::look();
    const uint32_t *whole = &voxel_[v * d];
    if (halvings && !may_fit(whole, edge_)) continue;
    for (size_t q = 0; q < parts; ++q) {
      for (size_t c = 0; c < d; ++c) part[c] = whole[c] << halvings | static_cast<uint32_t>(halvings ? q >> c & 1 : 0);
      if (may_fit(part.data(), edge)) kept.insert(kept.end(), part.begin(), part.end());
    }
    if (halvings && static_cast<double>(kept.size()) > most_ * p_.dim) return false;
  }
  voxel_ = std::move(kept), edge_ = std::move(edge);
  return true;
}

bool FreeRoom::refine(const std::vector<int32_t> &order, size_t at) {
  if (!known()) {
    begin(order, at);
    sift(0);
  } else {
    const bool fine = std::any_of(voxel_.begin(), voxel_.end(), [](uint32_t k) { return k >> 31; });
    if (fine || !sift(1)) sift(0);
  }
  return known();
}

void FreeRoom::random_point(Rng &rng, double *x) const {
  const size_t n = count();
  const size_t v = std::min(n - 1, static_cast<size_t>(rng.uniform() * static_cast<double>(n)));
  for (int c = 0; c < p_.dim; ++c) {
    const double in_brick = (voxel_[v * static_cast<size_t>(p_.dim) + c] + rng.uniform()) * edge_[c];
    x[c] = wrap(in_brick, p_.cell.edge(c));
  }
}

}  // namespace jam::inside
