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

// Residuals in extended precision: in double those of a converged packing are rounding of these sums alone.
using Wide = long double;
// A pair that stays wider than this, relative, when all contacts are closed together is none.
constexpr double closed = 1e-8;
// Gaps above this are more than what rounding leaves of closed contacts.
constexpr double rounding = 3e-14;

void refresh(const Packing &p, ContactNetwork &net) {
  const int d = p.dim;
  Wide r[JAM_MAX_DIM];
  for (size_t k = 0; k < net.size(); ++k) {
    const size_t i = net.pairs.i[k], j = net.pairs.j[k];
    Wide r2 = 0.0;
    for (int c = 0; c < d; ++c) {
      r[c] = (static_cast<Wide>(p.position[i * d + c]) - p.position[j * d + c]) + net.pairs.offset[k * d + c];
      r2 += r[c] * r[c];
    }
    const Wide length = std::sqrt(r2), sigma = 0.5L * (static_cast<Wide>(p.diameter[i]) + p.diameter[j]);
    for (int c = 0; c < d; ++c) net.vector[k * d + c] = static_cast<double>(r[c] / length);
    net.gap[k] = static_cast<double>((length - sigma) / sigma);
  }
}

double largest(const std::vector<double> &x) {
  double m = 0.0;
  for (double v : x) m = std::max(m, std::fabs(v));
  return m;
}

double norm(const std::vector<double> &x) {
  double sum = 0.0;
  for (double v : x) sum += v * v;
  return std::sqrt(sum);
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
  const int d = p.dim;
  std::vector<double> ones(net.size(), 1.0), x(p.position.size()), correction(net.size());
  std::vector<Wide> force(net.force.begin(), net.force.end()), unbalanced(p.position.size());
  if (!system.factorise(net.vector.data(), ones.data(), diagonal.data())) return;
  for (int round = 0; round < 4; ++round) {
    std::fill(unbalanced.begin(), unbalanced.end(), 0.0L);
    for (size_t k = 0; k < net.size(); ++k)
      for (int c = 0; c < d; ++c) {
        const Wide f = force[k] * net.vector[k * d + c];
        unbalanced[static_cast<size_t>(net.pairs.i[k]) * d + c] += f;
        unbalanced[static_cast<size_t>(net.pairs.j[k]) * d + c] -= f;
      }
    std::copy(unbalanced.begin(), unbalanced.end(), x.begin());
    system.cholesky().solve(x.data());
    system.rows_times(net.vector.data(), x.data(), correction.data());
    for (size_t k = 0; k < net.size(); ++k) force[k] -= correction[k];
  }
  Wide mean = 0.0;
  for (Wide f : force) mean += std::fabs(f) / static_cast<Wide>(net.size());  // a sign that is wrong must show
  for (size_t k = 0; k < net.size(); ++k) net.force[k] = static_cast<double>(force[k] / mean);
  net.force_scale *= static_cast<double>(mean);
}

bool pushes_only(const ContactNetwork &net) {
  return std::all_of(net.force.begin(), net.force.end(), [](double f) { return f > 0.0; });
}

int64_t excess(const ContactNetwork &net, int dim) {
  const auto stable = std::count_if(net.coordination.begin(), net.coordination.end(), [](int32_t z) { return z > 0; });
  return static_cast<int64_t>(net.size()) - (dim * (stable - 1) + 1);
}

// More contacts than one state of self-stress needs: the forces are not unique. Those of least norm at the same mean are the
// projection of equal forces; false, and nothing changed, if one of them pulls (the LP's forces then have to do).
bool least_forces(const Packing &p, ContactNetwork &net, NewtonSystem &system, const std::vector<double> &diagonal) {
  if (excess(net, p.dim) <= 0) return false;
  ContactNetwork least = net;
  std::fill(least.force.begin(), least.force.end(), 1.0);
  balance_forces(p, least, system, diagonal);
  if (!pushes_only(least)) return false;
  least.force_scale = net.force_scale;
  net = std::move(least);
  return true;
}

