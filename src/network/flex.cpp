#include "network/flex.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "linalg/dot.hpp"
#include "network/tuning.hpp"

namespace jam::inside {
namespace {

// Nodes that no rotation moves.
std::vector<char> middle_of(const RigidityMatrix &g) {
  const size_t d = static_cast<size_t>(g.dim);
  std::vector<double> speed(static_cast<size_t>(g.nodes), 0.0);
  for (const std::vector<double> &v : g.rotations)
    for (size_t k = 0; k < v.size(); ++k) speed[k / d] = std::max(speed[k / d], std::fabs(v[k]));
  const double most = *std::max_element(speed.begin(), speed.end());
  std::vector<char> middle;
  for (const double s : speed) middle.push_back(s <= RoundingTuning::sure * most);
  return middle;
}

// Adds the motions of each part to those found, as far as they are independent of them.
void add_parts(const RigidityMatrix &g, const std::vector<int32_t> &part, const std::vector<std::vector<double>> &whole,
               std::vector<std::vector<double>> &found) {
  const size_t d = static_cast<size_t>(g.dim);
  for (int32_t root = 0; root < g.nodes; ++root) {
    if (part[root] != root) continue;
    for (const std::vector<double> &motion : whole) {
      std::vector<double> v(motion);
      for (size_t k = 0; k < v.size(); ++k)
        if (part[k / d] != root) v[k] = 0.0;
      const double before = std::sqrt(std::inner_product(v.begin(), v.end(), v.begin(), 0.0));
      for (int twice = 0; twice < 2; ++twice) {
        g.remove_symmetries(v.data());
        for (const std::vector<double> &q : found) {
          const double along = std::inner_product(v.begin(), v.end(), q.begin(), 0.0);
          for (size_t k = 0; k < v.size(); ++k) v[k] -= along * q[k];
        }
      }
      const double after = std::sqrt(std::inner_product(v.begin(), v.end(), v.begin(), 0.0));
      if (!(after > least_rest * before)) continue;
      for (double &x : v) x /= after;
      found.push_back(std::move(v));
    }
  }
}

// Whether each part, by its root, touches a wall across this axis.
std::vector<char> stopped_along(const RigidityMatrix &g, const std::vector<int32_t> &part, size_t axis) {
  std::vector<char> stopped(part.size(), 0);
  for (size_t k = 0; k < g.contacts(); ++k)
    if (g.b[k] < 0 && g.normal[k * static_cast<size_t>(g.dim) + axis] != 0.0) stopped[part[g.a[k]]] = 1;
  return stopped;
}

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
  double largest = std::sqrt(largest_squared(v, g.nodes, g.dim));
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
  if (!(size_of(g, rest) > least_rest * largest)) return false;
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
    const double w = std::max(g.b[k] < 0 ? 0.0 : motion[k].across, least_rest);
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

PartTranslations::PartTranslations(const RigidityMatrix &g)
    : dim_(static_cast<size_t>(g.dim)), part_(parts_of(g)), open_axes_(g.open_axes) {
  if (g.curved != 0) return;
  for (size_t c = 0; c < dim_; ++c) {
    stopped_.push_back(stopped_along(g, part_, c));
    bool whole = open_axes_ >> c & 1u;  // is a symmetry: one part less slides
    for (int32_t root = 0; root < g.nodes; ++root) {
      if (part_[root] != root || stopped_[c][root]) continue;
      if (!whole) slides_.push_back({root, c});
      whole = false;
    }
  }
}

void PartTranslations::remove(double *x) const {
  if (slides_.empty()) return;
  std::vector<double> sum(part_.size());
  std::vector<int32_t> size(part_.size(), 0);
  for (const int32_t root : part_) ++size[root];
  for (size_t c = 0; c < dim_; ++c) {
    std::fill(sum.begin(), sum.end(), 0.0);
    for (size_t i = 0; i < part_.size(); ++i) sum[part_[i]] += x[i * dim_ + c];
    for (size_t i = 0; i < part_.size(); ++i)
      if (!stopped_[c][part_[i]]) x[i * dim_ + c] -= sum[part_[i]] / size[part_[i]];
  }
}

std::vector<double> PartTranslations::motion(size_t k) const {
  const auto [root, axis] = slides_[k];
  std::vector<double> v(part_.size() * dim_, 0.0);
  const double nodes = static_cast<double>(part_.size()),
               own = static_cast<double>(std::count(part_.begin(), part_.end(), root)),
               mean = open_axes_ >> axis & 1u ? own / nodes : 0.0;
  for (size_t i = 0; i < part_.size(); ++i) v[i * dim_ + axis] = (part_[i] == root ? 1.0 : 0.0) - mean;
  const double length = std::sqrt(std::inner_product(v.begin(), v.end(), v.begin(), 0.0));
  for (double &u : v) u /= length;
  return v;
}

Slides find_slides(const RigidityMatrix &g) {
  const size_t d = static_cast<size_t>(g.dim);
  if (g.nodes == 0) return {};
  std::vector<std::vector<double>> found, translations;
  const std::vector<int32_t> part = parts_of(g);
  for (size_t c = 0; c < d; ++c) {
    if (g.curved >> c & 1) continue;
    const std::vector<char> stopped = stopped_along(g, part, c);
    translations.emplace_back(g.unknowns(), 0.0);
    for (size_t i = 0; i < part.size(); ++i) translations.back()[i * d + c] = stopped[part[i]] ? 0.0 : 1.0;
  }
  add_parts(g, part, translations, found);
  if (!g.rotations.empty()) add_parts(g, parts_of(g, middle_of(g)), g.rotations, found);
  Slides out;
  out.count = static_cast<int64_t>(found.size());
  if (!found.empty()) out.motion = found.front();
  return out;
}

}  // namespace jam::inside
