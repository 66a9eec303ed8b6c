#include "network/slides.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "network/tuning.hpp"

namespace jam::inside {
namespace {

// The part of each node: nodes with a contact between them are in one, except for nodes that are `left` out.
std::vector<int32_t> parts_of(const RigidityMatrix &g, const std::vector<char> &left) {
  std::vector<int32_t> part(static_cast<size_t>(g.nodes));
  std::iota(part.begin(), part.end(), 0);
  const auto root = [&](int32_t i) {
    while (part[i] != i) i = part[i] = part[part[i]];
    return i;
  };
  for (size_t k = 0; k < g.contacts(); ++k)
    if (g.b[k] >= 0 && !left[g.a[k]] && !left[g.b[k]]) {
      const int32_t a = root(g.a[k]), b = root(g.b[k]);
      part[std::max(a, b)] = std::min(a, b);
    }
  for (int32_t i = 0; i < g.nodes; ++i) part[i] = root(i);
  return part;
}

// Nodes that no rotation moves.
std::vector<char> middle_of(const RigidityMatrix &g) {
  const size_t d = static_cast<size_t>(g.dim);
  std::vector<double> speed(static_cast<size_t>(g.nodes), 0.0);
  for (const std::vector<double> &v : g.rotations)
    for (size_t k = 0; k < v.size(); ++k) speed[k / d] = std::max(speed[k / d], std::fabs(v[k]));
  const double most = *std::max_element(speed.begin(), speed.end());
  std::vector<char> middle;
  for (const double s : speed) middle.push_back(s <= RigidityTuning::no_rotation * most);
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
      if (!(after > RigidityTuning::least_relative * before)) continue;
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

}  // namespace

PartTranslations::PartTranslations(const RigidityMatrix &g)
    : dim_(static_cast<size_t>(g.dim)), part_(parts_of(g, std::vector<char>(g.nodes, 0))), open_axes_(g.open_axes) {
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
  const std::vector<int32_t> part = parts_of(g, std::vector<char>(static_cast<size_t>(g.nodes), 0));
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
