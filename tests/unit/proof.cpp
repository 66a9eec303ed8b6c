// Parts of a proof against slow exact oracles: sums without rounding, the size of a factor, the bound of the smallest
// singular value, and what a proof may not say.

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <random>

#include "linalg/block_cholesky.hpp"
#include "lp/packing_lp.hpp"
#include "proof/expansion.hpp"
#include "proof/newton.hpp"
// test.h comes last: it has a macro `fail`.
#include "test.h"

using namespace jam::inside;

namespace {

// A triangular lattice of columns x rows disks, each touching six others, less the disks in `gone`.
struct Lattice {
  Packing packing;
  ContactNetwork network;
};
// All pairs that touch, with equal forces.
void list_contacts(Lattice &l) {
  l.network.pairs = find_pairs(l.packing, 0.0, 1.0 + 1e-9);
  measure_contacts(l.packing, l.network);
  l.network.coordination.assign(l.packing.n(), 0);
  l.network.force.assign(l.network.size(), 1.0);
  for (size_t k = 0; k < l.network.size(); ++k)
    ++l.network.coordination[l.network.pairs.i[k]], ++l.network.coordination[l.network.pairs.j[k]];
}
Lattice triangular(int columns, int rows, const std::vector<int> &gone = {}) {
  Lattice out;
  Packing &p = out.packing;
  p.dim = 2;
  const double height = std::sqrt(0.75);
  const double cell[4] = {double(columns), 0.0, 0.0, rows * height};
  p.cell = Cell::from_triangle(2, cell);
  for (int r = 0, k = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c, ++k) {
      if (std::find(gone.begin(), gone.end(), k) != gone.end()) continue;
      p.position.push_back(c + 0.5 * (r % 2)), p.position.push_back(r * height);
      p.diameter.push_back(1.0);
    }
  list_contacts(out);
  return out;
}

// A scene whose contacts close in two doubles, and its equations.
struct Refined {
  explicit Refined(const Lattice &l) : s(make_proof_scene(l.packing, l.network, {})) { assert_true(refine(s, e)); }
  ProofScene s;
  ProofEquations e;
};

Eigen::MatrixXd dense_rows(const ProofScene &s, const ProofEquations &e) {
  Eigen::MatrixXd r = Eigen::MatrixXd::Zero(s.contacts(), s.unknowns());
  for (size_t c = 0; c < s.contacts(); ++c)
    for (int k = 0; k < s.dim; ++k) {
      r(c, s.a[c] * s.dim + k) += e.row[c * s.dim + k];
      r(c, s.b[c] * s.dim + k) -= e.row[c * s.dim + k];
    }
  return r.rightCols(s.unknowns() - s.dim);
}

CASE(sums_are_exact) {
  // Integers of 20 bits times powers of two: an exact oracle is 128-bit integers.
  std::mt19937_64 random(1);
  for (int trial = 0; trial < 2000; ++trial) {
    Expansion sum, other;
    __int128 whole = 0, second = 0;
    for (int k = 0; k < 12; ++k) {
      const auto m = static_cast<int64_t>(random() % 2097151) - 1048575;
      const int shift = static_cast<int>(random() % 40);
      sum.add(std::ldexp(static_cast<double>(m), shift)), whole += static_cast<__int128>(m) * (int64_t{1} << shift);
      if (k < 3) other.add(static_cast<double>(m)), second += m;
    }
    Expansion product;
    product.add_product(sum, other);
    __int128 again = 0, expected = whole * second;
    for (size_t k = 0; k < product.count(); ++k) again += static_cast<__int128>(product.part(k));
    assert_true(again == expected);
    assert_true(std::fabs(product.value() - static_cast<double>(expected)) <=
                2.0 * half_ulp * std::fabs(static_cast<double>(expected)));
  }
}

// One bit in 25 from 2^-1000 to 2^1000: 81 parts that no double joins but where two are so near. Taken out again from
// the middle, nothing may be left.
CASE(sums_of_any_range_are_exact) {
  std::mt19937_64 random(5);
  for (int trial = 0; trial < 200; ++trial) {
    Expansion sum;
    std::vector<double> bits;
    for (int k = -40; k <= 40; ++k) bits.push_back(std::ldexp(random() % 2 ? 1.0 : -1.0, 25 * k));
    std::shuffle(bits.begin(), bits.end(), random);
    for (const double x : bits) sum.add(x);
    std::shuffle(bits.begin(), bits.end(), random);
    for (size_t k = 0; k + 1 < bits.size(); ++k) sum.add(-bits[k]);
    assert_int_equal(sum.count(), 1);
    assert_true(sum.value() == bits.back());
  }
}

CASE(the_size_of_a_factor_is_that_of_a_dense_one) {
  std::mt19937_64 random(2);
  for (const int dim : {2, 3, 5}) {
    BlockMatrix m;
    m.dim = dim, m.nodes = 30;
    const int n = dim * m.nodes;
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n, n);
    for (int i = 0; i < m.nodes; ++i)
      for (int j = i + 1; j < m.nodes; ++j)
        if (random() % 8 == 0) {
          m.ei.push_back(i), m.ej.push_back(j);
          for (int p = 0; p < dim; ++p)
            for (int q = 0; q < dim; ++q) {
              const double x = static_cast<double>(random() % 1000) / 1000.0 - 0.5;
              m.off.push_back(x);
              a(i * dim + p, j * dim + q) = a(j * dim + q, i * dim + p) = x;
            }
        }
    for (int i = 0; i < n; ++i) a(i, i) = 4.0 * n;
    m.diag.assign(static_cast<size_t>(n) * dim, 0.0);
    for (int i = 0; i < n; ++i) m.diag[static_cast<size_t>(i) * dim + i % dim] = 4.0 * n;
    ShiftedFactor factor(m);
    assert_true(factor.factorise(0.0));
    const ShiftedFactor::Size size = factor.size();
    // |L| |L^T| has the diagonal of A, and with so heavy a one its rows exceed it by less than the rest of A.
    assert_true(size.longest_row >= 1 && size.longest_row <= static_cast<size_t>(n));
    assert_true(size.absolute_square >= a.diagonal().maxCoeff() * (1.0 - 1e-12));
    const Eigen::MatrixXd l = Eigen::LLT<Eigen::MatrixXd>(a).matrixL();
    const double dense = (l.cwiseAbs() * l.transpose().cwiseAbs()).rowwise().sum().maxCoeff();
    // Another elimination order has other fill; both stay near the diagonal.
    assert_true(std::fabs(size.absolute_square / dense - 1.0) < 0.1);
  }
}

