// S(q) in tilted cells: against plain sums, in two bases of one lattice, on a crystal, and in the cube to the bit.
#include <algorithm>
#include <complex>
#include <map>

#include "analysis/structure.hpp"
#include "core/cell_change.hpp"
#include "core/create.hpp"
#include "core/math.hpp"
#include "core/rng.hpp"
#include "test.h"

using namespace jam::inside;

namespace {

Packing points(int dim, size_t n, const std::vector<double> &rows) {
  Packing p;
  p.dim = dim, p.cell = Cell::from_triangle(dim, rows.data());
  Rng rng(7, Stream::analysis_start);
  p.diameter.assign(n, 0.1);
  for (size_t k = 0; k < n * static_cast<size_t>(dim); ++k) p.position.push_back(3.0 * rng.uniform());
  wrap_positions(p);
  return p;
}

const std::vector<double> tilted = {1.3, 0.0, 0.0, 0.4, 0.9, 0.0, -0.3, 0.35, 1.1};

void assert_same(const StructureFactor &a, const StructureFactor &b) {
  assert_int_equal(a.q.size(), b.q.size());
  for (size_t k = 0; k < a.q.size(); ++k) {
    assert_true(std::fabs(a.q[k] - b.q[k]) < 1e-11 * a.q[k]);
    assert_true(std::fabs(a.s[k] - b.s[k]) < 1e-9);
  }
}

// Every vector q = 2 pi (m_1 b_1 + ...) with b_k . a_c = (k == c), b from cross products.
CASE(plain_sum) {
  const Packing p = points(3, 20, tilted);
  const double q_max = 2.5 * 2.0 * M_PI * 0.1;
  const double *a[3] = {p.cell.row(0), p.cell.row(1), p.cell.row(2)};
  std::vector<std::pair<double, double>> expect;
  for (int x = -9; x <= 9; ++x)
    for (int y = -9; y <= 9; ++y)
      for (int z = -9; z <= 9; ++z) {
        double q[3], q2 = 0.0;
        for (int c = 0; c < 3; ++c) {
          const auto cross = [&](int k) {  // of the other two vectors
            const double *u = a[(k + 1) % 3], *v = a[(k + 2) % 3];
            return (u[(c + 1) % 3] * v[(c + 2) % 3] - u[(c + 2) % 3] * v[(c + 1) % 3]) / p.cell.volume();
          };
          q[c] = 2.0 * M_PI * (x * cross(0) + y * cross(1) + z * cross(2));
          q2 += q[c] * q[c];
        }
        if (q2 == 0.0 || std::sqrt(q2) * 0.1 > q_max) continue;
        std::complex<double> rho = 0.0;
        for (size_t i = 0; i < p.n(); ++i)
          rho +=
              std::polar(1.0, q[0] * p.position[3 * i] + q[1] * p.position[3 * i + 1] + q[2] * p.position[3 * i + 2]);
        expect.push_back({std::sqrt(q2) * 0.1, std::norm(rho) / 20.0});
      }
  std::sort(expect.begin(), expect.end());
  const StructureFactor f = structure_factor(p, q_max);
  assert_int_equal(expect.size(), 2 * f.q.size());  // in this cell each length belongs to one pair +-q
  assert_true(f.q.size() > 20);
  for (size_t k = 0; k < f.q.size(); ++k) {
    assert_true(std::fabs(f.q[k] - expect[2 * k].first) < 1e-12);
    assert_true(std::fabs(f.s[k] - expect[2 * k].second) < 1e-10);
  }
  assert_int_equal(structure_factor(p, q_max, true).q.size(), f.q.size());
}

CASE(the_basis_does_not_matter) {
  for (const int dim : {2, 3}) {
    std::vector<double> rows;
    for (int r = 0; r < dim; ++r)
      for (int c = 0; c < dim; ++c) rows.push_back(tilted[3 * r + c]);
    const Packing p = points(dim, 40, rows);
    Packing q = p, turned = p;
    for (int c = 0; c < dim; ++c) rows[(dim - 1) * dim + c] += 5.0 * tilted[c];  // as given, tilt 5 and all
    q.cell = Cell::from_triangle(dim, rows.data());
    wrap_positions(q);
    assert_same(structure_factor(p, 2.0), structure_factor(q, 2.0));
    // A left-over rotation: the first vector is replaced by a longer one, so the reduced cell is another frame.
    std::vector<double> other(rows);
    for (int c = 0; c < dim; ++c) other[c] = tilted[c] + tilted[3 * (dim - 1) + c];
    for (int c = 0; c < dim; ++c) other[(dim - 1) * dim + c] = tilted[3 * (dim - 1) + c];
    turned.velocity.assign(turned.position.size(), 0.0);
    enter_cell(turned, reduce_cell(dim, other.data()));
    assert_same(structure_factor(p, 2.0), structure_factor(turned, 2.0));
  }
}

// In the cube the sums have one order: by the first component, then the second; recurrences as in a product of phases.
CASE(bits_in_the_cube) {
  const double side = 1.7;
  const Packing p = points(2, 30, {side, 0.0, 0.0, side});
  const double step = 2.0 * M_PI / side;
  const int most = 4;
  std::vector<double> sum(2 * most * most + 1, 0.0);
  std::vector<int> count(sum.size(), 0);
  for (int x = 0; x <= most; ++x)
    for (int y = x > 0 ? -most : 1; y <= most; ++y) {
      double re = 0.0, im = 0.0;
      for (size_t i = 0; i < p.n(); ++i) {
        const double a = step * x * p.position[2 * i], b = step * y * p.position[2 * i + 1];
        re += math::cos(a) * math::cos(b) - math::sin(a) * math::sin(b);
        im += math::cos(a) * math::sin(b) + math::sin(a) * math::cos(b);
      }
      sum[x * x + y * y] += (re * re + im * im) / 30.0;
      ++count[x * x + y * y];
    }
  const StructureFactor f = structure_factor(p, 4.01 * step * 0.1);
  size_t k = 0;
  for (int n2 = 1; n2 <= most * most; ++n2) {
    if (count[n2] == 0) continue;
    assert_true(f.q[k] == step * std::sqrt(static_cast<double>(n2)) * diameter_mean(p));
    assert_true(f.s[k++] == sum[n2] / count[n2]);
  }
  assert_int_equal(k, f.q.size());
}

// The sums on a grid against plain ones, for one axis to three; points lie on both sides of the cell's ends.
CASE(grid_sums_are_plain_sums) {
  for (const FourierSums::Bounds &most : {FourierSums::Bounds{9, 4, 6}, {30, 11, 0}, {17, 0, 0}, {1, 1, 1}}) {
    const size_t axes = most[1] == 0 ? 1 : most[2] == 0 ? 2 : 3, points = 50;
    Rng rng(3, Stream::analysis_start);
    std::vector<double> s;
    for (size_t k = 0; k < points * axes; ++k) s.push_back(2.5 * rng.uniform() - 0.75);
    const FourierSums sums(s, axes, most);
    for (int x = 0; x <= most[0]; ++x)
      for (int y = -most[1]; y <= most[1]; ++y)
        for (int z = -most[2]; z <= most[2]; ++z) {
          const int m[3] = {x, y, z};
          std::complex<double> plain = 0.0;
          for (size_t i = 0; i < points; ++i) {
            double turns = 0.0;
            for (size_t c = 0; c < axes; ++c) turns += m[c] * s[i * axes + c];
            plain += std::polar(1.0, 2.0 * M_PI * turns);
          }
          assert_true(std::abs(sums.at(m) - plain) < 1e-11 * points);
        }
  }
}

// Enough products that a grid is used: shells of the first lengths against plain sums, and one axis between walls.
CASE(many_spheres_by_a_grid) {
  for (const int32_t walls : {0, 2}) {
    jam_create_options o = default_create_options();
    o.n = walls ? 30000 : 4000, o.dim = 2, o.packing_fraction = 0.2, o.walls = walls;
    const Packing p = make_packing(o, nullptr, 0, nullptr, 0);
    const double unit = diameter_mean(p), step = 2.0 * M_PI * unit / p.cell.side();
    const StructureFactor f = structure_factor(p, (walls ? 6000.0 : 170.0) * step);
    const int last = walls ? 20 : 5;
    std::map<int, std::pair<double, int>> shell;
    for (int x = -last; x <= last; ++x)
      for (int y = walls ? 0 : -last; y <= (walls ? 0 : last); ++y) {
        const int n2 = x * x + y * y;
        if (n2 == 0 || n2 > last * last) continue;
        std::complex<double> rho = 0.0;
        for (size_t i = 0; i < p.n(); ++i)
          rho += std::polar(1.0, 2.0 * M_PI * (x * p.position[2 * i] + y * p.position[2 * i + 1]) / p.cell.side());
        shell[n2].first += std::norm(rho) / static_cast<double>(p.n()), ++shell[n2].second;
      }
    size_t at = 0;
    for (const auto &[n2, sum] : shell) {
      assert_true(std::fabs(f.q[at] - step * std::sqrt(n2)) < 1e-12 * f.q[at]);
      assert_true(std::fabs(f.s[at] - sum.first / sum.second) < 1e-9);
      ++at;
    }
  }
}

}  // namespace
