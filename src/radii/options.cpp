#include "radii/maximise.hpp"

#include <algorithm>
#include <cmath>

#include "core/create.hpp"
#include "core/limits.hpp"
#include "radii/tuning.hpp"
#include "radii/vertex.hpp"

namespace jam::inside {

double mean_weight(const double *weights, size_t n) {
  double mean = 0.0;
  for (size_t i = 0; i < n; ++i) mean += weights[i] / static_cast<double>(n);
  return mean;
}

std::vector<double> exponents_of(const jam_radii_options &o) {
  const double all[] = {o.exponent_1, o.exponent_2, o.exponent_3, o.exponent_4};
  return {all, all + o.moments};
}

// A sum lets every radius grow, moments may let one vanish: they have a lower bound of their own.
RadiiBounds bounds_of(const Packing &p, const jam_radii_options &o) {
  RadiiBounds out{o.radius_min, o.radius_max};
  const bool edges = (o.strain & JAM_STRAIN_EDGES) != 0, tilts = (o.strain & JAM_STRAIN_TILTS) != 0;
  out.strain = strain_basis(p.dim, edges, tilts, ~p.container.closed());
  for (double &component : out.strain.matrices) component /= radii_unit(p);
  out.volume = p.cell.volume();
  if (o.moments == 0) return out;
  const auto [low, high] = std::minmax_element(p.diameter.begin(), p.diameter.end());
  const double least = 0.5 * std::max(RadiiTuning::least_radius * *low, RadiiTuning::least_ratio * *high);
  out.least = std::max(o.radius_min, least);
  return out;
}

namespace {

// The search divides by weights over their mean, which must not underflow.
void check_weights(const Packing &p, const double *weights, size_t weights_len) {
  if (weights_len && weights_len != p.n())
    fail(JAM_E_ARGUMENT, "weights_len is %zu, it must be 0 or n = %zu", weights_len, p.n());
  for (size_t i = 0; i < weights_len; ++i)
    if (!(weights[i] > 0.0 && weights[i] <= RadiiTuning::most_weight))
      fail(JAM_E_ARGUMENT,
           "weights[%zu] is %g, it must be positive and at most %g: without a weight a radius has no value", i,
           weights[i], RadiiTuning::most_weight);
  const double mean = mean_weight(weights, weights_len);
  for (size_t i = 0; i < weights_len; ++i)
    if (!std::isnormal(weights[i] / mean))
      fail(JAM_E_ARGUMENT, "weights[%zu] is %g and the mean weight %g: no double holds the quotient to all digits", i,
           weights[i], mean);
}

void check_moments(const Packing &p, const jam_radii_options &o, size_t weights_len) {
  if (o.moments < 0 || o.moments > 4)
    fail(JAM_E_ARGUMENT, "moments is %lld, it must be 0 .. 4", static_cast<long long>(o.moments));
  if (o.moments == 0) return;
  if (weights_len)
    fail(JAM_E_ARGUMENT, "weights and moments: a sum has weights, moments have none; leave one of them out");
  const std::vector<double> q = exponents_of(o);
  for (size_t k = 0; k < q.size(); ++k) {
    if (!(std::fabs(q[k]) >= RadiiTuning::least_exponent && std::fabs(q[k]) <= RadiiTuning::most_exponent))
      fail(JAM_E_ARGUMENT,
           "exponent_%zu is %g, its size must be %g to %g: the moment of exponent 0 is the number of spheres", k + 1,
           q[k], RadiiTuning::least_exponent, RadiiTuning::most_exponent);
    for (size_t j = 0; j < k; ++j)
      if (std::fabs(q[j] - q[k]) < RadiiTuning::least_exponent * (1.0 - 1e-9))  // of doubles nearest to decimals
        fail(JAM_E_ARGUMENT, "exponent_%zu is %g and exponent_%zu %g: nearer than %g they count as one moment twice",
             j + 1, q[j], k + 1, q[k], RadiiTuning::least_exponent);
  }
  const auto [low, high] = std::minmax_element(p.diameter.begin(), p.diameter.end());
  const RadiiBounds bounds = bounds_of(p, o);
  if (!(0.5 * *low * (1.0 - o.room) > bounds.least && 0.5 * *high < bounds.most))
    fail(
        JAM_E_ARGUMENT,
        "radii from %g, less the room of %g, to %g are not between radius_min %g and radius_max %g: moments start from "
        "radii that are",
        0.5 * *low, o.room, 0.5 * *high, bounds.least, bounds.most);
  const RadiiGoal named(p, q);  // refuses radii that moments fix
}

}  // namespace

jam_radii_options default_radii_options() {
  jam_radii_options o{};
  o.struct_size = sizeof o;
  o.threads = 1;
  o.room = RadiiTuning::room;
  o.radius_max = o.wall_time = std::numeric_limits<double>::infinity();
  o.max_steps = 100000;
  o.exponent_1 = 1.0, o.exponent_2 = 2.0, o.exponent_3 = 3.0, o.exponent_4 = 4.0;
  return o;
}

void check_radii(const Packing &p, const jam_radii_options &o, const double *weights, size_t weights_len) {
  check_threads(o.threads);
  check_at_least(o.max_steps, 1, "max_steps");
  check_positive(o.wall_time, "wall_time");
  check_strain(o.strain, "a maximum of radii");
  if (o.strain != JAM_STRAIN_NONE) refuse_closed(p, 2, "a maximum of radii that changes the cell at fixed volume");
  if (!(o.room > 0.0 && o.room < 1.0)) fail(JAM_E_ARGUMENT, "room is %g, it must be above 0 and below 1", o.room);
  check_not_negative(o.radius_min, "radius_min");
  if (!(o.radius_max > o.radius_min))
    fail(JAM_E_ARGUMENT, "radius_max is %g and radius_min %g: radii have no room between them", o.radius_max,
         o.radius_min);
  double longest = 0.0;
  for (int c = 0; c < p.dim; ++c) longest = std::max(longest, p.cell.edge(c));
  if (!(2.0 * o.radius_min <= longest))
    fail(JAM_E_ARGUMENT, "radius_min is %g, no sphere of it has room in a cell whose longest edge is %g", o.radius_min,
         longest);
  if (!(2.0 * o.radius_max >= limits::diameter_min * longest))
    fail(JAM_E_ARGUMENT,
         "radius_max is %g, diameters of at least %g of the longest edge of the cell (%g) are supported", o.radius_max,
         limits::diameter_min, longest);
  check_weights(p, weights, weights_len);
  if (p.model == JAM_MODEL_MK || p.non_additivity != 0.0)
    fail(JAM_E_UNSUPPORTED,
         "radii are unknowns of additive Euclidean spheres alone: no Mari-Kurchan shifts, no "
         "non_additivity");
  if (p.dim >= JAM_MAX_DIM)
    fail(JAM_E_UNSUPPORTED, "radii are unknowns in d = 2 to %d, this packing has d = %d", JAM_MAX_DIM - 1, p.dim);
  check_moments(p, o, weights_len);
  refuse_overlaps(p, overlap_tolerance);
}

}  // namespace jam::inside
