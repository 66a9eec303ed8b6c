#include "linalg/newton_system.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/call_scope.hpp"
#include "core/with_dimension.hpp"
#include "linalg/block_matrix.hpp"
#include "linalg/dot.hpp"

namespace jam::inside {
namespace {

void add(double factor, const std::vector<double> &x, double *y) {
  for (size_t k = 0; k < x.size(); ++k) y[k] += factor * x[k];
}

}  // namespace

void NewtonSystem::set_graph(int dim, int32_t n, const PairList &pairs, int threads, bool keep_order) {
  set_strain(nullptr, 0);
  if (dim == dim_ && n == n_ && threads == threads_ && pairs.i == pair_i_ && pairs.j == pair_j_) return;
  const double t0 = now_seconds();
  dim_ = 0;  // until all is done: the call may be left
  n_ = n;
  threads_ = threads;
  pair_i_ = pairs.i;
  pair_j_ = pairs.j;
  edge_of_pair_.resize(pairs.size());
  std::vector<int32_t> ei, ej;
  // Pairs are sorted by (i, j, image): images of one pair are neighbours in the list.
  for (size_t k = 0; k < pairs.size(); ++k) {
    if (pairs.i[k] == pairs.j[k]) {
      edge_of_pair_[k] = -1;
      continue;
    }
    if (pairs.wall(k)) {
      edge_of_pair_[k] = -2;
      continue;
    }
    if (ei.empty() || ei.back() != pairs.i[k] || ej.back() != pairs.j[k]) {
      ei.push_back(pairs.i[k]);
      ej.push_back(pairs.j[k]);
    }
    edge_of_pair_[k] = static_cast<int32_t>(ei.size()) - 1;
  }
  edges_ = ei.size();
  if (keep_order)
    cholesky_.analyse_keep_order(dim, n, ei.data(), ej.data(), edges_, threads);
  else
    cholesky_.analyse(dim, n, ei.data(), ej.data(), edges_, threads);
  CallScope::need_memory(
      bytes(dim, n, static_cast<double>(pairs.size()), static_cast<double>(edges_),
            static_cast<double>(cholesky_.factor_nonzeros()), static_cast<double>(cholesky_.front_numbers())),
      "the linear programs of this packing");
  const size_t block = static_cast<size_t>(dim) * dim, unknowns = static_cast<size_t>(n) * dim;
  diag_.resize(block * n);
  off_.resize(block * edges_);
  for (auto *v : {&box_, &column_, &column_solved_, &work_, &residual_, &correction_}) v->resize(unknowns);
  row_work_.resize(pairs.size());
  dim_ = dim;
  seconds_assemble += now_seconds() - t0;
}

void NewtonSystem::release() {
  cholesky_.release();
  gradients_ = ConjugateGradients();
  dim_ = 0;
}

void NewtonSystem::set_strain(const double *strain, int count) {
  strain_ = strain, strains_ = count;
  const size_t spheres = static_cast<size_t>(n_) * dim_;
  for (auto *v : {&box_, &work_, &residual_, &correction_, &column_}) v->resize(spheres + count);
  border_.resize(spheres * count), border_solved_.resize(spheres * count);
}

template <int D>
void NewtonSystem::assemble(const double *a, const double *weight) {
  constexpr int B = D * D;
  std::fill(diag_.begin(), diag_.end(), 0.0);
  std::fill(off_.begin(), off_.end(), 0.0);
  for (size_t k = 0; k < pair_i_.size(); ++k) {
    double *di = &diag_[static_cast<size_t>(pair_i_[k]) * B];
    const double *row = a + k * D;
    if (edge_of_pair_[k] < 0) {
      for (int p = 0; p < D && edge_of_pair_[k] == -2; ++p)
        for (int q = 0; q < D; ++q) di[p * D + q] += weight[k] * row[p] * row[q];
      continue;
    }
    double *dj = &diag_[static_cast<size_t>(pair_j_[k]) * B];
    double *e = &off_[static_cast<size_t>(edge_of_pair_[k]) * B];
    for (int p = 0; p < D; ++p) {
      const double wp = weight[k] * row[p];
      for (int q = 0; q < D; ++q) {
        const double v = wp * row[q];
        di[p * D + q] += v;
        dj[p * D + q] += v;
        e[p * D + q] -= v;
      }
    }
  }
  for (int32_t i = 0; i < n_; ++i)
    for (int p = 0; p < D; ++p) diag_[static_cast<size_t>(i) * B + p * (D + 1)] += box_[static_cast<size_t>(i) * D + p];
}

bool NewtonSystem::factorise(const double *a, const double *weight, const double *box, Precision precision) {
  const double t0 = now_seconds();
  a_ = a;
  weight_ = weight;
  std::copy(box, box + box_.size(), box_.begin());
  with_dimension(dim_, [&](auto d) { assemble<d>(a, weight); });
  const double t1 = now_seconds();
  seconds_assemble += t1 - t0;
  const int replaced = cholesky_.factorise(diag_.data(), off_.data(), precision);
  ++factorisations;
  const double t2 = now_seconds();
  seconds_factor += t2 - t1;
  if (replaced < 0) return false;
  gradients_.forget(box_.size() + 1);
  transpose_times(a, weight, column_.data());
  delta_ = 0.0;
  for (size_t k = 0; k < pair_i_.size(); ++k) delta_ += weight[k];
  column_solved_.assign(column_.begin(), column_.end() - strains_);
  cholesky_.solve(column_solved_.data());
  schur_ = delta_ - dot(column_solved_, column_.data());
  // In exact arithmetic schur > 0; what rounding leaves below eps * delta says nothing.
  if (!(schur_ > 1e-14 * delta_)) schur_ = 1e-14 * delta_;
  if (strains_ > 0) border();
  seconds_solve += now_seconds() - t2;
  return std::isfinite(schur_);
}

// Schur complement of (g, e): C^T D C + diag - (A^T D C)^T K^-1 (A^T D C) with the columns C = (-1, B).
void NewtonSystem::border() {
  const size_t spheres = column_solved_.size(), m = pair_i_.size(), q = static_cast<size_t>(strains_);
  Eigen::MatrixXd s = Eigen::MatrixXd::Zero(strains_ + 1, strains_ + 1);
  s(0, 0) = schur_;
  for (int c = 0; c < strains_; ++c) {
    double *f = &border_[c * spheres], *k = &border_solved_[c * spheres];
    for (size_t e = 0; e < m; ++e) row_work_[e] = weight_[e] * strain_[e * q + c];
    jam::inside::transpose_times(dim_, n_, pair_i_, pair_j_, a_, row_work_.data(), f);
    std::copy(f, f + spheres, k);
    cholesky_.solve(k);
    s(0, c + 1) = std::inner_product(k, k + spheres, column_.begin(), 0.0);
    for (size_t e = 0; e < m; ++e) s(0, c + 1) -= row_work_[e];
    for (int b = 0; b <= c; ++b) {
      double &x = s(b + 1, c + 1);
      for (size_t e = 0; e < m; ++e) x += row_work_[e] * strain_[e * q + b];
      x -= std::inner_product(k, k + spheres, &border_[b * spheres], 0.0);
      if (b == c) x += box_[spheres + c];
    }
  }
  s.triangularView<Eigen::StrictlyLower>() = s.transpose();
  const Eigen::MatrixXd inverse = s.ldlt().solve(Eigen::MatrixXd::Identity(strains_ + 1, strains_ + 1));
  corner_.assign(inverse.data(), inverse.data() + inverse.size());
}

void NewtonSystem::solve_once(const double *rhs, double h, double *ds, double *dg) {
  const size_t spheres = column_solved_.size();
  std::copy(rhs, rhs + spheres, ds);
  cholesky_.solve(ds);
  if (strains_ == 0) {
    *dg = (h + dot(column_, ds)) / schur_;
  } else {
    Eigen::VectorXd x(strains_ + 1);
    x[0] = h + std::inner_product(ds, ds + spheres, column_.begin(), 0.0);
    for (int c = 0; c < strains_; ++c)
      x[c + 1] = rhs[spheres + c] - std::inner_product(ds, ds + spheres, &border_[c * spheres], 0.0);
    x = (Eigen::Map<const Eigen::MatrixXd>(corner_.data(), strains_ + 1, strains_ + 1) * x).eval();
    *dg = x[0];
    for (int c = 0; c < strains_; ++c) {
      for (size_t k = 0; k < spheres; ++k) ds[k] -= x[c + 1] * border_solved_[c * spheres + k];
      ds[spheres + c] = x[c + 1];
    }
  }
  for (size_t k = 0; k < spheres; ++k) ds[k] += *dg * column_solved_[k];
}

// work_ = A^T D (A ds - dg), without box. Returns `rest` less the row of g.
double NewtonSystem::operator_times(const double *ds, double dg, double rest) {
  rows_times(a_, ds, row_work_.data());
  for (size_t k = 0; k < row_work_.size(); ++k) {
    row_work_[k] = weight_[k] * (row_work_[k] - dg);
    rest += row_work_[k];
  }
  transpose_times(a_, row_work_.data(), work_.data());
  return rest;
}

bool NewtonSystem::solve_near(const double *rhs, double h, double *ds, double *dg, double accuracy, int most) {
  const double t0 = now_seconds();
  const size_t unknowns = box_.size();
  bordered_rhs_.assign(rhs, rhs + unknowns);
  bordered_rhs_.push_back(h);
  bordered_.resize(unknowns + 1);
  const bool near = gradients_.solve(
      bordered_rhs_.data(), accuracy, most,
      [&](const double *in, double *out) { solve_once(in, in[unknowns], out, out + unknowns); },
      [&](const double *in, double *out) {
        out[unknowns] = -operator_times(in, in[unknowns], 0.0);
        for (size_t k = 0; k < unknowns; ++k) out[k] = work_[k] + box_[k] * in[k];
      },
      bordered_.data());
  std::copy(bordered_.begin(), bordered_.end() - 1, ds);
  *dg = bordered_.back();
  seconds_solve += now_seconds() - t0;
  return near;
}

void NewtonSystem::solve(const double *rhs, double h, double *ds, double *dg, int refine) {
  const double t0 = now_seconds();
  solve_once(rhs, h, ds, dg);
  for (int step = 0; step < refine; ++step) {
    const double rest = operator_times(ds, *dg, h);
    double worst = std::fabs(rest), scale = std::fabs(h);
    for (size_t k = 0; k < work_.size(); ++k) {
      residual_[k] = rhs[k] - work_[k] - box_[k] * ds[k];
      worst = std::max(worst, std::fabs(residual_[k]));
      scale = std::max(scale, std::fabs(rhs[k]));
    }
    if (worst <= 1e-9 * scale) break;
    double dg_more;
    solve_once(residual_.data(), rest, correction_.data(), &dg_more);
    for (size_t k = 0; k < work_.size(); ++k) ds[k] += correction_[k];
    *dg += dg_more;
  }
  seconds_solve += now_seconds() - t0;
}

void NewtonSystem::rows_times(const double *a, const double *s, double *out) const {
  jam::inside::rows_times(dim_, pair_i_, pair_j_, a, s, out);
  add_columns_times(strain_, static_cast<size_t>(strains_), pair_i_.size(), s + static_cast<size_t>(n_) * dim_, out);
}

void NewtonSystem::transpose_times(const double *a, const double *y, double *out) const {
  jam::inside::transpose_times(dim_, n_, pair_i_, pair_j_, a, y, out);
  columns_transpose_times(strain_, static_cast<size_t>(strains_), pair_i_.size(), y,
                          out + static_cast<size_t>(n_) * dim_);
}

void ConjugateGradients::forget(size_t unknowns) {
  count_ = 0;
  for (auto *v : {&residual_, &correction_, &now_.along, &now_.image}) v->resize(unknowns);
}

// The squared error in the norm of K is about r . M^-1 r; the energy of x is its squared size.
bool ConjugateGradients::solve(const double *b, double accuracy, int most, const Product &precondition,
                               const Product &times_k, double *x) {
  const size_t unknowns = residual_.size();
  std::copy(b, b + unknowns, residual_.begin());
  std::fill(x, x + unknowns, 0.0);
  std::fill(now_.along.begin(), now_.along.end(), 0.0);
  double energy = 0.0, product = 1.0;
  const auto go = [&](const Direction &d) {
    const double length = dot(d.along, residual_) / d.energy;
    energy += length * length * d.energy;
    add(length, d.along, x);
    add(-length, d.image, residual_.data());
  };
  for (size_t k = 0; k < count_; ++k) go(kept_[k]);
  for (int step = 0;; ++step) {
    precondition(residual_.data(), correction_.data());
    const double next = dot(residual_, correction_);
    if (!(next >= 0.0) || !std::isfinite(next)) return false;
    if (next <= accuracy * accuracy * (energy + next)) break;
    if (step == most) return false;
    const double keep = step == 0 ? 0.0 : next / product;
    product = next;
    for (size_t u = 0; u < unknowns; ++u) now_.along[u] = correction_[u] + keep * now_.along[u];
    for (size_t k = 0; k < count_; ++k)  // also to those of this solve: rounding makes them lose it
      add(-dot(kept_[k].image, now_.along) / kept_[k].energy, kept_[k].along, now_.along.data());
    times_k(now_.along.data(), now_.image.data());
    now_.energy = dot(now_.along, now_.image);
    go(now_);
    if (count_ >= static_cast<size_t>(most)) continue;
    if (kept_.size() == count_) kept_.emplace_back();
    kept_[count_++] = now_;
  }
  add(1.0, correction_, x);  // the last correction costs nothing
  return true;
}

}  // namespace jam::inside
