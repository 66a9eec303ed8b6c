// Status codes, their texts and the thread-local last error.
#include <cstdio>
#include <new>
#include <stdexcept>

#include "capi/guard.hpp"
#include "linalg/blas.hpp"

namespace jam::inside {
namespace {
thread_local char last_error[sentence_max] = "";
}
OwnEnvironmentOfCall::OwnEnvironmentOfCall() noexcept {}
OwnEnvironmentOfCall::~OwnEnvironmentOfCall() {}

void set_last_error(const char *text) noexcept { std::snprintf(last_error, sizeof last_error, "%s", text); }

jam_status status_of_exception() noexcept {
  try {
    throw;
  } catch (const Error &e) {
    set_last_error(e.what());
    return e.code();
  } catch (const std::bad_alloc &) {
    set_last_error("out of memory");
    return JAM_E_MEMORY;
  } catch (const std::length_error &) {  // more elements than pointers reach
    set_last_error("out of memory");
    return JAM_E_MEMORY;
  } catch (const std::exception &e) {
    set_last_error(e.what());
    return JAM_E_INTERNAL;
  } catch (...) {
    set_last_error("unknown exception inside libjam");
    return JAM_E_INTERNAL;
  }
}

const char *text_of_status(jam_status status) {
  switch (status) {
    case JAM_CANCELLED:
      return "jam_cancel or a callback stopped the call; the state is valid";
    case JAM_LIMIT:
      return "a limit on work or time was reached first; the state is valid: raise the limit, or call again to "
             "continue";
    case JAM_NOT_CONVERGED:
      return "the method made no further progress; the last state is kept, which need not be the best";
    case JAM_PRECISION:
      return "double precision cannot resolve the target; the result is as close to it as doubles allow";
    case JAM_NOT_JAMMED:
      return "the contact network is empty, so there is no rigidity to analyse: crunch the packing first";
    case JAM_AMBIGUOUS:
      return "the answer is not unique: another one fits as well";
    default:
      return jam_status_string(status);
  }
}

namespace {
const char *text_of_stop(int32_t reason) {
  switch (reason) {
    case JAM_STOP_COLLISIONS:
      return "collisions_per_particle came before the target; the packing reached is kept: raise it, or call again to "
             "continue";
    case JAM_STOP_TIME:
      return "the limit of simulated time came before the target; the packing reached is kept: raise it, or call again "
             "to continue";
    case JAM_STOP_WALL_TIME:
      return "wall_time came before the end; the packing reached is kept: raise wall_time, or call again to continue";
    case JAM_STOP_CANCELLED:
      return "jam_cancel or a callback stopped the call; the packing reached is kept: call again to continue";
    case JAM_STOP_PRECISION:
      return "gaps, overlaps or forces are at rounding, the limit of double precision; the packing reached is kept";
    case JAM_STOP_LP_LIMIT:
      return "max_lps came before convergence; the packing reached is kept: raise max_lps, or crunch again to continue";
    case JAM_STOP_SOLVER:
      return "no answer of the LP solver passed the checks; the packing reached is kept, without a certificate";
    case JAM_STOP_STRAIN:
      return "strain";
    case JAM_STOP_EVENT:
      return "event";
    case JAM_STOP_JAMMED:
      return "jammed";
    case JAM_STOP_UNJAMMED:
      return "the crunch converged without a rigid network: no contact forces are in balance; compress the packing "
             "further first, or take more spheres";
    case JAM_STOP_SADDLE:
      return "contact forces balance, but a motion opens contacts (a saddle), and steps along it do not leave the "
             "saddle: take another seed, or compress the packing further first";
    case JAM_STOP_EVALUATIONS:
      return "max_evaluations came before the minimum; the state reached is kept: raise it, or call again to continue";
    case JAM_STOP_STEPS:
      return "max_steps came before the end; the state reached is kept: raise it, or call again to continue";
    default:
      return nullptr;
  }
}
}  // namespace

Answer stopped(jam_status status, int32_t stop_reason) {
  const char *text = status > 0 ? text_of_stop(stop_reason) : nullptr;
  return text ? Answer(status, text) : Answer(status);
}

Answer stopped_run(jam_status status, int32_t stop_reason) {
  const bool cancelled = stop_reason == JAM_STOP_CANCELLED;
  if (status <= 0 || (!cancelled && stop_reason != JAM_STOP_WALL_TIME)) return stopped(status, stop_reason);
  return {status, sentence("%s; what was made is kept, and resume = 1 continues; without it a call starts again",
                           cancelled ? "jam_cancel or a callback stopped the call" : "wall_time came before the end")};
}

}  // namespace jam::inside

