// See maximise.hpp.
#include "radii/maximise.hpp"

#include <algorithm>
#include <cmath>

#include "core/limits.hpp"
#include "radii/tuning.hpp"
#include "radii/vertex.hpp"

namespace jam::inside {
namespace {

// Radii between their bounds; contacts open, unless radii at the lower bound hold them. Moments keep their ratios.
void shrink(Packing &p, const RadiiGoal &goal, const RadiiBounds &bounds, double unit, double room) {
  if (goal.moments()) {
    for (double &s : p.diameter) s *= 1.0 - room;
    return;
  }
  const double narrow = std::min(RadiiTuning::least_room * unit, 0.25 * (bounds.most - bounds.least));
  for (double &s : p.diameter) {
    const double radius = std::min(0.5 * s, bounds.most);
    s = 2.0 * (bounds.least + std::max((1.0 - room) * (radius - bounds.least), narrow));
  }
}

void make_room(Packing &p, const RadiiGoal &goal, const RadiiBounds &bounds, double unit, double room) {
  shrink(p, goal, bounds, unit, room);
  const ClosestPair pair = closest_contact(p);
  if (!(pair.gap > 0.0))
    fail(JAM_E_ARGUMENT,
         "radius_min is %g, which spheres %d and %d have no room for where they start: start with such radii",
         bounds.least, pair.i, pair.j);
}

double weighted_sum(const Packing &p, const double *weights) {
  DoubleDouble sum(0.0);
  for (size_t i = 0; i < p.n(); ++i) sum = sum + two_product(weights ? weights[i] : 1.0, 0.5 * p.diameter[i]);
  return static_cast<double>(sum);
}

std::vector<double> of_mean_one(size_t n, const double *weights, double &mean) {
  std::vector<double> out(n, 1.0);
  mean = 1.0;
  if (!weights) return out;
  mean = mean_weight(weights, n);
  for (size_t i = 0; i < n; ++i) out[i] = weights[i] / mean;
  return out;
}

// Forces below are rounding: where bounds hold all radii, no contact needs to carry any.
bool carries(const RadiiVertex &vertex, size_t k) { return vertex.force[k] > -RadiiTuning::no_force; }

ContactNetwork network_of(const Packing &p, const RadiiVertex &vertex) {
  ContactNetwork net;
  net.coordination.assign(p.n(), 0);
  double sum = 0.0;
  for (size_t k = 0; k < vertex.contacts.pairs.size(); ++k) {
    if (!carries(vertex, k)) continue;
    add_contact(p, vertex.contacts.pairs, k, net);
    net.force.push_back(vertex.force[k]);
    sum += vertex.force[k];
    for_spheres(vertex.contacts.pairs.i[k], vertex.contacts.pairs.j[k], [&](int32_t q) { ++net.coordination[q]; });
  }
  for (double &f : net.force) f *= static_cast<double>(net.size()) / sum;
  measure_contacts(p, net);
  set_force_scale(p, net);
  return net;
}

void report_sizes(const Packing &p, const RadiiGoal &goal, const double *weights, jam_radii_report &r) {
  r.value = goal.moments() ? goal.lambda(p) : weighted_sum(p, weights);
  r.moment_residual = goal.residual(p);
  r.packing_fraction = packing_fraction(p);
  const auto [low, high] = std::minmax_element(p.diameter.begin(), p.diameter.end());
  r.radius_smallest = 0.5 * *low, r.radius_largest = 0.5 * *high;
  const double mean = diameter_mean(p);
  double square = 0.0;
  for (const double s : p.diameter) square += (s / mean - 1.0) * (s / mean - 1.0);
  r.polydispersity = std::sqrt(square / static_cast<double>(p.n()));
}

// force_unit: of the forces of the vertex, in units of the value.
void report_maximum(const Packing &p, const RadiiVertex &vertex, const ContactNetwork &net, const RadiiGoal &goal,
                    double force_unit, jam_radii_report &r) {
  r.maximum = 1;
  r.contacts = static_cast<int64_t>(net.size());
  r.at_bounds = 0;
  double least = std::numeric_limits<double>::infinity();
  for (size_t k = 0; k < vertex.force.size(); ++k) {
    if (!carries(vertex, k)) continue;
    least = std::min(least, vertex.force[k]);
    if (k >= vertex.contacts.pairs.size()) ++r.at_bounds;
  }
  r.excess = r.contacts + r.at_bounds + static_cast<int64_t>(goal.equations()) -
             static_cast<int64_t>(vertex.contacts.unknowns()) + symmetries(p.container, p.dim);
  r.rattlers = static_cast<int64_t>(p.n()) - stable_spheres(net.coordination);
  r.balance_residual = vertex.balance;
  r.max_contact_gap = vertex.gap, r.min_gap = vertex.open;
  r.min_force = force_unit * least;
  if (!goal.moments()) return;
  const std::vector<double> multipliers = goal.multipliers(p, vertex.multiplier);
  double *const to[] = {&r.multiplier_1, &r.multiplier_2, &r.multiplier_3, &r.multiplier_4};
  for (size_t q = 0; q < multipliers.size(); ++q) *to[q] = multipliers[q];
}

// Sideways along the motion of a saddle, as far as there is room.
void push_off(Packing &p, const RadiiGoal &goal, const std::vector<double> &motion, const RadiiBounds &bounds,
              double unit) {
  double length = RadiiTuning::push * unit;
  shrink(p, goal, bounds, unit, RadiiTuning::room);
  std::vector<double> sideways = motion;
  const size_t b = static_cast<size_t>(p.dim) + 1;
  for (size_t i = 0; i < p.n(); ++i) sideways[i * b + b - 1] = 0.0;  // a strain stays
  const Packing from = p;
  do {
    move_radii(from, sideways, length, bounds, p);
    length *= 0.5;
  } while (!(closest_contact(p).gap > 0.0) && length > 0.0);
}

// Packings have no wider sizes: the call ends before them.
bool too_wide(const Packing &p) {
  const auto [low, high] = std::minmax_element(p.diameter.begin(), p.diameter.end());
  return !(*high <= limits::size_ratio_max * *low);
}

}  // namespace

RadiiResult maximise_radii(const Packing &start, const jam_radii_options &o, const double *weights, Monitor &monitor) {
  RadiiResult out;
  out.packing = start;
  Packing &p = out.packing;
  p.given = {};
  double mean_weight = 1.0;
  RadiiGoal goal = o.moments > 0 ? RadiiGoal(p, exponents_of(o)) : RadiiGoal(of_mean_one(p.n(), weights, mean_weight));
  const RadiiBounds bounds = bounds_of(p, o);
  monitor.wall_time = o.wall_time;
  make_room(p, goal, bounds, radii_unit(p), o.room);
  RadiiPath path(p, goal, bounds, o.threads);
  const double unit = path.unit();
  RadiiMatrix matrix;
  jam_radii_report &r = out.report;
  r.struct_size = sizeof r;
  r.contacts = r.rattlers = r.at_bounds = r.excess = -1;
  r.balance_residual = r.max_contact_gap = r.min_gap = r.min_force = std::nan("");
  r.multiplier_1 = r.multiplier_2 = r.multiplier_3 = r.multiplier_4 = std::nan("");
  r.stop_reason = JAM_STOP_STALLED, out.status = JAM_NOT_CONVERGED;
  int pushes = 0, climbs = 0;
  int32_t wide = -1;
  Packing last = p;
  for (double mu = std::max(path.first_mu(), RadiiTuning::least_mu * unit); mu > RadiiTuning::mu_end * unit;
       mu *= RadiiTuning::mu_factor) {
    if (!path.centre(mu, o.max_steps, monitor)) {
      const bool stopped = monitor.interrupted();
      r.stop_reason = stopped ? monitor.why_interrupted() : JAM_STOP_STEPS;
      out.status = monitor.cancelled() ? JAM_CANCELLED : JAM_LIMIT;
      break;
    }
    if (too_wide(p)) {
      p = last;
      out.text = sentence(
          "the largest radius grew to %g times the smallest one; the packing is the last one before: "
          "radius_min keeps radii nearer to each other",
          limits::size_ratio_max);
      break;
    }
    last = p;
    if (mu > RadiiTuning::polish_from * unit) continue;
    RadiiVertex vertex = close_vertex(p, path.rows(), path.forces(), goal, bounds, unit, matrix);
    wide = vertex.wide;
    if (vertex.closed && too_wide(vertex.packing)) continue;
    const std::vector<double> &away = vertex.closed ? vertex.escape : vertex.uphill;
    int &count = vertex.closed ? pushes : climbs;
    if (!away.empty() && count < RadiiTuning::pushes) {
      ++count;
      if (vertex.closed) p = vertex.packing;
      push_off(p, goal, away, bounds, unit);
      path.renew();
      mu = RadiiTuning::mu_after_push * unit / RadiiTuning::mu_factor;
      continue;
    }
    if (!vertex.closed) continue;
    if (!vertex.escape.empty()) break;
    p = vertex.packing;
    out.contacts = network_of(p, vertex);
    const double force_unit = goal.moments() ? goal.lambda(p) / goal.scale() : mean_weight;
    report_maximum(p, vertex, out.contacts, goal, force_unit, r);
    r.stop_reason = JAM_STOP_CONVERGED, out.status = JAM_OK;
    break;
  }
  wrap_positions(p);
  if (!r.maximum) take_rounding_out(p, find_pairs(p, RadiiTuning::least_room * unit, 1.0), bounds.least);
  r.saddles = pushes;
  out.notes = path.notes;
  r.steps = path.steps, r.factorisations = path.matrix.factorisations + matrix.factorisations;
  report_sizes(p, goal, weights, r);
  r.seconds = monitor.seconds();
  if (out.status == JAM_NOT_CONVERGED && out.text.empty())
    out.text = sentence(
        "the contacts of the maximum were not found after %lld Newton steps; the packing is the "
        "last one of the path",
        static_cast<long long>(r.steps));
  if (out.status == JAM_NOT_CONVERGED && wide >= 0)
    out.text = sentence(
        "sphere %d became as wide as the round wall, where its contact has no direction: the largest sum is approached "
        "to rounding, without a list of contacts; the packing is the last one of the path",
        wide);
  return out;
}

}  // namespace jam::inside
