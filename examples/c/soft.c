/* Soft spheres from random points to an energy minimum, its moduli, down to jamming, checked by a crunch, and 1 % up.
 */
#include <jam/jam.h>
#include <math.h>
#include <stdio.h>

static int failed(jam_system *sys) {
  fprintf(stderr, "%s\n", jam_last_error());
  jam_destroy(sys);
  return 1;
}

int main(void) {
  jam_create_options o;
  jam_relax_report minimum, above;
  jam_modes_options choose;
  jam_hessian_options stiffness;
  jam_moduli_report moduli;
  jam_decompress_report down;
  jam_start start = {.struct_size = sizeof start};
  jam_system *sys = NULL;
  double size[100], mode[1][2];
  size_t m = 0;
  int k;

  for (k = 0; k < 100; ++k) size[k] = k % 2 ? 1.4 : 1.0; /* so few equal spheres would order */
  start.diameters = size;
  start.diameters_len = 100;
  jam_create_options_init(&o, sizeof o);
  o.n = 100;
  o.packing_fraction = 0.72;     /* above jamming */
  o.overlap = JAM_OVERLAP_ALLOW; /* independent uniform points */
  if (jam_create(&o, &start, &sys) < 0) return failed(sys);

  minimum.struct_size = sizeof minimum;
  if (jam_relax(sys, NULL, &minimum) < 0) return failed(sys); /* NULL: harmonic, forces balanced to 1e-12 */
  printf("energy %.6g, pressure %.6g, %.3f contacts a sphere, residual %.1e\n", minimum.energy, minimum.pressure,
         minimum.coordination, minimum.force_residual);

  jam_hessian_options_init(&stiffness, sizeof stiffness);
  stiffness.stiffness = JAM_STIFFNESS_SOFT; /* of the energy that was minimised */
  stiffness.prestress = 1.0;                /* all of its pre-stress */
  moduli.struct_size = sizeof moduli;
  if (jam_moduli(sys, &stiffness, &moduli) < 0) return failed(sys);
  printf("bulk modulus %.4g, shear modulus %.4g\n", moduli.bulk, moduli.shear);

  down.struct_size = sizeof down;
  if (jam_decompress(sys, NULL, &down) < 0) return failed(sys);
  printf("phi_J %.9f from above, %.9f by crunch; %lld of %lld contacts in common\n", down.jammed_fraction,
         down.crunch_fraction, (long long)down.common_contacts, (long long)down.contacts);

  /* A packing fraction 1 % above phi_J. jam_forces and jam_contacts give the forces there, jam_modes the vibrations. */
  above.struct_size = sizeof above;
  jam_modes_options_init(&choose, sizeof choose);
  choose.which = JAM_MODES_LOWEST;
  choose.count = 1;
  if (jam_scale_diameters(sys, pow(1.01, 1.0 / 3.0)) < 0 || jam_relax(sys, NULL, &above) < 0 ||
      jam_modes(sys, &stiffness, &choose, JAM_MODE_COLUMNS, &mode[0][0], 2, NULL, 0, &m) < 0)
    return failed(sys);
  printf("1 %% above phi_J: pressure %.4g, %.3f contacts a sphere, lowest frequency %.4g\n", above.pressure,
         above.coordination, sqrt(mode[0][JAM_MODE_LAMBDA]));
  jam_destroy(sys);
  return minimum.converged && down.same_network == 1 && above.converged && above.coordination > 6.0 ? 0 : 1;
}
