/* jam-pack check FILE: is the packing of the file jammed, as it is? One paragraph on standard output, or JSON. */
#include <math.h>
#include <stdio.h>
#include "jam-pack.h"

enum { CHECK_YES = 0, CHECK_NO = 1, CHECK_REFUSED = 2, CHECK_UNDECIDED = 3 };

/* Proofs speak of the contacts of the file's packing. */
static jam_status write_proof(jam_system *sys, const char *path, int32_t kind) {
  const jam_status status = jam_contacts_from_geometry(sys, NULL, NULL);
  return status < 0 || status == JAM_CANCELLED ? status : jam_write_proof(sys, path, kind, NULL, 0);
}

/* 0, or an exit code after a message where the file was asked for and cannot be written. */
static int put_proof(jam_system *sys, const char *path, int32_t kind, int32_t verdict) {
  jam_status status;
  if (!path) return 0;
  if (verdict != JAM_VERDICT_YES)
    complain("%s is not written: the packing is not %sjammed%s", path, kind == JAM_RIGIDITY_STRICT ? "strictly " : "",
             verdict == JAM_VERDICT_NO ? "" : " for certain");
  if (verdict != JAM_VERDICT_YES) return 0;
  status = write_proof(sys, path, kind);
  return !has_failed(status) ? 0 : status == JAM_CANCELLED ? EXIT_OUTPUT : code_of(status);
}

/* The stress tensor of a jammed packing, over its pressure; the number of its components, 0 where there is none. */
static size_t stress_of(jam_system *sys, const jam_check_report *r, double *stress, size_t most) {
  size_t numbers = 0;
  if (r->jammed != JAM_VERDICT_YES || jam_contacts_from_geometry(sys, NULL, NULL) < 0) return 0;
  return jam_stress(sys, stress, most, &numbers) == JAM_OK ? numbers : 0;
}

static void print_stress(const double *stress, int dim) {
  double beyond = 0;
  int c;
  fputs("Stress over pressure:", stdout);
  for (c = 0; c < dim * dim; ++c)
    if (c % (dim + 1) == 0)
      printf(" %.4f", stress[c]);
    else
      beyond = fmax(beyond, fabs(stress[c]));
  printf(" on the diagonal, at most %.1e off it.\n", beyond);
}

static int write_json(jam_system *sys, const options *o, int code, const jam_check_report *r) {
  static const char *const reasons[] = {"proof",   "apart", "no_force", "flex", "digits",
                                        "overlap", "gaps",  "margin",   "slide"};
  double stress[JAM_MAX_DIM * JAM_MAX_DIM];
  output out;
  FILE *f;
  if (open_output(&out, "-")) return -1;
  f = out.file;
  begin_json(f, o->input, code, jam_check_text(r));
  put_verdict(f, "jammed", r->jammed);
  put_verdict(f, "strictly_jammed", r->strictly_jammed);
  put_verdict(f, "stationary", r->stationary);
  fprintf(f, "  \"reason\": \"%s\",\n", reasons[r->reason]);
  put_count(f, "n", r->n, 1);
  put_count(f, "dim", r->dim, 1);
  put_number(f, "packing_fraction", r->packing_fraction);
  put_count(f, "digits", r->digits, r->digits > 0);
  put_count(f, "contacts", r->contacts, 1);
  put_count(f, "excess_contacts", r->excess_contacts, 1);
  put_count(f, "strict_excess_contacts", r->strict_excess_contacts, 1);
  put_count(f, "rattlers", r->rattlers, 1);
  put_count(f, "closed_pairs", r->closed_pairs, 1);
  put_count(f, "undecided_contacts", r->undecided_contacts, 1);
  put_count(f, "self_stresses", r->self_stresses, 1);
  put_count(f, "flexes", r->flexes, 1);
  put_count(f, "strict_flexes", r->strict_flexes, 1);
  put_number(f, "nearest_gap", r->nearest_gap);
  put_number(f, "min_gap", r->min_gap);
  put_number(f, "max_contact_gap", r->max_contact_gap);
  put_number(f, "force_residual", r->force_residual);
  put_number(f, "rigidity_margin", r->rigidity_margin);
  put_number(f, "curvature_margin", r->curvature_margin);
  put_number(f, "resolution", r->resolution);
  put_number(f, "diameter_factor", r->diameter_factor);
  put_verdict(f, "crunch_jammed", r->crunch_jammed);
  put_number(f, "crunch_packing_fraction", r->crunch_packing_fraction);
  put_number(f, "proof_radius", o->prove || o->proof || o->strict_proof ? r->proof_radius : NAN);
  put_notes(f, jam_notes(sys), "");
  put_stress(f, stress, stress_of(sys, r, stress, sizeof stress / sizeof *stress));
  return end_json(&out);
}

/* The proof, then the text or the JSON; returns the exit code. */
static int say(jam_system *sys, const options *o, const jam_check_report *report) {
  const int strict = o->strict || o->strict_proof;
  const int32_t verdict = strict ? report->strictly_jammed : report->jammed;
  int code = verdict == JAM_VERDICT_YES ? CHECK_YES : verdict == JAM_VERDICT_NO ? CHECK_NO : CHECK_UNDECIDED;
  const int proof = put_proof(sys, o->proof, JAM_RIGIDITY_COLLECTIVE, report->jammed);
  const int strict_proof = put_proof(sys, o->strict_proof, JAM_RIGIDITY_STRICT, report->strictly_jammed);
  double stress[JAM_MAX_DIM * JAM_MAX_DIM];
  if (proof || strict_proof) code = proof ? proof : strict_proof;
  if (o->json) return write_json(sys, o, code, report) ? EXIT_OUTPUT : code;
  complain_notes(sys); /* what reading assumed, such as periodic axes */
  if (!o->quiet) puts(jam_check_text(report));
  if (!o->quiet && stress_of(sys, report, stress, sizeof stress / sizeof *stress)) print_stress(stress, report->dim);
  return end_stdout(code);
}

int check_file(const options *o) {
  jam_check_options check;
  jam_check_report report = {0};
  jam_system *sys = NULL;
  jam_status status;
  int code = CHECK_REFUSED;
  if (read_as_it_is(o, &sys)) return CHECK_REFUSED;
  if (!sys) return CHECK_UNDECIDED;
  report.struct_size = sizeof report;
  cancel_on_signal(sys);
  jam_set_progress(sys, stop_late, (void *)o);
  status = jam_check_options_init(&check, sizeof check);
  check.wall_time = seconds_until(o->given.deadline);
  check.prove = o->prove || o->proof || o->strict_proof;
  if (status >= 0) status = jam_check_packing(sys, &check, &report);
  if (status == JAM_CANCELLED) {
    complain("interrupted by Ctrl-C or --wall-time, before the verdict");
    code = CHECK_UNDECIDED;
  } else if (status < 0) {
    complain("%s", jam_last_error());
    complain_notes(sys);
  } else {
    code = say(sys, o, &report);
  }
  cancel_on_signal(NULL);
  return leave(sys, code);
}
