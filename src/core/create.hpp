// Makes a packing from checked arrays or by random sequential addition.
#pragma once
#include "core/notes.hpp"
#include "core/packing.hpp"

namespace jam::inside {

// Overlaps up to this fraction of sigma_ij are rounding of a file's digits, not a user's error.
constexpr double overlap_tolerance = 1e-12;
// Squared distances across the cell are rounded relative to the squared edge. So dynamics of a dilute gas leaves
// overlaps up to this part of a contact distance; of a thousand spheres near jamming it is 5e-15.
double overlap_of_long_flights(const Packing &p);

jam_create_options default_create_options();
// wall_time and memory_limit of the options, which bound work that comes before the rest is known.
void check_create_limits(const jam_create_options &o);
// Of a random start, where the options leave it open: below saturation, which falls with d (create.cpp), in time.
double default_packing_fraction(int dim);
// Checks everything jam_create documents; positions_len == 0 means a random sequential start.
// cell: rows of the cell vectors (dim, dim), or NULL for the cube of o.box. notes: NULL, or where changes are noted.
Packing make_packing(const jam_create_options &o, const double *positions, size_t positions_len,
                     const double *diameters, size_t diameters_len, const double *cell = nullptr,
                     Notes *notes = nullptr);
// An upper bound on the factor by which diameters must shrink to fit at any positions; 1 when they may fit already.
// Without this test a search for the worst pair would list images without end. Conditions: no sphere is wider than the
// box; no contact distance exceeds sqrt(d)/2 box, the largest distance of nearest images; the volume of the hard cores,
// which are (1 + Delta) sigma when Delta < 0, is at most that of the box. Mari-Kurchan spheres share space: there is no
// such bound on their volume.
double fitting_factor(const Packing &p);
// Throws JAM_E_OVERLAP naming the worst pair, or allows overlaps, as `policy` says.
void apply_overlap_policy(Packing &p, int32_t policy);
// JAM_OVERLAP_SHRINK: multiplies all diameters by the factor that brings the worst pair to contact, and notes it.
// JAM_E_OVERLAP where the factor is below `least`, or no factor helps.
void shrink_to_contact(Packing &p, double least, Notes *notes);
// Throws JAM_E_OVERLAP naming the worst pair, and how to mend it, where one overlaps by more than the tolerance.
void refuse_overlaps(const Packing &p, double tolerance);
// A random start with the ratios of the diameters at this packing fraction; 0: at the default, or where the spheres
// find no place in a narrow scene at a lower one, which is noted.
void start_at_random(Packing &p, double packing_fraction, Notes *notes);
// Independent uniform points (JAM_OVERLAP_ALLOW).
void place_uniformly(Packing &p);
// Random sequential addition, largest spheres first, at the diameters that p holds. JAM_E_UNPLACEABLE with
// the fraction reached when many tries find no place for one sphere.
void place_at_random(Packing &p);
// Mari-Kurchan start at equilibrium at any density (Krzakala and Zdeborova, J. Chem. Phys. 134, 034513 (2011)):
// uniform positions; then each pair draws its shift again until it does not overlap.
void plant(Packing &p);

// What every packing is, whatever made it. Entrances check it always; builds with JAM_CHECK_PAIRS, which are those of
// the tests under sanitizers, check it after every call that changes a handle.

// Throws `code`, with a text that names the value at fault, unless lengths agree, positions lie in the brick of the
// cell, diameters are within the limits and velocities too. Overlaps are another question.
void check_packing(const Packing &p, jam_status code);

// Throws `code` where a sphere is wider than the shortest period: pairs are no longer searched beyond nearest images.
void refuse_wider_than_periods(const Packing &p, jam_status code);

}  // namespace jam::inside
