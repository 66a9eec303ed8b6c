// Contact networks with known answers: Bravais lattices, and pairs by hand.
#pragma once
#include <algorithm>
#include <cmath>
#include <vector>
#include "network/contact_network.hpp"
#include "network/rigidity_matrix.hpp"

namespace jamtest {

struct Case {
  jam::inside::Packing packing;
  jam::inside::ContactNetwork network;
};

inline void add_contact(Case &c, int i, int j, const std::vector<double> &offset, double force = 1.0) {
  c.network.pairs.i.push_back(i);
  c.network.pairs.j.push_back(j);
  c.network.pairs.offset.insert(c.network.pairs.offset.end(), offset.begin(), offset.end());
  std::vector<double> r(c.packing.dim);
  const size_t k = c.network.size() - 1;
  const double length = std::sqrt(jam::inside::pair_vector(c.packing, c.network.pairs, k, r.data()));
  for (double x : r) c.network.vector.push_back(x / length);
  c.network.gap.push_back(length / (0.5 * (c.packing.diameter[i] + c.packing.diameter[j])) - 1.0);
  c.network.force.push_back(force);
  if (c.network.coordination.size() < c.packing.n()) c.network.coordination.assign(c.packing.n(), 0);
  ++c.network.coordination[i];
  ++c.network.coordination[j];
}

using Vectors = std::vector<std::vector<double>>;

// cells^d sites of the Bravais lattice of `basis` (unit nearest-neighbour distance), periodic along the basis, and the
// contacts along `bonds` (integer combinations of the basis, one of each +- pair).
inline Case lattice(const Vectors &basis, const std::vector<std::vector<int>> &bonds, int cells) {
  const int d = static_cast<int>(basis.size());
  Case c;
  c.packing.set_cube(d, cells);
  int n = 1;
  for (int k = 0; k < d; ++k) n *= cells;
  c.packing.diameter.assign(n, 1.0);
  auto digits = [&](int s) {
    std::vector<int> q(d);
    for (int k = 0; k < d; ++k, s /= cells) q[k] = s % cells;
    return q;
  };
  for (int s = 0; s < n; ++s) {
    const std::vector<int> q = digits(s);
    for (int x = 0; x < d; ++x) {
      double v = 0.0;
      for (int k = 0; k < d; ++k) v += q[k] * basis[k][x];
      c.packing.position.push_back(v);
    }
  }
  c.network.coordination.assign(n, 0);
  for (int s = 0; s < n; ++s)
    for (const auto &bond : bonds) {
      std::vector<int> q = digits(s);
      std::vector<double> offset(d, 0.0);
      int t = 0, stride = 1;
      for (int k = 0; k < d; ++k, stride *= cells) {
        int to = q[k] + bond[k];
        const int turn = static_cast<int>(std::floor(static_cast<double>(to) / cells));
        to -= turn * cells;
        t += to * stride;
        // site s - image of site t: position_s - (position_t + turn * cells * basis)
        for (int x = 0; x < d; ++x) offset[x] -= turn * cells * basis[k][x];
      }
      if (s <= t) {
        add_contact(c, s, t, offset);
      } else {
        for (double &x : offset) x = -x;
        add_contact(c, t, s, offset);
      }
    }
  return c;
}

inline Vectors triangular_basis() { return {{1.0, 0.0}, {0.5, std::sqrt(0.75)}}; }
inline std::vector<std::vector<int>> triangular_bonds() { return {{1, 0}, {0, 1}, {-1, 1}}; }
inline Vectors fcc_basis() {
  const double h = std::sqrt(0.5);
  return {{0, h, h}, {h, 0, h}, {h, h, 0}};
}
inline std::vector<std::vector<int>> fcc_bonds() {
  return {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, -1, 0}, {0, 1, -1}, {1, 0, -1}};
}
inline Vectors square_basis() { return {{1.0, 0.0}, {0.0, 1.0}}; }
inline std::vector<std::vector<int>> square_bonds() { return {{1, 0}, {0, 1}}; }

// Eigenvalues of a symmetric 2x2 or 3x3 matrix by Jacobi rotations.
inline std::vector<double> small_eigenvalues(std::vector<double> a, int d) {
  for (int sweep = 0; sweep < 60; ++sweep)
    for (int p = 0; p < d; ++p)
      for (int q = p + 1; q < d; ++q) {
        if (std::fabs(a[p * d + q]) < 1e-300) continue;
        const double theta = 0.5 * std::atan2(2.0 * a[p * d + q], a[q * d + q] - a[p * d + p]), co = std::cos(theta),
                     si = std::sin(theta);
        for (int k = 0; k < d; ++k) {
          const double x = a[k * d + p], y = a[k * d + q];
          a[k * d + p] = co * x - si * y;
          a[k * d + q] = si * x + co * y;
        }
        for (int k = 0; k < d; ++k) {
          const double x = a[p * d + k], y = a[q * d + k];
          a[p * d + k] = co * x - si * y;
          a[q * d + k] = si * x + co * y;
        }
      }
  std::vector<double> e(d);
  for (int k = 0; k < d; ++k) e[k] = a[k * d + k];
  return e;
}

// Bloch: for wave number m (phases 2 pi m_k / cells) the dynamical matrix is sum over bonds of 2 (1 - cos) of the block
// k n n^T - t (1 - n n^T); all eigenvalues, sorted.
inline std::vector<double> bloch_spectrum(const Vectors &basis, const std::vector<std::vector<int>> &bonds, int cells,
                                          double t = 0.0) {
  const int d = static_cast<int>(basis.size());
  int n = 1;
  for (int k = 0; k < d; ++k) n *= cells;
  std::vector<double> all;
  for (int s = 0; s < n; ++s) {
    std::vector<double> m(d * d, 0.0);
    for (const auto &bond : bonds) {
      double phase = 0.0;
      std::vector<double> u(d, 0.0);
      for (int k = 0, q = s; k < d; ++k, q /= cells) {
        phase += 2.0 * M_PI * (q % cells) * bond[k] / cells;
        for (int x = 0; x < d; ++x) u[x] += bond[k] * basis[k][x];
      }
      const double sine = std::sin(0.5 * phase), w = 4.0 * sine * sine;
      for (int r = 0; r < d; ++r)
        for (int c = 0; c < d; ++c) m[r * d + c] += w * ((1.0 + t) * u[r] * u[c] - (r == c ? t : 0.0));
    }
    for (double e : small_eigenvalues(m, d)) all.push_back(e);
  }
  std::sort(all.begin(), all.end());
  return all;
}

// FCC in a cube of `cells` conventional cells, unit diameters at contact: 4 cells^3 spheres.
inline jam::inside::Packing fcc_cube(int cells) {
  const double a = std::sqrt(2.0), site[4][3] = {{0, 0, 0}, {0, 0.5, 0.5}, {0.5, 0, 0.5}, {0.5, 0.5, 0}};
  jam::inside::Packing p;
  p.set_cube(p.dim, cells * a);
  for (int x = 0; x < cells; ++x)
    for (int y = 0; y < cells; ++y)
      for (int z = 0; z < cells; ++z)
        for (const auto &s : site)
          p.position.insert(p.position.end(), {(x + s[0]) * a, (y + s[1]) * a, (z + s[2]) * a});
  p.diameter.assign(4 * static_cast<size_t>(cells * cells * cells), 1.0);
  return p;
}

}  // namespace jamtest
