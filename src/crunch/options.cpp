#include "crunch/options.hpp"

#include <limits>

#include "core/checks.hpp"
#include "core/create.hpp"
#include "core/error.hpp"
#include "core/limits.hpp"
#include "lp/packing_lp.hpp"
#include "lp/strain.hpp"

namespace jam::inside {

jam_crunch_options default_crunch_options() {
  jam_crunch_options o{};
  o.struct_size = sizeof o;
  o.lp_solver = JAM_LP_IPM;
  o.method = JAM_CRUNCH_BARRIER_PATH;
  o.polish = 1;
  o.max_lps = 1000;
  o.threads = 1;
  o.gain_tolerance = 1e-12;
  o.step_tolerance = 1e-9;
  o.lp_tolerance = 1e-15;
  o.wall_time = std::numeric_limits<double>::infinity();
  return o;
}

void check_options(const Packing &p, const jam_crunch_options &o) {
  check_enum(o.lp_solver, JAM_LP_IPM, JAM_LP_CLP, "lp_solver", "jam_lp_solver");
  if (o.lp_solver == JAM_LP_CLP && !clp_is_built())
    fail(JAM_E_UNSUPPORTED, "lp_solver is JAM_LP_CLP, and this build of libjam has no Clp (JAM_CLP=OFF)");
  check_enum(o.method, JAM_CRUNCH_BARRIER_PATH, JAM_CRUNCH_SEQUENTIAL_LP, "method", "jam_crunch_method");
  check_at_least(o.max_lps, 1, "max_lps");
  check_threads(o.threads);
  check_positive(o.gain_tolerance, "gain_tolerance");
  check_positive(o.step_tolerance, "step_tolerance");
  check_positive(o.lp_tolerance, "lp_tolerance");
  check_positive(o.wall_time, "wall_time");
  check_range("neighbour_radius", o.neighbour_radius, 0.0, limits::radius_max);
  // Smaller steps are lost in the rounding of positions; larger ones leave the numbers that the LP solvers take.
  if (o.step_bound != 0.0) check_range("step_bound", o.step_bound, 1e-15, limits::radius_max);
  check_flag(o.polish, "polish");
  check_flag(o.full_lps, "full_lps");
  check_flag(o.steps, "steps");
  check_flag(o.prove, "prove");
  if (o.keep_steps < 0 || o.keep_steps > limits::keep_steps_max)
    fail(JAM_E_ARGUMENT, "keep_steps is %d, it must be 0 .. %d", o.keep_steps, limits::keep_steps_max);
  check_strain(o.strain, "a crunch");
  if (o.duality_gap != 0.0) {
    check_range("duality_gap", o.duality_gap, limits::duality_gap_min, limits::duality_gap_max);
    if (o.method != JAM_CRUNCH_BARRIER_PATH || o.strain != JAM_STRAIN_NONE)
      fail(JAM_E_ARGUMENT, "duality_gap %g needs the barrier path and a fixed cell", o.duality_gap);
  }
  if (p.n() < 2 && o.strain == JAM_STRAIN_NONE)
    fail(JAM_E_TOO_FEW, "%zu sphere: crunch needs at least 2, or a free cell (strain)", p.n());
  refuse_overlaps(p, 1e-9);
}

}  // namespace jam::inside
