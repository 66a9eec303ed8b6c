// Tables of a packing in d = 2 for any plotting program: disks.csv (x, y, diameter, contacts) and forces.csv (two ends,
// force).
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <vector>

#include <jam/jam.hpp>

int main() try {
  std::vector<double> sizes(200, 1.0);
  std::fill(sizes.begin() + 100, sizes.end(), 1.4);
  jam::System packing = jam::System::random(200, 2, 1, 0.3, sizes);
  packing.crunch();

  const jam::View x = packing.positions(), sigma = packing.diameters();
  const std::vector<std::int32_t> contacts = packing.coordination();
  std::ofstream disks("disks.csv");
  disks.precision(17);
  disks << "x,y,diameter,contacts\n";
  for (std::size_t i = 0; i < x.rows(); ++i)
    disks << x(i, 0) << ',' << x(i, 1) << ',' << sigma(i, 0) << ',' << contacts[i] << '\n';

  const std::vector<std::int32_t> pair = packing.contacts();
  const std::vector<double> n = packing.contact_vectors(), force = packing.forces();
  std::ofstream lines("forces.csv");
  lines.precision(17);
  lines << "x1,y1,x2,y2,force\n";
  for (std::size_t k = 0; k < force.size(); ++k) {
    const auto i = static_cast<std::size_t>(pair[2 * k]), j = static_cast<std::size_t>(pair[2 * k + 1]);
    const double r = 0.5 * (sigma(i, 0) + sigma(j, 0));  // the second end may lie outside of the periodic box
    lines << x(i, 0) << ',' << x(i, 1) << ',' << x(i, 0) - r * n[2 * k] << ',' << x(i, 1) - r * n[2 * k + 1] << ','
          << force[k] << '\n';
  }
  std::printf("%zu disks, %zu forces\n", x.rows(), force.size());
  return disks && lines ? 0 : 1;
} catch (const std::exception &e) {
  std::fprintf(stderr, "%s\n", e.what());
  return 1;
}
