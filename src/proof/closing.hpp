// Which contacts close together. Doubles cannot distinguish a gap of 1e-14 from a force of 1e-8; two doubles can.
#pragma once
#include "proof/scene.hpp"

namespace jam::inside {

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
  double least = 0.0;       // least relative gap of a pair that is no contact, as far as proof_tuning::near
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
// All pairs that are no contacts with relative gaps up to proof_tuning::near, except for a sphere and its own images.
std::vector<NearPair> near_pairs(const ProofScene &scene);
Expansion apart(const ProofScene &scene, const NearPair &pair, size_t component);  // of x_i - x_j + n A
double opening_of(const ProofScene &scene, const NearPair &pair);

// Rattlers that overlap, in two doubles: a place is free where a proof may put them.

// A rattler that overlaps moves to where all pairs that it nearly touches are open. Its cage may be far narrower than
// the overlap. pairs: near_pairs of the scene. False where no such place is found; then it overlaps as little as it
// can: a sphere that just fits touches others, and rounding is what stays of its overlap.
bool free_rattler(ProofScene &scene, int32_t i, const std::vector<NearPair> &pairs);

// All of them; whether one moved.
bool free_rattlers(ProofScene &scene);

}  // namespace jam::inside
