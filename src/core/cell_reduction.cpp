#include "core/cell_reduction.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.hpp"
#include "core/limits.hpp"
#include "core/math.hpp"
#include "core/tuning.hpp"

namespace jam::inside {
namespace {

// Gram-Schmidt: row k = sum_j mu[k][j] star_j.
struct Orthogonal {
  std::vector<double> star, mu, length2;
  Orthogonal(int d, const std::vector<double> &b) : star(b), mu(b.size(), 0.0), length2(d, 0.0) {
    for (int k = 0; k < d; ++k) {
      for (int j = 0; j < k; ++j) {
        double product = 0.0;
        for (int c = 0; c < d; ++c) product += star[k * d + c] * star[j * d + c];
        mu[k * d + j] = product / length2[j];
        for (int c = 0; c < d; ++c) star[k * d + c] -= mu[k * d + j] * star[j * d + c];
      }
      mu[k * d + k] = 1.0;
      for (int c = 0; c < d; ++c) length2[k] += star[k * d + c] * star[k * d + c];
    }
  }
};

class Reduction {
 public:
  Reduction(int dim, const double *rows) : d_(dim), b_(rows, rows + static_cast<size_t>(dim) * dim) {
    t_.assign(b_.size(), 0);
    for (int k = 0; k < d_; ++k) t_[k * d_ + k] = 1;
  }

  void run() {
    int64_t left = ReductionTuning::most_steps;
    for (int k = 1; k < d_ && --left > 0;) {
      for (int j = k - 1; j >= 0; --j) shorten(k, j);
      const Orthogonal g(d_, b_);
      const double mu = g.mu[k * d_ + k - 1];
      if (g.length2[k] >= (ReductionTuning::lovasz - mu * mu) * g.length2[k - 1]) {
        ++k;
        continue;
      }
      exchange(k, k - 1);
      k = std::max(1, k - 1);
    }
    if (odd_) negate(0);  // the determinant stays positive
  }

  ReducedCell result() const {
    ReducedCell out;
    out.transform = t_;
    out.rotation.assign(b_.size(), 0.0);
    const Orthogonal g(d_, b_);
    bool triangular = true;
    for (int k = 0; k < d_; ++k) {
      triangular = triangular && b_[k * d_ + k] > 0.0;
      for (int c = k + 1; c < d_; ++c) triangular = triangular && b_[k * d_ + c] == 0.0;
    }
    out.rotated = !triangular;
    std::vector<double> rows(b_);
    for (int k = 0; k < d_; ++k)
      for (int c = 0; c < d_; ++c) {
        out.rotation[k * d_ + c] = triangular ? (k == c) : g.star[k * d_ + c] / std::sqrt(g.length2[k]);
        if (!triangular) rows[k * d_ + c] = c <= k ? g.mu[k * d_ + c] * std::sqrt(g.length2[c]) : 0.0;
      }
    out.cell = Cell::from_triangle(d_, rows.data());
    return out;
  }

 private:
  void shorten(int k, int j) {
    const Orthogonal g(d_, b_);
    // Half an edge either way is the same lattice: only more than that is taken off.
    if (std::fabs(g.mu[k * d_ + j]) <= 0.5 + 1e-12) return;
    const double m = std::nearbyint(g.mu[k * d_ + j]);
    constexpr double largest = 1e15;  // integers of that size and their sums are exact in doubles
    for (int c = 0; c < d_; ++c) {
      const double entry = static_cast<double>(t_[k * d_ + c]) - m * static_cast<double>(t_[j * d_ + c]);
      if (!(std::fabs(entry) <= largest))
        fail(JAM_E_ARGUMENT, "the cell is flat: its vectors are nearly parallel, %g times one is taken off another", m);
    }
    for (int c = 0; c < d_; ++c) {
      b_[k * d_ + c] -= m * b_[j * d_ + c];
      t_[k * d_ + c] -= static_cast<int64_t>(m) * t_[j * d_ + c];
    }
  }
  void exchange(int k, int j) {
    for (int c = 0; c < d_; ++c) std::swap(b_[k * d_ + c], b_[j * d_ + c]), std::swap(t_[k * d_ + c], t_[j * d_ + c]);
    odd_ = !odd_;
  }
  void negate(int k) {
    for (int c = 0; c < d_; ++c) b_[k * d_ + c] = -b_[k * d_ + c], t_[k * d_ + c] = -t_[k * d_ + c];
    odd_ = !odd_;
  }

