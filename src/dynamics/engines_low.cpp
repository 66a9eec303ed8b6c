// Engines for d = 2, 3, 4, and the order of spheres in memory.
#include "dynamics/engine_archive.hpp"
#include "dynamics/engine_cells.hpp"
#include "dynamics/engine_events.hpp"
#include "dynamics/engine_lists.hpp"
#include "dynamics/engine_quenched.hpp"
#include "dynamics/engine_time.hpp"

namespace jam {

template class Engine<2, false>;
template class Engine<2, true>;
template class Engine<3, false>;
template class Engine<3, true>;
template class Engine<4, false>;
template class Engine<4, true>;

std::vector<int32_t> curve_order(const Packing &p) {
  const size_t n = p.n(), d = static_cast<size_t>(p.dim);
  const int bits = static_cast<int>(std::min<size_t>(16, 62 / d));
  std::vector<uint64_t> key(n, 0);
  for (size_t i = 0; i < n; ++i)
    for (size_t c = 0; c < d; ++c) {
      const auto x = static_cast<uint64_t>(wrap(p.position[i * d + c] / p.box, 1.0) * static_cast<double>(1u << bits));
      for (int b = 0; b < bits; ++b) key[i] |= (x >> b & 1u) << (static_cast<size_t>(b) * d + c);
    }
  std::vector<int32_t> order(n);
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int32_t a, int32_t b) { return key[a] < key[b]; });
  return order;
}

}  // namespace jam
