// Gaps, classes, structure and correlations against brute force and against the FCC crystal.
#include "analysis/structure.hpp"
#include "analysis_networks.hpp"
#include "core/create.hpp"
#include "core/rng.hpp"
#include "core/shells.hpp"
#include "jam/jam.h"
#include "network/contacts_from_geometry.hpp"
#include "test.h"

using namespace jam::inside;
using namespace jamtest;

namespace {

Packing fluid(int d, int n, double phi) {
  jam_create_options o = default_create_options();
  o.dim = d;
  o.n = n;
  o.packing_fraction = phi;
  return make_packing(o, nullptr, 0, nullptr, 0);
}

CASE(fcc_structure) {
  const Packing p = fcc_cube(4);
  const ContactNetwork net = contacts_from_geometry(p, default_geometry_options()).network;
  const SphereStructure s = sphere_structure(p, net, false);
  for (double x : s.c) assert_true(std::fabs(x) < 1e-12);
  for (double x : s.s) assert_true(std::fabs(x + 6.0) < 1e-12);  // -z/2
  for (double q : bond_order(p, 6, 1.2)) assert_true(std::fabs(q - 0.57452426) < 1e-7);
  for (double q : bond_order(p, 4, 1.2)) assert_true(std::fabs(q - 0.19094065) < 1e-7);
  int peak = 0, all = 0;
  for (double x : contact_dots(p, net, false).dot) peak += std::fabs(x - 0.5) < 1e-9, ++all;
  assert_int_equal(all, 256 * 66);
  assert_int_equal(peak, 256 * 24);
}

CASE(triangular_bond_order) {
  Packing p;  // a hexagon around one disk
  p.set_cube(2, 10.0);
  p.diameter.assign(7, 1.0);
  p.position = {5.0, 5.0};
  for (int k = 0; k < 6; ++k)
    p.position.insert(p.position.end(), {5.0 + std::cos(k * M_PI / 3.0), 5.0 + std::sin(k * M_PI / 3.0)});
  assert_true(std::fabs(bond_order(p, 6, 1.2)[0] - 1.0) < 1e-12);
  assert_true(bond_order(p, 4, 1.2)[0] < 1e-7);
}

CASE(local_fraction_of_fcc) {
#ifdef JAM_HAVE_VORO
  double sum = 0.0;
  for (double phi : local_fractions(fcc_cube(3))) assert_true(std::fabs(phi - M_PI / std::sqrt(18.0)) < 1e-9);
  const Packing p = fluid(3, 300, 0.3);
  const std::vector<double> phi = local_fractions(p);
  for (size_t i = 0; i < p.n(); ++i) sum += unit_sphere_volume(3) * std::pow(p.diameter[i], 3) / phi[i];
  assert_true(std::fabs(sum - 1.0) < 1e-9);  // the cells fill the box
#else
  skip();
#endif
}

CASE(contact_sums_match_their_pairs) {
  // S_i = (|C_i|^2 - z_i) / 2 and, with forces, the same with sum f^2: against the pairs one by one.
  Case c = lattice(triangular_basis(), triangular_bonds(), 5);
  Rng rng(4, Stream::analysis_start);
  for (double &x : c.packing.position) x += 0.1 * rng.normal();
  Case moved;
  moved.packing = c.packing;
  for (size_t k = 0; k < c.network.size(); ++k)
    add_contact(moved, c.network.pairs.i[k], c.network.pairs.j[k],
                {c.network.pairs.offset[2 * k], c.network.pairs.offset[2 * k + 1]}, rng.uniform());
  for (bool weighted : {false, true}) {
    const SphereStructure s = sphere_structure(moved.packing, moved.network, weighted);
    const ContactDots dots = contact_dots(moved.packing, moved.network, weighted);
    const std::vector<size_t> of = count_contact_dots(moved.packing, moved.network, weighted);
    for (size_t i = 0; i < of.size(); ++i)
      assert_int_equal(std::count(dots.sphere.begin(), dots.sphere.end(), static_cast<int32_t>(i)), of[i]);
    std::vector<double> sum(moved.packing.n(), 0.0);
    for (size_t k = 0; k < dots.dot.size(); ++k) sum[dots.sphere[k]] += dots.dot[k];
    for (size_t i = 0; i < sum.size(); ++i) assert_true(std::fabs(sum[i] - s.s[i]) < 1e-12);
    if (!weighted)
      for (size_t i = 0; i < sum.size(); ++i) {
        const double c2 = s.c[2 * i] * s.c[2 * i] + s.c[2 * i + 1] * s.c[2 * i + 1];
        assert_true(std::fabs(0.5 * (c2 - moved.network.coordination[i]) - s.s[i]) < 1e-12);
      }
  }
}

CASE(gaps_by_brute_force) {
  const Packing p = fluid(3, 150, 0.25);
  const Gaps g = find_gaps(p, nullptr, 1.0, false);
  const PairList all = find_pairs_brute(p, 0.0, 2.0);
  std::vector<double> h, r(3);
  for (size_t k = 0; k < all.size(); ++k)
    h.push_back(std::sqrt(pair_vector(p, all, k, r.data())) / p.diameter[0] - 1.0);
  std::sort(h.begin(), h.end());
  assert_int_equal(h.size(), g.gap.size());
  for (size_t k = 0; k < h.size(); ++k) assert_true(std::fabs(h[k] - g.gap[k]) < 1e-12);
  // in the crystal the contacts are left out, image by image: next shell at sqrt 2
  const Packing x = fcc_cube(1);
  const ContactNetwork net = contacts_from_geometry(x, default_geometry_options()).network;
  const Gaps y = find_gaps(x, &net, 0.5, true);
  assert_int_equal(y.gap.size(), 4 * 3);
  for (double v : y.gap) assert_true(std::fabs(v - (std::sqrt(2.0) - 1.0)) < 1e-12);
}

CASE(values_by_class) {
  // A small network: spheres 0, 2 and 3 are bucklers or less, so every number can be counted by hand.
  Case c;
  c.packing.set_cube(2, 1.0);
  c.packing.diameter.assign(6, 1.0);
  c.packing.position = {0, 0, 1, 0, -0.5, 0.8, -0.5, -0.8, 2.0, 0.0, 3.0, 0.0};
  add_contact(c, 0, 1, {0, 0}, 3.0);
  add_contact(c, 0, 2, {0, 0}, 1.0);
  add_contact(c, 0, 3, {0, 0}, 2.0);
  add_contact(c, 1, 4, {0, 0}, 6.0);
  const auto get = [&](int32_t quantity, int32_t which) {
    const std::vector<double> values = local_values(c.packing, c.network, quantity, which);
    assert_int_equal(count_local_values(c.packing, c.network, quantity, which), values.size());
    return values;
  };
  const std::vector<double> local = get(JAM_LOCAL_FORCE, JAM_POPULATION_LOCALISED),
                            extended = get(JAM_LOCAL_FORCE, JAM_POPULATION_EXTENDED);
  assert_int_equal(local.size(), 3);
  assert_true(local[0] == 1.5 && local[1] == 0.5 && local[2] == 1.0);  // over their mean 2
  assert_int_equal(extended.size(), 1);
  assert_true(extended[0] == 1.0);
  const std::vector<int32_t> flags = classify_contacts(c.packing, c.network);
  constexpr int32_t ends = JAM_CONTACT_SMALLEST | JAM_CONTACT_MEDIAN;  // of spheres with one contact or two
  assert_true(flags[0] == (JAM_CONTACT_LOCALISED | ends) && flags[1] == flags[0] && flags[2] == flags[0] &&
              flags[3] == ends);
  assert_int_equal(get(JAM_LOCAL_FORCE, JAM_POPULATION_SMALLEST).size(), 4);
  assert_int_equal(get(JAM_LOCAL_COORDINATION, JAM_POPULATION_ALL).size(), 5);  // sphere 5 touches nothing
  assert_true(get(JAM_LOCAL_COORDINATION, JAM_POPULATION_LOCALISED) == std::vector<double>{3.0});
  assert_true(get(JAM_LOCAL_FORCE_SUM, JAM_POPULATION_ALL) == (std::vector<double>{6.0, 9.0, 1.0, 2.0, 6.0}));
  assert_int_equal(get(JAM_LOCAL_VECTOR_DOT, JAM_POPULATION_LOCALISED).size(), 3);
  assert_int_equal(get(JAM_LOCAL_VECTOR_DOT, JAM_POPULATION_EXTENDED).size(), 1);
  assert_true(std::fabs(get(JAM_LOCAL_FORCE_DOT, JAM_POPULATION_EXTENDED)[0] + 18.0) <
              1e-12);  // straight through sphere 1
  assert_true(std::fabs(get(JAM_LOCAL_VECTOR_PAIRS, JAM_POPULATION_EXTENDED)[0] + 1.0) < 1e-12);
  assert_true(std::fabs(get(JAM_LOCAL_VECTOR_SUM, JAM_POPULATION_EXTENDED)[0]) < 1e-12);
}

CASE(partial_correlations_add_up) {
  const Packing p = fluid(3, 500, 0.2);
  std::vector<int32_t> kind(500);
  for (int i = 0; i < 500; ++i) kind[i] = i < 200;
  const double r_max = 1.4 * p.cell.side() / diameter_mean(p);  // past half the box: several images count
  const auto all = pair_correlation(p, nullptr, 0, -1, -1, r_max, 60),
             aa = pair_correlation(p, kind.data(), 500, 1, 1, r_max, 60),
             ab = pair_correlation(p, kind.data(), 500, 1, 0, r_max, 60),
             bb = pair_correlation(p, kind.data(), 500, 0, 0, r_max, 60);
  for (int k = 0; k < 60; ++k) assert_true(std::fabs(0.16 * aa[k] + 2 * 0.24 * ab[k] + 0.36 * bb[k] - all[k]) < 1e-12);
  double tail = 0.0;
  for (int k = 40; k < 60; ++k) tail += all[k] / 20.0;
  assert_true(std::fabs(tail - 1.0) < 0.02);
}

// Contacts of equal spheres lie at r = 1 but for rounding, which must not divide them where 1 is an edge of bins.
CASE(contacts_lie_in_one_bin) {
  Packing p;
  p.set_cube(2, 10.0);
  p.diameter.assign(6, 1.0);
  p.position = {1.0, 1.0, 2.0 - 4e-15, 1.0, 1.0, 5.0, 2.0, 5.0, 5.0, 8.0, 6.0 + 4e-15, 8.0};
  for (size_t bins : {20, 100, 200, 400}) {
    const std::vector<double> g = pair_correlation(p, nullptr, 0, -1, -1, 4.0, bins);
    const size_t contact = bins / 4;
    assert_true(g[contact - 1] == 0.0);
    const double shell = M_PI * (16.0 / static_cast<double>(bins * bins)) * (2.0 * static_cast<double>(contact) + 1.0);
    assert_true(std::fabs(g[contact] - 6.0 / (6.0 * 0.06 * shell)) < 1e-9 * g[contact]);
  }
}

}  // namespace
