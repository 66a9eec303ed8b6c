// Time and radius of a proof against N and Newton's steps, beside the time of the crunch: proof N,N,... SEEDS [strict].
// strict: cells are free, and packings are proved strictly jammed. JSON.
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>

#include "capi/system.hpp"
#include "linalg/blas.hpp"
#include "proof/newton.hpp"
#include "proof/theorem.hpp"

#include "../start.h"

using namespace jam::inside;

namespace {

double processor() { return static_cast<double>(clock()) / CLOCKS_PER_SEC; }

// A jammed packing grown at the defaults, and the time of its crunch.
jam_system *jammed(int n, int dim, int seed, bool strict, double &seconds) {
  jam_create_options o;
  jam_create_options_init(&o, sizeof o);
  o.n = n, o.dim = dim, o.seed = seed, o.packing_fraction = dim == 2 ? 0.3 : 0.2;
  std::vector<double> sizes;
  for (int i = 0; i < n; ++i) sizes.push_back(dim == 2 && i % 2 ? 1.4 : 1.0);
  jam_system *sys = nullptr;
  if (create_from(&o, nullptr, 0, sizes.data(), sizes.size(), &sys) < 0 || jam_compress(sys, nullptr, nullptr) < 0)
    std::exit((std::fprintf(stderr, "%s\n", jam_last_error()), 1));
  jam_crunch_options free_cell;
  jam_crunch_options_init(&free_cell, sizeof free_cell);
  if (strict) free_cell.strain = JAM_STRAIN_FREE;
  const double before = processor();
  if (jam_crunch(sys, &free_cell, nullptr) < 0) std::exit((std::fprintf(stderr, "%s\n", jam_last_error()), 1));
  seconds = processor() - before;
  return sys;
}

// The proof after so many steps of Newton; the time of the whole.
void measure(const jam_system *sys, int n, int dim, int seed, bool strict, int steps, double crunch, bool &first) {
  const double before = processor();
  const BlasThreads one(1);
  ProofScene s = make_proof_scene(sys->packing, sys->contacts, {});
  if (strict) s.strict = true, s.implied.clear();
  ProofEquations e = evaluate(s);
  for (int k = 0; k < steps; ++k) {
    NormalMatrix normal(s, e);
    if (!normal.factorise()) return;
    refine_forces(s, e, normal);
    take_step(s, newton_step(s, e, normal));
    e = evaluate(s);
  }
  {
    NormalMatrix normal(s, e);
    if (!normal.factorise()) return;
    refine_forces(s, e, normal);
  }
  const Proof p = prove(s, e);
  std::printf(
      "%s\n {\"n\": %d, \"dim\": %d, \"seed\": %d, \"strict\": %d, \"steps\": %d, \"exact\": %d, \"trapped\": %d, "
      "\"cause\": %d, "
      "\"radius\": %.4g, \"gamma_error\": %.4g, \"least_force\": %.4g, \"force_error\": %.4g, \"eigenvalue\": %.4g, "
      "\"rounding\": %.4g, \"inner\": %.4g, \"outer\": %.4g, \"seconds\": %.4g, \"crunch\": %.4g}",
      first ? "" : ",", n, dim, seed, strict, steps, p.exact, p.trapped, static_cast<int>(p.cause), p.radius,
      p.gamma_radius, p.least_force, p.force_radius, p.bound.eigenvalue, p.bound.rounding, p.inner, p.outer,
      processor() - before, crunch);
  std::fflush(stdout);
  first = false;
}

}  // namespace

int main(int argc, char **argv) {
  const std::string sizes = argc > 1 ? argv[1] : "64,256,1024";
  const int seeds = argc > 2 ? std::atoi(argv[2]) : 3;
  const bool strict = argc > 3 && std::string(argv[3]) == "strict";
  bool first = true;
  std::printf("[");
  for (const char *at = sizes.c_str(); *at; at += *at == ',') {
    char *end = nullptr;
    const int n = static_cast<int>(std::strtol(at, &end, 10));
    at = end;
    for (const int dim : {2, 3})
      for (int seed = 1; seed <= seeds; ++seed) {
        double crunch = 0.0;
        jam_system *sys = jammed(n, dim, seed, strict, crunch);
        for (int steps = 0; steps <= 3; ++steps) measure(sys, n, dim, seed, strict, steps, crunch, first);
        jam_destroy(sys);
      }
  }
  std::printf("\n]\n");
}