// One list for code and text; the numbers are checked against the header by the compiler through the switch.
#define JAM_STATUS_TEXTS(X)                                                           \
  X(JAM_OK, "done")                                                                   \
  X(JAM_CANCELLED, "cancelled")                                                       \
  X(JAM_LIMIT, "a limit on work or time came first")                                  \
  X(JAM_NOT_CONVERGED, "no further progress")                                         \
  X(JAM_PRECISION, "beyond the resolution of the numbers")                            \
  X(JAM_NOT_JAMMED, "no jammed network")                                              \
  X(JAM_AMBIGUOUS, "the answer is not unique")                                        \
  X(JAM_E_NULL, "a needed pointer is NULL")                                           \
  X(JAM_E_STRUCT_SIZE, "struct_size was not set, or an option is of a later version") \
  X(JAM_E_ARGUMENT, "a value is out of its range")                                    \
  X(JAM_E_DIMENSION, "the dimension is not supported")                                \
  X(JAM_E_NONFINITE, "NaN or infinity in the input")                                  \
  X(JAM_E_OVERLAP, "spheres overlap")                                                 \
  X(JAM_E_UNPLACEABLE, "the spheres cannot reach the packing fraction")               \
  X(JAM_E_BUFFER, "the output buffer is too short")                                   \
  X(JAM_E_MEMORY, "out of memory")                                                    \
  X(JAM_E_IO, "file cannot be opened, read or written")                               \
  X(JAM_E_FORMAT, "file does not have the format")                                    \
  X(JAM_E_STATE, "no such result yet")                                                \
  X(JAM_E_SOLVER, "no solver gave an answer that checks out")                         \
  X(JAM_E_TOO_FEW, "too few spheres")                                                 \
  X(JAM_E_BUSY, "another call is running on this handle")                             \
  X(JAM_E_UNSUPPORTED, "not available in this build or model")                        \
  X(JAM_E_INTERNAL, "internal error of libjam")

extern "C" {

const char *jam_status_string(jam_status code) {
  switch (code) {
#define X(name, text) \
  case name:          \
    return text;
    JAM_STATUS_TEXTS(X)
#undef X
    default:
      return "unknown status";
  }
}

const char *jam_stop_string(int32_t reason) {
  static constexpr const char *names[] = {
      "none",      "pressure",  "packing_fraction", "collisions", "wall_time", "cancelled", "stalled",
      "precision", "converged", "lp_limit",         "solver",     "unjammed",  "time",      "evaluations",
      "steps",     "saddle",    "duality_gap",      "strain",     "event",     "jammed"};
  static_assert(sizeof names / sizeof *names == JAM_STOP_JAMMED + 1, "a name for each jam_stop_reason");
  return reason >= 0 && reason <= JAM_STOP_JAMMED ? names[reason] : "unknown";
}

const char *jam_last_error(void) { return jam::inside::last_error; }
void jam_set_error(const char *text) { jam::inside::set_last_error(text ? text : ""); }
const char *jam_version(void) { return JAM_VERSION_STRING; }
const char *jam_commit(void) { return JAM_COMMIT_STRING; }
const char *jam_blas_kernel(void) { return jam::inside::blas_kernel(); }
int32_t jam_abi_version(void) { return JAM_ABI; }

}  // extern "C"
