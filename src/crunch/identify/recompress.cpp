#include <algorithm>
#include <cmath>

#include "core/motion.hpp"
#include "core/pair_rule.hpp"
#include "core/rng.hpp"
#include "crunch/approach/lp_step.hpp"
#include "crunch/control.hpp"
#include "crunch/phases.hpp"

namespace jam::inside {
namespace {

// A free cell changes its shape too: a lattice of one sphere has nothing else that could leave its saddle. Lengths
// change by less than the share, and the volume stays.
void strain_at_random(Packing &p, Rng &rng, double share) {
  const size_t d = static_cast<size_t>(p.dim);
  std::vector<double> strain(d * d);
  const auto open = [&](size_t c) { return (p.container.closed() >> c & 1) == 0; };
  for (size_t a = 0; a < d; ++a)
    for (size_t b = a; b < d; ++b)
      if (open(a) && open(b)) strain[a * d + b] = (2.0 * rng.uniform() - 1.0) * share / static_cast<double>(d);
  PairList none;
  strain_at_fixed_volume(p, none, strain);
}

}  // namespace

bool recompress(CrunchState &s) {
  const auto &parts = s.tuning.decompression;
  const size_t done = s.history.stage.decompressions;
  if (done >= parts.size() || !(parts[done] > 0.0)) return false;
  ++s.history.stage.decompressions;
  Packing &p = s.out.packing;
  s.monitor.log(JAM_LOG_INFO, "not shown to be jammed at phi %.12f: decompresses by %.0e of the diameters",
                packing_fraction(p), parts[done]);
  // Gaps open by this part of sigma_ij = (1 + Delta) (s_i + s_j) / 2, or of (s_i + s_j) / 2.
  const size_t d = static_cast<size_t>(p.dim);
  const double gap = parts[done] * std::min(1.0, 1.0 + p.non_additivity),
               room = s.tuning.displaced * gap / std::sqrt(static_cast<double>(d));
  Rng rng(p.seed, Stream::recompression, static_cast<uint64_t>(done) << 40);
  for (size_t k = 0; k < p.position.size(); ++k)
    p.position[k] += (2.0 * rng.uniform() - 1.0) * room * p.diameter[k / d];
  for (double &diameter : p.diameter) diameter *= 1.0 - parts[done];
  if (s.o.strain == JAM_STRAIN_FREE) strain_at_random(p, rng, (1.0 - 2.0 * s.tuning.displaced) * gap);
  wrap_positions(p);
  record_opening(s);
  s.history.stage.path_taken = false;
  s.last.active = ActiveSet();
  restart_lps(s, first_bound(p, s.o, s.tuning));
  return true;
}

}  // namespace jam::inside
