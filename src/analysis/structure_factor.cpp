// S(q) on the wave vectors of a periodic cell, or of the axes of it that repeat.
#include <algorithm>
#include <cmath>
#include <optional>

#include "analysis/structure.hpp"
#include "analysis/tuning.hpp"
#include "core/call_scope.hpp"
#include "core/math.hpp"

namespace jam::inside {
namespace {

// Sums of S over the wave vectors of each length. Lengths come in any order; equal ones meet when the list is sorted.
class Shells {
 public:
  void add(double q2, double s) {
    if (shell_.size() >= next_sort_) merge();
    shell_.push_back({q2, s, 1, added_++});
  }
  StructureFactor means(double step, double unit) {
    merge();
    StructureFactor out;
    for (const Shell &s : shell_) {
      out.q.push_back(step * std::sqrt(s.q2) * unit);
      out.s.push_back(s.sum / static_cast<double>(s.count));
    }
    return out;
  }

 private:
  struct Shell {
    double q2, sum;
    int64_t count, number;
  };
  // Rounding of q^2 is below 1e-13 in the flattest cells. In a cube q^2 is a whole number, below 1e11.
  static constexpr double same_length = 1e-12;
  // Sums keep the order of the vectors.
  void merge() {
    std::sort(shell_.begin(), shell_.end(),
              [](const Shell &a, const Shell &b) { return a.q2 < b.q2 || (a.q2 == b.q2 && a.number < b.number); });
    size_t kept = 0;
    for (const Shell &s : shell_) {
      if (kept > 0 && s.q2 - shell_[kept - 1].q2 <= same_length * s.q2) {
        shell_[kept - 1].sum += s.sum;
        shell_[kept - 1].count += s.count;
      } else {
        shell_[kept++] = s;
      }
    }
    shell_.resize(kept);
    next_sort_ = std::max<size_t>(4096, 2 * kept);
    CallScope::need_memory(2.0 * static_cast<double>(next_sort_ * sizeof(Shell)), "lengths of wave vectors");
  }
  std::vector<Shell> shell_;
  size_t next_sort_ = 4096;
  int64_t added_ = 0;
};

// The reciprocal lattice in units of 2 pi / V^(1/d). Component c of the vector (m_0, m_1, ...) is the sum over k <= c
// of m_k inverse[c][k]: it does not depend on the coefficients that follow.
struct Reciprocal {
  int dim;
  std::vector<Cell::Vector> inverse;
  std::vector<double> length;  // |a_c|: |m_c| is at most that times |q|

  explicit Reciprocal(const Cell &cell) : dim(cell.dim()), inverse(cell.dim()), length(cell.dim()) {
    for (int c = 0; c < dim; ++c) {
      Cell::Vector axis{};
      axis[c] = cell.side();
      cell.fraction(axis.data(), inverse[c].data());
      double r2 = 0.0;
      for (int k = 0; k <= c; ++k) r2 += cell.row(c)[k] / cell.side() * (cell.row(c)[k] / cell.side());
      length[c] = std::sqrt(r2);
    }
  }
};

// Coordinates along the cell vectors, in units of V^(1/d): what the coefficients of a wave vector multiply.
std::vector<double> phases_of(const Packing &p) {
  std::vector<double> s = p.position;
  const size_t d = static_cast<size_t>(p.dim);
  for (size_t i = 0; i < p.n() && !p.cell.cube(); ++i) {
    p.cell.fraction(&s[i * d], &s[i * d]);
    for (size_t c = 0; c < d; ++c) s[i * d + c] *= p.cell.side();
  }
  return s;
}

// For each axis the largest coefficient of a wave vector. Waves across walls would show the container: those along the
// axes that repeat are left.
std::vector<int> most_coefficients(const Packing &p, double reach) {
  const Reciprocal lattice(p.cell);
  std::vector<int> out;
  for (int c = 0; c < p.dim; ++c)
    out.push_back(p.cell.repeats(c)
                      ? static_cast<int>(std::min(std::floor(reach * lattice.length[c]), FourierTuning::coefficients))
                      : 0);
  return out;
}

FourierSums::Bounds bounds_of(const std::vector<int> &most) {
  FourierSums::Bounds out{};
  size_t axes = 0;
  for (const int m : most)
    if (m > 0) out[axes++] = m;
  return out;
}

FourierSums fourier_sums(const Packing &p, const std::vector<int> &most) {
  std::vector<double> s;
  size_t axes = 0;
  for (const int m : most) axes += m > 0;
  Cell::Vector x{};
  for (size_t i = 0; i < p.n(); ++i) {
    p.cell.fraction(&p.position[i * most.size()], x.data());
    for (size_t c = 0; c < most.size(); ++c)
      if (most[c] > 0) s.push_back(x[c]);
  }
  return {s, axes, bounds_of(most)};
}

enum class SumsBy { lengths_only, products, grid };

class Sum {
 public:
  Sum(const Packing &p, double reach, double vectors, SumsBy by)
      : lattice_(p.cell),
        n_(by == SumsBy::products ? p.n() : 0),
        spheres_(static_cast<double>(p.n())),
        reach2_(reach * reach),
        vectors_(vectors),
        most_(most_coefficients(p, reach)),
        re_(p.dim + 1, std::vector<double>(n_, 1.0)),
        im_(p.dim + 1, std::vector<double>(n_, 0.0)) {
    const int d = p.dim;
    const double step = 2.0 * math::pi / p.cell.side();
    if (by == SumsBy::grid) sums_.emplace(fourier_sums(p, most_));
    const std::vector<double> s = phases_of(p);
    // cos and sin for every component, coefficient and sphere, so that inner loops run over spheres
    for (int c = 0; c < d; ++c) {
      const size_t width = 2 * static_cast<size_t>(most_[c]) + 1;
      CallScope::need_memory(static_cast<double>(width * n_) * 2.0 * sizeof(double), "phases of the spheres");
      co_.emplace_back(width * n_);
      si_.emplace_back(width * n_);
      for (int m = -most_[c]; m <= most_[c]; ++m)
        for (size_t i = 0; i < n_; ++i) {
          const double phase = step * m * s[i * d + c];
          co_[c][static_cast<size_t>(m + most_[c]) * n_ + i] = math::cos(phase);
          si_[c][static_cast<size_t>(m + most_[c]) * n_ + i] = math::sin(phase);
        }
    }
  }
  StructureFactor run(double step, double unit) {
    descend(0, 0.0, false);
    return shells_.means(step, unit);
  }

