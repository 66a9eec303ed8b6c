#include "crunch/crunch.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "crunch/sequential_lp.hpp"

namespace jam {

double free_spacing(const Packing &p) {
  const double jammed = p.dim == 2 ? 0.84 : 0.64 * std::pow(0.7, p.dim - 3);
  return std::max(0.0, std::pow(packing_fraction(p), -1.0 / p.dim) - std::pow(jammed, -1.0 / p.dim));
}

CrunchResult crunch(const Packing &start, const jam_crunch_options &o, Monitor &monitor, History *history,
                    const CrunchSeams *seams) {
  check_options(start, o);
  monitor.wall_time = o.wall_time;
  if (monitor.log_fn && monitor.log_level >= JAM_LOG_INFO) {
    const jam_estimate e = estimate(start, o);
    monitor.log(JAM_LOG_INFO,
                "estimate: %.3g MB, %lld pairs, %.3g flops a factorisation, about %.3g s for %.0f of them",
                e.bytes / 1e6, static_cast<long long>(e.pairs), e.flops, e.seconds, e.factorisations);
  }
  History own;
  History &steps = history ? *history : own;
  const CrunchSeams none;
  CrunchResult result = SequentialLp(start, o, monitor, steps, seams ? *seams : none).run();
  if (seams && seams->attempt) seams->attempt(result);
  const bool gave_up = result.status == JAM_NOT_CONVERGED || result.status == JAM_NOT_JAMMED;
  if (!gave_up || o.method != JAM_CRUNCH_BARRIER_PATH || monitor.interrupted()) return result;
  // The path led to a point where a contact's force is too weak for the LPs to decide whether it closes. The chain
  // takes another way from the same start; its answer counts if it is a jammed packing.
  monitor.log(JAM_LOG_WARNING, "the barrier path ended at an undecided contact; the chain of LPs starts again");
  jam_crunch_options chain = o;
  chain.method = JAM_CRUNCH_SEQUENTIAL_LP;
  History again;
  std::swap(again, steps);  // callbacks look at `steps`
  CrunchResult second = SequentialLp(start, chain, monitor, steps, seams ? *seams : none).run();
  second.report.lp_solves += result.report.lp_solves;
  second.report.factorisations += result.report.factorisations;
  if (second.report.jammed) return second;
  std::swap(again, steps);
  return result;
}

}  // namespace jam
