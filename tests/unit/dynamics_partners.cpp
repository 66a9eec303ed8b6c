// The Mari-Kurchan model in the engine: the search for partners against all images of all pairs, and no overlaps.
#include <algorithm>

#include "core/limits.hpp"
#include "dynamics/event_driven/mari_kurchan.hpp"
#include "naive_dynamics.hpp"

using namespace jam::inside;
using namespace jamtest;

namespace {

const double no_shift = 0.0, weak = 0.3, strong = 7.3, strongest = limits::mk_zeta_max,
             uniform = std::numeric_limits<double>::infinity();

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
  const Units<Offsets::listed> units(p.cell);
  const Lattice<D> lattice(p.cell, units.scale);
  PartnerTable<D> table(shifts, lattice, n);
  std::vector<int32_t> found, first;
  std::vector<double> rho(n);
  for (int i = 0; i < n; ++i) {
    std::array<uint64_t, D> place;
    for (int c = 0; c < D; ++c)
      place[c] = static_cast<uint64_t>(std::llrint(p.position[i * D + c] / p.cell.side() * units.scale));
    rho[i] = 0.05 + 0.1 * (i % 3);
    table.set(i, place, rho[i]);
  }
  for (int i = 0; i < n; ++i)
    for (InstructionSet set : {InstructionSet::portable, InstructionSet::avx2, InstructionSet::avx512}) {
      if (!has_instruction_set(set)) continue;
      found.resize(n);
      found.resize(pair_kernel<D>(set).partners(table.spheres(), i, found.data()));
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
CASE(every_partner_is_found) {
  const std::vector<double> cube, oblique = {1.0, 0.0, 0.45, 0.8}, brick = {1, 0, 0, 0, 1, 0, 0, 0, 6},
                                  monoclinic = {1.0, 0.0, 0.0, 0.0, 1.2, 0.0, 0.35, 0.0, 0.9};
  for (double zeta : {no_shift, weak, strong, strongest, uniform}) {
    for (int n : {1, 2, 7, 8, 9, 150}) check_search<3>(n, zeta, cube);
    check_search<2>(150, zeta, cube);
    check_search<4>(150, zeta, cube);
    check_search<5>(150, zeta, cube);
    check_search<6>(60, zeta, cube);
    check_search<7>(60, zeta, cube);
    check_search<8>(60, zeta, cube);
    check_search<2>(150, zeta, oblique);
    check_search<3>(150, zeta, brick);
    check_search<3>(150, zeta, monoclinic);
  }
}

// Two spheres along one height of the cell, where floats and 32 bits have nothing to spare: they touch to 1e-12 (small:
// 1e-6), or in a cube are apart by 1e-5. Small: 5e-10 to 3e-9 of the height, some units of 2^-32.
template <int D>
void check_edge(double zeta, const std::vector<double> &rows, bool small) {
  Packing p = quenched(D, 2, zeta, rows);
  const MkShifts shifts(p);
  const Units<Offsets::listed> units(p.cell);
  const Lattice<D> lattice(p.cell, units.scale);
  double s[D], shift[D];
  shifts.get(0, 1, s);
  p.cell.combine(s, shift);
  Rng rng(5, Stream::rsa_positions);
  for (int k = 0; k < 300; ++k) {
    const double distance = (0.05 + 0.3 * rng.uniform()) * p.cell.height(D - 1) * (small ? 1e-8 : 1.0);
    std::array<uint64_t, D> place[2];
    for (int c = 0; c < D; ++c) {
      const double x = rng.uniform(), y = x + shift[c] + (c == D - 1 ? distance : 0.0);
      place[0][c] = static_cast<uint64_t>(std::llrint(x / p.cell.side() * units.scale));
      place[1][c] = static_cast<uint64_t>(std::llrint(y / p.cell.side() * units.scale));
    }
    for (auto &x : place) lattice.wrap(x);
    for (const bool apart : {false, true}) {
      PartnerTable<D> table(shifts, lattice, 2);
      const double reach = 0.5 * distance / p.cell.side() * (1.0 + (apart ? -1e-5 : small ? 1e-6 : 1e-12));
      for (int i = 0; i < 2; ++i) table.set(i, place[i], reach);
      for (InstructionSet set : {InstructionSet::portable, InstructionSet::avx2, InstructionSet::avx512}) {
        if (!has_instruction_set(set)) continue;
        int32_t found[2];
        for (int i = 0; i < 2; ++i) {
          const int32_t partners = pair_kernel<D>(set).partners(table.spheres(), i, found);
          if (!apart) assert_int_equal(partners, 1);
          if (apart && lattice.cube() && !small) assert_int_equal(partners, 0);
        }
      }
    }
  }
}

CASE(partners_at_the_edge_are_found) {
  for (double zeta : {no_shift, weak, strong, strongest, uniform})
    for (const bool small : {false, true}) {
      check_edge<2>(zeta, {}, small);
      check_edge<3>(zeta, {}, small);
      check_edge<8>(zeta, {}, small);
      check_edge<3>(zeta, {1, 0, 0, 0, 1, 0, 0, 0, 6}, small);
      check_edge<3>(zeta, {1.0, 0.0, 0.0, 0.0, 1.2, 0.0, 0.35, 0.0, 0.9}, small);
    }
}

// Planting has drawn shifts again.
CASE(never_overlaps) {
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
    grows_without_overlap(make_packing(o, nullptr, 0, diameters.data(), diameters.size(), c.rows), c.growth, 1e4);
  }
}

}  // namespace
