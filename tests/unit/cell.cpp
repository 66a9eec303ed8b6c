// The periodic cell: wrapping, images and pair lists in tilted cells, against sums over lattice vectors.
#include "core/cell.hpp"

#include <algorithm>
#include <cmath>
#include <vector>
#include "core/cell_change.hpp"
#include "core/cell_reduction.hpp"
#include "core/error.hpp"
#include "core/limits.hpp"
#include "core/pairs.hpp"
#include "core/rng.hpp"
// test.h comes last: it has a macro `fail`.
#include "test.h"

using namespace jam::inside;

namespace {

// Edges near 1, tilts up to half an edge.
Cell tilted(int dim, uint64_t seed) {
  Rng rng(static_cast<int64_t>(seed), Stream::rsa_positions);
  std::vector<double> rows(static_cast<size_t>(dim) * dim, 0.0);
  for (int c = 0; c < dim; ++c) {
    for (int k = 0; k < c; ++k) rows[c * dim + k] = rng.uniform() - 0.5;
    rows[c * dim + c] = 0.8 + 0.4 * rng.uniform();
  }
  return Cell::from_triangle(dim, rows.data());
}

double norm(const double *x, int dim) {
  double r2 = 0.0;
  for (int c = 0; c < dim; ++c) r2 += x[c] * x[c];
  return std::sqrt(r2);
}

// Lengths of all images of dx shorter than the cutoff, from a plain sum over coefficients up to `most`.
std::vector<double> images_by_sum(const Cell &cell, const double *dx, double cutoff, int most) {
  const int d = cell.dim();
  std::vector<double> out;
  std::vector<int> m(d, -most);
  for (;;) {
    Cell::Vector s{}, x{};
    std::copy(m.begin(), m.end(), s.begin());
    cell.combine(s.data(), x.data());
    for (int c = 0; c < d; ++c) x[c] += dx[c];
    if (norm(x.data(), d) < cutoff) out.push_back(norm(x.data(), d));
    int c = 0;
    while (c < d && m[c] == most) m[c++] = -most;
    if (c == d) break;
    ++m[c];
  }
  std::sort(out.begin(), out.end());
  return out;
}

std::vector<double> images_by_cell(const Cell &cell, const double *dx, double cutoff) {
  const int d = cell.dim();
  std::vector<double> out;
  cell.images(dx, cutoff, [&](const double *shift) {
    Cell::Vector x{};
    for (int c = 0; c < d; ++c) x[c] = dx[c] + shift[c];
    out.push_back(norm(x.data(), d));
  });
  std::sort(out.begin(), out.end());
  return out;
}

void assert_close(const std::vector<double> &a, const std::vector<double> &b) {
  assert_int_equal(a.size(), b.size());
  for (size_t k = 0; k < a.size(); ++k) assert_true(std::fabs(a[k] - b[k]) < 1e-12);
}

CASE(images_of_a_vector) {
  Rng rng(3, Stream::rsa_positions);
  for (int dim = 2; dim <= 4; ++dim)
    for (uint64_t seed = 1; seed <= 5; ++seed) {
      const Cell cell = tilted(dim, seed);
      for (int k = 0; k < 10; ++k) {
        Cell::Vector dx{};
        for (int c = 0; c < dim; ++c) dx[c] = 4.0 * rng.uniform() - 2.0;
        const std::vector<double> all = images_by_sum(cell, dx.data(), 1.6, 7);
        assert_true(!all.empty());
        assert_close(images_by_cell(cell, dx.data(), 1.6), all);
        double shortest_edge = cell.edge(0);
        for (int c = 1; c < dim; ++c) shortest_edge = std::min(shortest_edge, cell.edge(c));
        cell.nearest(dx.data());
        if (all.front() < 0.5 * shortest_edge) assert_true(std::fabs(norm(dx.data(), dim) - all.front()) < 1e-12);
      }
    }
}

CASE(wrapping) {
  Rng rng(5, Stream::rsa_positions);
  for (int dim = 2; dim <= JAM_MAX_DIM; ++dim) {
    const Cell cell = tilted(dim, 7);
    Cell::Vector x{}, old{}, shift{}, s{};
    for (int k = 0; k < 50; ++k) {
      for (int c = 0; c < dim; ++c) x[c] = 20.0 * rng.uniform() - 10.0;
      if (k == 0) x[dim - 1] = -1e-20;  // a whole edge more rounds to the edge itself
      old = x;
      cell.wrap(x.data(), shift.data());
      cell.fraction(shift.data(), s.data());
      for (int c = 0; c < dim; ++c) {
        assert_true(x[c] >= 0.0 && x[c] < cell.edge(c));
        assert_true(std::fabs(x[c] + shift[c] - old[c]) < 1e-13);
        assert_true(std::fabs(s[c] - std::nearbyint(s[c])) < 1e-11);
      }
    }
  }
}

CASE(sizes) {
  const double rows[9] = {1, 0, 0, 0.5, std::sqrt(0.75), 0, 0.5, std::sqrt(1.0 / 12.0), std::sqrt(2.0 / 3.0)};
  const Cell fcc = Cell::from_triangle(3, rows);
  assert_false(fcc.cube());
  assert_true(std::fabs(fcc.volume() - std::sqrt(0.5)) < 1e-15);
  assert_true(std::fabs(fcc.side() - std::cbrt(std::sqrt(0.5))) < 1e-15);
  assert_true(std::fabs(fcc.shortest() - 1.0) < 4e-15);
  for (int c = 0; c < 3; ++c) assert_true(std::fabs(fcc.height(c) - std::sqrt(2.0 / 3.0)) < 4e-15);
  const double flat[4] = {1, 0, 0.5, 0.1};  // the shortest vector is a combination of the rows: 2 b - a
  assert_true(std::fabs(Cell::from_triangle(2, flat).shortest() - 0.2) < 1e-15);
  const double cube[4] = {2, 0, 0, 2};
  assert_true(Cell::from_triangle(2, cube).cube());
}

// The same lattice by other vectors, one of them with tilt 5: the same pairs at the same distances.
CASE(pairs_do_not_depend_on_the_basis) {
  for (const int dim : {2, 3}) {
    Packing p;
    p.dim = dim, p.cell = tilted(dim, 11);
    Rng rng(1, Stream::rsa_positions);
    p.diameter.assign(dim == 2 ? 400 : 600, 0.03);
    for (size_t k = 0; k < p.n() * static_cast<size_t>(dim); ++k) p.position.push_back(rng.uniform());
    wrap_positions(p);
    Packing q = p;
    std::vector<double> rows;
    for (int c = 0; c < dim; ++c)
      for (int k = 0; k < dim; ++k) rows.push_back(p.cell.row(c)[k] + (c == dim - 1 ? 5.0 * p.cell.row(0)[k] : 0.0));
    q.cell = Cell::from_triangle(dim, rows.data());
    wrap_positions(q);
    const auto lengths = [](const Packing &a, const PairList &pairs) {
      std::vector<double> r(pairs.size());
      double v[JAM_MAX_DIM];
      for (size_t k = 0; k < r.size(); ++k) r[k] = std::sqrt(pair_vector(a, pairs, k, v));
      std::sort(r.begin(), r.end());
      return r;
    };
    const double reach = dim == 2 ? 0.1 : 0.15;  // several cells of the search along every vector
    const PairList by_cells = find_pairs(p, reach, 0.0), brute = find_pairs_brute(p, reach, 0.0);
    assert_true(by_cells.size() > p.n());
    assert_true(by_cells.i == brute.i && by_cells.j == brute.j);
    assert_close(lengths(p, by_cells), lengths(q, find_pairs(q, reach, 0.0)));
    const PairList wide = find_pairs(p, 1.2, 0.0);  // several images of a pair
    assert_close(lengths(p, wide), lengths(q, find_pairs(q, 1.2, 0.0)));
    std::vector<double> all;  // by sums over lattice vectors, each pair and each image of a sphere with itself once
    for (size_t i = 0; i < 20; ++i)
      for (size_t j = i; j < 20; ++j) {
        Cell::Vector dx{};
        for (int c = 0; c < dim; ++c) dx[c] = p.position[i * dim + c] - p.position[j * dim + c];
        std::vector<double> of = images_by_sum(p.cell, dx.data(), 1.2, 5);
        if (i == j) {  // without the sphere itself; of each pair +-r one
          std::vector<double> half;
          for (size_t k = 1; k < of.size(); k += 2) half.push_back(of[k]);
          of = half;
        }
        all.insert(all.end(), of.begin(), of.end());
      }
    Packing few = p;
    few.position.resize(20 * static_cast<size_t>(dim)), few.diameter.resize(20);
    std::sort(all.begin(), all.end());
    assert_close(lengths(few, find_pairs(few, 1.2, 0.0)), all);
  }
}

// Rows mixed by whole multiples of each other are another basis of the same lattice, in every dimension. Reduction
// gives the rows T times those given, turned by Q; the volume and the shortest vector are those of the lattice.
CASE(reduction_of_long_vectors) {
  for (int d = 2; d <= JAM_MAX_DIM; ++d)
    for (uint64_t seed = 1; seed <= 4; ++seed) {
      const Cell cell = tilted(d, seed);
      Rng rng(static_cast<int64_t>(100 + seed), Stream::rsa_positions);
      std::vector<double> rows;
      for (int c = 0; c < d; ++c) rows.insert(rows.end(), cell.row(c), cell.row(c) + d);
      for (int round = 0; round < 2 * d; ++round) {
        const int to = static_cast<int>(rng.uniform() * d),
                  from = (to + 1 + static_cast<int>(rng.uniform() * (d - 1))) % d;
        const double times = std::floor(7.0 * rng.uniform()) - 3.0;
        for (int k = 0; k < d; ++k) rows[to * d + k] += times * rows[from * d + k];
      }
      const NormalCell reduced = reduce_cell(d, rows.data());
      assert_true(std::fabs(reduced.cell.volume() / cell.volume() - 1.0) < 1e-11);
      assert_true(std::fabs(reduced.cell.shortest() / cell.shortest() - 1.0) < 1e-9);
      double longest = 0.0;
      for (const double x : rows) longest = std::max(longest, std::fabs(x));
      for (int c = 0; c < d; ++c) {
        // No pair of short vectors gets shorter by one step of the other.
        for (int k = 0; k < c; ++k) assert_true(std::fabs(reduced.cell.row(c)[k]) <= 0.5 * reduced.cell.edge(k) + 1e-9);
        // Lovasz' condition: the next vector is not much shorter where the one before is taken out of both.
        if (c > 0) {
          const double *row = reduced.cell.row(c), before = reduced.cell.edge(c - 1);
          assert_true(row[c] * row[c] + row[c - 1] * row[c - 1] >= 0.7 * before * before * (1.0 - 1e-9));
        }
        std::vector<double> wanted(d, 0.0), got(d, 0.0);
        for (int k = 0; k < d; ++k)
          for (int b = 0; b < d; ++b) wanted[b] += static_cast<double>(reduced.transform[c * d + k]) * rows[k * d + b];
        for (int a = 0; a < d; ++a)
          for (int b = 0; b < d; ++b) got[a] += (reduced.rotated ? reduced.rotation[a * d + b] : a == b) * wanted[b];
        for (int a = 0; a < d; ++a) assert_true(std::fabs(got[a] - reduced.cell.row(c)[a]) < 1e-11 * longest);
      }
    }
}

// Faces just above the limit are taken, just below it they are refused.
CASE(flat_cells) {
  for (int d = 2; d <= JAM_MAX_DIM; ++d)
    for (const double part : {1.001, 0.999}) {
      const double height = part * limits::cell_height_min;  // over V^(1/d): the other edges have the rest
      std::vector<double> rows(static_cast<size_t>(d) * d, 0.0);
      rows[0] = height;
      for (int c = 1; c < d; ++c) rows[c * d + c] = std::pow(1.0 / height, 1.0 / (d - 1));
      try {
        assert_true(std::fabs(reduce_cell(d, rows.data()).cell.height_min() - height) < 1e-12 && part > 1.0);
      } catch (const Error &error) {
        assert_true(error.code() == JAM_E_ARGUMENT && part < 1.0);
      }
    }
}

// Proofs square the entries of a cell: what strains leave of a zero becomes zero, all else stays to the last bit.
CASE(strains_leave_no_tiny_entry) {
  const std::vector<double> rows{3.0, 0.0, 0.0, -4.8e-74, 2.0, 0.0, 1e-41, -0.5, 4.0};
  Packing p;
  p.dim = 3;
  take_strained_cell(p, rows);
  const Cell cell = p.cell;
  for (int c = 0; c < 3; ++c)
    for (int k = 0; k < 3; ++k) assert_true(cell.row(c)[k] == (c == 1 && k == 0 ? 0.0 : rows[c * 3 + k]));
  p.dim = 2;
  take_strained_cell(p, {1.0, 0.0, 1e-61, 1.0});
  assert_true(p.cell.cube());
}

}  // namespace
