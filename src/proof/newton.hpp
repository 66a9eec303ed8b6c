// Newton's steps towards the exactly jammed packing, on positions of two doubles.
#pragma once
#include "linalg/block_cholesky.hpp"
#include "proof/scene.hpp"

namespace jam::inside {

// M = R^T R of the rows of a proof, with the pinned sphere held, its factor, and a proved lower bound of the smallest
// singular value of R.

class NormalMatrix {
 public:
  NormalMatrix(const ProofScene &scene, const ProofEquations &equations);
  NormalMatrix(const NormalMatrix &) = delete;
  NormalMatrix &operator=(const NormalMatrix &) = delete;
  // False where R^T R is singular to rounding. The other functions need true.
  bool factorise();
  // v (nodes, dim) with R v nearest to y, refined to double precision; 0 at the pinned node.
  std::vector<double> nearest(const std::vector<double> &y) const;
  // f := the nearest to it with R^T f = 0, strict with R^T f = the gradient of log V.
  void project_on_balance(std::vector<double> &f) const;

  // The smallest eigenvalue of M is at least `singular`^2. A factorisation L L^T of M - mu without a lost pivot has
  // |M - mu - L L^T| <= gamma_(k + 4) |L| |L^T|, k the longest row of L (Higham, ch. 10), so that
  // eigenvalue >= mu - that error. 0 where no mu can be shown.
  struct Bound {
    double singular = 0.0;    // at or below the smallest singular value of the exact R
    double eigenvalue = 0.0;  // estimate of the smallest eigenvalue of M
    double rounding = 0.0;    // what the error bounds take off mu
  };
  Bound bound();

