// Reads the contact network of a packing and checks that the forces balance on every sphere.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include <jam/jam.hpp>

int main() try {
  constexpr std::size_t d = 3;
  jam::System packing = jam::System::random(128, d, 1);
  packing.compress();
  packing.crunch();
  const std::vector<double> force = packing.forces(), n = packing.contact_vectors();  // mean 1; (contacts, d)
  const std::vector<std::int32_t> pair = packing.contacts();                          // (contacts, 2)
  std::vector<double> net(128 * d);
  for (std::size_t k = 0; k < force.size(); ++k)
    for (std::size_t c = 0; c < d; ++c) {  // n points from j to i: i is pushed along it, j against it
      net[static_cast<std::size_t>(pair[2 * k]) * d + c] += force[k] * n[k * d + c];
      net[static_cast<std::size_t>(pair[2 * k + 1]) * d + c] -= force[k] * n[k * d + c];
    }
  double worst = 0;
  for (const double f : net) worst = std::max(worst, std::fabs(f));

  const auto k = static_cast<std::size_t>(std::max_element(force.begin(), force.end()) - force.begin());
  const jam::View x = packing.positions();  // no copy
  const auto i = static_cast<std::size_t>(pair[2 * k]);
  std::printf("%zu forces, the strongest %.4f on the sphere at (%.4f, %.4f, %.4f), worst balance %.1e\n", force.size(),
              force[k], x(i, 0), x(i, 1), x(i, 2), worst);
  return worst < 1e-8 ? 0 : 1;
} catch (const std::exception &e) {
  std::fprintf(stderr, "%s\n", e.what());
  return 1;
}
