#include "network/rigidity_matrix.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/error.hpp"
#include "core/pair_rule.hpp"
#include "linalg/dot.hpp"
#include "network/tuning.hpp"

namespace jam::inside {
namespace {

void take_out(const std::vector<double> &v, double *x) {
  double along = 0.0;
  for (size_t k = 0; k < v.size(); ++k) along += v[k] * x[k];
  for (size_t k = 0; k < v.size(); ++k) x[k] -= along * v[k];
}

// Rotations about an axis on which all spheres stand are none.
void orthonormalise(std::vector<std::vector<double>> &vectors) {
  std::vector<std::vector<double>> kept;
  for (std::vector<double> &v : vectors) {
    const double before = norm(v);
    for (int twice = 0; twice < 2; ++twice)
      for (const std::vector<double> &q : kept) take_out(q, v.data());
    const double after = norm(v);
    if (!(after > RoundingTuning::sure * before)) continue;
    for (double &x : v) x /= after;
    kept.push_back(std::move(v));
  }
  vectors = std::move(kept);
}

[[noreturn]] void refuse_without_direction(const Packing &p, int32_t i, int32_t j) {
  if (j >= 0) fail(JAM_E_OVERLAP, "spheres %d and %d have the same centre: their contact has no direction", i, j);
  fail(JAM_E_OVERLAP, "the centre of sphere %d is on %s: the contact has no direction", i,
       p.container[wall_partner(j)].name().c_str());
}

}  // namespace

void take_symmetries(const Container &container, const double *position, RigidityMatrix &g) {
  const size_t d = static_cast<size_t>(g.dim);
  g.open_axes = ~container.closed();
  g.curved = container.curved();
  for (const Surface &wall : container) g.wall.push_back(wall.turning());
  for (int q = 0; q < container.rotations(); ++q) {
    std::vector<double> v(g.unknowns());
    for (size_t i = 0; i < g.sphere.size(); ++i)
      container.rotation(q, position + static_cast<size_t>(g.sphere[i]) * d, &v[i * d]);
    g.rotations.push_back(std::move(v));
  }
  orthonormalise(g.rotations);
}

RigidityMatrix make_rigidity_matrix(const Packing &p, const ContactNetwork &network) {
  RigidityMatrix g;
  const int d = g.dim = p.dim;
  g.node.assign(p.n(), -1);
  for (size_t k = 0; k < network.size(); ++k)
    for_spheres(network.pairs.i[k], network.pairs.j[k], [&](int32_t i) { g.node[i] = 0; });
  for (size_t i = 0; i < p.n(); ++i)
    if (g.node[i] == 0) {
      g.node[i] = g.nodes++;
      g.sphere.push_back(static_cast<int32_t>(i));
    }
  // Two coordinates are off by half a unit in their last place each.
  double largest = 0.0;
  for (const double x : p.position) largest = std::max(largest, std::fabs(x));
  g.rounding = std::sqrt(static_cast<double>(d)) * (std::nextafter(largest, HUGE_VAL) - largest);
  std::vector<double> r(d);
  for (size_t k = 0; k < network.size(); ++k) {
    const int32_t i = network.pairs.i[k], j = network.pairs.j[k];
    g.a.push_back(g.node[i]);
    g.b.push_back(j < 0 ? j : g.node[j]);
    g.distance.push_back(std::sqrt(pair_vector(p, network.pairs, k, r.data())));
    if (g.distance.back() == 0.0) refuse_without_direction(p, i, j);
    g.sigma.push_back(contact_distance(p, i, j));
    for (int c = 0; c < d; ++c) g.normal.push_back(r[c] / g.distance.back());
    g.bending.push_back(
        j < 0 ? -p.container[wall_partner(j)].curvature(&p.position[static_cast<size_t>(i) * static_cast<size_t>(d)])
              : 1.0 / g.distance.back());
  }
  if (p.container) take_symmetries(p.container, p.position.data(), g);
  g.force = network.force;
  g.stiffness = network.stiffness;
  g.prestress = network.prestress;
  return g;
}

RigidityMatrix subset(const RigidityMatrix &g, const std::vector<char> &on) {
  RigidityMatrix out;
  const size_t d = static_cast<size_t>(out.dim = g.dim);
  out.rounding = g.rounding;
  out.node.assign(static_cast<size_t>(g.nodes), -1);
  for (size_t k = 0; k < g.contacts(); ++k)
    if (on[k]) for_spheres(g.a[k], g.b[k], [&](int32_t i) { out.node[i] = 0; });
  for (int32_t i = 0; i < g.nodes; ++i)
    if (out.node[i] == 0) out.node[i] = out.nodes++, out.sphere.push_back(i);
  for (size_t k = 0; k < g.contacts(); ++k) {
    if (!on[k]) continue;
    out.a.push_back(out.node[g.a[k]]), out.b.push_back(g.b[k] < 0 ? g.b[k] : out.node[g.b[k]]);
    out.normal.insert(out.normal.end(), &g.normal[k * d], &g.normal[k * d] + d);
    if (!g.distance.empty()) out.distance.push_back(g.distance[k]);
    if (!g.bending.empty()) out.bending.push_back(g.bending[k]);
    if (!g.sigma.empty()) out.sigma.push_back(g.sigma[k]);
    if (!g.force.empty()) out.force.push_back(g.force[k]);
    if (!g.stiffness.empty()) out.stiffness.push_back(g.stiffness[k]), out.prestress.push_back(g.prestress[k]);
  }
  out.open_axes = g.open_axes, out.curved = g.curved, out.wall = g.wall;
  for (const std::vector<double> &all : g.rotations) {
    std::vector<double> v;
    for (const int32_t i : out.sphere)
      v.insert(v.end(), &all[static_cast<size_t>(i) * d], &all[static_cast<size_t>(i) * d] + d);
    out.rotations.push_back(std::move(v));
  }
  orthonormalise(out.rotations);
  return out;
}

int RigidityMatrix::symmetries() const {
  int count = static_cast<int>(rotations.size());
  for (int c = 0; c < dim; ++c) count += static_cast<int>(open_axes >> c & 1);
  return count;
}

void RigidityMatrix::remove_symmetries(double *x) const {
  remove_translation(dim, nodes, x, open_axes);
  for (const std::vector<double> &v : rotations) take_out(v, x);
}

RigidityMatrix::Stretch RigidityMatrix::stretch(size_t k, const double *u) const {
  const size_t d = static_cast<size_t>(dim);
  const double *n = &normal[k * d], *ua = u + static_cast<size_t>(a[k]) * d;
  double along = 0.0, all = 0.0, turned = 0.0;
  if (b[k] < 0) {
    const Turning turns = turning(k);
    for (size_t c = 0; c < d; ++c) {
      along += n[c] * ua[c];
      if (turns.along(static_cast<int>(c))) all += ua[c] * ua[c], turned += turns.lean * n[c] * ua[c];
    }
    return {along, all - turned * turned};
  }
  const double *ub = u + static_cast<size_t>(b[k]) * d;
  for (size_t c = 0; c < d; ++c) {
    const double x = ua[c] - ub[c];
    along += n[c] * x;
    all += x * x;
  }
  return {along, all - along * along};
}

void scatter(const RigidityMatrix &sub, const double *x, double factor, std::vector<double> &v) {
  for (int32_t i = 0; i < sub.nodes; ++i)
    for (int c = 0; c < sub.dim; ++c)
      v[static_cast<size_t>(sub.sphere[i]) * sub.dim + c] += factor * x[i * sub.dim + c];
}

std::vector<int32_t> parts_of(const RigidityMatrix &g, const std::vector<char> &left) {
  std::vector<int32_t> part(static_cast<size_t>(g.nodes));
  std::iota(part.begin(), part.end(), 0);
  const auto root = [&](int32_t i) {
    while (part[i] != i) i = part[i] = part[part[i]];
    return i;
  };
  for (size_t k = 0; k < g.contacts(); ++k)
    if (g.b[k] >= 0 && (left.empty() || (!left[g.a[k]] && !left[g.b[k]]))) {
      const int32_t a = root(g.a[k]), b = root(g.b[k]);
      part[std::max(a, b)] = std::min(a, b);
    }
  for (int32_t i = 0; i < g.nodes; ++i) part[i] = root(i);
  return part;
}

std::vector<double> direction_errors(const RigidityMatrix &g) {
  std::vector<double> open(static_cast<size_t>(g.nodes), 0.0),
      out(g.contacts(), 4.0 * std::numeric_limits<double>::epsilon());
  const auto apart = [&](size_t k) { return std::fabs(g.distance[k] - g.sigma[k]); };
  for (size_t k = 0; k < g.contacts(); ++k)
    for_spheres(g.a[k], g.b[k], [&](int32_t i) { open[i] = std::max(open[i], apart(k)); });
  for (size_t k = 0; k < g.contacts(); ++k) {
    double widest = 0.0;
    for_spheres(g.a[k], g.b[k], [&](int32_t i) { widest = std::max(widest, open[i]); });
    out[k] += (g.rounding + widest) / g.distance[k];
  }
  return out;
}

void apply_compatibility(const RigidityMatrix &g, const double *x, double *y) {
  rows_times(g.dim, g.a, g.b, g.normal.data(), x, y);
}

void apply_equilibrium(const RigidityMatrix &g, const double *f, double *y) {
  transpose_times(g.dim, g.nodes, g.a, g.b, g.normal.data(), f, y);
}

namespace {
// Largest |sum_j f_ij n_ij| of the net forces y (spheres, dim), over the mean of |f|.
double over_mean_force(int dim, const std::vector<double> &y, const double *f, size_t contacts) {
  double mean = 0.0;
  for (size_t k = 0; k < contacts; ++k) mean += std::fabs(f[k]);
  mean /= static_cast<double>(contacts);
  return mean > 0.0 ? std::sqrt(largest_squared(y, y.size() / static_cast<size_t>(dim), dim)) / mean : 0.0;
}
}  // namespace

double balance_residual(const RigidityMatrix &g, const double *f) {
  std::vector<double> y(g.unknowns());
  apply_equilibrium(g, f, y.data());
  return over_mean_force(g.dim, y, f, g.contacts());
}

double balance_residual(int dim, size_t n, const ContactNetwork &network) {
  std::vector<double> y(n * static_cast<size_t>(dim));
  transpose_times(dim, static_cast<int32_t>(n), network.pairs.i, network.pairs.j, network.vector.data(),
                  network.force.data(), y.data());
  return over_mean_force(dim, y, network.force.data(), network.size());
}

}  // namespace jam::inside
