// The Mari-Kurchan model in the engine: the search for partners against all images of all pairs, and no overlaps.
#include <algorithm>

#include "core/pair_rule.hpp"
#include "core/pairs.hpp"
#include "dynamics/engine.hpp"
#include "dynamics/md.hpp"
#include "naive_dynamics.hpp"

using namespace jam;
using namespace jamtest;

namespace {

const double no_shift = 0.0, weak = 0.3, strong = 7.3, uniform = std::numeric_limits<double>::infinity();

Monitor &begun() {
  static Monitor monitor;
  monitor.begin();
  return monitor;
}

Packing quenched(int dim, int n, double zeta, const std::vector<double> &rows) {
  Packing p;
  if (rows.empty())
    p.set_cube(dim, 1.0);
  else
    p.cell = Cell::from_triangle(dim, rows.data()), p.dim = dim;
  p.model = JAM_MODEL_MK;
  p.seed = 11;
  p.mk_zeta = zeta;
  p.diameter.assign(n, 1.0);
  Rng rng(3, Stream::rsa_positions);
  p.position.resize(static_cast<size_t>(n) * dim);
  for (int i = 0; i < n; ++i) {
    double s[JAM_MAX_DIM];
    for (int c = 0; c < dim; ++c) s[c] = rng.uniform();
    p.cell.combine(s, &p.position[static_cast<size_t>(i) * dim]);
  }
  return p;
}

// Whether an image of the pair is within the cutoff.
bool near(const Packing &p, const MkShifts &shifts, int i, int j, double cutoff) {
  double s[JAM_MAX_DIM], r[JAM_MAX_DIM];
  shifts.get(i, j, s);
  p.cell.combine(s, r);
  for (int c = 0; c < p.dim; ++c) r[c] += p.position[i * p.dim + c] - p.position[j * p.dim + c];
  bool any = false;
  p.cell.images(r, cutoff, [&any](const double *) { any = true; });
  return any;
}

template <int D>
void check_search(int n, double zeta, const std::vector<double> &rows) {
  const Packing p = quenched(D, n, zeta, rows);
  const MkShifts shifts(p);
  const Units<true> units(p.cell);
  const Lattice<D> lattice(p.cell, units.scale);
  const size_t stride = (static_cast<size_t>(n) + 7) / 8 * 8;
  std::vector<int32_t> x(stride * D), found(n), first;
  std::vector<float> reach(stride);
  std::vector<double> rho(n);
  for (int i = 0; i < n; ++i) {
    std::array<uint64_t, D> place;
    double s[D];
    for (int c = 0; c < D; ++c)
      place[c] = static_cast<uint64_t>(std::llrint(p.position[i * D + c] / p.cell.side() * units.scale));
    lattice.fraction(place, s);
    for (int c = 0; c < D; ++c)
      x[c * stride + i] = static_cast<int32_t>(static_cast<int64_t>(std::floor(s[c] * 0x1p32)));
    rho[i] = 0.05 + 0.1 * (i % 3);
    reach[i] = static_cast<float>(rho[i] * 0x1p32 * (1.0 + 1e-6)) + 10.0f;
  }
  Partners<D> q{x.data(), reach.data(), stride, {}, lattice.cube(), shifts.key(), zeta, n};
  for (int c = 0; c < D; ++c) q.height[c] = static_cast<float>(lattice.height(c));
  for (int i = 0; i < n; ++i)
    for (InstructionSet set : {InstructionSet::portable, InstructionSet::avx2, InstructionSet::avx512}) {
      if (!has_instruction_set(set)) continue;
      found.resize(n);
      found.resize(pair_kernel<D>(set).partners(q, i, found.data()));
      assert_true(std::is_sorted(found.begin(), found.end()) && !std::binary_search(found.begin(), found.end(), i));
      int true_ones = 0;
      for (int j = 0; j < n; ++j)
        if (j != i && near(p, shifts, i, j, (rho[i] + rho[j]) * p.cell.side())) {
          ++true_ones;
          if (!std::binary_search(found.begin(), found.end(), j))
            print_error("d=%d n=%d zeta=%g: %d misses %d\n", D, n, zeta, i, j);
          assert_true(std::binary_search(found.begin(), found.end(), j));
        }
      // In a cube nothing else is found.
      if (lattice.cube()) assert_int_equal(true_ones, found.size());
      if (set == InstructionSet::portable) first = found;
      assert_true(found == first);
    }
}

// Whole vectors and rests, one sphere alone; shifts of every kind; cells that are no cubes.
void every_partner_is_found(void **) {
  const std::vector<double> cube, oblique = {1.0, 0.0, 0.45, 0.8}, brick = {1, 0, 0, 0, 1, 0, 0, 0, 6},
                                  monoclinic = {1.0, 0.0, 0.0, 0.0, 1.2, 0.0, 0.35, 0.0, 0.9};
  for (double zeta : {no_shift, weak, strong, uniform}) {
    for (int n : {1, 2, 7, 8, 9, 150}) check_search<3>(n, zeta, cube);
    check_search<2>(150, zeta, cube);
    check_search<5>(150, zeta, cube);
    check_search<8>(60, zeta, cube);
    check_search<2>(150, zeta, oblique);
    check_search<3>(150, zeta, brick);
    check_search<3>(150, zeta, monoclinic);
  }
}

// All images of all pairs are looked at when it is over; planting has drawn shifts again.
void never_overlaps(void **) {
  const double monoclinic[9] = {1.0, 0.0, 0.0, 0.0, 1.2, 0.0, 0.35, 0.0, 0.9};
  const struct {
    int dim, n;
    double fraction, ratio, growth, zeta;
    const double *rows;
  } cases[] = {{3, 300, 1.5, 1.0, 0.01, uniform, nullptr},
               {2, 100, 0.8, 1.4, 0.1, uniform, nullptr},
               {3, 100, 0.4, 1.0, 0.1, weak, nullptr},
               {4, 150, 0.5, 1.0, 0.1, strong, nullptr},
               {3, 100, 1.0, 1.2, 0.1, uniform, monoclinic}};
  for (const auto &c : cases) {
    jam_create_options o = default_create_options();
    o.dim = c.dim;
    o.n = c.n;
    o.packing_fraction = c.fraction;
    o.model = JAM_MODEL_MK;
    o.mk_zeta = c.zeta;
    std::vector<double> diameters(c.n, 1.0);
    for (int i = 0; i < c.n; i += 2) diameters[i] = c.ratio;
    Packing p = make_packing(o, nullptr, 0, diameters.data(), diameters.size(), c.rows);
    jam_md_report report{};
    assert_int_equal(run_stage(p, {c.growth, 1e4, never, 1e5, 300.0}, begun(), report), JAM_OK);
    const double gap = closest_pair(p).gap;
    if (!(gap > -1e-14)) print_error("d=%d n=%d zeta=%g: gap %g\n", c.dim, c.n, c.zeta, gap);
    assert_true(gap > -1e-14);
    assert_true(report.max_overlap < 1e-13);
    assert_true(report.pressure >= 1e4);
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(every_partner_is_found),
      cmocka_unit_test(never_overlaps),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
