#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/rng.hpp"
#include "linalg/dot.hpp"
#include "linalg/symmetric_eigen.hpp"
#include "radii/tuning.hpp"
#include "radii/vertex.hpp"

namespace jam::inside {
namespace {

// sum_k f_k a_k + w: zero on all unknowns at a maximum. weight: what forces add up to.
std::vector<double> imbalance(const RadiiRows &contacts, const std::vector<double> &force,
                              const std::vector<double> &weight) {
  std::vector<double> out;
  contacts.transpose_times(force, out);
  const size_t b = contacts.block();
  for (size_t i = 0; i < weight.size(); ++i) out[i * b + b - 1] += weight[i];
  return out;
}

// The largest of them over the weight of its sphere, which is all that the sphere carries; of strains over all weights.
double residual(const RadiiRows &contacts, const std::vector<double> &wrong, const std::vector<double> &weight) {
  const double all = std::accumulate(weight.begin(), weight.end(), 0.0);
  double most = 0.0;
  for (size_t q = 0; q < wrong.size(); ++q) {
    const size_t i = q / contacts.block();
    const double part = std::fabs(wrong[q]) / (i < weight.size() ? weight[i] : all);
    if (std::isnan(part)) return part;  // no balance
    most = std::max(most, part);
  }
  return most;
}

// The balanced forces nearest to those given, and the multipliers of the goal's equations.
double balance(const RadiiRows &contacts, const RadiiGoal &goal, const RadiiMatrix &matrix, std::vector<double> &force,
               std::vector<double> &multiplier) {
  multiplier.assign(goal.equations(), 0.0);
  std::vector<double> correction, best = force, best_multiplier = multiplier, weight = goal.carried(multiplier);
  double least = residual(contacts, imbalance(contacts, force, weight), weight);
  for (int k = 0; k < RadiiTuning::balance_steps; ++k) {
    std::vector<double> wrong = imbalance(contacts, force, weight);
    const std::vector<double> more = matrix.solve(wrong);
    contacts.times(wrong, correction);
    for (size_t q = 0; q < force.size(); ++q) force[q] -= correction[q];
    for (size_t q = 0; q < more.size(); ++q) multiplier[q] += more[q];
    weight = goal.carried(multiplier);
    const double now = residual(contacts, imbalance(contacts, force, weight), weight);
    if (!(now < least)) break;
    least = now, best = force, best_multiplier = multiplier;
  }
  force = best, multiplier = best_multiplier;
  return least;
}

// Takes from x, of the unknowns, the translations that keep all contacts, the displacements of spheres without
// contacts, and what it has along the motions before it. False where nothing is left.
bool independent(const RadiiRows &contacts, const std::vector<char> &touched,
                 const std::vector<std::vector<double>> &before, std::vector<double> &x) {
  const size_t b = contacts.block(), n = touched.size();
  std::vector<double> moved(x.size()), opened;
  for (size_t c = 0; c + 1 < b; ++c) {
    std::fill(moved.begin(), moved.end(), 0.0);
    double mean = 0.0, count = 0.0;
    for (size_t i = 0; i < n; ++i)
      if (touched[i]) moved[i * b + c] = 1.0, mean += x[i * b + c], count += 1.0;
    contacts.times(moved, opened);
    const bool keeps = largest_entry(opened) == 0.0 && count > 0.0;
    for (size_t i = 0; i < n; ++i) x[i * b + c] = touched[i] ? x[i * b + c] - (keeps ? mean / count : 0.0) : 0.0;
  }
  const auto along = [&](const std::vector<double> &y) {
    double sum = 0.0;
    for (size_t q = 0; q < x.size(); ++q) sum += x[q] * y[q];
    return sum;
  };
  for (const std::vector<double> &y : before) {
    const double part = along(y);
    for (size_t q = 0; q < x.size(); ++q) x[q] -= part * y[q];
  }
  const double size = std::sqrt(along(x));
  if (!(size > RadiiTuning::no_motion * std::sqrt(static_cast<double>(x.size())))) return false;
  for (double &v : x) v /= size;
  return true;
}

// Of motions along directions that a round wall bends: one wall contact may replace so many of pairs.
size_t most_motions(const RadiiVertex &at) {
  size_t most = RadiiTuning::most_motions;
  for (size_t k = 0; k < at.contacts.pairs.size(); ++k)
    if (at.contacts.pairs.wall(k))
      most += static_cast<size_t>(at.packing.container[wall_partner(at.contacts.pairs.j[k])].curved_directions());
  return most;
}

// Rotations that the container allows, orthonormal.
std::vector<std::vector<double>> rotations_of(const RadiiVertex &at, const std::vector<char> &touched) {
  const Packing &p = at.packing;
  std::vector<std::vector<double>> out;
  const size_t d = static_cast<size_t>(p.dim), b = d + 1;
  for (int q = 0; q < p.container.rotations(); ++q) {
    std::vector<double> x(at.contacts.unknowns());
    for (size_t i = 0; i < p.n(); ++i) {
      p.container.rotation(q, &p.position[i * d], &x[i * b]);
      for (size_t c = 0; c < d; ++c) x[i * b + c] *= std::sqrt(static_cast<double>(b)) / p.cell.edge(0);
    }
    if (independent(at.contacts, touched, out, x)) out.push_back(x);
  }
  return out;
}

// Motions that keep contacts closed and equations, orthonormal.
std::vector<std::vector<double>> motions_along(const RadiiVertex &at, const RadiiMatrix &matrix) {
  std::vector<std::vector<double>> out;
  std::vector<char> touched(at.packing.n());
  for (size_t k = 0; k < at.contacts.pairs.size(); ++k)
    for_spheres(at.contacts.pairs.i[k], at.contacts.pairs.j[k], [&](int32_t q) { touched[q] = 1; });
  Rng rng(at.packing.seed, Stream::radii_saddle);
  out = rotations_of(at, touched);
  const size_t rigid = out.size(), most = rigid + most_motions(at);
  while (out.size() <= most) {
    std::vector<double> x(at.contacts.unknowns());
    for (double &v : x) v = rng.normal();
    keep_closed(at.contacts, matrix, x);
    if (!independent(at.contacts, touched, out, x)) break;
    out.push_back(x);
  }
  out.erase(out.begin(), out.begin() + static_cast<std::ptrdiff_t>(rigid));
  return out;
}

// Minus the second derivatives along motions and their sums, (motions, motions).
std::vector<double> stiffness_along(const RadiiVertex &at, const RadiiGoal &goal,
                                    const std::vector<std::vector<double>> &motion) {
  const size_t m = motion.size();
  std::vector<double> stiffness(m * m);
  for (size_t a = 0; a < m; ++a) {
    stiffness[a * m + a] = -second_derivative(at, goal, motion[a]);
    for (size_t b = 0; b < a; ++b) {
      std::vector<double> both = motion[a];
      for (size_t q = 0; q < both.size(); ++q) both[q] += motion[b][q];
      stiffness[a * m + b] = -0.5 * (second_derivative(at, goal, both) + stiffness[a * m + a] + stiffness[b * m + b]);
    }
  }
  return stiffness;
}

// The eigenvector of its lowest eigenvalue.
std::vector<double> softest(const std::vector<double> &stiffness, size_t m) {
  const auto size = static_cast<Eigen::Index>(m);
  Eigen::MatrixXd form(size, size);
  for (Eigen::Index a = 0; a < size; ++a)
    for (Eigen::Index b = 0; b <= a; ++b) form(a, b) = form(b, a) = stiffness[static_cast<size_t>(a * size + b)];
  const SymmetricEigen eigen = symmetric_eigen(form);
  return {eigen.vectors.data(), eigen.vectors.data() + m};
}

// sum of part times motion, with a largest component of 1.
std::vector<double> combine(const std::vector<std::vector<double>> &motion, const std::vector<double> &part) {
  std::vector<double> x(motion[0].size());
  for (size_t a = 0; a < part.size(); ++a)
    for (size_t q = 0; q < x.size(); ++q) x[q] += part[a] * motion[a][q];
  const double most = largest_entry(x);
  for (double &v : x) v /= most;
  return x;
}

// Where no maximum is near: the softest motion and the force that is left, as unit vectors, both along the ascent.
std::vector<double> uphill(const std::vector<std::vector<double>> &motion, const std::vector<double> &stiffness,
                           const std::vector<double> &left) {
  std::vector<double> part = softest(stiffness, motion.size());
  const double along = std::inner_product(part.begin(), part.end(), left.begin(), 0.0);
  const double size = std::sqrt(std::inner_product(left.begin(), left.end(), left.begin(), 0.0));
  for (size_t a = 0; a < part.size(); ++a) part[a] = (along < 0.0 ? -part[a] : part[a]) + left[a] / size;
  return combine(motion, part);
}

}  // namespace

double longest_edge(const Packing &p) {
  double edge = 0.0;
  for (int c = 0; c < p.dim; ++c) edge = std::max(edge, p.cell.edge(c));
  return edge;
}

bool close_contacts(Packing &p, RadiiRows &contacts, RadiiGoal &goal, RadiiMatrix &matrix, double unit) {
  const std::vector<double> ones(contacts.pairs.size() + contacts.bounds(), 1.0);
  std::vector<double> step;
  double path = 0.0, before = std::numeric_limits<double>::infinity();
  Packing moved = p;
  for (int k = 0; k < RadiiTuning::polish_steps; ++k) {
    contacts.measure(p);
    goal.linearise(p);
    const double wrong = std::max(largest_entry(contacts.gap), goal.residual(p) * unit);
    const bool small = wrong <= RadiiTuning::closed * longest_edge(p);
    if (small && !(wrong < 0.5 * before)) return true;
    if (k > 3 && !small && !(wrong < before)) return false;
    before = wrong;
    contacts.transpose_times(contacts.gap, step);
    matrix.factorise(contacts, ones, goal.columns(), RadiiTuning::polish_ridge, 1);
    matrix.solve(step, goal.wrong(p));
    path += largest_entry(step);
    if (!(path < RadiiTuning::longest_polish * unit)) return false;
    move_radii(p, step, -1.0, contacts.allowed(), moved);
    std::swap(p, moved);
  }
  contacts.measure(p);
  goal.linearise(p);
  return std::max(largest_entry(contacts.gap), goal.residual(p) * unit) <= RadiiTuning::closed * longest_edge(p);
}

void balance_contacts(RadiiVertex &at, RadiiGoal &goal, RadiiMatrix &matrix) {
  at.contacts.measure(at.packing);
  goal.linearise(at.packing);
  matrix.factorise(at.contacts, std::vector<double>(at.force.size(), 1.0), goal.columns(), RadiiTuning::polish_ridge,
                   1);
  at.balance = balance(at.contacts, goal, matrix, at.force, at.multiplier);
}

void keep_closed(const RadiiRows &contacts, const RadiiMatrix &matrix, std::vector<double> &x) {
  std::vector<double> opened, back;
  for (int k = 0; k < RadiiTuning::projections; ++k) {
    contacts.times(x, opened);
    contacts.transpose_times(opened, back);
    matrix.solve(back, matrix.along_columns(x));
    for (size_t q = 0; q < x.size(); ++q) x[q] -= back[q];
  }
}

bool settle_curved(RadiiVertex &at, RadiiGoal &goal, double unit, RadiiMatrix &matrix) {
  for (int step = 0; step < RadiiTuning::settle_steps && !(at.balance <= RadiiTuning::balanced); ++step) {
    const std::vector<std::vector<double>> motion = motions_along(at, matrix);
    const size_t m = motion.size();
    if (m == 0 || m > most_motions(at)) return false;
    const std::vector<double> left = imbalance(at.contacts, at.force, goal.carried(at.multiplier));
    std::vector<double> part(m), x(left.size());
    for (size_t a = 0; a < m; ++a) part[a] = std::inner_product(left.begin(), left.end(), motion[a].begin(), 0.0);
    const std::vector<double> stiffness = stiffness_along(at, goal, motion);
    SmallCholesky factor;
    if (!factor.factorise(m, stiffness)) {  // no maximum along them
      if (at.packing.container.curved()) at.uphill = uphill(motion, stiffness, part);
      return false;
    }
    factor.solve(part);
    for (size_t a = 0; a < m; ++a)
      for (size_t q = 0; q < x.size(); ++q) x[q] += part[a] * motion[a][q];
    if (!(largest_entry(x) < RadiiTuning::longest_polish * unit)) return false;
    const Packing from = at.packing;
    move_radii(from, x, 1.0, at.contacts.allowed(), at.packing);
    if (!close_contacts(at.packing, at.contacts, goal, matrix, unit)) return false;
    balance_contacts(at, goal, matrix);
  }
  return at.balance <= RadiiTuning::balanced;
}

std::vector<double> least_held(const RadiiVertex &at, const RadiiGoal &goal, const RadiiMatrix &matrix) {
  const std::vector<std::vector<double>> motion = motions_along(at, matrix);
  if (motion.empty()) return {};
  return combine(motion, softest(stiffness_along(at, goal, motion), motion.size()));
}

}  // namespace jam::inside
