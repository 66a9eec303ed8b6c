// A build without Clp (JAM_CLP=OFF): a call that needs it gets no answer, and the log says why.
#include "lp/packing_lp.hpp"

namespace jam::inside {
namespace {

LpSolution no_answer(const PackingLp &lp, const Monitor *monitor) {
  if (monitor) monitor->log(JAM_LOG_WARNING, "a linear program would go to Clp, which this build does not have");
  LpSolution out;
  out.s.assign(lp.spheres(), 0.0);
  out.strain.assign(static_cast<size_t>(lp.strains), 0.0);
  out.y.assign(lp.rows(), 0.0);
  out.w = lp.c;
  return out;
}

}  // namespace

bool clp_is_built() { return false; }
LpSolution solve_lp_clp(const PackingLp &lp, double, const Monitor *monitor, const LpSolution *) {
  return no_answer(lp, monitor);
}

}  // namespace jam::inside
