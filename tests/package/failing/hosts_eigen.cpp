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
  jam_modes_options o = jam::modes_options();
  o.count = 5;
  const std::vector<double> table = disks.modes(o).table;
  std::printf("%.4f\n", mine.squaredNorm());
  return table.size() == 5 * JAM_MODE_COLUMNS && table[0] > 0.0 ? 0 : 1;
}