CASE(the_singular_bound_is_below_the_singular_value) {
  for (const auto &gone : {std::vector<int>{}, std::vector<int>{9}, std::vector<int>{9, 20}}) {
    const Lattice l = triangular(6, 6, gone);
    const ProofScene s = make_proof_scene(l.packing, l.network, {});
    const ProofEquations e = evaluate(s);
    NormalMatrix normal(s, e);
    assert_true(normal.factorise());
    const NormalMatrix::Bound bound = normal.bound();
    const double exact = Eigen::JacobiSVD<Eigen::MatrixXd>(dense_rows(s, e)).singularValues().minCoeff();
    assert_true(bound.singular > 0.5 * exact);           // 0.6 of its square is tried first
    assert_true(bound.singular < exact * (1.0 - 1e-6));  // and never more
  }
}

CASE(wrong_forces_prove_nothing) {
  Refined pulls(triangular(6, 6)), unbalanced(triangular(6, 6));
  pulls.s.force[5] = -pulls.s.force[5];
  const Proof proof = prove(pulls.s, pulls.e);
  assert_false(proof.exact || proof.trapped);
  assert_int_equal(static_cast<int>(proof.cause), static_cast<int>(ProofCause::force));
  unbalanced.s.force[5] *= 2.0;  // positive, but no state of self-stress
  assert_false(prove(unbalanced.s, unbalanced.e).trapped);
}