  const int d_;
  std::vector<double> b_;
  std::vector<int64_t> t_;
  bool odd_ = false;
};

// By elimination with pivots; a left-handed cell has a negative sign.
double determinant(int d, std::vector<double> m) {
  double product = 1.0;
  for (int k = 0; k < d; ++k) {
    int pivot = k;
    for (int r = k + 1; r < d; ++r)
      if (std::fabs(m[r * d + k]) > std::fabs(m[pivot * d + k])) pivot = r;
    if (m[pivot * d + k] == 0.0) return 0.0;
    if (pivot != k) {
      for (int c = 0; c < d; ++c) std::swap(m[k * d + c], m[pivot * d + c]);
      product = -product;
    }
    product *= m[k * d + k];
    for (int r = k + 1; r < d; ++r) {
      const double f = m[r * d + k] / m[k * d + k];
      for (int c = k; c < d; ++c) m[r * d + c] -= f * m[k * d + c];
    }
  }
  return product;
}

}  // namespace

ReducedCell reduce_cell(int dim, const double *rows) {
  const size_t count = static_cast<size_t>(dim) * dim;
  std::vector<double> unit(rows, rows + count);
  double largest = 0.0;
  for (size_t k = 0; k < count; ++k) {
    if (!std::isfinite(rows[k]))
      fail(JAM_E_NONFINITE, "component %zu of cell vector %zu is %g", k % dim, k / dim, rows[k]);
    largest = std::max(largest, std::fabs(rows[k]));
  }
  if (!(largest > 0.0)) fail(JAM_E_ARGUMENT, "the cell vectors are all 0");
  for (double &x : unit) x /= largest;
  const double volume = determinant(dim, unit);
  if (!(volume > 0.0))
    fail(JAM_E_ARGUMENT, "the cell vectors have the determinant %g, it must be positive: %s", volume,
         volume < 0.0 ? "exchange two of them" : "they are linearly dependent");
  check_box(math::pow(volume, 1.0 / dim) * largest);
  Reduction reduction(dim, rows);
  reduction.run();
  ReducedCell out = reduction.result();
  const double height = out.cell.height_min() / out.cell.side();
  if (!(height >= limits::cell_height_min))
    fail(JAM_E_ARGUMENT, "the cell is flat: two faces are %g V^(1/d) apart, at least %g is supported", height,
         limits::cell_height_min);
  return out;
}

void enter_cell(Packing &p, const ReducedCell &reduced) {
  const size_t d = static_cast<size_t>(p.dim);
  p.cell = reduced.cell;
  if (reduced.rotated)
    for (auto *of : {&p.position, &p.velocity})
      for (size_t i = 0; i < of->size() / d; ++i) {
        Cell::Vector x{};
        for (size_t k = 0; k < d; ++k)
          for (size_t c = 0; c < d; ++c) x[k] += reduced.rotation[k * d + c] * (*of)[i * d + c];
        std::copy(x.begin(), x.begin() + d, of->begin() + i * d);
      }
  if (!p.position.empty()) wrap_positions(p);
}

bool keeps_shifts(const Packing &p, const ReducedCell &reduced) {
  bool same = true;
  for (int r = 0; r < p.dim; ++r)
    for (int c = 0; c < p.dim; ++c) same &= reduced.transform[static_cast<size_t>(r) * p.dim + c] == (r == c ? 1 : 0);
  return same || p.model != JAM_MODEL_MK;
}

void strain_affinely(Packing &p, const double *strain) {
  refuse_walls(p, "strained");
  const int d = p.dim;
  const auto deform = [&](const double *x, double *y) {
    for (int a = 0; a < d; ++a) {
      y[a] = x[a];
      for (int b = 0; b < d; ++b) y[a] += strain[a * d + b] * x[b];
    }
  };
  std::vector<double> rows(static_cast<size_t>(d) * d);
  for (int c = 0; c < d; ++c) deform(p.cell.row(c), &rows[c * d]);
  for (size_t i = 0; i < p.n(); ++i) {
    Cell::Vector y{};
    deform(&p.position[i * d], y.data());
    std::copy(y.begin(), y.begin() + d, p.position.begin() + i * d);
  }
  const ReducedCell reduced = reduce_cell(d, rows.data());
  if (!keeps_shifts(p, reduced))
    fail(JAM_E_UNSUPPORTED, "so large a strain gives the cell other vectors, and with them other Mari-Kurchan shifts");
  enter_cell(p, reduced);
}

}  // namespace jam::inside
