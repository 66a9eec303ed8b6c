#include "crunch/barrier_schedule.hpp"

#include <algorithm>
#include <limits>

namespace jam {
namespace {

// Squared Newton decrement a row below which the maximum counts as reached. Looser values leave the path.
constexpr double reached = 0.005;
// The point reached is a saddle, and mu is warmed up, after so many Newton steps at one mu or after `cut` of them
// that ended before half their length and left the decrement where it was, since it last fell by `fall`: down the
// valley steps are longer at larger mu. Of more than `many` rows more are in the way, one or a few with each step, and
// both take as much longer. But mu falls where the decrement is within `all_but` of the maximum's: a few of very many
// spheres hold up the rest; and after `flow` steps with a duality gap above `hot`, which is a slow flow.
constexpr int stuck = 40, cut = 8, flow = 15;
constexpr double fall = 0.6, many = 5e4, all_but = 4.0, hot = 1e-3;
// By how much: little, so that what the rest of a large packing has reached is kept; more where that led back to a
// saddle as warm as `again` times the last one.
constexpr double reheat = 10.0, reheat_again = 100.0, again = 0.5;
// A start colder than its forces can balance at creeps along the walls: after so many steps in a row it is warmed up by
// `warm`.
constexpr int creeps = 4, most_warmed = 3;
constexpr double warm = 10.0;

}  // namespace

double BarrierSchedule::before(const Step &last) {
  creeping_ = last.balance > 0.5 && last.part < 0.1 && last.trust < 0.5 ? creeping_ + 1 : 0;
  double factor = 1.0;
  if (creeping_ >= creeps && warmed_ < most_warmed && !centred_once_) factor = warm, at_mu_ = creeping_ = 0, ++warmed_;
  if (at_mu_ == 0) cuts_ = 0, least_ = mark_ = std::numeric_limits<double>::infinity();
  // The first steps at a new mu may be short; many spheres make all steps short, but on no saddle the decrement falls.
  const bool falls = last.decrement < 0.9 * least_;
  if (at_mu_ > 0) {
    least_ = std::min(least_, last.decrement);
    if (last.decrement < fall * mark_) cuts_ = 0, mark_ = last.decrement;
  }
  if (at_mu_ > 2 && last.part < 0.5 && !falls) ++cuts_;
  ++at_mu_;
  return factor * turn(last);
}

// After too long at one mu.
double BarrierSchedule::turn(const Step &last) {
  const bool flows = last.gap > hot;
  const bool nearly = last.decrement < all_but * reached * last.rows;
  const double patience = nearly || last.last ? 1.0 : std::max(1.0, last.rows / many);
  if (flows ? at_mu_ <= flow : at_mu_ <= stuck * patience && cuts_ < cut * patience) return 1.0;
  at_mu_ = 0;
  if (flows || nearly) return shrink;
  ++reheats_;
  const bool same = last.gap > again * saddle_;
  saddle_ = last.gap;
  return same ? reheat_again : reheat;
}

bool BarrierSchedule::centred(double decrement, double rows) {
  if (!(decrement < reached * rows)) return false;
  at_mu_ = 0, centred_once_ = true;
  return true;
}

}  // namespace jam
