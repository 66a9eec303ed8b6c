/* What jam-pack writes: JSON report and summary. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "jam-pack.h"

/* What stands before the next item of a list. */
static const char *next(int *first) {
  const char *between = *first ? "" : ", ";
  *first = 0;
  return between;
}

static void print_note(const char *line, int warns, void *with) {
  (void)warns;
  (void)with;
  printf("  start     %s\n", line);
}
static void print_warning(const char *line, int warns, void *with) {
  (void)with;
  if (warns) complain("%s", line);
}
void print_warnings(const char *notes) { each_note(notes, print_warning, NULL); }

void print_stop(const jam_system *sys, const options *o, jam_status status, const outcome *result) {
  const int32_t stop = result->has_radii    ? result->radii.stop_reason
                       : result->has_crunch ? result->crunch.stop_reason
                                            : result->md_stop;
  const int is_kept = o->checkpoint && !result->has_radii && (status == JAM_LIMIT || status == JAM_CANCELLED);
  char why[1024];
  const jam_info info = info_of(sys);
  if (stop_if_asked(NULL, NULL))
    strcpy(why, "interrupted; writing the state reached");
  else if (status == JAM_LIMIT && stop == JAM_STOP_WALL_TIME)
    snprintf(why, sizeof why, "stopped early: --wall-time came before the end of %s, at packing fraction %.6g",
             result->has_radii    ? "the search of radii"
             : result->has_crunch ? "the crunch"
                                  : "dynamics",
             info.packing_fraction);
  else
    snprintf(why, sizeof why, "stopped early: %s", jam_last_error());
  if (is_kept)
    complain("%s; --resume %s continues", why, o->checkpoint);
  else
    complain("%s", why);
}

/* What was asked for, and what was done of it in this run. */
static void put_protocol(FILE *f, const options *o, const outcome *result) {
  static const char *const methods[] = {"barrier_path", "sequential_lp"}, *const solvers[] = {"ipm", "clp"},
                           *const strains[] = {"none", "edges", "tilts", "free"};
  int k, first = 1;
  fputs("  \"options\": [", f);
  for (k = 0; k < o->given.word_count; ++k) {
    if (k) fputs(", ", f);
    put_text(f, o->given.words[k]);
  }
  fputs("],\n  \"protocol\": [", f);
  if (o->nve > 0 && !o->resume)
    fprintf(f, "%s{\"stage\": \"nve\", \"collisions_per_particle\": %.17g}", next(&first), o->nve);
  for (k = 0; k < o->given.stage_count; ++k)
    if (result->stage_stop[k] && !(o->given.stages[k].growth > 0))
      fprintf(f, "%s{\"stage\": \"growth\", \"packing_fraction\": %.17g, \"stop_reason\": \"%s\"}", next(&first),
              o->given.density, jam_stop_string(result->stage_stop[k]));
    else if (result->stage_stop[k])
      fprintf(f, "%s{\"stage\": \"growth\", \"growth_rate\": %.17g, \"pressure\": %.17g, \"stop_reason\": \"%s\"}",
              next(&first), o->given.stages[k].growth, o->given.stages[k].pressure,
              jam_stop_string(result->stage_stop[k]));
  if (result->has_radii)
    fprintf(f, "%s{\"stage\": \"radii\", \"kind\": \"%s\", \"strain\": \"%s\"}", next(&first), o->radii,
            strains[o->strain]);
  else if (result->has_crunch)
    fprintf(f, "%s{\"stage\": \"crunch\", \"method\": \"%s\", \"strain\": \"%s\"}", next(&first), methods[o->method],
            strains[o->strain]);
  fputs("],\n", f);
  if (result->has_crunch && !result->has_radii)
    fprintf(f, "  \"method\": \"%s\",\n  \"lp_solver\": \"%s\",\n", methods[result->crunch.method],
            solvers[result->crunch.lp_solver]);
  else
    fputs("  \"method\": null,\n  \"lp_solver\": null,\n", f);
}

/* A line a wall: force in newtons is a confining pressure times stress times area. */
static void put_walls(FILE *f, const outcome *result) {
  const size_t columns = sizeof *result->walls / sizeof **result->walls;
  size_t w;
  fputs("  \"walls\": [", f);
  for (w = 0; w < result->wall_numbers / columns; ++w) {
    const double *row = result->walls[w];
    fprintf(f, "%s\n    {\"axis\": %d, \"side\": %d, \"area\": %.17g, \"stress\": ", w ? "," : "",
            (int)row[JAM_WALL_AXIS], (int)row[JAM_WALL_SIDE], row[JAM_WALL_AREA]);
    if (isfinite(row[JAM_WALL_STRESS]))
      fprintf(f, "%.17g}", row[JAM_WALL_STRESS]);
    else
      fputs("null}", f);
  }
  fputs("],\n", f);
}

