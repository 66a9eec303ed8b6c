// Lowest vibrational modes of a packing. What jam.hpp does not wrap is called in C, on get(), with check() around it.
#include <cmath>
#include <cstdio>
#include <vector>

#include <jam/jam.hpp>

int main() try {
  jam::System packing = jam::System::random(128, 3, 1);
  packing.compress();
  packing.crunch();
  jam_modes_options o = jam::options(jam_modes_options_init);
  o.count = 8;
  std::vector<double> table(8 * 2);
  std::size_t m = 0;
  jam::check(jam_modes(packing.get(), nullptr, &o, JAM_MODE_COLUMNS, table.data(), table.size(), nullptr, 0, &m));
  for (std::size_t k = 0; k < m; ++k)
    std::printf("omega %.5f  participation %.4f\n", std::sqrt(std::fmax(table[2 * k + JAM_MODE_LAMBDA], 0)),
                table[2 * k + JAM_MODE_PARTICIPATION]);

  jam_moduli_report moduli = jam::report<jam_moduli_report>();
  jam::check(jam_moduli(packing.get(), nullptr, &moduli));
  std::printf("bulk modulus %.4f, shear modulus %.4f\n", moduli.bulk, moduli.shear);
  return m == 8 ? 0 : 1;
} catch (const std::exception &e) {
  std::fprintf(stderr, "%s\n", e.what());
  return 1;
}
