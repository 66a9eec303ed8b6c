// Lowest vibrational modes of a packing, and its moduli. What jam.hpp does not wrap is called in C, on get(), with
// check() around it.
#include <cmath>
#include <cstdio>
#include <vector>

#include <jam/jam.hpp>

int main() try {
  jam::System packing = jam::System::random(128, 3, 1);
  packing.compress();
  packing.crunch();
  jam_modes_options o = jam::modes_options();
  o.count = 8;
  const std::vector<double> table = packing.modes(o).table;
  const std::size_t m = table.size() / JAM_MODE_COLUMNS;
  for (std::size_t k = 0; k < m; ++k)
    std::printf("omega %.5f  participation %.4f\n",
                std::sqrt(std::fmax(table[JAM_MODE_COLUMNS * k + JAM_MODE_LAMBDA], 0)),
                table[JAM_MODE_COLUMNS * k + JAM_MODE_PARTICIPATION]);

  jam_moduli_report moduli = jam::report<jam_moduli_report>();
  jam::check(jam_moduli(packing.get(), nullptr, &moduli));
  std::printf("bulk modulus %.4f, shear modulus %.4f\n", moduli.bulk, moduli.shear);
  return m == 8 ? 0 : 1;
} catch (const std::exception &e) {
  std::fprintf(stderr, "%s\n", e.what());
  return 1;
}
