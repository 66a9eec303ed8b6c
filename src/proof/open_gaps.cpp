#include "proof/newton.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/pairs.hpp"
#include "linalg/symmetric_eigen.hpp"
#include "network/rattlers.hpp"
#include "proof/expansion.hpp"
#include "proof/tuning.hpp"

namespace jam::inside {
namespace {

// x with a positive component along each of the vectors, where there is one: contacts in directions that are known
// exactly release a sphere along it.
bool positive_on_all(int d, const std::vector<double> &vectors, std::vector<double> &x) {
  const size_t count = vectors.size() / static_cast<size_t>(d);
  std::vector<char> on(count, 1);
  const std::vector<int32_t> sphere(count, 0), wall(count, wall_partner(0));
  const std::vector<Release> out = release_unbalanced(d, 1, sphere, wall, vectors, on, std::vector<double>(count, 0.0));
  if (!out.empty()) x = out[0].direction;
  return !out.empty();
}

// The pairs of a rattler, from its side: unit vectors away from the others, and gaps.
struct Cage {
  std::vector<const NearPair *> pairs;
  std::vector<double> normal, gap;
  // None leads away from a sphere with the same centre.
  bool has_directions() const {
    return std::all_of(normal.begin(), normal.end(), [](double x) { return std::isfinite(x); });
  }
  double overlap() const { return gap.empty() ? 0.0 : -*std::min_element(gap.begin(), gap.end()); }
};
Cage cage_of(const ProofScene &s, int32_t i, const std::vector<NearPair> &pairs) {
  const size_t d = static_cast<size_t>(s.dim);
  Cage out;
  for (const NearPair &pair : pairs) {
    if (pair.i != i && pair.j != i) continue;
    out.pairs.push_back(&pair);
    Cell::Vector r{};
    double square = 0.0;
    for (size_t c = 0; c < d; ++c) {
      if (pair.j < 0) r[c] = (s.round(pair.j) ? -1.0 : 1.0) * apart(s, pair, c).value();
      if (pair.j >= 0) r[c] = s.high[pair.i * d + c] - s.high[pair.j * d + c];
      for (size_t q = c; q < d; ++q) r[c] += pair.image[q] * s.cell.row(static_cast<int>(q))[c];
      square += r[c] * r[c];
    }
    for (size_t c = 0; c < d; ++c) out.normal.push_back((pair.i == i ? r[c] : -r[c]) / std::sqrt(square));
    // A mirror image moves away as fast as the sphere.
    if (s.round(pair.j))
      out.gap.push_back(0.25 * opening_of(s, pair) * s.weight(pair.i, pair.j) / std::sqrt(square));
    else
      out.gap.push_back(opening_of(s, pair) * (pair.j < 0 ? 0.25 : 0.5) * std::sqrt(square) / s.gamma());
  }
  return out;
}

void move_sphere(ProofScene &s, int32_t i, const double *u) {
  for (size_t c = 0, d = static_cast<size_t>(s.dim); c < d; ++c) {
    const DoubleDouble sum = DoubleDouble(s.high[i * d + c], s.low[i * d + c]) + DoubleDouble(u[c]);
    s.high[i * d + c] = sum.high, s.low[i * d + c] = sum.low;
  }
}

// u / t with n . u + t gap > 0 for each pair of the cage, and t > 0. Gaps are measured by lengths from the overlap on.
bool move_into_cage(ProofScene &s, int32_t i, const std::vector<NearPair> &pairs, double longest) {
  const size_t d = static_cast<size_t>(s.dim);
  const Cage cage = cage_of(s, i, pairs);
  std::vector<double> vectors, x;
  for (double unit = std::max(cage.overlap(), proof_tuning::closed * longest); unit < longest; unit *= 4.0) {
    vectors.assign(d, 0.0), vectors.push_back(1.0);
    for (size_t k = 0; k < cage.gap.size(); ++k) {
      const double part = cage.gap[k] / unit, length = std::sqrt(1.0 + part * part);
      for (size_t c = 0; c < d; ++c) vectors.push_back(cage.normal[k * d + c] / length);
      vectors.push_back(part / length);
    }
    if (!positive_on_all(s.dim + 1, vectors, x)) continue;
    for (size_t c = 0; c < d; ++c) x[c] *= unit / x[d];
    ProofScene moved = s;
    move_sphere(moved, i, x.data());
    if (cage_of(moved, i, pairs).overlap() < 0.0) return s = std::move(moved), true;
  }
  return false;
}

// To the place where the pairs that overlap, or are open by as little, are nearest to closed.
void move_between(ProofScene &s, int32_t i, const std::vector<NearPair> &pairs) {
  const Cage cage = cage_of(s, i, pairs);
  std::vector<double> normal, closing;
  for (size_t k = 0; k < cage.gap.size(); ++k) {
    if (cage.gap[k] > cage.overlap()) continue;
    const auto at = cage.normal.begin() + static_cast<std::ptrdiff_t>(k) * s.dim;
    normal.insert(normal.end(), at, at + s.dim), closing.push_back(-cage.gap[k]);
  }
  move_sphere(s, i, least_squares(s.dim, normal, closing).data());
}

using Image = std::vector<int32_t>;

// Contacts of each pair of spheres, i < j, as images of i - j.
std::map<std::pair<int32_t, int32_t>, std::set<Image>> contact_images(const ProofScene &s) {
  std::map<std::pair<int32_t, int32_t>, std::set<Image>> out;
  for (size_t c = 0; c < s.contacts(); ++c) {
    int32_t i = s.sphere[s.a[c]], j = s.partner(c);
    Image n(s.image.begin() + static_cast<std::ptrdiff_t>(c * s.dim),
            s.image.begin() + static_cast<std::ptrdiff_t>((c + 1) * s.dim));
    if (j >= 0 && i > j) {
      std::swap(i, j);
      for (int32_t &x : n) x = -x;
    }
    out[{i, j}].insert(n);
  }
  return out;
}

// The packing of doubles with the scene's diameters, for the search of pairs: it is off by 1e-16, the search looks
// 1e-3 far.
Packing rounded(const ProofScene &s) {
  Packing p;
  p.dim = s.dim, p.cell = s.cell, p.container = s.container, p.non_additivity = s.non_additivity;
  p.position = s.high;
  for (const double ratio : s.ratio) p.diameter.push_back(std::sqrt(s.gamma()) * ratio);
  return p;
}

// Whether all centres are inside, at a distance that no radius of a proof reaches.
bool inside_walls(const Packing &p) {
  for (size_t i = 0; i < p.n(); ++i)
    if (p.container && !p.container.holds(&p.position[i * static_cast<size_t>(p.dim)], 0.25 * p.diameter[i]))
      return false;
  return true;
}

// f(i, j, n) of all pairs that are no contacts, as far as `far_above`. False where an offset is no cell vector.
template <class F>
bool each_near_pair(const ProofScene &s, const Packing &p, F &&f) {
  const size_t d = static_cast<size_t>(s.dim);
  const auto contacts = contact_images(s);
  const PairList pairs = find_pairs(p, 0.0, 1.0 + proof_tuning::far_above);
  for (size_t k = 0; k < pairs.size(); ++k) {
    Image n(d);
    if (!lattice_image(p.cell, &pairs.offset[k * d], n.data())) return false;
    const auto at = contacts.find({pairs.i[k], pairs.j[k]});
    if (at == contacts.end() || !at->second.count(n)) f(pairs.i[k], pairs.j[k], n);
  }
  return true;
}

}  // namespace

Expansion apart(const ProofScene &s, const NearPair &pair, size_t c) {
  return s.component(pair.i, pair.j, pair.image.data(), static_cast<int>(c));
}

double opening_of(const ProofScene &s, const NearPair &pair) {
  return s.gap(pair.i, pair.j, pair.image.data()).value() / s.weight(pair.i, pair.j);
}

std::vector<NearPair> near_pairs(const ProofScene &s) {
  std::vector<NearPair> out;
  each_near_pair(s, rounded(s), [&](int32_t i, int32_t j, const Image &n) {
    if (i != j) out.push_back({i, j, n, 0.0}), out.back().opening = opening_of(s, out.back());
  });
  return out;
}

namespace {

// At a round wall; lengths of r move by `way` at most. Relative to the sphere's radius.
double gap_to_round_wall(const ProofScene &s, int32_t i, const Image &n, double way, double growth) {
  double one = 0.0, square = 0.0;
  for (int c = 0; c < s.dim; ++c) {
    const double r = up(std::fabs(s.component(i, wall_partner(s.container.count() - 1), n.data(), c).value()));
    one = add_up(one, r), square = add_up(square, mul_up(r, r));
  }
  square = add_up(square, add_up(mul_up(2.0 * way, one), mul_up(way, way)));
  const double wide = mul_up(growth, s.ratio[i]);
  return down(sub_down(sub_down(s.cell.edge(0), sqrt_up(square)), wide) / wide);
}

}  // namespace

OpenGaps open_gaps(const ProofScene &s, double radius, double growth) {
  const double gamma = s.rooted() ? mul_up(growth, growth) : growth;
  OpenGaps out;
  out.least = proof_tuning::far_above;
  const Packing p = rounded(s);
  const size_t d = static_cast<size_t>(s.dim);
  const Expansion exact = s.exact_gamma();
  // A pair that the search leaves out has a gap of `far_above` less rounding; that is open where the radius is far
  // smaller.
  out.open = out.all_seen =
      radius < 1e-3 * proof_tuning::far_above * *std::min_element(p.diameter.begin(), p.diameter.end());
  const bool listed = each_near_pair(s, p, [&](int32_t i, int32_t j, const Image &n) {
    if (s.rooted())
      out.overlap = std::max(out.overlap, -s.gap(i, j, n.data()).value() / (s.weight(i, j) * s.gamma_per_growth()) *
                                              (1.0 + 32.0 * half_ulp));
    if (s.round(j)) {
      const double gap = gap_to_round_wall(s, i, n, s.node[i] >= 0 ? mul_up(2.0, radius) : 0.0, growth);
      out.least = std::min(out.least, gap);
      if (!(gap > 0.0)) out.open = false, out.of_rattler = s.node[i] < 0;
      return;
    }
    Expansion sum;
    double one = 0.0;
    for (size_t c = 0; c < d; ++c) {
      const Expansion r = s.component(i, j, n.data(), static_cast<int>(c));
      sum.add_product(r, r);
      one = add_up(one, up(std::fabs(r.value())));
    }
    const double moving = (s.node[i] >= 0) + (s.node[j < 0 ? i : j] >= 0);
    double ends = moving;
    for (size_t q = 0; s.strict && q < d; ++q) ends += std::abs(n[q]);
    const Expansion sigma2 = s.sigma_squared(i, j);
    const double need = mul_up(gamma, up(sigma2.value()));
    const double have = sub_down(down(sum.value()), mul_up(2.0 * ends, mul_up(one, radius)));
    Expansion below = sum;
    below.add_product(exact, sigma2, -1.0);
    if (!s.rooted())
      out.overlap = std::max(out.overlap, div_up(-below.value(), sigma2.value()) * (1.0 + 8.0 * half_ulp));
    out.least = std::min(out.least, std::sqrt(std::max(0.0, have) / need) - 1.0);
    if (have > need) return;
    out.open = false;
    out.of_rattler = moving < 2.0;
  });
  if (!listed || !inside_walls(p)) return {};
  const double widest = *std::max_element(s.ratio.begin(), s.ratio.end());
  if (!(mul_up(gamma, mul_up(widest, widest)) <
        s.shortest_period() * s.shortest_period() * (1.0 - (s.strict ? 1e-3 : 1e-12))))
    out.open = out.all_seen = false;
  if (s.rooted() && !(mul_up(growth, widest) < s.cell.edge(0))) out.open = out.all_seen = false;
  return out;
}

bool free_rattler(ProofScene &s, int32_t i, const std::vector<NearPair> &pairs) {
  double overlap = cage_of(s, i, pairs).overlap();
  ProofScene moved = s;
  for (int pass = 0; pass < 3 && cage_of(moved, i, pairs).has_directions(); ++pass) {
    if (move_into_cage(moved, i, pairs, proof_tuning::far_above * s.ratio[i] * std::sqrt(s.gamma())))
      return s = std::move(moved), true;
    move_between(moved, i, pairs);
    const Cage there = cage_of(moved, i, pairs);  // without directions where it met another centre
    if (there.has_directions() && there.overlap() < overlap) s = moved, overlap = there.overlap();
    if (overlap < 0.0) return true;
  }
  return false;
}

void free_rattlers(ProofScene &s) {
  const std::vector<NearPair> pairs = near_pairs(s);
  for (const NearPair &pair : pairs)
    for_spheres(pair.i, pair.j, [&](int32_t i) {
      if (s.node[i] < 0 && opening_of(s, pair) < 0.0) free_rattler(s, i, pairs);
    });
}

}  // namespace jam::inside
