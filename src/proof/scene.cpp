#include "proof/scene.hpp"

#include <algorithm>
#include <cmath>

#include "core/cell_change.hpp"
#include "proof/newton.hpp"

namespace jam::inside {

Expansion ProofScene::component(int32_t i, int32_t j, const int32_t *n, int k) const {
  const size_t at = static_cast<size_t>(i) * dim + k;
  Expansion r(high[at]);
  r.add(low[at]);
  if (j < 0) {
    const Surface &wall = container[wall_partner(j)];
    if (wall.curved() ? !wall.turning().along(k) : wall.axis() != k) return Expansion();
    if (!wall.curved() && wall.side()) r.add(-cell.edge(k));
    r.add(Expansion(r));
    if (wall.curved()) r.add(-cell.edge(0));
    return r;
  }
  const size_t to = static_cast<size_t>(j) * dim + k;
  r.add(-high[to]), r.add(-low[to]);
  for (int q = k; q < dim; ++q)
    if (n[q] != 0) {
      r.add_product(n[q], cell.row(q)[k]);
      r.add_product(n[q], cell_low[q * dim + k]);
    }
  return r;
}

Expansion ProofScene::exact_growth() const {
  Expansion out(growth);
  out.add(growth_low);
  return out;
}

Expansion ProofScene::exact_gamma() const {
  const Expansion once = exact_growth();
  if (!rooted()) return once;
  Expansion square;
  square.add_product(once, once);
  return square;
}

void ProofScene::grow(double by_gamma) { add_to(growth, growth_low, by_gamma / gamma_per_growth()); }

Expansion ProofScene::room(int32_t i) const {
  Expansion out(cell.edge(0));
  out.add_product(exact_growth(), Expansion(ratio[i]), -1.0);
  return out;
}

Expansion ProofScene::gap(int32_t i, int32_t j, const int32_t *n) const {
  const bool inside = round(j);
  Expansion sum;
  for (int k = 0; k < dim; ++k) {
    const Expansion r = component(i, j, n, k);
    sum.add_product(r, r, inside ? -1.0 : 1.0);
  }
  if (inside)
    sum.add_product(room(i), room(i));
  else
    sum.add_product(exact_gamma(), sigma_squared(i, j), -1.0);
  return sum;
}

double ProofScene::weight(int32_t i, int32_t j) const {
  return round(j) ? ratio[i] * room(i).value() / growth : sigma_squared(i, j).value();
}

double ProofScene::lever(size_t c) const {
  if (round(b[c])) return 2.0 * room(sphere[a[c]]).value() / growth;
  return std::sqrt(sigma_squared(c).value()) * (wall(c) ? 2.0 : 1.0);
}

double ProofScene::shortest_period() const {
  std::vector<double> rows;
  int open = 0;
  for (int q = 0; q < dim; ++q) {
    if (!cell.repeats(q)) continue;
    ++open;
    for (int k = 0; k < dim; ++k)
      if (cell.repeats(k)) rows.push_back(cell.row(q)[k]);
  }
  return open > 0 ? Cell::from_triangle(open, rows.data()).shortest() : HUGE_VAL;
}

Expansion ProofScene::sigma_squared(int32_t i, int32_t j) const {
  if (j < 0) j = i;
  Expansion sum(0.5 * ratio[i]), square;
  sum.add(0.5 * ratio[j]);
  if (non_additivity != 0.0 && ratio[i] != ratio[j]) {
    Expansion factor(1.0), longer;
    factor.add(non_additivity);
    longer.add_product(sum, factor);
    sum = longer;
  }
  square.add_product(sum, sum);
  return square;
}

namespace {

void take_out_contacts(ProofScene &s, const std::vector<char> &on) {
  size_t kept = 0;
  for (size_t c = 0; c < on.size(); ++c) {
    if (!on[c]) continue;
    s.a[kept] = s.a[c], s.b[kept] = s.b[c], s.force[kept] = s.force[c];
    for (int k = 0; k < s.dim; ++k) s.image[kept * s.dim + k] = s.image[c * s.dim + k];
    ++kept;
  }
  s.a.resize(kept), s.b.resize(kept), s.force.resize(kept), s.image.resize(kept * s.dim);
}

}  // namespace

// Gauss' elimination of the velocities of rotations, with the largest pivots.
void pin_rotations(ProofScene &s) {
  const size_t d = static_cast<size_t>(s.dim);
  s.pin.clear();
  if (s.container.rotations() == 0) return;
  s.pin.assign(s.ratio.size() * d, 0);
  if (s.nodes() == 0) return;
  std::vector<std::vector<double>> turn;
  for (int q = 0; q < s.container.rotations(); ++q) {
    turn.emplace_back(s.nodes() * d);
    for (size_t i = 0; i < s.nodes(); ++i) s.container.rotation(q, &s.high[s.sphere[i] * d], &turn.back()[i * d]);
  }
  const auto size = [](double a, double b) { return std::fabs(a) < std::fabs(b); };
  while (!turn.empty()) {
    size_t most = 0, at = 0;
    for (size_t q = 0; q < turn.size(); ++q) {
      const size_t k = std::max_element(turn[q].begin(), turn[q].end(), size) - turn[q].begin();
      if (q == 0 || size(turn[most][at], turn[q][k])) most = q, at = k;
    }
    const std::vector<double> pivot = turn[most];
    turn.erase(turn.begin() + static_cast<std::ptrdiff_t>(most));
    if (pivot[at] == 0.0) return;  // all spheres are on the axis
    s.pin[s.sphere[at / d] * d + at % d] = 1;
    for (std::vector<double> &v : turn)
      for (size_t k = v.size(); k-- > 0;) v[k] -= k == at ? v[k] : v[at] / pivot[at] * pivot[k];
  }
}

void keep_contacts(ProofScene &s, const std::vector<char> &on) {
  take_out_contacts(s, on);
  const std::vector<int32_t> before = s.sphere;
  std::vector<char> stable(s.nodes(), 0);
  for (size_t c = 0; c < s.contacts(); ++c) for_spheres(s.a[c], s.b[c], [&](int32_t k) { stable[k] = 1; });
  s.sphere.clear();
  for (size_t k = 0; k < before.size(); ++k) {
    s.node[before[k]] = stable[k] ? static_cast<int32_t>(s.sphere.size()) : -1;
    if (stable[k]) s.sphere.push_back(before[k]);
  }
  for (size_t c = 0; c < s.contacts(); ++c) {
    s.a[c] = s.node[before[s.a[c]]];
    if (!s.wall(c)) s.b[c] = s.node[before[s.b[c]]];
  }
  pin_rotations(s);
}

ProofScene without_implied(const ProofScene &s) {
  ProofScene out = s;
  out.implied.clear();
  std::vector<char> on(s.contacts(), 1);
  for (const ImpliedContact &c : s.implied) on[c.contact] = 0;
  take_out_contacts(out, on);
  return out;
}

bool lattice_image(const Cell &cell, const double *offset, int32_t *n) {
  Cell::Vector s{};
  cell.fraction(offset, s.data());
  for (int c = 0; c < cell.dim(); ++c) {
    const double whole = std::nearbyint(s[c]);
    if (!(std::fabs(s[c] - whole) < 1e-6) || std::fabs(whole) > 1e6) return false;
    n[c] = static_cast<int32_t>(whole);
  }
  return true;
}

namespace {

// Where Newton starts is free: numbers whose squares would leave the range of doubles become 0.
double without_tiny(double x) { return std::fabs(x) < least_cell_entry ? 0.0 : x; }

void take_contacts(const Packing &p, const ContactNetwork &network, ProofScene &s) {
  const size_t d = static_cast<size_t>(p.dim);
  s.node.assign(p.n(), -1);
  for (size_t i = 0; i < p.n(); ++i)
    if (network.coordination[i] > 0) {
      s.node[i] = static_cast<int32_t>(s.sphere.size());
      s.sphere.push_back(static_cast<int32_t>(i));
    }
  s.image.resize(network.size() * d);
  for (size_t c = 0; c < network.size(); ++c) {
    const int32_t j = network.pairs.j[c];
    s.a.push_back(s.node[network.pairs.i[c]]), s.b.push_back(j < 0 ? j : s.node[j]);
    s.own_images = s.own_images || network.pairs.own_image(c);
    if (!lattice_image(p.cell, &network.pairs.offset[c * d], &s.image[c * d]))
      fail(JAM_E_ARGUMENT, "contact %zu is shifted by no cell vector: proofs are for spheres without such shifts", c);
  }
}

}  // namespace

ProofScene scene_of_contacts(const Packing &p, const ContactNetwork &network, const std::vector<double> &ratio) {
  ProofScene s;
  s.dim = p.dim;
  s.unit = std::ldexp(1.0, std::ilogb(p.cell.side()));
  std::vector<double> rows = p.cell.rows();
  for (double &x : rows) {
    x /= s.unit;
    if (x != 0.0 && std::fabs(x) < least_cell_entry)
      fail(JAM_E_ARGUMENT, "the cell has an entry of %g of its size: for a proof it must be 0, or at least %g", x,
           least_cell_entry);
  }
  s.cell = Cell::from_triangle(p.dim, rows.data());
  s.cell.close(p.cell.closed());
  if (p.container) s.container = Container(p.container.kind(), p.container.flat(), s.cell);
  s.cell_low.assign(rows.size(), 0.0);
  s.non_additivity = p.non_additivity;
  s.high = p.position;
  for (double &x : s.high) x = without_tiny(x / s.unit);
  s.low.assign(s.high.size(), 0.0);
  take_contacts(p, network, s);
  // Only ratios count, and those of equal spheres are 1.
  double given = 0.0, now = 0.0;
  const bool equal = std::count(p.diameter.begin(), p.diameter.end(), p.diameter[0]) == static_cast<long>(p.n());
  for (size_t i = 0; i < p.n(); ++i) {
    s.ratio.push_back(!ratio.empty() ? ratio[i] : equal ? 1.0 : p.diameter[i] / s.unit);
    given += s.ratio.back(), now += p.diameter[i] / s.unit;
  }
  s.growth = s.rooted() ? now / given : (now / given) * (now / given);
  pin_rotations(s);
  // f_c in units of |r_c|: forces times directions balance, and directions are r_c / |r_c|.
  double sum = 0.0;
  for (size_t c = 0; c < s.contacts(); ++c) {
    s.force.push_back(network.force[c] / s.lever(c));
    sum += s.force.back() * s.weight(c);
  }
  for (double &f : s.force) f /= sum;
  return s;
}

ProofScene make_proof_scene(const Packing &p, const ContactNetwork &network, const std::vector<double> &ratio) {
  ProofScene s = scene_of_contacts(p, network, ratio);
  s.implied = find_implied(s);
  return s;
}

ProofEquations evaluate(const ProofScene &s) {
  ProofEquations e;
  const size_t d = static_cast<size_t>(s.dim);
  e.row.resize(s.contacts() * d);
  for (size_t c = 0; c < s.contacts(); ++c) {
    for (size_t k = 0; k < d; ++k)
      e.row[c * d + k] = (s.round(s.b[c]) ? -2.0 : 2.0) * s.component(c, static_cast<int>(k)).value();
    e.f.push_back(s.gap(s.sphere[s.a[c]], s.partner(c), &s.image[c * d]).value()), e.sigma2.push_back(s.weight(c));
  }
  return e;
}

void multiply_rows(const ProofScene &s, const ProofEquations &e, const double *v, double *y) {
  for (size_t c = 0; c < s.contacts(); ++c) {
    double sum = 0.0;
    for (int k = 0; k < s.dim; ++k) {
      double opening = 0.0;
      s.each_end(c, [&](size_t node, double weight) {
        if (s.moves(node, k)) opening += weight * v[node * s.dim + k];
      });
      sum += e.row[c * s.dim + k] * opening;
    }
    y[c] = sum;
  }
}

void multiply_columns(const ProofScene &s, const ProofEquations &e, const double *f, double *y, bool absolute) {
  std::fill(y, y + s.unknowns(), 0.0);
  for (size_t c = 0; c < s.contacts(); ++c)
    for (int k = 0; k < s.dim; ++k) {
      const double x = e.row[c * s.dim + k] * f[c];
      s.each_end(c, [&](size_t node, double weight) {
        if (s.moves(node, k)) y[node * s.dim + k] += absolute ? std::fabs(weight * x) : weight * x;
      });
    }
}

namespace {
double weight_of(const ProofScene &s, size_t c) {
  double sum = 0.0;
  s.each_end(c, [&](size_t, double weight) { sum += weight * weight; });
  return sum;
}
}  // namespace

double largest_weight(const ProofScene &s) {
  double most = 0.0;
  for (size_t c = 0; c < s.contacts(); ++c) most = std::max(most, weight_of(s, c));
  return most;
}

double largest_load(const ProofScene &s) {
  std::vector<double> load(s.ends(), 0.0);
  for (size_t c = 0; c < s.contacts(); ++c) s.each_end(c, [&](size_t node, double) { load[node] += weight_of(s, c); });
  return *std::max_element(load.begin(), load.end());
}

double growth_load(const ProofScene &s) {
  std::vector<double> q;
  for (size_t c = 0; s.rooted() && c < s.contacts(); ++c) q.push_back(up(up(s.sigma_squared(c).value())));
  return norm_up(q);
}

std::vector<double> balance_target(const ProofScene &s) {
  std::vector<double> out(s.unknowns(), 0.0);
  for (int q = 0; s.strict && q < s.dim; ++q) out[(s.nodes() + q) * s.dim + q] = 1.0 / s.cell.row(q)[q];
  return out;
}

}  // namespace jam::inside
