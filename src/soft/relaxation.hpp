// Minimising the energy of soft spheres. Data flow:
//   state -> L-BFGS until contacts settle -> Newton on the stable spheres -> balance of forces
#pragma once
#include <algorithm>
#include <limits>

#include "core/error.hpp"
#include "core/monitor.hpp"
#include "linalg/block_cholesky.hpp"
#include "soft/soft_state.hpp"

namespace jam::inside {

// Why a descent ended.
enum class DescentEnd {
  balanced,     // max |F_i| over the mean force is below the tolerance
  no_overlaps,  // the energy is 0, at no pressure
  limit,        // evaluations are used up
  interrupted,  // cancelled, or wall time is over
  yields,       // the cell strains on and on: it cannot hold the stress
  stalled,      // the method made no progress
  rounding      // what forces leave is rounding
};
// Whether spheres overlap, and no limit ended the descent: another cell or pressure may follow.
inline bool can_continue(DescentEnd end) {
  return end == DescentEnd::balanced || end == DescentEnd::stalled || end == DescentEnd::rounding;
}

// What has been spent, and when to stop; shared by all parts of a call.
struct Effort {
  Monitor *monitor = nullptr;
  int32_t phase = 0;            // jam_phase that is reported
  int64_t max_evaluations = 0;  // that `evaluations` may reach
  int64_t evaluations = 0, factorisations = 0;
  int64_t steps = 0;
  double packing_fraction = 0.0, pressure = 0.0;  // reported

  void allow(int64_t more) {
    max_evaluations = evaluations + std::min(more, std::numeric_limits<int64_t>::max() - evaluations);
  }
};

// f(), which factorises the Hessian; `without` where its factor exceeds the memory of the call, which the log says.
template <class F>
bool if_it_fits(const Effort &effort, bool without, F &&f) {
  try {
    return f();
  } catch (const Error &e) {
    if (e.code() != JAM_E_MEMORY) throw;
    if (effort.monitor) effort.monitor->log(JAM_LOG_INFO, "without the Hessian: %s", e.what());
    return without;
  }
}

// A state, its forces and sums at the present displacements.
class Relaxation {
 public:
  Relaxation(SoftState &state, Effort &effort) : state(state), effort(effort), start(state.base().cell) { evaluate(); }

  // Takes in changed displacements.
  void evaluate() {
    state.moved();
    sums = state.evaluate(force);
    if (sums.overlap > 0.0) stiffness = sums.stiffness(state.energy().alpha());
    ++effort.evaluations;
  }
  // No overlaps, and no pressure that brings some. All together below the rounding of one coordinate are none: no
  // minimiser can take them away.
  bool at_rest() const {
    const double none = std::numeric_limits<double>::epsilon() * state.base().cell.side();
    return (sums.energy == 0.0 || sums.overlap < none) && !(state.cell().pressure > 0.0);
  }
  // Largest |F_i| over the mean force: of all spheres, and of stable ones. In a free cell the stress counts too.
  double residual() const;
  double stable_residual() const;
  // Whether rounding may be all of this residual, and keeps the tolerance from being met.
  bool at_rounding(double residual, double tolerance) const;
  // Whether rounding of the coordinates may have made all overlaps, at no pressure.
  bool open() const;
  // open(), or the residual is below the tolerance or, where contacts have settled, below what rounding of the
  // coordinates leaves of it.
  bool rounded(double tolerance) const;
  // Rounds positions and counts displacements from there, if rounding of long displacements keeps the residual above
  // the tolerance. True: it did.
  bool renew_origin(double residual, double tolerance);
  // Called once an evaluation: true when the descent must end, with the reason in `end`. The monitor is asked now and
  // then, or where steps are long at every one.
  bool must_stop(DescentEnd &end, bool long_steps = false) const;
  // Whether a cell under loads that no energy bounds has strained too far to come to rest, or is narrower than a
  // radius. Its packing is refused, and lists of pairs grow as the period falls.
  bool yields() const;

  SoftState &state;
  Effort &effort;
  std::vector<double> force;  // (blocks, dim)
  SoftSums sums;
  Cell start;
  double stiffness = 1.0;  // typical one of a contact, when there last was one

 private:
  // Residuals that rounding may leave: with displacements of 0, with those of now, and with coordinates in doubles.
  struct Roundings {
    double always, now, coordinates;
  };
  Roundings roundings() const;
};

// Each minimises until max |F_i| of stable spheres over the mean force is below the tolerance.
DescentEnd fire(Relaxation &r, double tolerance);
DescentEnd lbfgs(Relaxation &r, double tolerance);
// near_minimum: begins with Newton's method. convex: that the last factor of the Hessian was positive as it is; kept
// without one.
DescentEnd hybrid(Relaxation &r, double tolerance, bool near_minimum, bool &convex);

// Moves every sphere that has fewer than d + 1 contacts to where its nearest neighbours are as far as they can be.
// Spheres that first-order methods leave against their cage flicker between contact and none, and stop Newton's method.
void centre_rattlers(SoftState &state);

// The Hessian of soft spheres with pre-stress on the stable spheres, and its factor.

class SoftHessian {
 public:
  // Factorises the Hessian of these contacts plus the smallest shift of shift * 10^k that makes it positive definite.
  // `on`: stable_contacts(). One stable sphere is tied to its place, for the translations, and rattlers by a weak
  // spring to theirs. False when no shift is enough.
  bool factorise(const SoftState &state, const SoftContacts &contacts, const std::vector<char> &on, double shift,
                 int64_t &factorisations);
  // Numbers that its factor would have, without computing it.
  size_t factor_numbers(const SoftState &state, const SoftContacts &contacts, const std::vector<char> &on);
  // x: displacements, and behind them the strains of a free cell.
  void solve(std::vector<double> &x) const;
  // Whether these are the contacts of the last factorisation.
  bool has_contacts(const SoftState &state, const SoftContacts &contacts) const;
  double shift() const { return shift_; }  // that was needed, in units of the typical stiffness

 private:
  void assemble(const SoftState &state, const SoftContacts &contacts, const std::vector<char> &on);
  void add_border(const SoftState &state, const SoftContacts &contacts, const CellStrain &strain, size_t contact);
  // False when the matrix with the strains is not positive definite.
  bool factorise_border(double shift);

  BlockCholesky cholesky_;
  std::vector<int32_t> ei_, ej_;
  std::vector<double> diag_, off_;
  // Strains: their columns (spheres, strains), these by the inverse of the matrix of spheres, what couples strains to
  // strains, and the inverse of its Schur complement.
  size_t strains_ = 0;
  std::vector<double> border_, border_solved_, corner_, schur_;
  std::vector<int32_t> analysed_i_, analysed_j_;
  double unit_ = 1.0, shift_ = 0.0;
};

}  // namespace jam::inside
