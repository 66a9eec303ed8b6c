#include "core/cell_reduction.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/limits.hpp"
#include "core/math.hpp"
#include "core/tuning.hpp"

namespace jam::inside {
namespace {

constexpr double most_tilt = 0.5 + 1e-12;  // over the edge: half an edge either way is the same lattice

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

  void shorten_tilts() {
    for (int k = 1; k < d_; ++k)
      for (int j = k - 1; j >= 0; --j) shorten(k, j);
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

  NormalCell result() const {
    NormalCell out;
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
    if (std::fabs(g.mu[k * d_ + j]) <= most_tilt) return;
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

void check_vectors(int dim, const double *rows) {
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
}

double relative_height(const Cell &cell) { return cell.height_min() / cell.side(); }

}  // namespace

bool NormalCell::same_vectors() const {
  const auto d = static_cast<size_t>(cell.dim());
  for (size_t k = 0; k < d * d; ++k)
    if (transform[k] != (k % (d + 1) == 0 ? 1 : 0)) return false;
  return true;
}

void NormalCell::turn(std::vector<double> &vectors) const {
  const auto d = static_cast<size_t>(cell.dim());
  for (size_t i = 0; rotated && i < vectors.size(); i += d) {
    Cell::Vector x{};
    for (size_t k = 0; k < d; ++k)
      for (size_t c = 0; c < d; ++c) x[k] += rotation[k * d + c] * vectors[i + c];
    std::copy(x.begin(), x.begin() + d, vectors.begin() + i);
  }
}

double orthogonality_defect(const Cell &cell) {
  double product = 1.0;
  for (int c = 0; c < cell.dim(); ++c) {
    double r2 = 0.0;
    for (int k = 0; k <= c; ++k) r2 += cell.row(c)[k] / cell.edge(c) * (cell.row(c)[k] / cell.edge(c));
    product *= std::sqrt(r2);
  }
  return product;
}

// Reduced vectors of dense lattices have up to 2^(d/2). A search for images examines up to 3^d times as many.
double defect_max(int dim) { return std::ldexp(1.0, dim + 2); }

Cell upright(const Cell &cell) {
  const int d = cell.dim();
  std::vector<double> rows = cell.rows();
  bool changed = false;
  for (int c = 1; c < d; ++c)
    for (int k = c - 1; k >= 0; --k) {
      const double tilt = rows[c * d + k] / rows[k * d + k];
      if (std::fabs(tilt) <= most_tilt) continue;
      for (int e = 0; e <= k; ++e) rows[c * d + e] -= std::nearbyint(tilt) * rows[k * d + e];
      changed = true;
    }
  if (!changed) return cell;
  Cell out = Cell::from_triangle(d, rows.data());
  out.close(cell.closed());
  return out;
}

Cell search_cell(const Packing &p) { return p.model == JAM_MODEL_MK ? p.cell : upright(p.cell); }

NormalCell reduce_cell(int dim, const double *rows) {
  check_vectors(dim, rows);
  Reduction reduction(dim, rows);
  reduction.run();
  NormalCell out = reduction.result();
  const double height = relative_height(out.cell);
  if (!(height >= limits::cell_height_min))
    fail(JAM_E_ARGUMENT, "the cell is flat: two faces are %g V^(1/d) apart, at least %g is supported", height,
         limits::cell_height_min);
  return out;
}

NormalCell normal_cell(int dim, const double *rows, double most_defect) {
  check_vectors(dim, rows);
  for (const bool shorten : {false, true}) {
    Reduction reduction(dim, rows);
    if (shorten) reduction.shorten_tilts();
    NormalCell out = reduction.result();
    out.most_defect = most_defect;
    if (orthogonality_defect(out.cell) <= most_defect && relative_height(upright(out.cell)) >= limits::cell_height_min)
      return out;
  }
  NormalCell out = reduce_cell(dim, rows);
  out.most_defect = most_defect;
  return out;
}

NormalCell normal_cell(int dim, const double *rows) { return normal_cell(dim, rows, defect_max(dim)); }

}  // namespace jam::inside