 private:
  // One of each pair +-q: the first coefficient that is not zero is positive.
  void descend(int c, double q2, bool positive) {
    if (c == lattice_.dim) {
      if (positive) add(q2);
      return;
    }
    double before = 0.0;
    for (int k = 0; k < c; ++k) before += coefficient_[k] * lattice_.inverse[c][k];
    for (int m = positive ? -most_[c] : 0; m <= most_[c]; ++m) {
      const double q = before + m * lattice_.inverse[c][c], next = q2 + q * q;
      if (next > reach2_) continue;
      coefficient_[c] = m;
      const size_t at = static_cast<size_t>(m + most_[c]) * n_;
      const double *a = co_[c].data() + at, *b = si_[c].data() + at;  // n_ = 0: no element to refer to
      for (size_t i = 0; i < n_; ++i) {
        re_[c + 1][i] = re_[c][i] * a[i] - im_[c][i] * b[i];
        im_[c + 1][i] = re_[c][i] * b[i] + im_[c][i] * a[i];
      }
      descend(c + 1, next, positive || m > 0);
    }
  }
  void add(double q2) {
    CallScope::report_share(done_, static_cast<double>(done_) / vectors_);
    ++done_;
    double x = 0.0, y = 0.0;
    if (sums_) {
      int m[3] = {0, 0, 0}, axes = 0;
      for (int c = 0; c < lattice_.dim; ++c)
        if (most_[c] > 0) m[axes++] = static_cast<int>(coefficient_[c]);
      x = sums_->at(m).real(), y = sums_->at(m).imag();
    }
    for (size_t i = 0; i < n_; ++i) x += re_[lattice_.dim][i], y += im_[lattice_.dim][i];
    shells_.add(q2, (x * x + y * y) / spheres_);
  }

  const Reciprocal lattice_;
  const size_t n_;
  const double spheres_, reach2_, vectors_;
  const std::vector<int> most_;
  std::optional<FourierSums> sums_;
  std::vector<std::vector<double>> co_, si_, re_, im_;
  Cell::Vector coefficient_{};
  int64_t done_ = 0;
  Shells shells_;
};

}  // namespace

StructureFactor structure_factor(const Packing &p, double q_max, bool lengths_only) {
  const double unit = diameter_mean(p), step = 2.0 * math::pi / p.cell.side();
  if (!(q_max > 0.0 && std::isfinite(q_max)))
    fail(JAM_E_ARGUMENT, "q_max is %g per mean diameter, it must be finite and > 0", q_max);
  refuse_closed(p, 1, "S(q)");
  const double reach = q_max / unit / step;
  const double vectors = 0.5 * unit_sphere_volume(p.dim) * math::pow(2.0 * reach, p.dim);
  const double products = vectors * static_cast<double>(p.n());
  const std::vector<int> most = most_coefficients(p, reach);
  const bool fits = std::count_if(most.begin(), most.end(), [](int m) { return m > 0; }) <= 3;
  const double by_grid = fits ? FourierSums::seconds(p.n(), bounds_of(most)) : HUGE_VAL,
               direct = FourierTuning::second_a_product * products;
  const bool grid = products > FourierTuning::products && by_grid < direct;
  if (std::min(by_grid, direct) > FourierTuning::longest)
    fail(JAM_E_ARGUMENT, "q_max = %g means %.3g wave vectors for %zu spheres: too much work", q_max, vectors, p.n());
  Sum sum(p, reach, vectors, lengths_only ? SumsBy::lengths_only : grid ? SumsBy::grid : SumsBy::products);
  return sum.run(step, unit);
}

}  // namespace jam::inside