// A square lattice balances and closes exactly, but its rows shear freely.
CASE(rows_that_shear_prove_nothing) {
  Lattice l;
  Packing &p = l.packing;
  p.set_cube(2, 4.0);
  for (int k = 0; k < 16; ++k) p.position.push_back(k % 4), p.position.push_back(k / 4);
  p.diameter.assign(16, 1.0);
  list_contacts(l);
  ProofScene s = make_proof_scene(p, l.network, {});
  ProofEquations e = evaluate(s);
  for (const double f : e.f) assert_true(f == 0.0);
  const Proof proof = refine(s, e) ? prove(s, e) : Proof();
  assert_false(proof.exact || proof.trapped);
}

// No listed contact is open by more than rounding of two doubles, no force pulls, and no pair overlaps by more.
void check_closed(const ProofScene &s) {
  const ProofEquations e = evaluate(s);
  for (size_t c = 0; c < s.contacts(); ++c) assert_true(std::fabs(e.f[c]) < 1e-26 && s.force[c] > 0.0);
  for (const NearPair &pair : near_pairs(s)) assert_true(pair.opening > -1e-26);
}

// Linear programs and exchanges of contacts find the same Gamma, whether a disk is too small by 1e-14 or too large by
// 1e-12, and a rattler that overlaps comes free.
CASE(linear_programs_close_the_same_contacts) {
  Lattice large = triangular(40, 40);  // 4800 pairs
  ProofScene refused = make_proof_scene(large.packing, large.network, {});
  assert_true(close_by_lps(refused) == (clp_is_built() ? LpsEnd::too_many_rows : LpsEnd::without_clp));
  if (!clp_is_built()) return;
  for (const double change : {-1e-14, 1e-12}) {
    Lattice l = triangular(6, 6, {9});
    l.packing.diameter[14] += change;
    ProofScene by_exchange = make_proof_scene(l.packing, l.network, {}), by_lps = by_exchange;
    assert_true(close_together(by_exchange) == Exchange::changed);
    assert_true(close_by_lps(by_lps) == LpsEnd::closed);
    const ProofEquations e = evaluate(by_lps);
    double sum = 0.0;
    for (size_t c = 0; c < by_lps.contacts(); ++c) {
      assert_true(std::fabs(e.f[c]) < 1e-26 && by_lps.force[c] >= 0.0);
      sum += by_lps.force[c];
    }
    assert_true(std::fabs(sum - 1.0) < 1e-6);
    for (const NearPair &pair : near_pairs(by_lps)) assert_true(pair.opening > 0.0);
    const double apart = (by_lps.growth - by_exchange.growth) + (by_lps.growth_low - by_exchange.growth_low);
    // Centres that the first order leaves free may differ by the change, and Gamma by its square.
    assert_true(std::fabs(apart) < change * change + 1e-26);
  }
  Lattice l = triangular(6, 6, {14});
  l.packing.position.push_back(2.25 + 1e-14), l.packing.position.push_back(2.0 * std::sqrt(0.75));
  l.packing.diameter.push_back(0.5), l.network.coordination.push_back(0);
  ProofScene s = make_proof_scene(l.packing, l.network, {});
  const double before = s.gamma();
  assert_true(close_by_lps(s) == LpsEnd::closed);
  for (const NearPair &pair : near_pairs(s)) assert_true(pair.opening > 0.0);
  assert_true(std::fabs(s.gamma() - before) < 1e-14);
}

// A list without three contacts of a disk that is too large: it overlaps there.
CASE(pairs_that_overlap_enter_the_list) {
  Lattice l = triangular(6, 6);
  l.packing.diameter[14] += 1e-14;
  std::vector<char> on(l.network.size(), 1);
  for (size_t c = 0, left = 3; c < on.size(); ++c)
    if (left > 0 && (l.network.pairs.i[c] == 14 || l.network.pairs.j[c] == 14)) on[c] = 0, --left;
  ProofScene s = make_proof_scene(l.packing, subset(l.network, on, 2), {});
  assert_true(finish_exchange(s, close_together(s)) != Settled::unchanged);
  check_closed(s);
  assert_true(s.node[14] >= 0);
}

