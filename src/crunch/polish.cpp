// The last digits: contacts closed and forces balanced to rounding.
#include <algorithm>
#include <cmath>

#include "crunch/crunch.hpp"

namespace jam {
namespace {

// A tiny diagonal fixes the translations (and the rattlers, which no row holds); what it costs in accuracy the
// repeated steps win back.
std::vector<double> small_diagonal(const Packing &p, const ContactNetwork &net) {
  std::vector<double> diagonal(p.position.size(), 1e-12);
  for (size_t i = 0; i < p.n(); ++i)
    for (int c = 0; c < p.dim && net.coordination[i] == 0; ++c) diagonal[i * p.dim + c] = 1.0;
  return diagonal;
}

void refresh(const Packing &p, ContactNetwork &net) {
  double r[JAM_MAX_DIM];
  for (size_t k = 0; k < net.size(); ++k) {
    const double length = std::sqrt(pair_vector(p, net.pairs, k, r));
    for (int c = 0; c < p.dim; ++c) net.vector[k * p.dim + c] = r[c] / length;
    net.gap[k] = length / (0.5 * (p.diameter[net.pairs.i[k]] + p.diameter[net.pairs.j[k]])) - 1.0;
  }
}

double largest(const std::vector<double> &x) {
  double m = 0.0;
  for (double v : x) m = std::max(m, std::fabs(v));
  return m;
}

// One Gauss-Newton step of all gaps to zero over positions and the common factor of the diameters. On a network with a
// single state of self-stress the system is square and the step is Newton's; with more contacts it is least squares.
void close_contacts(Packing &p, ContactNetwork &net, NewtonSystem &system, const std::vector<double> &diagonal) {
  const int d = p.dim;
  std::vector<double> rows(net.size() * d), ones(net.size(), 1.0), rhs(p.position.size()), step(p.position.size());
  double h = 0.0, dg = 0.0;
  for (size_t k = 0; k < net.size(); ++k) {
    const double sigma = 0.5 * (p.diameter[net.pairs.i[k]] + p.diameter[net.pairs.j[k]]);
    for (int c = 0; c < d; ++c) rows[k * d + c] = net.vector[k * d + c] / sigma * diameter_mean(p);
    h += net.gap[k];
  }
  if (!system.factorise(rows.data(), ones.data(), diagonal.data())) return;
  system.transpose_times(rows.data(), net.gap.data(), rhs.data());
  for (double &v : rhs) v = -v;
  system.solve(rhs.data(), h, step.data(), &dg, 2);
  const double unit = diameter_mean(p);
  for (size_t k = 0; k < step.size(); ++k) p.position[k] += unit * step[k];
  for (double &s : p.diameter) s *= 1.0 + dg;
  wrap_positions(p, net.pairs);
  refresh(p, net);
}

// f -= S (S^T S)^-1 S^T f, twice or more: the nearest forces that balance on every sphere.
void balance_forces(const Packing &p, ContactNetwork &net, NewtonSystem &system, const std::vector<double> &diagonal) {
  std::vector<double> ones(net.size(), 1.0), unbalanced(p.position.size()), x(p.position.size()), correction(net.size());
  if (!system.factorise(net.vector.data(), ones.data(), diagonal.data())) return;
  for (int round = 0; round < 3; ++round) {
    system.transpose_times(net.vector.data(), net.force.data(), unbalanced.data());
    x = unbalanced;
    system.cholesky().solve(x.data());
    system.rows_times(net.vector.data(), x.data(), correction.data());
    for (size_t k = 0; k < net.size(); ++k) net.force[k] -= correction[k];
  }
  double mean = 0.0;
  for (double f : net.force) mean += f / static_cast<double>(net.size());
  for (double &f : net.force) f /= mean;
  net.force_scale *= mean;
}

}  // namespace

bool polish(Packing &p, ContactNetwork &net, NewtonSystem &system, int threads, Monitor *monitor) {
  if (net.size() == 0) return false;
  Packing q = p;
  ContactNetwork better = net;
  system.set_graph(p.dim, static_cast<int32_t>(p.n()), net.pairs, threads);
  const std::vector<double> diagonal = small_diagonal(p, net);
  double worst = largest(better.gap);
  for (int round = 0; round < 4 && worst > 1e-16; ++round) {
    Packing q_old = q;
    ContactNetwork old = better;
    close_contacts(q, better, system, diagonal);
    const double now = largest(better.gap);
    if (!(now < 0.5 * worst)) {  // no gain: rounding rules, or the contacts cannot all close
      if (!(now < worst)) q = std::move(q_old), better = std::move(old);
      break;
    }
    worst = now;
  }
  if (monitor && monitor->cancelled()) return false;
  balance_forces(q, better, system, diagonal);
  for (double f : better.force)
    if (!(f > 0.0)) return false;
  if (closest_pair(q).gap < std::min(-1e-14, closest_pair(p).gap)) return false;
  p = std::move(q);
  net = std::move(better);
  return true;
}

}  // namespace jam
