#include "core/validate.hpp"

#include "core/create.hpp"
#include "core/error.hpp"
#include "core/limits.hpp"

namespace jam::inside {

void check_packing(const Packing &p, jam_status code) {
  check_dim(p.dim);
  check_box(p.cell.side());
  check_non_additivity(p.non_additivity);
  const size_t n = p.n(), d = static_cast<size_t>(p.dim);
  if (n == 0 || p.position.size() != n * d || p.velocity.size() != n * d)
    fail(code, "%zu diameters, %zu coordinates and %zu velocity components in d = %zu", n, p.position.size(),
         p.velocity.size(), d);
  for (size_t k = 0; k < n * d; ++k)
    if (!(p.position[k] >= 0.0 && (p.position[k] < p.cell.edge(static_cast<int>(k % d)) ||
                                   (p.position[k] == p.cell.edge(static_cast<int>(k % d)) && p.container &&
                                    !p.cell.repeats(static_cast<int>(k % d))))))
      fail(code, "positions[%zu] is %.17g, outside of 0 to %g", k, p.position[k], p.cell.edge(static_cast<int>(k % d)));
  for (size_t i = 0; i < n; ++i)
    if (!(p.diameter[i] > 0.0)) fail(code, "diameters[%zu] is %g, it must be positive", i, p.diameter[i]);
  refuse_wider_than_periods(p, code);
  check_diameters(p.diameter, p.cell);
  check_velocities(p, p.velocity, code);
}

void refuse_wider_than_periods(const Packing &p, jam_status code) {
  const double widest = p.cell.shortest() * (1.0 + overlap_tolerance);
  for (size_t i = 0; i < p.n(); ++i)
    if (!(p.diameter[i] <= widest))
      fail(code, "diameters[%zu] is %g where the shortest period of the cell is %g", i, p.diameter[i],
           p.cell.shortest());
}

}  // namespace jam::inside
