// What is reported of a soft packing at its minimum.
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/math.hpp"
#include "core/pair_rule.hpp"
#include "linalg/dot.hpp"
#include "soft/decompression.hpp"
#include "soft/tuning.hpp"

namespace jam::inside {
namespace {

double largest(const std::vector<double> &force, size_t n, int d, const std::vector<char> *of) {
  double most = 0.0;
  for (size_t i = 0; i < n; ++i) {
    if (of && !(*of)[i]) continue;
    most = std::max(most, squared(&force[i * d], d));
  }
  return std::sqrt(most);
}

}  // namespace

SoftResult measure(SoftState &state, int32_t minimiser) {
  state.rebase();  // offsets of pairs then belong to the rounded positions
  const int d = state.dim();
  SoftResult out;
  out.packing = state.packing();
  const SoftContacts contacts = state.contacts();
  const std::vector<char> on = stable_contacts(state, contacts);
  std::vector<double> force;
  const SoftSums sums = state.evaluate(force);
  ContactNetwork &net = out.contacts;
  net.coordination.assign(state.n(), 0);
  jam_relax_report &r = out.report;
  double mean = 0.0, overlap = 0.0;
  int64_t ends = 0;
  for (size_t q = 0; q < contacts.size(); ++q) {
    const size_t k = contacts.pair[q];
    const int32_t i = state.pairs().i[k], j = state.pairs().j[k];
    const double sigma = contacts.distance[q] + contacts.overlap[q], h = contacts.overlap[q] / sigma;
    r.max_overlap = std::max(r.max_overlap, h);
    if (!on[q]) continue;
    net.pairs.append(state.pairs(), k);
    net.vector.insert(net.vector.end(), &contacts.normal[q * d], &contacts.normal[q * d] + d);
    net.gap.push_back(-h);
    net.force.push_back(contacts.force[q]);
    net.stiffness.push_back(state.energy().stiffness(contacts.overlap[q], contacts.force[q]));
    net.prestress.push_back(contacts.transverse[q]);
    for_spheres(i, j, [&](int32_t s) { ++net.coordination[s], ++ends; });
    mean += contacts.force[q];
    overlap += h;
  }
  const auto count = static_cast<double>(net.size());
  for (double &f : net.force) f *= count / mean;
  set_force_scale(state.base(), net);

  double worst = 0.0;
  for (size_t i = 0; i < state.n(); ++i) {
    if (net.coordination[i] == 0) continue;
    worst = std::max(worst, squared(&force[i * d], d));
    ++r.stable;
  }
  r.minimiser = minimiser;
  r.contacts = static_cast<int64_t>(net.size());
  r.rattlers = static_cast<int64_t>(state.n()) - r.stable;
  r.excess_contacts = r.contacts - isostatic_contacts(r.stable, d, state.base().container);
  r.force_residual = r.contacts > 0 ? std::sqrt(worst) * count / mean : 0.0;
  r.stress_residual = r.contacts > 0 ? sums.stress : 0.0;
  r.energy = sums.energy;
  r.pressure = sums.virial / (d * scene_volume(state.base()));
  r.packing_fraction = packing_fraction(state.base());
  r.distance = sums.distance(state.energy().alpha());
  r.jammed_fraction = r.packing_fraction * math::pow(1.0 - r.distance, d);
  r.coordination = r.stable > 0 ? static_cast<double>(ends) / static_cast<double>(r.stable) : 0.0;
  r.mean_overlap = r.contacts > 0 ? overlap / count : 0.0;
  return out;
}

jam_crunch_report soft_certificate(const SoftResult &soft, double seconds) {
  jam_crunch_report r{};
  certify(soft.packing, soft.contacts, r);
  r.stop_reason = JAM_STOP_NONE;
  r.gain = r.max_step = r.gamma_residual = r.duality_gap = std::nan("");
  r.seconds = seconds;
  r.status = soft.status;
  return r;
}

Packing just_below_contact(const SoftResult &soft) {
  Packing p = soft.packing;
  const double factor = (1.0 - soft.report.max_overlap) * (1.0 - 1e-13);
  for (double &s : p.diameter) s *= factor;
  return p;
}

SoftComparison compare_with_jammed(const ContactNetwork &soft, const ContactNetwork &hard,
                                   const jam_crunch_report &report) {
  SoftComparison v;
  v.packing_fraction = report.packing_fraction;
  const auto common = common_contacts(soft, hard);
  v.common_contacts = static_cast<int64_t>(common.size());
  v.same_network = report.jammed == 1 && common.size() == hard.size() && common.size() == soft.size();
  if (v.same_network == 0) return v;
  v.force_difference = 0.0;
  for (const auto &[k, q] : common)
    v.force_difference = std::max(v.force_difference, std::fabs(soft.force[k] - hard.force[q]));
  return v;
}

void centre_rattlers(SoftState &state) {
  const int d = state.dim();
  const SoftContacts contacts = state.contacts();
  const std::vector<char> on = stable_contacts(state, contacts);
  std::vector<char> rattler(state.n(), 1);
  for (size_t q = 0; q < contacts.size(); ++q)
    if (on[q])
      for_spheres(state.pairs().i[contacts.pair[q]], state.pairs().j[contacts.pair[q]],
                  [&](int32_t s) { rattler[s] = 0; });
  Packing p = state.packing();
  const double mean = state.diameter_mean();
  const PairList pairs = find_pairs(p, 0.5 * mean, 1.0);
  std::vector<std::vector<size_t>> of(state.n());
  for (size_t k = 0; k < pairs.size(); ++k) {
    if (pairs.i[k] == pairs.j[k]) continue;
    for_spheres(pairs.i[k], pairs.j[k], [&](int32_t s) {
      if (rattler[s]) of[s].push_back(k);
    });
  }
  const std::vector<double> start = p.position;
  // Smallest gap of sphere i at the positions in p, and the direction away from that neighbour.
  const auto nearest = [&](size_t i, double *away) {
    double least = std::numeric_limits<double>::infinity(), r[JAM_MAX_DIM];
    for (const size_t k : of[i]) {
      const double length = std::sqrt(pair_vector(p, pairs, k, r));
      const double gap = length - contact_distance(p, pairs.i[k], pairs.j[k]);
      if (!(gap < least) || !(length > 0.0)) continue;
      least = gap;
      const double sign = static_cast<size_t>(pairs.i[k]) == i ? 1.0 : -1.0;
      for (int c = 0; c < d; ++c) away[c] = sign * r[c] / length;
    }
    return least;
  };
  double away[JAM_MAX_DIM] = {}, step = CageTuning::first_step * mean;
  std::vector<double> before(state.n()), best = start, widest(state.n(), -std::numeric_limits<double>::infinity());
  for (size_t i = 0; i < state.n(); ++i) before[i] = nearest(i, away);
  for (int sweep = 0; sweep < CageTuning::sweeps; ++sweep, step *= CageTuning::step_factor)
    for (size_t i = 0; i < state.n(); ++i) {
      if (of[i].empty()) continue;
      const double least = nearest(i, away);
      if (least > widest[i]) {
        widest[i] = least;
        std::copy_n(&p.position[i * d], d, &best[i * d]);
      }
      if (least > CageTuning::wide_gap * mean) continue;
      for (int c = 0; c < d; ++c) p.position[i * d + c] += step * away[c];
    }
  p.position = best;
  // Where rattlers share a cage their best places may not fit together: these go back.
  for (bool again = true; again;) {
    again = false;
    for (size_t i = 0; i < state.n(); ++i) {
      if (of[i].empty() || best[i * d] == start[i * d] || nearest(i, away) >= std::min(0.0, before[i])) continue;
      std::copy_n(&start[i * d], d, &p.position[i * d]);
      std::copy_n(&start[i * d], d, &best[i * d]);
      again = true;
    }
  }
  for (size_t k = 0; k < start.size(); ++k) state.displacement()[k] += best[k] - start[k];
}

double Relaxation::residual() const {
  if (sums.coincident > 0) return std::numeric_limits<double>::infinity();
  const double mean = sums.mean_force();
  if (mean > 0.0) return std::max(largest(force, state.n(), state.dim(), nullptr) / mean, sums.stress);
  return at_rest() ? 0.0 : std::numeric_limits<double>::infinity();
}

double Relaxation::stable_residual() const {
  if (sums.coincident > 0) return std::numeric_limits<double>::infinity();
  const SoftContacts contacts = state.contacts();
  const std::vector<char> on = stable_contacts(state, contacts);
  std::vector<char> stable(state.n(), 0);
  double sum = 0.0;
  int64_t count = 0;
  for (size_t k = 0; k < contacts.size(); ++k) {
    if (!on[k]) continue;
    for_spheres(state.pairs().i[contacts.pair[k]], state.pairs().j[contacts.pair[k]],
                [&](int32_t s) { stable[s] = 1; });
    sum += contacts.force[k];
    ++count;
  }
  if (!(sum > 0.0)) return residual();
  return std::max(largest(force, state.n(), state.dim(), &stable) * static_cast<double>(count) / sum, sums.stress);
}

// Overlaps have the digits of the displacements, which the next list makes small, or in plain doubles of coordinates.
Relaxation::Roundings Relaxation::roundings() const {
  double overlap = sums.overlap / static_cast<double>(sums.contacts);
  if (const double stiffens = 2.0 - state.energy().alpha(); stiffens > 0.0) {  // the least overlap rounds most
    const std::vector<double> all = state.contacts().overlap;
    if (!all.empty()) overlap *= math::pow(*std::min_element(all.begin(), all.end()) / overlap, stiffens);
  }
  const auto rounding = [&](double length) {
    return RelaxTuning::roundings * std::numeric_limits<double>::epsilon() * (1.0 + length / overlap);
  };
  const double always = state.precision() == JAM_SOFT_DOUBLE ? state.base().cell.side() : 0.0;
  const double moved = norm(state.displacement()) / std::sqrt(static_cast<double>(state.n()));
  return {rounding(always), rounding(always + moved), rounding(state.base().cell.side())};
}

bool Relaxation::open() const {
  const double none = std::numeric_limits<double>::epsilon() * state.base().cell.side();
  return sums.overlap <= RelaxTuning::roundings * none * static_cast<double>(sums.contacts) &&
         !(state.cell().pressure > 0.0);
}

bool Relaxation::rounded(double tolerance) const {
  if (open()) return true;
  const double rounding = sums.contacts > 0 ? std::min(roundings().coordinates, NewtonTuning::settled) : 0.0;
  return stable_residual() < std::max(tolerance, rounding);
}

bool Relaxation::at_rounding(double residual, double tolerance) const {
  const Roundings r = roundings();
  return tolerance < r.always && residual < r.now;
}

bool Relaxation::renew_origin(double residual, double tolerance) {
  const Roundings r = roundings();
  if (tolerance < r.always || !(tolerance < r.now && residual < r.now)) return false;
  state.rebase();
  evaluate();
  return true;
}

bool Relaxation::yields() const {
  const Packing &p = state.base();
  if (state.strains() > 0 && p.cell.shortest() < 0.5 * *std::max_element(p.diameter.begin(), p.diameter.end()))
    return true;
  if (state.cell().beyond.empty()) return false;
  const std::vector<double> e = strain_between(start, state.base().cell);
  return std::any_of(e.begin(), e.end(), [](double x) { return std::fabs(x) > RelaxTuning::most_strain; });
}

bool Relaxation::must_stop(DescentEnd &end, bool long_steps) const {
  if (effort.evaluations >= effort.max_evaluations) {
    end = DescentEnd::limit;
    return true;
  }
  if (effort.monitor && (long_steps || effort.evaluations % 64 == 1)) {
    jam_progress p = progress_of(effort.phase);
    p.packing_fraction = effort.packing_fraction;
    p.pressure = effort.pressure;
    p.steps = effort.steps;
    p.factorisations = effort.factorisations;
    if (effort.monitor->report(p) || effort.monitor->interrupted()) {
      end = DescentEnd::interrupted;
      return true;
    }
    if (yields()) {
      end = DescentEnd::yields;
      return true;
    }
  }
  return false;
}

}  // namespace jam::inside
