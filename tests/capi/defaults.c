/* Default options make a jammed packing in every dimension. */
#include <math.h>

#include "steps.h"

/* A random start, the two stages of growth and the crunch, all by default. Few spheres: in a small cell equal spheres
 * order, so the test asks for a proof of rigidity, and for a density between that of the start and that of the densest
 * lattices (Conway and Sloane, Sphere Packings, Lattices and Groups, table 1.2). */
CASE(defaults_jam_in_every_dimension) {
  static const int64_t n[] = {0, 0, 40, 60, 60, 40, 40, 40, 60};
  static const double densest[] = {0, 0, 0.9069, 0.7405, 0.6169, 0.4653, 0.3730, 0.2953, 0.2537};
  for (int32_t dim = 2; dim <= JAM_MAX_DIM; ++dim) {
    SIZED(jam_md_report, grown);
    SIZED(jam_crunch_report, r);
    OWNED jam_system *sys = random_spheres(dim, n[dim], 0.0, 1);
    const jam_info info = info_of(sys);
    assert_true(fabs(info.packing_fraction / (dim <= 3 ? 0.2 : 0.2 * pow(0.5, dim - 3)) - 1.0) < 1e-12);
    if (jam_compress(sys, NULL, &grown) != JAM_OK) fail_msg("d = %d: %s", dim, jam_last_error());
    assert_int_equal(grown.stop_reason, JAM_STOP_PRESSURE);
    assert_true(grown.pressure >= 1e6);
    if (jam_crunch(sys, NULL, &r) != JAM_OK) fail_msg("d = %d: %s", dim, jam_last_error());
    print_message("d = %d: phi_J %.4f, %d contacts, excess %d\n", dim, r.packing_fraction, (int)r.contacts,
                  (int)r.excess_contacts);
    assert_true(r.jammed == 1 && r.excess_contacts >= 0);
    assert_true(r.packing_fraction >= grown.packing_fraction && r.packing_fraction <= densest[dim]);
    assert_true(r.packing_fraction > info.packing_fraction && r.force_residual < 1e-10);
  }
}