/* The strict proof where its file was asked for, else the collective one. */
static const char *proof_of(const outcome *result) {
  const jam_crunch_report *r = &result->crunch;
  const jam_proof_report *s = &result->strict;
  if (!r->jammed) return "not tried: not jammed";
  if (result->has_strict)
    return jam_proof_text(s->theorem, s->cause, s->theorem == JAM_THEOREM_EXACT ? s->radius : s->inner, s->cause_value,
                          s->cause_bound);
  return jam_proof_text(r->theorem, r->proof_cause, r->proof_radius, r->proof_value, r->proof_bound);
}

/* A file says all that a packing is, unless spheres are moved at random. */
static int has_seed(const options *o, const outcome *result) {
  return !o->input || result->has_md || (result->has_crunch && result->crunch.decompressions > 0);
}

int write_report(const options *o, const outcome *result, const char *path) {
  const jam_info *info = &result->info;
  const jam_crunch_report *r = &result->crunch;
  const jam_radii_report *radii = &result->radii;
  const int crunched = result->has_crunch, moved = crunched && !result->has_radii, grown = result->has_radii;
  const int known = crunched && r->rattlers >= 0;    /* else it was stopped before its contacts were known */
  const int certified = crunched && r->contacts > 0; /* without contacts zeros would look like perfect balance */
  const double rate = result->seconds_md > 0 ? (double)result->collisions / result->seconds_md : NAN;
  output out;
  FILE *f;
  if (open_output(&out, path)) return -1;
  f = out.file;
  begin_json(f, o->input ? o->input : o->resume, result->code, messages());
  put_count(f, "n", info->n, 1);
  put_count(f, "dim", info->dim, 1);
  put_count(f, "seed", info->seed, has_seed(o, result));
  put_protocol(f, o, result);
  put_notes(f, result->notes, "");
  put_number(f, "packing_fraction", info->packing_fraction);
  put_number(f, "diameter_mean", info->diameter_mean);
  put_number(f, "diameter_mean_given", result->diameter_given);
  put_walls(f, result);
  put_stress(f, result->stress, result->stress_numbers);
  put_number(f, "pressure", result->has_md ? result->pressure : NAN);
  put_count(f, "collisions", result->collisions, 1);
  put_number(f, "collisions_per_second", rate);
  put_count(f, "lp_solves", r->lp_solves, moved);
  put_count(f, "factorisations", grown ? radii->factorisations : r->factorisations, moved || grown);
  put_count(f, "decompressions", r->decompressions, moved);
  put_number(f, "radii_value", grown ? radii->value : NAN);
  put_count(f, "radii_excess", radii->excess, grown && radii->maximum);
  put_number(f, "moment_residual", grown ? radii->moment_residual : NAN);
  put_number(f, "polydispersity", grown ? radii->polydispersity : NAN);
  put_count(f, "contacts", r->contacts, known);
  put_count(f, "rattlers", r->rattlers, known);
  put_count(f, "bucklers", r->bucklers, known);
  put_count(f, "isostatic_contacts", r->isostatic_contacts, known);
  put_count(f, "excess_contacts", r->excess_contacts, known);
  put_count(f, "undecided_contacts", r->undecided_contacts, known);
  put_number(f, "max_overlap", crunched ? r->max_overlap : NAN);
  put_number(f, "force_residual", certified ? r->force_residual : NAN);
  put_number(f, "gamma_residual", certified ? r->gamma_residual : NAN);
  put_number(f, "min_force", certified ? r->min_force : NAN);
  put_number(f, "min_gap", certified ? r->min_gap : NAN);
  put_number(f, "duality_gap", certified ? r->duality_gap : NAN);
  put_number(f, "gain", moved ? r->gain : NAN);
  put_number(f, "packing_fraction_start", moved ? r->packing_fraction_start : NAN);
  put_number(f, "displacement_max", moved ? r->displacement_max : NAN);
  put_number(f, "displacement_rms", moved ? r->displacement_rms : NAN);
  put_number(f, "displacement_max_stable", moved ? r->displacement_max_stable : NAN);
  put_number(f, "displacement_rms_stable", moved ? r->displacement_rms_stable : NAN);
  put_count(f, "contacts_start", r->contacts_start, moved && r->contacts_start >= 0);
  put_count(f, "contacts_kept", r->contacts_kept, moved && r->contacts_kept >= 0);
  put_verdict(f, "jammed", crunched ? (r->jammed ? JAM_VERDICT_YES : JAM_VERDICT_NO) : JAM_VERDICT_UNTESTED);
  put_verdict(f, "strictly_jammed", crunched ? r->strictly_jammed : JAM_VERDICT_UNTESTED);
  fputs("  \"proof\": ", f);
  if (o->prove && crunched)
    put_text(f, proof_of(result));
  else
    fputs("null", f);
  fputs(",\n", f);
  put_number(f, "proof_radius", crunched ? r->proof_radius : NAN);
  fprintf(f, "  \"stop_reason\": \"%s\",\n",
          jam_stop_string(grown      ? radii->stop_reason
                          : crunched ? r->stop_reason
                                     : result->md_stop));
  fprintf(f, "  \"md_stop_reason\": \"%s\",\n", jam_stop_string(result->md_stop));
  put_number(f, "seconds_md", result->seconds_md);
  put_number(f, "seconds_crunch", grown ? radii->seconds : crunched ? r->seconds : 0.0);
  fprintf(f, "  \"version\": \"%s\",\n  \"commit\": \"%s\",\n", jam_version(), jam_commit());
  fprintf(f, "  \"blas_kernel\": \"%s\"\n}\n", jam_blas_kernel());
  return close_output(&out);
}

