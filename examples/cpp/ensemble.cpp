// Many seeds on all cores: each thread makes and crunches systems of its own.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <thread>
#include <vector>

#include <jam/jam.hpp>

static double phi_j(int seed) {
  std::vector<double> sizes(128, 1.0);
  std::fill(sizes.begin() + 64, sizes.end(), 1.4);
  jam::System packing = jam::System::random(128, 2, seed, 0.2, sizes);
  jam_compress_options growth = jam::compress_options();
  growth.growth_rate = 3e-2;
  growth.pressure = 1e4;
  packing.compress(growth);
  const jam_crunch_report r = packing.crunch();
  return r.jammed ? r.packing_fraction : 0.0;
}

int main() {
  std::vector<double> phi(8);
  std::atomic<std::size_t> next{0};
  std::vector<std::thread> threads(std::max(1u, std::thread::hardware_concurrency()));
  for (std::thread &t : threads)
    t = std::thread([&] {
      for (std::size_t k; (k = next++) < phi.size();) try {
          phi[k] = phi_j(static_cast<int>(k) + 1);  // the same bits on whichever thread
        } catch (const std::exception &e) {
          std::fprintf(stderr, "seed %zu: %s\n", k + 1, e.what());
        }
    });
  for (std::thread &t : threads) t.join();
  phi.erase(std::remove(phi.begin(), phi.end(), 0.0), phi.end());
  if (phi.size() < 2) return 1;
  double mean = 0, variance = 0;
  const double n = static_cast<double>(phi.size());
  for (const double p : phi) mean += p / n;
  for (const double p : phi) variance += (p - mean) * (p - mean) / (n - 1);
  std::printf("%zu jammed, phi_J = %.5f +- %.5f\n", phi.size(), mean, std::sqrt(variance / n));
}