// False where a sphere would be left with too few contacts.
bool drop(ContactNetwork &net, size_t k, int dim) {
  int32_t &zi = net.coordination[net.pairs.i[k]], &zj = net.coordination[net.pairs.j[k]];
  if (zi <= dim + 1 || zj <= dim + 1) return false;
  --zi, --zj;
  const auto erase = [k](auto &v, size_t width) { v.erase(v.begin() + k * width, v.begin() + (k + 1) * width); };
  erase(net.pairs.i, 1), erase(net.pairs.j, 1), erase(net.pairs.offset, dim);
  erase(net.vector, dim), erase(net.gap, 1), erase(net.force, 1);
  return true;
}

// What least squares leave of the gaps is orthogonal to every change of the packing: itself a state of self-stress g, without
// pressure. Of the forces f - t g the first to vanish, as t grows, is of the contact that opens when the others close: a pivot of
// the dual simplex. False where all are closed, and where that contact's spheres have none to spare.
bool drop_open_contact(ContactNetwork &net, int dim) {
  if (excess(net, dim) <= 0 || !(largest(net.gap) > rounding)) return false;
  size_t first = net.size();
  for (size_t k = 0; k < net.size(); ++k)
    if (net.gap[k] > 0.0 && (first == net.size() || net.force[k] * net.gap[first] < net.force[first] * net.gap[k])) first = k;
  return first < net.size() && drop(net, first, dim);
}

// Closes all contacts as far as they go: on a network with one state of self-stress to rounding, else in least squares. False when cancelled.
bool close_all(Packing &p, ContactNetwork &net, NewtonSystem &system, int threads, Monitor *monitor) {
  system.set_graph(p.dim, static_cast<int32_t>(p.n()), net.pairs, threads);
  const std::vector<double> diagonal = small_diagonal(p, net);
  const auto open = [&] { return excess(net, p.dim) > 0 ? norm(net.gap) : largest(net.gap); };
  double worst = open();
  for (int round = 0; round < 4 && worst > 1e-16; ++round) {
    if (monitor) monitor->log(JAM_LOG_DEBUG, "polish %d largest gap %.2e", round, largest(net.gap));
    if (monitor && monitor->cancelled()) return false;
    Packing p_old = p;
    ContactNetwork old = net;
    close_contacts(p, net, system, diagonal);
    const double now = open();
    if (!(now < 0.5 * worst)) {  // no gain: rounding rules, or the contacts cannot all close
      if (!(now < worst)) p = std::move(p_old), net = std::move(old);
      break;
    }
    worst = now;
  }
  return !(monitor && monitor->cancelled());
}

}  // namespace

bool drop_idle_contact(ContactNetwork &net, int dim) {
  constexpr double idle = 1e-5;
  if (net.size() == 0 || excess(net, dim) <= 0) return false;
  const size_t k = std::min_element(net.force.begin(), net.force.end()) - net.force.begin();
  return net.force[k] <= idle && drop(net, k, dim);
}

PolishEnd polish(Packing &p, ContactNetwork &net, NewtonSystem &system, int threads, Monitor *monitor) {
  if (net.size() == 0) return PolishEnd::no_contacts;
  Packing q = p;
  ContactNetwork better = net;
  do {
    if (!close_all(q, better, system, threads, monitor)) return PolishEnd::cancelled;
    if (!(largest(better.gap) < closed)) return PolishEnd::open_contact;
  } while (drop_open_contact(better, p.dim));
  if (monitor && largest(better.gap) > rounding)
    monitor->log(JAM_LOG_WARNING, "polish: %zu contacts cannot all close, gaps of %.1e stay", better.size(), largest(better.gap));
  const std::vector<double> diagonal = small_diagonal(q, better);
  if (!least_forces(q, better, system, diagonal)) balance_forces(q, better, system, diagonal);
  if (!pushes_only(better)) return PolishEnd::negative_force;
  if (closest_pair(q).gap < std::min(-1e-14, closest_pair(p).gap)) return PolishEnd::overlap;
  p = std::move(q);
  net = std::move(better);
  return PolishEnd::done;
}

}  // namespace jam