 private:
  double smallest_eigenvalue() const;
  void pin(std::vector<double> &v) const;
  double forming_error() const;
  const ProofScene &scene_;
  const ProofEquations &equations_;
  BlockMatrix m_;
  std::unique_ptr<ShiftedFactor> factor_;
};

// The step J u = -F from the scene's numbers, J = [R, -sigma^2]: v (ends, dim) and that of Gamma. With one state of
// self-stress f it solves all equations; with more of them it solves them as nearly as it can.
struct NewtonStep {
  std::vector<double> v;
  double gamma = 0.0;
};
NewtonStep newton_step(const ProofScene &scene, const ProofEquations &equations, const NormalMatrix &normal);
// Adds it to positions and Gamma of the scene, in two doubles. Rattlers stay.
void take_step(ProofScene &scene, const NewtonStep &step);

// The part of the forces with R^T f = 0, scaled to sum f sigma^2 = 1; strict with R^T f = the gradient of log V.
void refine_forces(ProofScene &scene, const ProofEquations &equations, const NormalMatrix &normal);

// Newton's steps until |F| stops falling, whether or not it can become 0. False where rows are dependent.
bool approach_closure(ProofScene &scene, ProofEquations &equations);

// Newton's steps until |F| stops falling. Returns the equations at the end; forces are refined too. A packing whose
// rows are dependent is left as it is: false.
bool refine(ProofScene &scene, ProofEquations &equations);

// Crystals: contacts that close exactly at the written doubles, with more of them than unknowns.

// Whether one Gamma makes every F_c exactly 0 at the scene's centres, to the last bit. Then Gamma is that.
bool close_exactly(ProofScene &scene);
// Forces that are equal except for rounding become equal, so that those of a crystal balance exactly.
void equal_forces(ProofScene &scene);

// The proof of a network, in two doubles.

// What is proved of a packing: that an exactly jammed one lies within a radius of it (existence), or that no motion
// without overlap leads away from it (trapping). Constants and proofs: bindings/docs/proof_theory.md.
//
//   scene -> Newton -> F, R, f -> [smallest singular value] -> existence -> open gaps
//                                                           -> trapping
//
// Every number in a Proof is rounded outward. All lengths are in the scene's unit.
enum class ProofCause { none = 0, excess = 1, force = 2, gap = 3, singular = 4, rattler = 5, images = 6, saddle = 7 };

struct Proof {
  bool exact = false, trapped = false;
  bool closed = false;                  // exact since all F_c are 0 as they stand: a crystal
  ProofCause cause = ProofCause::none;  // why it is not exact
  double cause_value = 0.0, cause_bound = 0.0;
  double radius = 0.0, gamma_radius = 0.0;       // of existence, in all unknowns and in Gamma
  double least_force = 0.0, force_radius = 0.0;  // over the mean force
  double least_gap = 0.0;                        // relative, of all pairs that are no contacts
  NormalMatrix::Bound bound;
  double inner = 0.0, outer = 0.0;  // no packing as dense between these distances
};

// The scene as refine() leaves it.
Proof prove(const ProofScene &scene, const ProofEquations &equations);

// Refines and tries to prove. If that fails, tries again with only the contacts that close together. On return `scene`
// is the one that was proved, or the last tried. False where rows are dependent and it is not refined.
bool find_proof(ProofScene &scene, ProofEquations &equations, Proof &proof);

// The equations and forces that balance where the contacts are. False where one of them would pull.
bool balance(ProofScene &scene, ProofEquations &equations);

// Which contacts close together. Doubles cannot distinguish a gap of 1e-14 from a force of 1e-8; two doubles can.

// The largest Gamma near a packing, to two doubles, by linear programs in doubles.

// Each LP of displacements counts gaps in units of its step, and the next step is shorter by what LPs leave (A. M.
// Gleixner, D. E. Steffy, K. Wolter, INFORMS J. Comput. 28, 449 (2016)). Linear gaps are never wider than true ones, so
// that no step makes an overlap. At the end contacts are all pairs that are closed, with the multipliers of the last LP
// as forces, some of them 0. Directions in which multipliers are below the tolerance of an LP (1e-9 of the mean) stay
// open: the contacts then leave a flex. The scene is as it was without Clp, above proof_tuning::largest_lp rows, and
// where steps come to no end.
enum class LpsEnd { closed, without_clp, too_many_rows, no_end };
LpsEnd close_by_lps(ProofScene &scene);

// The dual simplex method for the largest Gamma, in two doubles: Newton's steps, and exchanges of contacts with gaps
// that stay for pairs that overlap, until all listed contacts close and no other pair of stable spheres overlaps.
// Forces may vanish. Where exchanges come to no end, LPs do the same, with rattlers in them.
// `endless`: these end neither, and the scene is as it was; lps, which may be NULL, says why.
enum class Exchange { endless, same, changed };
Exchange close_together(ProofScene &scene, LpsEnd *lps = nullptr);

// After close_together, where the contacts are closed: forces in the middle of all states of self-stress, on the
// contacts that have some; and rattlers move out of overlaps. `held`: the test of jamming finds these forces, and no
// flex. `unchanged`: there was no end, and the scene is as it was.
enum class Settled { unchanged, changed, held };
Settled finish_exchange(ProofScene &scene, Exchange end);

// Adds the forces of the contacts that close to a small part of those in the middle: pairs that are not quite closed
// carry little then, and a proof allows for their gaps.
void mix_in_forces_of_closed(ProofScene &settled, const ProofScene &closed);

// Contacts that others imply, in d = 2: flowers of seven equal disks, patches of triangles and parallelograms.

// As many implied contacts as there are over one state of self-stress, or none. Where all other contacts are closed
// exactly, these are closed too: each is one side of a polygon whose other sides sum, by exact angles, to a vector of
// the contact's length (bindings/docs/proof_theory.md).
std::vector<ImpliedContact> find_implied(const ProofScene &scene);

// All pairs that are no contacts stay apart, wherever the exact packing lies within its radius.

struct OpenGaps {
  bool open = false;
  bool of_rattler = false;  // the pair that is not open has a rattler
  double least = 0.0;       // least relative gap of a pair that is no contact, as far as proof_tuning::far_above
  bool all_seen = false;    // no pair was left out, and no sphere reaches its own image
  double overlap = 0.0;     // by how much growth has to fall, to first order, until none of these pairs overlaps; or 0
};
// Every image: |r|^2 - 2 |r|_1 radius m > gamma sigma^2, m the number of stable spheres of the pair, strict with the
// number of cell vectors between them; and no sphere reaches its own image. At a round wall
// |r|^2 + 2 |r|_1 radius m + (radius m)^2 < (W - g s)^2, and W > g s of all spheres. growth: at or above that of the
// exact packing.
OpenGaps open_gaps(const ProofScene &scene, double radius, double growth);

struct NearPair {
  int32_t i, j;                // spheres, i <= j; j < 0: a wall
  std::vector<int32_t> image;  // n of x_i - x_j + n A
  double opening;              // |r|^2 / sigma^2 - Gamma at the scene's exact numbers, rounded once
};
// All pairs that are no contacts with relative gaps up to proof_tuning::far_above, except for a sphere and its own
// images.
std::vector<NearPair> near_pairs(const ProofScene &scene);
Expansion apart(const ProofScene &scene, const NearPair &pair, size_t component);  // of x_i - x_j + n A
double opening_of(const ProofScene &scene, const NearPair &pair);

// Rattlers that overlap, in two doubles: a place is free where a proof may put them.

// A rattler that overlaps moves to where all pairs that it nearly touches are open. Its cage may be far narrower than
// the overlap. pairs: near_pairs of the scene. False where no such place is found; then it overlaps as little as it
// can: a sphere that just fits touches others, and rounding is what stays of its overlap.
bool free_rattler(ProofScene &scene, int32_t i, const std::vector<NearPair> &pairs);

// All of them.
void free_rattlers(ProofScene &scene);

}  // namespace jam::inside
