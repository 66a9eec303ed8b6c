// See rows.hpp.
#include "radii/rows.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "linalg/block_matrix.hpp"
#include "radii/tuning.hpp"

namespace jam::inside {

RadiiRows::RadiiRows(const Packing &p, const RadiiBounds &bounds, double reach)
    : pairs(find_pairs(p, reach, 1.0)), dim_(p.dim), n_(static_cast<int32_t>(p.n())), cell_(p.cell), bounds_(bounds) {
  for (int32_t i = 0; i < n_; ++i) {
    sphere_.push_back(i), sign_.push_back(1.0);
    if (std::isfinite(bounds.most)) sphere_.push_back(i), sign_.push_back(-1.0);
  }
  for (size_t k = 0; k < pairs.size(); ++k)
    if (pairs.wall(k) && p.container[wall_partner(pairs.j[k])].curved()) round_.push_back(k);
  measure(p);
}

RadiiRows RadiiRows::only(const std::vector<char> &on) const {
  RadiiRows out;
  out.dim_ = dim_, out.n_ = n_, out.cell_ = cell_, out.bounds_ = bounds_;
  for (size_t k = 0; k < linear(); ++k) {
    if (!on[k]) continue;
    if (is_bound(k))
      out.sphere_.push_back(sphere_[k - pairs.size()]), out.sign_.push_back(sign_[k - pairs.size()]);
    else
      out.pairs.append(pairs, k);
  }
  return out;
}

void RadiiRows::enter(const Cell &cell) {
  if (bounds_.strains() == 0) return;
  double whole[JAM_MAX_DIM];
  for (size_t k = 0; k < pairs.offset.size(); k += dim_) {
    cell_.fraction(&pairs.offset[k], whole);
    for (int c = 0; c < dim_; ++c) whole[c] = std::nearbyint(whole[c]);
    cell.combine(whole, &pairs.offset[k]);
  }
  cell_ = cell;
}

void RadiiRows::measure_gaps(const Packing &p, std::vector<double> &out) {
  enter(p.cell);
  double r[JAM_MAX_DIM];
  out.resize(linear() + round_.size());
  for (size_t k = 0; k < pairs.size(); ++k) {
    const double radius = 0.5 * p.diameter[pairs.i[k]];
    out[k] = pairs.wall(k)
                 ? p.container[wall_partner(pairs.j[k])].distance(&p.position[static_cast<size_t>(pairs.i[k]) * dim_]) -
                       radius
                 : std::sqrt(pair_vector(p, pairs, k, r)) - (radius + 0.5 * p.diameter[pairs.j[k]]);
  }
  for (size_t b = 0; b < sphere_.size(); ++b) {
    const double radius = 0.5 * p.diameter[sphere_[b]];
    out[pairs.size() + b] = sign_[b] > 0.0 ? radius - bounds_.least : bounds_.most - radius;
  }
  for (size_t q = 0; q < round_.size(); ++q) {
    const size_t k = round_[q];
    const double *x = &p.position[static_cast<size_t>(pairs.i[k]) * dim_];
    out[linear() + q] = out[k] + 2.0 / p.container[wall_partner(pairs.j[k])].curvature(x);
  }
}

void RadiiRows::measure(const Packing &p) {
  const size_t d = static_cast<size_t>(dim_);
  measure_gaps(p, gap);
  normal.resize(pairs.size() * d), length.resize(pairs.size());
  for (size_t k = 0; k < pairs.size(); ++k) {
    double *n = &normal[k * d];
    length[k] = std::sqrt(pair_vector(p, pairs, k, n));
    if (pairs.wall(k)) {
      p.container[wall_partner(pairs.j[k])].normal(&p.position[static_cast<size_t>(pairs.i[k]) * d], n);
      continue;
    }
    for (size_t c = 0; c < d; ++c) n[c] /= length[k];
  }
  if (bounds_.strains() > 0) strain = strain_rows(bounds_.strain, normal, length);
}

void RadiiRows::times(const std::vector<double> &x, std::vector<double> &out) const {
  const size_t d = static_cast<size_t>(dim_);
  out.assign(linear() + round_.size(), 0.0);
  for (size_t k = 0; k < out.size(); ++k)
    parts(k, [&](int32_t i, double sign, double radial) {
      const double *xi = &x[static_cast<size_t>(i) * (d + 1)];
      double along = 0.0;
      if (sign != 0.0)
        for (size_t c = 0; c < d; ++c) along += normal_of(k)[c] * xi[c];
      out[k] += sign * along + radial * xi[d];
    });
  add_columns_times(strain.data(), bounds_.strains(), pairs.size(), x.data() + spheres() * block(), out.data());
}

void RadiiRows::transpose_times(const std::vector<double> &y, std::vector<double> &out) const {
  const size_t d = static_cast<size_t>(dim_);
  out.assign(unknowns(), 0.0);
  for (size_t k = 0; k < linear() + round_.size(); ++k)
    parts(k, [&](int32_t i, double sign, double radial) {
      double *xi = &out[static_cast<size_t>(i) * (d + 1)];
      if (sign != 0.0)
        for (size_t c = 0; c < d; ++c) xi[c] += y[k] * sign * normal_of(k)[c];
      xi[d] += y[k] * radial;
    });
  columns_transpose_times(strain.data(), bounds_.strains(), pairs.size(), y.data(), out.data() + spheres() * block());
}

void RadiiMatrix::set_graph(const RadiiRows &rows, int threads) {
  std::vector<int32_t> ei, ej;
  edge_.assign(rows.pairs.size(), -1);
  for (size_t k = 0; k < rows.pairs.size(); ++k) {
    const int32_t i = rows.pairs.i[k], j = rows.pairs.j[k];
    if (rows.pairs.wall(k) || rows.pairs.own_image(k)) continue;
    if (ei.empty() || ei.back() != i || ej.back() != j) ei.push_back(i), ej.push_back(j);  // images share a block
    edge_[k] = static_cast<int32_t>(ei.size()) - 1;
  }
  const size_t b = rows.block(), n = rows.spheres();
  block_ = b, spheres_ = n, strains_ = rows.allowed().strains();
  if (ei == ei_ && ej == ej_ && diag_.size() == n * b * b) return;
  ei_ = std::move(ei), ej_ = std::move(ej);
  diag_.resize(n * b * b), off_.resize(ei_.size() * b * b);
  cholesky_.analyse(static_cast<int>(b), static_cast<int32_t>(n), ei_.data(), ej_.data(), ei_.size(), threads);
}

void RadiiMatrix::factorise(const RadiiRows &rows, const std::vector<double> &weight,
                            const std::vector<double> &columns, double ridge, int threads,
                            const std::vector<double> &stiffness, const std::vector<double> &bending) {
  set_graph(rows, threads);
  const size_t b = rows.block(), d = b - 1, bb = b * b;
  std::fill(diag_.begin(), diag_.end(), 0.0);
  std::fill(off_.begin(), off_.end(), 0.0);
  for (size_t k = 0; k < weight.size(); ++k) {
    double row[2][JAM_MAX_DIM + 1];
    int32_t sphere[2];
    int count = 0;
    rows.parts(k, [&](int32_t i, double sign, double radial) {
      for (size_t c = 0; c < d; ++c) row[count][c] = sign == 0.0 ? 0.0 : sign * rows.normal_of(k)[c];
      row[count][d] = radial;
      sphere[count++] = i;
    });
    for (int q = 0; q < count; ++q)
      for (size_t u = 0; u < b; ++u)
        for (size_t v = 0; v < b; ++v)
          diag_[static_cast<size_t>(sphere[q]) * bb + u * b + v] += weight[k] * row[q][u] * row[q][v];
    if (count < 2) continue;
    double *block = &off_[static_cast<size_t>(edge_[k]) * bb];
    for (size_t u = 0; u < b; ++u)
      for (size_t v = 0; v < b; ++v) block[u * b + v] += weight[k] * row[0][u] * row[1][v];
  }
  const size_t n = diag_.size() / bb;
  for (size_t i = 0; i < stiffness.size(); ++i) diag_[i * bb + bb - 1] += stiffness[i];
  for (size_t q = 0; q < bending.size(); ++q) diag_[q / (d * d) * bb + q / d % d * b + q % d] += bending[q];
  double mean = 0.0;
  for (size_t i = 0; i < n; ++i)
    for (size_t u = 0; u < b; ++u) mean += diag_[i * bb + u * b + u];
  mean /= static_cast<double>(n * b);
  if (!columns.empty()) ridge = std::max(ridge, RadiiTuning::bordered_ridge);
  for (size_t i = 0; i < n; ++i)
    for (size_t u = 0; u < b; ++u) diag_[i * bb + u * b + u] += ridge * mean;
  ++factorisations;
  if (cholesky_.factorise(diag_.data(), off_.data()) < 0)
    fail(JAM_E_SOLVER, "the matrix of a step of the radii is not finite");
  border_strains(rows, weight, ridge * mean, stiffness, bending);
  border(columns);
}

// Of the strain e the motion z = (-K^-1 A^T D B e, e), whose rows are what the spheres cannot make up for. The sum over
// rows has no differences of large numbers.
void RadiiMatrix::border_strains(const RadiiRows &rows, const std::vector<double> &weight, double ridge,
                                 const std::vector<double> &stiffness, const std::vector<double> &bending) {
  moved_.assign(strains_, std::vector<double>(rows.unknowns()));
  if (strains_ == 0) return;
  const size_t b = block_, d = b - 1;
  std::vector<std::vector<double>> opened(strains_);
  for (size_t e = 0; e < strains_; ++e) {
    std::vector<double> &z = moved_[e], along(weight.size());
    for (size_t k = 0; k < rows.pairs.size(); ++k) along[k] = -weight[k] * rows.strain[k * strains_ + e];
    rows.transpose_times(along, z);
    cholesky_.solve(z.data());
    for (size_t q = 0; q < strains_; ++q) z[spheres_ * b + q] = q == e ? 1.0 : 0.0;
    rows.times(z, opened[e]);
  }
  std::vector<double> form(strains_ * strains_);
  for (size_t e = 0; e < strains_; ++e)
    for (size_t f = 0; f <= e; ++f) {
      double sum = 0.0;
      for (size_t k = 0; k < weight.size(); ++k) sum += weight[k] * opened[e][k] * opened[f][k];
      for (size_t q = 0; q < moved_[e].size(); ++q) sum += ridge * moved_[e][q] * moved_[f][q];
      for (size_t i = 0; i < stiffness.size(); ++i) sum += stiffness[i] * moved_[e][i * b + d] * moved_[f][i * b + d];
      for (size_t q = 0; q < bending.size(); ++q)
        sum += bending[q] * moved_[e][q / (d * d) * b + q / d % d] * moved_[f][q / (d * d) * b + q % d];
      form[e * strains_ + f] = sum;
    }
  strained_.factorise(strains_, form);
}

void RadiiMatrix::solve_rows(std::vector<double> &x) const {
  std::vector<double> part(strains_);
  for (size_t e = 0; e < strains_; ++e)
    for (size_t q = 0; q < x.size(); ++q) part[e] += moved_[e][q] * x[q];
  if (strains_ > 0) strained_.solve(part);
  cholesky_.solve(x.data());
  std::fill(x.begin() + static_cast<std::ptrdiff_t>(spheres_ * block_), x.end(), 0.0);
  for (size_t e = 0; e < strains_; ++e)
    for (size_t q = 0; q < x.size(); ++q) x[q] += part[e] * moved_[e][q];
}

std::vector<double> RadiiMatrix::along_columns(const std::vector<double> &x) const {
  std::vector<double> out(equations_);
  for (size_t q = 0; q < equations_; ++q)
    for (size_t i = 0; i < spheres_; ++i) out[q] += (*columns_)[q * spheres_ + i] * x[i * block_ + block_ - 1];
  return out;
}

void RadiiMatrix::border(const std::vector<double> &columns) {
  const size_t n = spheres_, unknowns = n * block_ + strains_;
  columns_ = &columns, equations_ = columns.size() / n;
  if (equations_ == 0) return;
  solved_.assign(equations_ * unknowns, 0.0);
  std::vector<double> schur(equations_ * equations_);
  for (size_t q = 0; q < equations_; ++q) {
    std::vector<double> x(unknowns);
    for (size_t i = 0; i < n; ++i) x[i * block_ + block_ - 1] = columns[q * n + i];
    solve_rows(x);
    std::copy(x.begin(), x.end(), solved_.begin() + static_cast<std::ptrdiff_t>(q * unknowns));
    const std::vector<double> along = along_columns(x);
    for (size_t k = 0; k < equations_; ++k)
      schur[k * equations_ + q] += 0.5 * along[k], schur[q * equations_ + k] += 0.5 * along[k];
  }
  schur_.factorise(equations_, schur);
}

std::vector<double> RadiiMatrix::solve(std::vector<double> &x, const std::vector<double> &given) const {
  solve_rows(x);
  std::vector<double> out = along_columns(x);
  for (size_t q = 0; q < given.size(); ++q) out[q] -= given[q];
  if (equations_ > 0) schur_.solve(out);
  for (size_t q = 0; q < equations_; ++q)
    for (size_t c = 0; c < x.size(); ++c) x[c] -= out[q] * solved_[q * x.size() + c];
  return out;
}

}  // namespace jam::inside
