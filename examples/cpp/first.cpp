// From nothing to a jammed packing of disks.  Build: c++ -std=c++17 first.cpp $(pkg-config --cflags --libs jam)
#include <algorithm>
#include <cstdio>
#include <vector>

#include <jam/jam.hpp>

int main() try {
  std::vector<double> sizes(200, 1.0);  // two sizes, so that disks do not crystallise; only ratios count
  std::fill(sizes.begin() + 100, sizes.end(), 1.4);
  jam::System packing = jam::System::random(200, 2, 1, 0.3, sizes);

  jam_compress_options growth = jam::compress_options();
  growth.growth_rate = 1e-2;
  growth.pressure = 1e3;
  const jam_md_report md = packing.compress(growth);
  std::printf("%lld collisions, p = %.3g\n", static_cast<long long>(md.collisions), md.pressure);

  const jam_crunch_report report = packing.crunch();
  std::printf("phi_J = %.9f, %lld contacts, %lld rattlers\n", report.packing_fraction,
              static_cast<long long>(report.contacts), static_cast<long long>(report.rattlers));
  packing.write("first_cpp.xyz");

  try {
    jam::System::random(100, 9);
  } catch (const jam::Error &e) {
    std::printf("refused, as it should be: %s\n", e.what());
  }
  return report.jammed ? 0 : 1;
} catch (const std::exception &e) {
  std::fprintf(stderr, "%s\n", e.what());
  return 1;
}
