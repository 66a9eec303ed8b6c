#include "lp/newton_system.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/error.hpp"
#include "core/monitor.hpp"
#include "linalg/pair_products.hpp"

namespace jam {
namespace {

double dot(const std::vector<double> &x, const double *y) { return std::inner_product(x.begin(), x.end(), y, 0.0); }

}  // namespace

void NewtonSystem::set_graph(int dim, int32_t n, const PairList &pairs, int threads, bool keep_order) {
  if (dim == dim_ && n == n_ && threads == threads_ && pairs.i == pair_i_ && pairs.j == pair_j_) return;
  const double t0 = now_seconds();
  dim_ = dim;
  n_ = n;
  threads_ = threads;
  has_factor_ = false;
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
  const size_t block = static_cast<size_t>(dim) * dim, unknowns = static_cast<size_t>(n) * dim;
  diag_.resize(block * n);
  off_.resize(block * edges_);
  box_.resize(unknowns);
  for (auto *v : {&column_, &column_solved_, &work_, &residual_, &correction_}) v->resize(unknowns);
  row_work_.resize(pairs.size());
  seconds_assemble += now_seconds() - t0;
}

template <int D>
void NewtonSystem::assemble(const double *a, const double *weight) {
  constexpr int B = D * D;
  std::fill(diag_.begin(), diag_.end(), 0.0);
  std::fill(off_.begin(), off_.end(), 0.0);
  for (size_t k = 0; k < pair_i_.size(); ++k) {
    if (edge_of_pair_[k] < 0) continue;
    double *di = &diag_[static_cast<size_t>(pair_i_[k]) * B], *dj = &diag_[static_cast<size_t>(pair_j_[k]) * B];
    double *e = &off_[static_cast<size_t>(edge_of_pair_[k]) * B];
    const double *row = a + k * D;
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

bool NewtonSystem::factorise(const double *a, const double *weight, const double *box) {
  const double t0 = now_seconds();
  a_ = a;
  weight_ = weight;
  std::copy(box, box + box_.size(), box_.begin());
  switch (dim_) {
    case 2:
      assemble<2>(a, weight);
      break;
    case 3:
      assemble<3>(a, weight);
      break;
    case 4:
      assemble<4>(a, weight);
      break;
    case 5:
      assemble<5>(a, weight);
      break;
    case 6:
      assemble<6>(a, weight);
      break;
    case 7:
      assemble<7>(a, weight);
      break;
    case 8:
      assemble<8>(a, weight);
      break;
    default:
      fail(JAM_E_INTERNAL, "dimension %d in NewtonSystem", dim_);
  }
  const double t1 = now_seconds();
  seconds_assemble += t1 - t0;
  const int replaced = cholesky_.factorise(diag_.data(), off_.data());
  ++factorisations;
  const double t2 = now_seconds();
  seconds_factor += t2 - t1;
  has_factor_ = replaced >= 0;
  if (!has_factor_) return false;
  transpose_times(a, weight, column_.data());
  delta_ = 0.0;
  for (size_t k = 0; k < pair_i_.size(); ++k) delta_ += weight[k];
  column_solved_ = column_;
  cholesky_.solve(column_solved_.data());
  schur_ = delta_ - dot(column_, column_solved_.data());
  // In exact arithmetic schur > 0; what rounding leaves below eps * delta says nothing.
  if (!(schur_ > 1e-14 * delta_)) schur_ = 1e-14 * delta_;
  seconds_solve += now_seconds() - t2;
  return std::isfinite(schur_);
}

void NewtonSystem::solve_once(const double *rhs, double h, double *ds, double *dg) {
  std::copy(rhs, rhs + column_.size(), ds);
  cholesky_.solve(ds);
  *dg = (h + dot(column_, ds)) / schur_;
  for (size_t k = 0; k < column_.size(); ++k) ds[k] += *dg * column_solved_[k];
}

void NewtonSystem::solve(const double *rhs, double h, double *ds, double *dg, int refine) {
  const double t0 = now_seconds();
  solve_once(rhs, h, ds, dg);
  for (int step = 0; step < refine; ++step) {
    rows_times(a_, ds, row_work_.data());
    double rest = h;
    for (size_t k = 0; k < row_work_.size(); ++k) {
      row_work_[k] = weight_[k] * (row_work_[k] - *dg);
      rest += row_work_[k];
    }
    transpose_times(a_, row_work_.data(), work_.data());
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

int NewtonSystem::solves_worth() const {
  // A solve passes twice over the factor: for each of its numbers the processor does some 60 operations of a front.
  return static_cast<int>(cholesky_.flops() / (60.0 * static_cast<double>(cholesky_.factor_nonzeros()) + 1.0));
}

void NewtonSystem::follow(const double *a, const double *weight, const double *box) {
  a_ = a;
  weight_ = weight;
  std::copy(box, box + box_.size(), box_.begin());
  for (auto *v : {&now_column_, &way_, &image_}) v->resize(column_.size());
  transpose_times(a, weight, now_column_.data());
  now_delta_ = std::accumulate(weight, weight + pair_i_.size(), 0.0);
  energy_ = 0.0;
  pcg_solves = 0;
}

// The matrix that is left when dg is eliminated: A^T D A + diag(box) - q q^T / delta.
void NewtonSystem::times(const double *s, double *out) {
  rows_times(a_, s, row_work_.data());
  const double g = dot(now_column_, s) / now_delta_;
  for (size_t k = 0; k < row_work_.size(); ++k) row_work_[k] = weight_[k] * (row_work_[k] - g);
  transpose_times(a_, row_work_.data(), out);
  for (size_t k = 0; k < box_.size(); ++k) out[k] += box_[k] * s[k];
}

// The energy of the error after a step is what later steps gain (Strakos and Tichy, Electron. Trans. Numer. Anal. 13,
// 56 (2002)): below the bound when the last three gained no more. The preconditioned residual alone would not do, nor
// as a measure of the first solution: a rattler that met its cage since the factorisation makes it a million times too
// large. It must be small, though: then nothing is unseen.
bool NewtonSystem::solve_pcg(const double *rhs, double h, double *ds, double *dg, double accuracy, int most) {
  constexpr int last = 3;
  const double t0 = now_seconds();
  const size_t unknowns = column_.size();
  times(ds, residual_.data());
  for (size_t k = 0; k < unknowns; ++k) residual_[k] = rhs[k] + now_column_[k] * (h / now_delta_) - residual_[k];
  double product = 0.0, gained[last] = {}, energy = 0.0, unused;
  bool done = false;
  for (int step = 0; pcg_solves < most; ++step) {
    solve_once(residual_.data(), 0.0, correction_.data(), &unused);
    ++pcg_solves;
    const double before = product, whole = std::max(energy, energy_);
    product = dot(residual_, correction_.data());
    done = product <= accuracy * (step < last ? accuracy : 1.0) * whole &&
           std::accumulate(gained, gained + last, 0.0) <= accuracy * accuracy * whole;
    if (done || !std::isfinite(product)) break;
    for (size_t k = 0; k < unknowns; ++k) way_[k] = correction_[k] + (step > 0 ? product / before * way_[k] : 0.0);
    times(way_.data(), image_.data());
    const double length = product / dot(image_, way_.data());
    for (size_t k = 0; k < unknowns; ++k) ds[k] += length * way_[k], residual_[k] -= length * image_[k];
    gained[step % last] = length * product;
    energy += length * product;
  }
  if (energy_ == 0.0) energy_ = energy;
  *dg = (h + dot(now_column_, ds)) / now_delta_;
  seconds_solve += now_seconds() - t0;
  return done;
}

void NewtonSystem::rows_times(const double *a, const double *s, double *out) const {
  jam::rows_times(dim_, pair_i_, pair_j_, a, s, out);
}

void NewtonSystem::transpose_times(const double *a, const double *y, double *out) const {
  jam::transpose_times(dim_, n_, pair_i_, pair_j_, a, y, out);
}

}  // namespace jam
