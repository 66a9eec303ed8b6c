// A free cell: path and LPs with strain amplitudes go on from the packing that fits the fixed one. They end in a
// strictly jammed packing, with d (N' - 1) + d (d + 1) / 2 contacts when it is disordered (Torquato and Jiao, Phys.
// Rev. E 82, 061302 (2010)).
#include <algorithm>
#include <cmath>

#include "core/cell_reduction.hpp"
#include "crunch/state.hpp"

namespace jam {

bool frees_cell(const CrunchState &s) {
  return s.o.strain != JAM_STRAIN_NONE && s.strain.count() == 0 && s.out.report.stop_reason == JAM_STOP_NONE;
}

Phase free_cell(CrunchState &s) {
  const bool edges = (s.o.strain & JAM_STRAIN_EDGES) != 0, tilts = (s.o.strain & JAM_STRAIN_TILTS) != 0;
  s.strain = strain_basis(s.out.packing.dim, edges, tilts);
  s.monitor.log(JAM_LOG_INFO, "fixed cell: phi %.12f; %d strains join", packing_fraction(s.out.packing),
                s.strain.count());
  s.bound = s.tuning.first_bound;
  s.moved = 1.0;
  s.stalled = 0;
  s.exact = s.path_taken = s.history.stage.path_taken = false;
  s.history.stage.cell_free = true;
  return Phase::approach;
}

namespace {

// r -> r + t (eps r + v) for all vectors r between spheres, then back to the old volume. False where Mari-Kurchan
// shifts would change.
bool deform_into(Packing &q, const Packing &p, const std::vector<double> &v, const std::vector<double> &eps, double t) {
  q = p;
  const int d = p.dim;
  std::vector<double> rows = p.cell.rows();
  const auto deform = [&](double *x) {
    Cell::Vector y{};
    for (int a = 0; a < d; ++a)
      for (int b = 0; b < d; ++b) y[a] += t * eps[a * d + b] * x[b];
    for (int a = 0; a < d; ++a) x[a] += y[a];
  };
  for (int c = 0; c < d; ++c) deform(&rows[c * d]);
  for (size_t k = 0; k < q.position.size(); k += d) deform(&q.position[k]);
  for (size_t k = 0; k < v.size(); ++k) q.position[k] += t * v[k];
  const ReducedCell reduced = reduce_cell(d, rows.data());
  if (!keeps_shifts(p, reduced)) return false;
  enter_cell(q, reduced);
  const double back = p.cell.side() / q.cell.side();
  rows = q.cell.rows();
  for (double &x : rows) x *= back;
  for (double &x : q.position) x *= back;
  q.cell = Cell::from_triangle(d, rows.data());
  wrap_positions(q);
  return true;
}

}  // namespace

// |r + t (eps r + v)|^2 = r^2 + 2 t r . (eps r + v) + t^2 |eps r + v|^2: contacts open, so only near pairs can block.
bool leave_strained_saddle(CrunchState &s, const PackingVerdict &strict) {
  const RigidityResult &r = strict.result;
  if (r.flex.empty() || r.strain.empty() || s.kicks >= s.tuning.max_kicks) return false;
  ++s.kicks;
  Packing &p = s.out.packing;
  const size_t d = static_cast<size_t>(p.dim);
  double largest = 0.0;
  std::vector<double> v(p.position.size(), 0.0), eps = r.strain;
  for (size_t q = 0; q < strict.sphere.size(); ++q)
    for (size_t c = 0; c < d; ++c) v[strict.sphere[q] * d + c] = r.flex[q * d + c];
  const double unit = diameter_mean(p);
  for (double x : v) largest = std::max(largest, std::fabs(x));
  for (double x : eps) largest = std::max(largest, unit * std::fabs(x));
  for (double t = s.tuning.kick * unit / largest; t * largest > 1e-6 * unit; t *= 0.5) {
    Packing q;
    if (!deform_into(q, p, v, eps, t) || closest_pair(q).gap < -1e-13) continue;
    s.monitor.log(JAM_LOG_INFO, "saddle of the free cell at phi %.12f with %lld flexes: moves %.1e diameters",
                  packing_fraction(p), static_cast<long long>(r.flexes), t * largest / unit);
    p = std::move(q);
    s.bound = s.tuning.first_bound;
    s.moved = 1.0;
    s.stalled = 0;
    s.exact = s.jammed = false;
    return true;
  }
  return false;
}

void shorten_cell(Packing &p) {
  const ReducedCell reduced = reduce_cell(p.dim, p.cell.rows().data());
  if (keeps_shifts(p, reduced)) enter_cell(p, reduced);
}

}  // namespace jam
