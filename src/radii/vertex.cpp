// See vertex.hpp.
#include "radii/vertex.hpp"

#include <algorithm>
#include <cmath>

#include "core/double_double.hpp"
#include "core/rng.hpp"
#include "radii/path.hpp"
#include "radii/tuning.hpp"

namespace jam::inside {
namespace {

double longest_edge(const Packing &p) {
  double edge = 0.0;
  for (int c = 0; c < p.dim; ++c) edge = std::max(edge, p.cell.edge(c));
  return edge;
}

double largest_of(const std::vector<double> &x) {
  double most = 0.0;
  for (const double v : x) most = std::max(most, std::fabs(v));
  return most;
}

// Newton steps on c = 0, the shortest ones where there are more unknowns than contacts.
bool close_contacts(Packing &p, RadiiRows &contacts, RadiiMatrix &matrix, double unit) {
  const std::vector<double> ones(contacts.pairs.size() + contacts.bounds(), 1.0);
  std::vector<double> step;
  double path = 0.0, before = std::numeric_limits<double>::infinity();
  Packing moved = p;
  for (int k = 0; k < RadiiTuning::polish_steps; ++k) {
    contacts.measure(p);
    const double wrong = largest_of(contacts.gap);
    const bool small = wrong <= RadiiTuning::closed * longest_edge(p);
    if (small && !(wrong < 0.5 * before)) return true;
    if (k > 3 && !small && !(wrong < before)) return false;
    before = wrong;
    contacts.transpose_times(contacts.gap, step);
    matrix.factorise(contacts, ones, RadiiTuning::polish_ridge, 1);
    matrix.solve(step);
    path += largest_of(step);
    if (!(path < RadiiTuning::longest_polish * unit)) return false;
    move_radii(p, step, -1.0, moved);
    p.position.swap(moved.position), p.diameter.swap(moved.diameter);
  }
  contacts.measure(p);
  return largest_of(contacts.gap) <= RadiiTuning::closed * longest_edge(p);
}

// sum_k f_k a_k + w: zero on all unknowns at a maximum.
std::vector<double> imbalance(const RadiiRows &contacts, const std::vector<double> &force,
                              const std::vector<double> &weight) {
  std::vector<double> out;
  contacts.transpose_times(force, out);
  const size_t b = contacts.block();
  for (size_t i = 0; i < weight.size(); ++i) out[i * b + b - 1] += weight[i];
  return out;
}

// The largest of them over the weight of its sphere, which is all that the sphere carries.
double residual(const std::vector<double> &wrong, const std::vector<double> &weight) {
  const size_t b = wrong.size() / weight.size();
  double most = 0.0;
  for (size_t q = 0; q < wrong.size(); ++q) most = std::max(most, std::fabs(wrong[q]) / weight[q / b]);
  return most;
}

// The balanced forces nearest to those given.
double balance(const RadiiRows &contacts, const std::vector<double> &weight, const RadiiMatrix &matrix,
               std::vector<double> &force) {
  std::vector<double> correction, best = force;
  double least = residual(imbalance(contacts, force, weight), weight);
  for (int k = 0; k < RadiiTuning::balance_steps; ++k) {
    std::vector<double> wrong = imbalance(contacts, force, weight);
    matrix.solve(wrong);
    contacts.times(wrong, correction);
    for (size_t q = 0; q < force.size(); ++q) force[q] -= correction[q];
    const double now = residual(imbalance(contacts, force, weight), weight);
    if (!(now < least)) break;
    least = now, best = force;
  }
  force = best;
  return least;
}

// Whether pair k overlaps, in two doubles, which are exact here up to 1e-31.
bool overlaps(const Packing &p, const PairList &pairs, size_t k) {
  const size_t d = static_cast<size_t>(p.dim), i = static_cast<size_t>(pairs.i[k]);
  if (pairs.wall(k)) {
    const Surface &wall = p.container[wall_partner(pairs.j[k])];
    return (wall.distance<DoubleDouble>(&p.position[i * d]) - DoubleDouble(0.5 * p.diameter[i])).high < 0.0;
  }
  const size_t j = static_cast<size_t>(pairs.j[k]);
  DoubleDouble r2(0.0);
  for (size_t c = 0; c < d; ++c) {
    const DoubleDouble r =
        two_sum(p.position[i * d + c], -p.position[j * d + c]) + DoubleDouble(pairs.offset[k * d + c]);
    r2 = r2 + r * r;
  }
  const DoubleDouble sum = two_sum(0.5 * p.diameter[i], 0.5 * p.diameter[j]);
  return (r2 - sum * sum).high < 0.0;
}

// Takes units of the last digit from diameters until no pair overlaps: one, then twice as many each time. least: radii
// at this bound stay there if the partner can shrink.
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

// The part of a random motion that keeps the contacts closed.
std::vector<double> free_motion(const Packing &p, const RadiiRows &contacts, const RadiiMatrix &matrix) {
  Rng rng(p.seed, Stream::radii_saddle);
  std::vector<double> x(contacts.unknowns()), opened, back;
  for (double &v : x) v = rng.normal();
  const double before = largest_of(x);
  for (int k = 0; k < RadiiTuning::projections; ++k) {
    contacts.times(x, opened);
    contacts.transpose_times(opened, back);
    matrix.solve(back);
    for (size_t q = 0; q < x.size(); ++q) x[q] -= back[q];
  }
  const double rest = largest_of(x);
  if (!(rest > RadiiTuning::no_motion * before)) return {};
  for (double &v : x) v /= rest;
  return x;
}

// Second derivative of sum f c along x over sum f, in 1 / length: pairs alone turn.
double opening(const RadiiRows &contacts, const std::vector<double> &force, const std::vector<double> &x) {
  const size_t b = contacts.block(), d = b - 1;
  double sum = 0.0, forces = 0.0;
  for (size_t k = 0; k < contacts.pairs.size(); ++k) {
    forces += force[k];
    if (contacts.pairs.wall(k) || contacts.pairs.own_image(k)) continue;
    const double *xi = &x[static_cast<size_t>(contacts.pairs.i[k]) * b], *n = &contacts.normal[k * d],
                 *xj = &x[static_cast<size_t>(contacts.pairs.j[k]) * b];
    double s2 = 0.0, along = 0.0;
    for (size_t c = 0; c < d; ++c) s2 += (xi[c] - xj[c]) * (xi[c] - xj[c]), along += n[c] * (xi[c] - xj[c]);
    sum += force[k] * (s2 - along * along) / contacts.length[k];
  }
  return forces > 0.0 ? sum / forces : 0.0;
}

}  // namespace

RadiiVertex close_vertex(const Packing &p, const RadiiRows &rows, const std::vector<double> &forces,
                         const std::vector<double> &weight, const RadiiBounds &bounds, double unit,
                         RadiiMatrix &matrix) {
  RadiiVertex out;
  std::vector<char> carries(rows.size());
  for (size_t k = 0; k < rows.size(); ++k) {
    carries[k] = forces[k] * unit > rows.gap[k];
    if (carries[k]) out.force.push_back(forces[k]);
  }
  out.packing = p;
  out.contacts = rows.only(carries);
  if (out.force.empty() || !close_contacts(out.packing, out.contacts, matrix, unit)) return out;
  take_rounding_out(out.packing, out.contacts.pairs, bounds.least);
  wrap_positions(out.packing, out.contacts.pairs);
  out.contacts.measure(out.packing);
  matrix.factorise(out.contacts, std::vector<double>(out.force.size(), 1.0), RadiiTuning::polish_ridge, 1);
  out.balance = balance(out.contacts, weight, matrix, out.force);
  if (!(out.balance <= RadiiTuning::balanced)) return out;
  for (double &f : out.force) {
    if (!(f >= RadiiTuning::no_force)) return out;
    f = std::max(f, 0.0);
  }
  const RadiiRows near(out.packing, bounds, RadiiTuning::reach * unit);
  std::vector<double> gaps;
  near.measure_gaps(out.packing, gaps);
  if (*std::min_element(gaps.begin(), gaps.end()) < -RadiiTuning::closed * longest_edge(p)) return out;
  take_rounding_out(out.packing, near.pairs, bounds.least);
  out.contacts.measure(out.packing);
  out.gap = largest_of(out.contacts.gap);
  near.measure_gaps(out.packing, gaps);
  gaps.resize(near.pairs.size());
  std::sort(gaps.begin(), gaps.end());
  const size_t closed = out.contacts.pairs.size();
  out.open = closed < gaps.size() ? gaps[closed] : std::numeric_limits<double>::infinity();
  out.closed = true;
  const std::vector<double> motion = free_motion(out.packing, out.contacts, matrix);
  if (!motion.empty() && opening(out.contacts, out.force, motion) * unit > RadiiTuning::turning) out.escape = motion;
  return out;
}

}  // namespace jam::inside
