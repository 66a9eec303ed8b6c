#include "network/contacts_from_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/call_scope.hpp"
#include "core/pair_rule.hpp"
#include "network/rattlers.hpp"
#include "network/self_stress.hpp"
#include "network/tuning.hpp"

namespace jam::inside {

jam_geometry_options default_geometry_options() {
  jam_geometry_options o{};
  o.struct_size = sizeof o;
  o.tolerance = 0.0;
  o.window = 0.1;
  return o;
}

namespace {

struct GapList {
  PairList pairs;
  std::vector<double> gap;
  std::vector<size_t> order;  // by |gap|
};

GapList pairs_below(const Packing &p, double limit) {
  GapList g;
  g.pairs = find_pairs(p, 0.0, 1.0 + limit);
  std::vector<double> r(p.dim);
  for (size_t k = 0; k < g.pairs.size(); ++k) {
    const double length = std::sqrt(pair_vector(p, g.pairs, k, r.data()));
    g.gap.push_back(length / contact_distance(p, g.pairs.i[k], g.pairs.j[k]) - 1.0);
  }
  g.order.resize(g.gap.size());
  std::iota(g.order.begin(), g.order.end(), size_t{0});
  std::stable_sort(g.order.begin(), g.order.end(),
                   [&](size_t x, size_t y) { return std::fabs(g.gap[x]) < std::fabs(g.gap[y]); });
  return g;
}

ContactNetwork network_of(const Packing &p, const GapList &g, double tolerance) {
  ContactNetwork net;
  for (size_t k = 0; k < g.pairs.size(); ++k)  // list order: sorted by (i, j) and image
    if (!(std::fabs(g.gap[k]) > tolerance)) add_contact(p, g.pairs, k, net);
  net.force.assign(net.size(), 0.0);
  net.coordination.assign(p.n(), 0);
  std::vector<char> on(net.size());  // contacts of a sphere with its own image constrain nothing in a fixed cell
  for (size_t k = 0; k < net.size(); ++k) on[k] = !net.pairs.own_image(k);
  drop_unbalanced(p.dim, p.n(), net.pairs.i, net.pairs.j, net.vector, on);
  return subset(net, on, p.dim);
}

// The contacts between spheres that carry force, those without force among them too.
ContactNetwork between_carrying(const ContactNetwork &net, const std::vector<char> &carrying, int d) {
  std::vector<char> stable(net.coordination.size(), 0), on(net.size());
  for (size_t k = 0; k < net.size(); ++k)
    if (carrying[k]) for_spheres(net.pairs.i[k], net.pairs.j[k], [&](int32_t i) { stable[i] = 1; });
  for (size_t k = 0; k < net.size(); ++k)
    on[k] = stable[net.pairs.i[k]] && (net.pairs.wall(k) || stable[net.pairs.j[k]]);
  return subset(net, on, d);
}

}  // namespace

namespace {

struct Jump {
  double ratio, below, above;
};

// The largest jumps of the sorted gaps, best first: the best of all, and the best of those that leave at least half of
// the spheres with enough contacts (ratios are large among the few smallest gaps, too). Gaps below the resolution count
// as that.
std::vector<Jump> find_jumps(const Packing &p, const GapList &g, double resolution, double window) {
  std::vector<Jump> jumps;
  const double enough = p.dim * 0.5 * static_cast<double>(p.n());
  size_t few = 0;
  for (size_t q = 0; q < g.order.size(); ++q) {
    const double below = std::max(std::fabs(g.gap[g.order[q]]), resolution);
    const double above = q + 1 < g.order.size() ? std::max(std::fabs(g.gap[g.order[q + 1]]), resolution) : window;
    if (above > below) jumps.push_back({above / below, below, above});
    if (static_cast<double>(q + 1) < enough) few = jumps.size();
  }
  const auto best = [&](size_t first, size_t last) {
    const size_t keep = std::min<size_t>(last - first, JumpTuning::most_candidates);
    const auto begin = jumps.begin() + static_cast<std::ptrdiff_t>(first);
    std::partial_sort(begin, begin + static_cast<std::ptrdiff_t>(keep),
                      jumps.begin() + static_cast<std::ptrdiff_t>(last),
                      [](const Jump &x, const Jump &y) { return x.ratio > y.ratio; });
    return std::vector<Jump>(begin, begin + static_cast<std::ptrdiff_t>(keep));
  };
  std::vector<Jump> out = best(few, jumps.size()), small = best(0, few);
  out.insert(out.end(), small.begin(), small.end());
  std::stable_sort(out.begin(), out.end(), [](const Jump &x, const Jump &y) { return x.ratio > y.ratio; });
  return out;
}

// In a fluid some gap is the widest step too. Without a true jump pairs that are open by more than the digits of their
// coordinates explain are no contacts.
bool reaches_open_pairs(const ContactNetwork &net, const Jump &jump, double reach) {
  const double widest = std::max(nearly_touching, reach);
  return jump.ratio < JumpTuning::wide &&
         std::any_of(net.gap.begin(), net.gap.end(), [widest](double h) { return h > widest; });
}

// The curvature of a round wall may hold spheres with fewer contacts. So may the spheres of a packing that is not
// rigid, as copies of a jammed one side by side: closed contacts whose forces balance are contacts, however few.
bool may_be_network(const ContactNetwork &net, const Packing &p, const Jump &jump) {
  if (net.size() == 0) return false;
  if (p.container.curved() != 0 || excess_contacts(net, p) >= 0) return true;
  return jump.ratio > JumpTuning::wide && jump.below < contact_gap_limit && jump.above > contact_gap_limit &&
         test_rigidity(make_rigidity_matrix(p, net), Jamming::collective).stressed == Verdict::yes;
}

void check_window(double window) {
  if (!(window > 0.0 && window <= 1.0)) fail(JAM_E_ARGUMENT, "window is %g, it must be in (0, 1]", window);
}

}  // namespace

GeometryResult contacts_from_geometry(const Packing &p, const jam_geometry_options &o) {
  if (!(o.tolerance >= 0.0 && o.tolerance < 1.0))
    fail(JAM_E_ARGUMENT, "tolerance is %g, it must be in [0, 1)", o.tolerance);
  check_window(o.window);
  GeometryResult out;
  jam_geometry_report &r = out.report;
  const double window = std::max(o.window, 2.0 * o.tolerance);
  const GapList g = pairs_below(p, window);
  const GapResolution resolution = gap_resolution(p);
  r.resolution = resolution.relative(p);
  const double smallest = *std::min_element(p.diameter.begin(), p.diameter.end());
  const double reach = resolution.reach(smallest) / smallest;
  r.tolerance = o.tolerance;
  r.second_contacts = -1, r.second_jump = 1.0;
  bool clear = true, wide = false;
  int64_t second_excess = 0;
  if (o.tolerance > 0.0) {
    out.network = network_of(p, g, o.tolerance);
  } else {
    bool chosen = false;
    for (const Jump &jump : find_jumps(p, g, r.resolution, window)) {
      ContactNetwork net = network_of(p, g, std::sqrt(jump.below * jump.above));
      if (!may_be_network(net, p, jump) || reaches_open_pairs(net, jump, reach)) continue;
      if (chosen) {
        r.second_jump = jump.ratio;
        r.second_contacts = static_cast<int64_t>(net.size());
        second_excess = excess_contacts(net, p);
        r.second_tolerance = std::sqrt(jump.below * jump.above);
        break;
      }
      chosen = true;
      out.network = std::move(net);
      r.tolerance = std::sqrt(jump.below * jump.above);
      r.jump = jump.ratio;
    }
    wide = chosen && r.jump > JumpTuning::wide;
    clear = wide && r.jump > r.second_jump * r.second_jump;
  }
  r.gap_below = 0.0;
  r.gap_above = window;
  for (size_t k = 0; k < g.gap.size(); ++k) {
    const double h = std::fabs(g.gap[k]);
    if (h <= r.tolerance) {
      r.gap_below = std::max(r.gap_below, h);
      ++r.pairs_within;
      if (g.pairs.own_image(k)) ++r.self_contacts;
    } else {
      r.gap_above = std::min(r.gap_above, h);
    }
  }
  if (o.tolerance > 0.0) r.jump = r.gap_above / std::max(r.gap_below, r.resolution);
  if (out.network.coordination.empty()) out.network.coordination.assign(p.n(), 0);
  // With the contacts of this tolerance taken as closed, whatever their gaps.
  const RigidityResult closed = test_rigidity(make_rigidity_matrix(p, out.network), Jamming::collective);
  if (closed.stressed == Verdict::yes) out.network = between_carrying(out.network, closed.carrying, p.dim);
  const RigidityMatrix graph = make_rigidity_matrix(p, out.network);
  const StressStates stress = find_stress(graph, false);
  out.network.force = stress.force;
  r.contacts = static_cast<int64_t>(out.network.size());
  r.self_stresses = stress.dimension;
  r.zero_modes = stress.zero_modes;
  r.force_residual = stress.residual;
  r.min_force = stress.min_force;
  r.excess_contacts = excess_contacts(out.network, p);
  r.clusters = count_clusters(graph);
  // The null space decides between two: rattlers that nearly touch their neighbours make the second network
  // hyperstatic.
  clear = clear || (wide && stress.dimension == 1 && stress.zero_modes == graph.symmetries() &&
                    r.excess_contacts == 0 && second_excess > 0);
  out.answer_if_closed = closed.rigid;
  out.clear = clear;
  set_force_scale(p, out.network);
  return out;
}

jam_status status_of(const GeometryResult &found, Verdict as_it_is, const GapResolution &resolution, const Packing &p) {
  // Contacts that the digits may hide forbid a no.
  if (found.answer_if_closed == Verdict::no && !(resolution.coarse(p) && as_it_is == Verdict::undecided))
    return JAM_NOT_JAMMED;
  const bool wide_gaps = as_it_is != found.answer_if_closed;
  return found.report.self_stresses > 1 || !found.clear || found.answer_if_closed == Verdict::undecided || wide_gaps
             ? JAM_AMBIGUOUS
             : JAM_OK;
}

ContactNetwork contacts_by_distance(const Packing &p, double gap) {
  if (!(gap > 0.0 && gap <= 1.0)) fail(JAM_E_ARGUMENT, "gap is %g, it must be above 0 and at most 1", gap);
  ContactNetwork net;
  const PairList near = find_pairs(p, 0.0, 1.0 + gap);
  for (size_t k = 0; k < near.size(); ++k) add_contact(p, near, k, net);
  net.force.assign(net.size(), std::numeric_limits<double>::quiet_NaN());
  net.coordination.assign(p.n(), 0);
  for (size_t k = 0; k < net.size(); ++k)
    for_spheres(net.pairs.i[k], net.pairs.j[k], [&](int32_t i) { ++net.coordination[static_cast<size_t>(i)]; });
  return net;
}

}  // namespace jam::inside
