// What is reported of a soft packing at its minimum.
#include <algorithm>
#include <cmath>

#include "core/math.hpp"
#include "network/certificate.hpp"
#include "soft/decompression.hpp"

namespace jam::inside {

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
    double f2 = 0.0;
    for (int c = 0; c < d; ++c) f2 += force[i * d + c] * force[i * d + c];
    worst = std::max(worst, f2);
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
  v.force_difference = std::nan("");
  const auto common = common_contacts(soft, hard);
  v.common_contacts = static_cast<int64_t>(common.size());
  v.same_network = report.jammed == 1 && common.size() == hard.size() && common.size() == soft.size();
  if (!v.same_network) return v;
  v.force_difference = 0.0;
  for (const auto &[k, q] : common)
    v.force_difference = std::max(v.force_difference, std::fabs(soft.force[k] - hard.force[q]));
  return v;
}

}  // namespace jam::inside
