#include "network/tile.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "core/call_scope.hpp"
#include "core/cell_reduction.hpp"
#include "core/create.hpp"
#include "core/limits.hpp"

namespace jam::inside {
namespace {

void refuse_walled_axis(const Packing &p, int c, int32_t count) {
  if (p.cell.repeats(c)) return;
  const Container &walls = p.container;
  int w = 0;
  while (walls[w].axis() != c && !walls[w].curved()) ++w;
  fail(JAM_E_UNSUPPORTED, "count[%d] is %d, and nothing repeats along this axis, which %s bounds", c, count,
       walls[w].name().c_str());
}

// The vectors count[c] a_c.
Cell tiled_cell(const Cell &cell, const Copies &copies) {
  const int d = cell.dim();
  std::vector<double> rows = cell.rows();
  for (int c = 0; c < d; ++c)
    for (int k = 0; k <= c; ++k) rows[c * d + k] *= copies.along(c);
  Cell large = Cell::from_triangle(d, rows.data());
  check_box(large.side());
  const double height = upright(large).height_min() / large.side();
  if (!(height >= limits::cell_height_min))
    fail(JAM_E_ARGUMENT, "so many copies make a flat cell: two faces are %g V^(1/d) apart, at least %g is supported",
         height, limits::cell_height_min);
  return large;
}

std::vector<double> repeated(const std::vector<double> &x, int64_t times) {
  std::vector<double> out;
  out.reserve(x.size() * static_cast<size_t>(times));
  for (int64_t k = 0; k < times; ++k) out.insert(out.end(), x.begin(), x.end());
  return out;
}

ContactNetwork reordered(const ContactNetwork &net, const std::vector<size_t> &order, int dim) {
  ContactNetwork out;
  out.coordination = net.coordination;
  out.force_scale = net.force_scale;
  for (const size_t k : order) {
    out.pairs.append(net.pairs, k);
    out.vector.insert(out.vector.end(), &net.vector[k * dim], &net.vector[k * dim] + dim);
    out.gap.push_back(net.gap[k]), out.force.push_back(net.force[k]);
    if (!net.stiffness.empty()) out.stiffness.push_back(net.stiffness[k]), out.prestress.push_back(net.prestress[k]);
  }
  return out;
}

// Adds contact k of `net` in one copy to `out`, smaller number first as in every list of pairs.
void add_copy(const Packing &p, const Copies &copies, const ContactNetwork &net, size_t k, int64_t copy,
              ContactNetwork &out) {
  const int d = p.dim;
  const auto n = static_cast<int64_t>(p.n());
  const int64_t i = net.pairs.i[k] + n * copy;
  int64_t j = net.pairs.j[k];
  Cell::Vector offset{};
  double sign = 1.0;
  if (!net.pairs.wall(k)) {
    const auto at = copies.place(copy), step = lattice_steps(p.cell, &net.pairs.offset[k * d]);
    Cell::Vector turns{};  // of the new lattice
    int64_t stride = n;
    for (int c = 0; c < d; ++c) {
      const int64_t count = copies.along(c), there = at[c] - int64_t{step[c]},
                    inside = ((there % count) + count) % count;
      turns[c] = static_cast<double>(inside - there);
      j += stride * inside;
      stride *= count;
    }
    p.cell.combine(turns.data(), offset.data());
    if (i > j) sign = -1.0;
  }
  out.pairs.i.push_back(static_cast<int32_t>(sign < 0.0 ? j : i));
  out.pairs.j.push_back(static_cast<int32_t>(sign < 0.0 ? i : j));
  for (int c = 0; c < d; ++c) {
    out.pairs.offset.push_back(sign < 0.0 ? 0.0 - offset[c] : offset[c]);
    out.vector.push_back(sign * net.vector[k * d + c]);
  }
  out.gap.push_back(net.gap[k]), out.force.push_back(net.force[k]);
  if (!net.stiffness.empty()) out.stiffness.push_back(net.stiffness[k]), out.prestress.push_back(net.prestress[k]);
}

// By (i, j), then image, as find_pairs lists them.
void sort_contacts(ContactNetwork &net, int dim) {
  const auto before = [&](size_t a, size_t b) {
    const PairList &p = net.pairs;
    if (p.i[a] != p.i[b] || p.j[a] != p.j[b]) return std::tie(p.i[a], p.j[a]) < std::tie(p.i[b], p.j[b]);
    const double *x = &p.offset[a * dim], *y = &p.offset[b * dim];
    return std::lexicographical_compare(x, x + dim, y, y + dim);
  };
  std::vector<size_t> order(net.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::stable_sort(order.begin(), order.end(), before);
  net = reordered(net, order, dim);
}

}  // namespace

Copies::Copies(const Packing &p, const int32_t *count) : dim_(p.dim) {
  for (int c = 0; c < dim_; ++c) {
    count_[c] = count[c];
    if (count[c] < 1) fail(JAM_E_ARGUMENT, "count[%d] is %d, it must be at least 1", c, count[c]);
    if (count[c] > 1) refuse_walled_axis(p, c, count[c]);
    if (count[c] > limits::n_max / (number_ * static_cast<int64_t>(p.n())))
      fail(JAM_E_ARGUMENT, "so many copies have more than 2^31-1 spheres: count[%d] is %d, after %lld copies of %zu", c,
           count[c], static_cast<long long>(number_), p.n());
    number_ *= count[c];
  }
  if (number_ > 1 && p.model == JAM_MODEL_MK)
    fail(JAM_E_UNSUPPORTED,
         "copies of Mari-Kurchan spheres would need copies of their shifts, which are drawn for each pair");
}

std::array<int32_t, JAM_MAX_DIM> Copies::place(int64_t copy) const {
  std::array<int32_t, JAM_MAX_DIM> k{};
  for (int c = 0; c < dim_; ++c) k[c] = static_cast<int32_t>(copy % count_[c]), copy /= count_[c];
  return k;
}

std::array<int32_t, JAM_MAX_DIM> lattice_steps(const Cell &cell, const double *vector) {
  Cell::Vector s{};
  cell.fraction(vector, s.data());
  std::array<int32_t, JAM_MAX_DIM> out{};
  for (int c = 0; c < cell.dim(); ++c) out[c] = static_cast<int32_t>(std::nearbyint(s[c]));
  return out;
}

ContactNetwork between_copies(const Packing &p, const ContactNetwork &own, const Copies &copies) {
  std::vector<char> on(own.size(), 0);
  for (size_t k = 0; k < own.size(); ++k) {
    const auto s = lattice_steps(p.cell, &own.pairs.offset[k * static_cast<size_t>(p.dim)]);
    for (int c = 0; c < p.dim; ++c) on[k] = on[k] || s[c] % copies.along(c) != 0;
  }
  return subset(own, on, p.dim);
}

Packing tile(const Packing &p, const Copies &copies, ContactNetwork *net) {
  if (copies.number() == 1) return p;
  const auto d = static_cast<size_t>(p.dim);
  const double contacts = net ? static_cast<double>(net->size()) : 0.0, all = static_cast<double>(copies.number());
  CallScope::need_memory(
      8.0 * all * (static_cast<double>(p.n() * (2 * d + 1)) + 2.0 * contacts * (2.0 * static_cast<double>(d) + 3.0)),
      "the copies of the packing");
  Packing out = p;
  out.cell = tiled_cell(p.cell, copies);
  check_diameters(p.diameter, out.cell);
  out.container = {};
  enclose(out, {p.container.kind(), p.container.flat()});
  out.diameter = repeated(p.diameter, copies.number());
  out.velocity = repeated(p.velocity, copies.number());
  out.position = repeated(p.position, copies.number());
  for (int64_t copy = 0; copy < copies.number(); ++copy) {
    const auto k = copies.place(copy);
    Cell::Vector shift{};
    std::copy(k.begin(), k.end(), shift.begin());
    p.cell.combine(shift.data(), shift.data());
    double *const x = &out.position[static_cast<size_t>(copy) * p.position.size()];
    for (size_t q = 0; q < p.position.size(); ++q) x[q] += shift[q % d];
    CallScope::look();
  }
  ContactNetwork large;
  for (size_t k = 0; net && k < net->size(); ++k)
    for (int64_t copy = 0; copy < copies.number(); ++copy) add_copy(p, copies, *net, k, copy, large);
  wrap_positions(out, large.pairs);
  if (net) {
    large.force_scale = net->force_scale / all;
    for (int64_t copy = 0; copy < copies.number(); ++copy)
      large.coordination.insert(large.coordination.end(), net->coordination.begin(), net->coordination.end());
    sort_contacts(large, p.dim);
    *net = std::move(large);
  }
  apply_overlap_policy(out, p.overlap_allowed ? JAM_OVERLAP_ALLOW : JAM_OVERLAP_REFUSE);
  return out;
}

}  // namespace jam::inside
