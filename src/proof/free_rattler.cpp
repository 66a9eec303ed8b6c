#include "proof/free_rattler.hpp"

#include <algorithm>
#include <cmath>

#include "linalg/least_squares.hpp"
#include "proof/tuning.hpp"

namespace jam::inside {
namespace {

// x with a positive component along each of the vectors, where the search finds one (F. Rosenblatt's perceptron).
bool positive_on_all(size_t d, const std::vector<double> &vectors, std::vector<double> &x) {
  x.assign(d, 0.0);
  for (int turn = 0; turn < proof_tuning::turns; ++turn) {
    double least = HUGE_VAL;
    size_t worst = 0;
    for (size_t k = 0; k < vectors.size(); k += d) {
      double along = 0.0;
      for (size_t c = 0; c < d; ++c) along += vectors[k + c] * x[c];
      if (along < least) least = along, worst = k;
    }
    if (least > 0.0) return true;
    for (size_t c = 0; c < d; ++c) x[c] += vectors[worst + c];
  }
  return false;
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
    if (!positive_on_all(d + 1, vectors, x)) continue;
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
    if (cage.gap[k] > proof_tuning::as_narrow * cage.overlap()) continue;
    const auto at = cage.normal.begin() + static_cast<std::ptrdiff_t>(k) * s.dim;
    normal.insert(normal.end(), at, at + s.dim), closing.push_back(-cage.gap[k]);
  }
  move_sphere(s, i, least_squares(s.dim, normal, closing).data());
}

}  // namespace

bool free_rattler(ProofScene &s, int32_t i, const std::vector<NearPair> &pairs) {
  const Cage cage = cage_of(s, i, pairs);
  if (!cage.has_directions()) return false;
  double overlap = cage.overlap();
  ProofScene moved = s;
  for (int pass = 0; pass < 3; ++pass) {
    if (move_into_cage(moved, i, pairs, proof_tuning::freed * s.ratio[i] * std::sqrt(s.gamma())))
      return s = std::move(moved), true;
    move_between(moved, i, pairs);
    const double left = cage_of(moved, i, pairs).overlap();
    if (left < overlap) s = moved, overlap = left;
    if (overlap < 0.0) return true;
  }
  return false;
}

bool free_rattlers(ProofScene &s) {
  const std::vector<NearPair> pairs = near_pairs(s);
  bool moved = false;
  for (const NearPair &pair : pairs)
    for_spheres(pair.i, pair.j, [&](int32_t i) {
      if (s.node[i] < 0 && opening_of(s, pair) < 0.0) moved = free_rattler(s, i, pairs) || moved;
    });
  return moved;
}

}  // namespace jam::inside
