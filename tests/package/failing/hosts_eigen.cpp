// A program that uses Eigen itself, compiled with -mavx2 -mfma: vectors are aligned to 32 bytes here and to 16 in
// libjam. Spectra calls the constructor below in the modes of 600 disks.
#include <Eigen/Core>
#include <cstdio>
#include <jam/jam.hpp>

int main() {
  const long n = 40;
  const Eigen::VectorXd mine = Eigen::VectorXd(n).setOnes();
  jam::System disks = jam::System::random(600, 2);
  disks.compress();
  disks.crunch();
  jam_modes_options o = jam::options<jam_modes_options>(jam_modes_options_init);
  o.count = 5;
  std::vector<double> table(static_cast<std::size_t>(2 * o.count));
  const jam_status status = jam_modes(disks.get(), nullptr, &o, table.data(), table.size(), nullptr, 0, nullptr);
  std::printf("%.4f\n", mine.squaredNorm());
  return status == JAM_OK && table[0] > 0.0 ? 0 : 1;
}