static const char *verdict(const jam_crunch_report *r) {
  if (r->strictly_jammed == JAM_VERDICT_YES) return "strictly jammed";
  if (r->jammed) return "jammed";
  return r->stop_reason == JAM_STOP_DUALITY_GAP ? "not tested" : "not jammed";
}

/* What the crunch did to the packing that it was given, and of what the verdict is. */
static void print_changes(const options *o, const outcome *result) {
  const jam_crunch_report *r = &result->crunch;
  printf("  moved     phi %.9f -> %.9f, spheres by up to %.2g diameters (rms %.2g)", r->packing_fraction_start,
         result->info.packing_fraction, r->displacement_max, r->displacement_rms);
  if (isfinite(r->displacement_max_stable))
    printf(", those with contacts by up to %.2g (rms %.2g)", r->displacement_max_stable, r->displacement_rms_stable);
  if (r->contacts_kept >= 0 && r->contacts_start > 0)
    printf(", %lld of the %lld contacts before it kept", (long long)r->contacts_kept, (long long)r->contacts_start);
  putchar('\n');
  if (o->input)
    printf(
        "  the file  is not tested: '%s' is the end state, after the crunch moved spheres by up to %.2g diameters. "
        "See: %s check %s\n",
        verdict(r), r->displacement_max, program, o->input);
}

void print_summary(const options *o, const outcome *result) {
  const jam_crunch_report *r = &result->crunch;
  const int strict = r->strictly_jammed == JAM_VERDICT_YES;
  const jam_info *info = &result->info;
  printf("%lld spheres in d = %d", (long long)info->n, (int)info->dim);
  if (has_seed(o, result)) printf(", seed %lld", (long long)info->seed);
  printf(": packing fraction %.12f\n", info->packing_fraction);
  each_note(result->notes, print_note, NULL);
  if (fabs(info->diameter_mean / result->diameter_given - 1.0) > 1e-9)
    printf("  diameters are %.9g times those %s, mean %.6g: the cell keeps its size\n",
           info->diameter_mean / result->diameter_given,
           o->given.sizes || o->given.diameters_file ? "of --sizes" : "of the file", info->diameter_mean);
  if (result->has_md)
    printf("  dynamics  p = %.4g after %.3g collisions in %.2f s (%s)\n", result->pressure, (double)result->collisions,
           result->seconds_md, jam_stop_string(result->md_stop));
  if (result->has_radii) print_radii(o, &result->radii);
  if (!result->has_crunch || result->has_radii) return;
  printf("  crunch    %s (%s): %lld LPs, %lld factorisations, %.2f s\n", verdict(r), jam_stop_string(r->stop_reason),
         (long long)r->lp_solves, (long long)r->factorisations, r->seconds);
  if (r->decompressions > 0)
    printf("            decompressed and crunched again %d times: ends before were not shown to be jammed\n",
           (int)r->decompressions);
  if (r->contacts < 0) puts("  network   unknown: the crunch stopped before its contacts were known");
  if (r->contacts <= 0) {
    print_changes(o, result);
    return;
  }
  if (r->stop_reason == JAM_STOP_DUALITY_GAP)
    printf("  gap       %.2e, so that phi_J is about %.12f; %lld undecided pairs\n", r->duality_gap,
           info->packing_fraction * pow(1.0 + r->duality_gap, 0.5 * info->dim), (long long)r->undecided_contacts);
  printf("  network   %lld contacts (isostatic %+lld%s), %lld rattlers, %lld bucklers\n", (long long)r->contacts,
         (long long)(strict ? r->contacts - r->strict_contacts_needed : r->excess_contacts),
         strict ? " for a cell that deforms" : "", (long long)r->rattlers, (long long)r->bucklers);
  printf("  certified largest overlap %.1e, force imbalance %.1e, smallest force %.1e, smallest gap %.1e\n",
         r->max_overlap, r->force_residual, r->min_force, r->min_gap);
  if (o->prove) printf("  proof     %s%s\n", result->has_strict ? "strict jamming: " : "", proof_of(result));
  print_changes(o, result);
}
