// Makes a packing, watches and crunches it, reads forces; then a small ensemble on two threads, one system each.
#include <algorithm>
#include <cstdio>
#include <thread>
#include <vector>

#include <jam/jam.hpp>

namespace {

std::vector<double> two_sizes(std::size_t n) {
  std::vector<double> s(n, 1.0);
  std::fill(s.begin() + static_cast<std::ptrdiff_t>(n / 2), s.end(), 1.4);
  return s;
}

double phi_j(int seed) {
  jam::System packing = jam::System::random(100, 2, seed, 0.3, two_sizes(100));
  return packing.crunch().packing_fraction;
}

}  // namespace

int main() try {
  jam::System packing = jam::System::random(200, 2, 1, 0.3, two_sizes(200));
  jam_compress_options growth = jam::compress_options();
  growth.growth_rate = 1e-2;
  growth.pressure = 1e3;
  const jam_md_report md = packing.compress(growth);
  std::printf("%lld collisions, p = %.3g\n", static_cast<long long>(md.collisions), md.pressure);

  packing.on_progress([](const jam_progress &p) {
    std::printf("  LP %lld, gain %.1e\n", static_cast<long long>(p.steps), p.gain);
    return false;  // true stops
  });
  const jam_report report = packing.crunch();
  std::printf("phi_J = %.9f, %lld contacts, %lld rattlers\n", report.packing_fraction, static_cast<long long>(report.contacts),
              static_cast<long long>(report.rattlers));

  const std::vector<double> force = packing.forces();
  const std::vector<std::int32_t> pairs = packing.contacts();
  const auto k = static_cast<std::size_t>(std::max_element(force.begin(), force.end()) - force.begin());
  const jam::View x = packing.positions();  // no copy
  const auto i = static_cast<std::size_t>(pairs[2 * k]);
  std::printf("strongest force %.4f, on the sphere at (%.4f, %.4f)\n", force[k], x(i, 0), x(i, 1));

  double phi[2];
  std::thread other([&] { phi[1] = phi_j(2); });
  phi[0] = phi_j(1);
  other.join();
  std::printf("two seeds: %.6f and %.6f\n", phi[0], phi[1]);

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