// A disk in the hole of disk 14 overlaps the disk to its right: a small one by 1e-14, and one that has no more room
// than 1e-15 on all sides by 1e-10.
void check_that_it_moves_out(double diameter, double x) {
  Lattice l = triangular(6, 6, {14});
  Packing &p = l.packing;
  p.position.push_back(x), p.position.push_back(2.0 * std::sqrt(0.75));
  p.diameter.push_back(diameter);
  l.network.coordination.push_back(0);
  ProofScene s = make_proof_scene(p, l.network, {});
  const auto overlap = [&] {
    double most = 0.0;
    for (const NearPair &pair : near_pairs(s))
      if (s.node[pair.i] < 0 || s.node[pair.j] < 0) most = std::max(most, -pair.opening);
    return most;
  };
  assert_true(overlap() > 1e-15);
  assert_true(finish_exchange(s, close_together(s)) != Settled::unchanged);
  assert_true(overlap() == 0.0);
}

CASE(rattlers_move_out_of_overlaps) {
  check_that_it_moves_out(0.5, 2.25 + 1e-14);
  check_that_it_moves_out(1.0 - 2e-15, 2.0 + 1e-10);
}

// A disk between three others has one place where it overlaps nothing, and none where all pairs are open. Two of them
// are nearly on opposite sides: they hold it far less along the line between them than across.
CASE(a_rattler_without_room_touches) {
  Packing p;
  p.dim = 2, p.cell = Cell{2, 8192.0};
  p.position = {4096, 4096, 4096 + 1601, 4096, 4096 - 1599, 4096 + 80, 4096 - 80, 4096 - 1599};
  p.diameter.assign(4, 1601.0);
  ContactNetwork none;
  none.coordination.assign(4, 0);
  for (const double off : {0x1p-30, -0x1p-31}) {
    p.position[0] = 4096 + off, p.position[1] = 4096 - off;
    ProofScene s = make_proof_scene(p, none, {});
    const auto overlap = [&] {
      double most = 0.0;
      for (const NearPair &pair : near_pairs(s)) most = std::max(most, -pair.opening / s.gamma());
      return most;
    };
    assert_true(overlap() > 1e-14);
    assert_true(!free_rattler(s, 0, near_pairs(s)));
    assert_true(overlap() < 1e-30);
  }
}

// Two disks with one centre: no direction leads them apart, and nothing is proved. In the hole of disk 14 they are
// rattlers; one more disk on disk 15 has contacts like it, or is a rattler there.
CASE(nothing_is_proved_with_two_at_one_centre) {
  for (int kind = 0; kind < 3; ++kind) {
    Lattice l = triangular(6, 6, kind == 0 ? std::vector<int>{14} : std::vector<int>{});
    Packing &p = l.packing;
    for (int k = kind == 0 ? 0 : 1; k < 2; ++k) {
      p.position.push_back(kind == 0 ? 2.3 : 3.0), p.position.push_back(2.0 * std::sqrt(0.75));
      p.diameter.push_back(1.0 - 0.25 * (kind == 0) * (1 + k)), l.network.coordination.push_back(0);
    }
    if (kind == 2) {
      std::vector<char> on;
      ContactNetwork all = l.network;
      all.pairs = find_pairs(p, 0.0, 1.0 + 1e-9);
      measure_contacts(p, all), all.force.assign(all.size(), 1.0);
      for (size_t k = 0; k < all.size(); ++k) on.push_back(all.gap[k] > -0.5);
      l.network = subset(all, on, 2);
    }
    ProofScene s = make_proof_scene(p, l.network, {});
    ProofEquations e;
    Proof proof;
    find_proof(s, e, proof);
    assert_true(!proof.exact && !proof.trapped);
    ProofScene by_lps = make_proof_scene(p, l.network, {});
    assert_true(close_by_lps(by_lps) == (clp_is_built() ? LpsEnd::no_end : LpsEnd::without_clp));
  }
}

}  // namespace
