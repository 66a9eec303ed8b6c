// See vertex.hpp.
#include "radii/vertex.hpp"

#include <algorithm>
#include <cmath>

#include "core/double_double.hpp"
#include "core/rng.hpp"
#include "linalg/dot.hpp"
#include "radii/tuning.hpp"

namespace jam::inside {
namespace {

// Whether pair k overlaps, in two doubles, which are exact here up to 1e-31.
bool overlaps(const Packing &p, const PairList &pairs, size_t k) {
  const size_t d = static_cast<size_t>(p.dim), i = static_cast<size_t>(pairs.i[k]);
  if (pairs.wall(k)) {
    const Surface &wall = p.container[wall_partner(pairs.j[k])];
    return (wall.distance<DoubleDouble>(&p.position[i * d]) - DoubleDouble(0.5 * p.diameter[i])).high < 0.0;
  }
  const size_t j = static_cast<size_t>(pairs.j[k]);
  DoubleDouble r2(0.0);
  double whole[JAM_MAX_DIM];
  p.cell.fraction(&pairs.offset[k * d], whole);
  for (size_t c = 0; c < d; ++c) {
    DoubleDouble r = two_sum(p.position[i * d + c], -p.position[j * d + c]);
    for (size_t a = c; a < d; ++a) r = r + two_product(std::nearbyint(whole[a]), p.cell.row(static_cast<int>(a))[c]);
    r2 = r2 + r * r;
  }
  const DoubleDouble sum = two_sum(0.5 * p.diameter[i], 0.5 * p.diameter[j]);
  return (r2 - sum * sum).high < 0.0;
}

// What closed bounds leave: radii between them to the last digit.
void keep_bounds(Packing &p, const RadiiBounds &bounds) {
  for (double &s : p.diameter) s = std::min(std::max(s, 2.0 * bounds.least), 2.0 * bounds.most);
}

// That part of a random motion.
std::vector<double> free_motion(const Packing &p, const RadiiRows &contacts, const RadiiMatrix &matrix) {
  Rng rng(p.seed, Stream::radii_saddle);
  std::vector<double> x(contacts.unknowns());
  for (double &v : x) v = rng.normal();
  const double before = largest_entry(x);
  keep_closed(contacts, matrix, x);
  const double rest = largest_entry(x);
  if (!(rest > RadiiTuning::no_motion * before)) return {};
  for (double &v : x) v /= rest;
  return x;
}

// Second derivative of the factor that keeps the volume (core/cell_change.hpp) along a strain.
double widening_of(const Packing &p, const std::vector<double> &strain) {
  if (strain.empty()) return 0.0;
  double sum = 0.0;
  for (size_t c = 0; c * c < strain.size(); ++c) sum += strain[c * (p.dim + 1)] * strain[c * (p.dim + 1)];
  return sum / (p.container ? p.container.open_axes() : p.dim);
}

// The second derivative over the sum of forces, in 1 / length.
double opening(const RadiiVertex &at, const RadiiGoal &goal, const std::vector<double> &x) {
  double forces = 0.0;
  for (size_t k = 0; k < at.contacts.pairs.size(); ++k) forces += at.force[k];
  return forces > 0.0 ? second_derivative(at, goal, x) / forces : 0.0;
}

}  // namespace

void take_rounding_out(Packing &p, const PairList &pairs, double least) {
  for (bool again = true; again;) {
    again = false;
    for (size_t k = 0; k < pairs.size(); ++k)
      for (double units = 1.0; overlaps(p, pairs, k); units *= 2.0) {
        bool free = false;
        for_spheres(pairs.i[k], pairs.j[k], [&](int32_t q) { free = free || p.diameter[q] > 2.0 * least; });
        for_spheres(pairs.i[k], pairs.j[k], [&](int32_t q) {
          const double d = p.diameter[q], smaller = d - units * (d - std::nextafter(d, 0.0));
          if (!free || d > 2.0 * least) p.diameter[q] = std::max(smaller, free ? 2.0 * least : 0.0);
        });
        again = true;
      }
  }
}

double second_derivative(const RadiiVertex &at, const RadiiGoal &goal, const std::vector<double> &x) {
  const RadiiRows &contacts = at.contacts;
  const std::vector<double> &force = at.force;
  const size_t b = contacts.block(), d = b - 1;
  const std::vector<double> strain = strain_of(contacts.allowed(), x, 1.0);
  const double widening = widening_of(at.packing, strain);
  double sum = goal.curvature(at.packing, at.multiplier, x);
  for (size_t k = 0; k < contacts.pairs.size(); ++k) {
    if (contacts.pairs.own_image(k) && strain.empty()) continue;
    const double *xi = &x[static_cast<size_t>(contacts.pairs.i[k]) * b], *n = &contacts.normal[k * d];
    if (contacts.pairs.wall(k)) {
      const Surface &wall = at.packing.container[wall_partner(contacts.pairs.j[k])];
      if (!wall.curved()) continue;
      const double bend = force[k] * wall.curvature(&at.packing.position[static_cast<size_t>(contacts.pairs.i[k]) * d]);
      contacts.bending(at.packing, k, [&](int u, int v, double share) { sum -= bend * share * xi[u] * xi[v]; });
      continue;
    }
    const double *xj = &x[static_cast<size_t>(contacts.pairs.j[k]) * b];
    double s2 = 0.0, along = 0.0, open = 0.0;
    for (size_t c = 0; c < d; ++c) {
      double s = xi[c] - xj[c];
      for (size_t a = c; a < d && !strain.empty(); ++a) s += strain[c * d + a] * n[a] * contacts.length[k];
      s2 += s * s, along += n[c] * s;
      if (!(at.packing.container.closed() >> c & 1u)) open += n[c] * n[c];
    }
    sum += force[k] * (s2 - along * along) / contacts.length[k];
    sum += force[k] * widening * open * contacts.length[k];
  }
  return sum;
}

RadiiVertex close_vertex(const Packing &p, const RadiiRows &rows, const std::vector<double> &forces, RadiiGoal &goal,
                         const RadiiBounds &bounds, double unit, RadiiMatrix &matrix) {
  RadiiVertex out;
  std::vector<char> carries(rows.size());
  for (size_t k = 0; k < rows.size(); ++k) {
    carries[k] = forces[k] * unit > rows.gap[k];
    if (carries[k] && k >= rows.linear()) out.wide = rows.pairs.i[rows.facing(k)];
    if (carries[k] && k < rows.linear()) out.force.push_back(forces[k]);
  }
  out.packing = p;
  out.contacts = rows.only(carries);
  if (out.wide >= 0 || out.force.empty() || !close_contacts(out.packing, out.contacts, goal, matrix, unit)) return out;
  keep_bounds(out.packing, bounds);
  take_rounding_out(out.packing, out.contacts.pairs, bounds.least);
  wrap_positions(out.packing, out.contacts.pairs);
  balance_contacts(out, goal, matrix);
  if (!(out.balance <= RadiiTuning::balanced)) {
    if (!(goal.moments() || p.container.curved()) || !settle_curved(out, goal, unit, matrix)) return out;
    keep_bounds(out.packing, bounds);
    take_rounding_out(out.packing, out.contacts.pairs, bounds.least);
  }
  for (double &f : out.force) {
    if (!(f >= RadiiTuning::no_force)) return out;
    f = std::max(f, 0.0);
  }
  RadiiRows near(out.packing, bounds, RadiiTuning::reach * unit);
  std::vector<double> gaps;
  near.measure_gaps(out.packing, gaps);
  if (*std::min_element(gaps.begin(), gaps.end()) < -RadiiTuning::closed * longest_edge(p)) return out;
  take_rounding_out(out.packing, near.pairs, bounds.least);
  out.contacts.measure(out.packing);
  out.gap = largest_entry(out.contacts.gap);
  near.measure_gaps(out.packing, gaps);
  gaps.resize(near.pairs.size());
  std::sort(gaps.begin(), gaps.end());
  const size_t closed = out.contacts.pairs.size();
  out.open = closed < gaps.size() ? gaps[closed] : std::numeric_limits<double>::infinity();
  out.closed = true;
  const std::vector<double> motion =
      p.container.curved() ? least_held(out, goal, matrix) : free_motion(out.packing, out.contacts, matrix);
  if (motion.empty()) return out;
  if (opening(out, goal, motion) * unit > RadiiTuning::turning) out.escape = motion;
  return out;
}

}  // namespace jam::inside
