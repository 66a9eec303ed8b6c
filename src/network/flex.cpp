#include "network/flex.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "network/tuning.hpp"

namespace jam::inside {
namespace {

// The motion of all nodes, and the strain of `rows`.
std::vector<double> release_spheres(const RigidityMatrix &g, const ConstraintRows &rows, const RigidityMatrix &sub,
                                    const ConstraintRows &sub_rows, const std::vector<double> &x,
                                    const std::vector<Release> &released) {
  const int d = g.dim;
  std::vector<double> v(rows.columns(), 0.0);
  if (!x.empty()) {
    scatter(sub, x.data(), 1.0, v);
    for (int q = 0; q < rows.strains && q < sub_rows.strains; ++q)
      v[g.unknowns() + q] = x[sub.unknowns() + q] * rows.length / sub_rows.length;
  }
  for (auto r = released.rbegin(); r != released.rend(); ++r) {
    double t = x.empty() ? 1.0 : 0.0;
    for (const size_t k : r->contacts) {
      double value = 0.0, along = 0.0;
      const double *n = &g.normal[k * d], sign = g.a[k] == r->sphere ? 1.0 : -1.0;
      for (int c = 0; c < d; ++c) {
        const double vb = g.b[k] < 0 ? 0.0 : v[static_cast<size_t>(g.b[k]) * d + c];
        value += n[c] * (v[static_cast<size_t>(g.a[k]) * d + c] - vb);
        along += sign * n[c] * r->direction[c];
      }
      for (int q = 0; q < rows.strains; ++q) value += rows.e[k * rows.strains + q] * v[g.unknowns() + q];
      t = std::max(t, -value / along);
    }
    for (int c = 0; c < d; ++c) v[static_cast<size_t>(r->sphere) * d + c] += t * r->direction[c];
  }
  return v;
}

// Largest displacement, or coefficient of the strain.
double size_of(const RigidityMatrix &g, const std::vector<double> &v) {
  double largest = 0.0;
  for (int32_t i = 0; i < g.nodes; ++i) {
    double s = 0.0;
    for (int c = 0; c < g.dim; ++c) s += v[static_cast<size_t>(i) * g.dim + c] * v[static_cast<size_t>(i) * g.dim + c];
    largest = std::max(largest, std::sqrt(s));
  }
  for (size_t k = g.unknowns(); k < v.size(); ++k) largest = std::max(largest, std::fabs(v[k]));
  return largest;
}

// Of each contact, along its normal and across.
struct Relative {
  double along, across;
};
std::vector<Relative> relative_motion(const RigidityMatrix &g, const std::vector<double> &v,
                                      const std::vector<double> &strain) {
  const size_t d = static_cast<size_t>(g.dim);
  std::vector<Relative> out;
  for (size_t k = 0; k < g.contacts(); ++k) {
    const double *n = &g.normal[k * d];
    double all = 0.0, along = 0.0;
    for (size_t c = 0; c < d; ++c) {
      double w = v[static_cast<size_t>(g.a[k]) * d + c];
      if (g.b[k] >= 0) w -= v[static_cast<size_t>(g.b[k]) * d + c];
      for (size_t q = 0; q < d && !strain.empty(); ++q) w += strain[c * d + q] * g.distance[k] * n[q];
      all += w * w, along += w * n[c];
    }
    out.push_back({along, std::sqrt(std::max(0.0, all - along * along))});
  }
  return out;
}

// The least change of the motion that keeps the contacts closed that it closes or barely opens. Between contacts that
// carry force some would else close as others open.
void keep_closed(const RigidityMatrix &g, const ConstraintRows &rows, bool strain, std::vector<double> &v) {
  std::vector<double> y(rows.rows()), wanted;
  rows.multiply(v.data(), y.data());
  std::vector<char> on(y.size());
  for (size_t k = 0; k < y.size(); ++k)
    if ((on[k] = y[k] < RigidityTuning::flex_rounding)) wanted.push_back(-y[k]);
  const RigidityMatrix part = subset(g, on);
  const ConstraintRows kept(part, strain);
  NormalSolver solver(kept);
  solver.factorise(std::vector<double>(kept.rows(), 1.0), flex_eigenvalue);
  const std::vector<double> change = nearest_motion(kept, solver, wanted);
  scatter(part, change.data(), 1.0, v);
  for (int q = 0; q < rows.strains; ++q) v[g.unknowns() + q] += change[part.unknowns() + q] * rows.length / kept.length;
}

// False for a translation, or another symmetry: it keeps all distances, and may be what is left where motions cancel.
bool normalise(const RigidityMatrix &g, std::vector<double> &v) {
  const double largest = size_of(g, v);
  std::vector<double> rest = v;
  g.remove_symmetries(rest.data());
  if (!(size_of(g, rest) > RigidityTuning::least_relative * largest)) return false;
  for (double &value : v) value /= largest;
  return true;
}

// Least rate at which contacts open, except for those of released spheres, and of them.
struct Opening {
  double held = std::numeric_limits<double>::infinity(), released = held;
};
Opening opening_of(const ConstraintRows &rows, const std::vector<Release> &released, const std::vector<double> &v) {
  std::vector<double> y(rows.rows());
  rows.multiply(v.data(), y.data());
  std::vector<char> loose(y.size(), 0);
  for (const Release &r : released)
    for (const size_t k : r.contacts) loose[k] = 1;
  Opening out;
  for (size_t k = 0; k < y.size(); ++k) {
    double &least = loose[k] ? out.released : out.held;
    least = std::min(least, y[k]);
  }
  return out;
}

// For each contact how far it may have been closed: positions are as wrong as contacts with force are open.
std::vector<double> uncertain_gaps(const RigidityMatrix &g, const std::vector<char> &carrying) {
  double widest = 0.0;
  for (size_t k = 0; k < g.contacts(); ++k)
    if (carrying[k]) widest = std::max(widest, std::fabs(g.distance[k] / g.sigma[k] - 1.0));
  return std::vector<double>(g.contacts(), widest);
}

// Displacements of v and its strain; empty without one.
RigidityResult split(const RigidityMatrix &g, const ConstraintRows &rows, bool strain, std::vector<double> v) {
  RigidityResult out;
  if (strain) out.strain = rows.strain_of(v.data());
  v.resize(g.unknowns());
  out.flex = std::move(v);
  return out;
}

}  // namespace

// A motion t v closes a contact at the rate y < 0 and opens it by t^2 w^2 / 2: it overlaps by y^2 / 2 w^2 at most. No
// motion along a wall opens it.
bool keeps_contacts(const RigidityMatrix &g, const std::vector<double> &gap, const std::vector<double> &v,
                    const std::vector<double> &strain) {
  const std::vector<Relative> motion = relative_motion(g, v, strain);
  for (size_t k = 0; k < motion.size(); ++k) {
    const double w = std::max(g.b[k] < 0 ? 0.0 : motion[k].across, RigidityTuning::least_across);
    const double open = gap.empty() ? 0.0 : std::max(0.0, gap[k]);
    if (motion[k].along < -RigidityTuning::flex_rounding * w - open) return false;
  }
  return true;
}

void complete_flex(const RigidityMatrix &g, const RigidityMatrix &sub, const ConstraintRows &sub_rows,
                   const std::vector<double> &x, const std::vector<Release> &released, bool strain,
                   RigidityResult &out) {
  const ConstraintRows rows(g, strain);
  std::vector<double> v = release_spheres(g, rows, sub, sub_rows, x, released);
  if (!normalise(g, v)) return;
  RigidityResult found = split(g, rows, strain, v);
  if (!keeps_contacts(g, {}, found.flex, found.strain)) {
    std::vector<double> closed = v;
    keep_closed(g, rows, strain, closed);
    if (normalise(g, closed)) {
      RigidityResult kept = split(g, rows, strain, closed);
      if (keeps_contacts(g, {}, kept.flex, kept.strain)) found = std::move(kept), v = std::move(closed);
    }
  }
  const Opening opening = opening_of(rows, released, v);
  if (std::min(opening.held, opening.released) < -RigidityTuning::flex_rounding) return;
  if (!keeps_contacts(g, uncertain_gaps(g, out.carrying), found.flex, found.strain)) return;
  out.opening = opening.held;
  out.flex = std::move(found.flex);
  if (strain) out.strain = std::move(found.strain);
}

}  // namespace jam::inside
