/* --radii: positions and radii to a maximum, in place of the crunch. */
#include <stdio.h>
#include <string.h>
#include "jam-pack.h"

int take_radii(const options *o, jam_radii_options *radii) {
  static const char moments[] = "moments:";
  const size_t begin = sizeof moments - 1;
  double exponent[4] = {1, 2, 3, 4};
  jam_radii_options_init(radii, sizeof *radii);
  if (!strncmp(o->radii, moments, begin)) radii->moments = take_numbers(o->radii + begin, exponent, 4);
  radii->exponent_1 = exponent[0], radii->exponent_2 = exponent[1];
  radii->exponent_3 = exponent[2], radii->exponent_4 = exponent[3];
  if (radii->moments || !strcmp(o->radii, "sum")) return 0;
  complain("--radii is '%s', it must be sum or moments:Q,.. with one to four exponents", o->radii);
  return -1;
}

jam_status run_radii(jam_system *sys, const options *o, double wall_time, outcome *result) {
  jam_radii_options radii;
  jam_status status;
  take_radii(o, &radii);
  radii.threads = (int32_t)o->threads;
  radii.wall_time = wall_time;
  radii.strain = (int32_t)o->strain;
  result->radii.struct_size = sizeof result->radii;
  status = jam_maximise_radii(sys, &radii, NULL, 0, &result->radii);
  result->has_radii = status >= 0;
  result->crunch.struct_size = sizeof result->crunch;
  result->has_crunch = result->has_radii && jam_get_crunch_report(sys, &result->crunch) >= 0;
  return status;
}

void print_radii(const options *o, const jam_radii_report *r) {
  printf("  radii     %s: %s %.15g (%s) after %lld steps in %.2f s; radii %.6g to %.6g, polydispersity %.4g\n",
         o->radii, o->radii[0] == 's' ? "sum" : "factor", r->value, jam_stop_string(r->stop_reason),
         (long long)r->steps, r->seconds, r->radius_smallest, r->radius_largest, r->polydispersity);
  if (r->maximum)
    printf("  maximum   %lld contacts (excess %+lld), %lld rattlers, smallest force %.1e, smallest gap %.1e\n",
           (long long)r->contacts, (long long)r->excess, (long long)r->rattlers, r->min_force, r->min_gap);
}
