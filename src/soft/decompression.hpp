// From overlapping spheres down to jamming. Data flow:
//   minimum -> estimate of R_J -> smaller diameters, predicted displacements -> minimum -> ... -> 1SS -> crunch
//   compares
#pragma once
#include <array>
#include <functional>

#include "network/contact_network.hpp"
#include "soft/relaxation.hpp"

namespace jam::inside {

jam_relax_options default_relax_options();
jam_decompress_options default_decompress_options();
void check_relax_options(const jam_relax_options &o);
void check_decompress_options(const jam_decompress_options &o);

// A soft packing at its minimum, rounded to doubles; the network has the digits beyond.
struct SoftResult {
  Packing packing;
  ContactNetwork contacts;  // of stable spheres, with stiffnesses
  jam_relax_report report{};
  jam_status status = JAM_OK;
};

// Throws for bad options, and where memory lacks or the search for pairs of the start is cancelled.
SoftResult relax(const Packing &start, const jam_relax_options &o, Monitor &monitor);

constexpr size_t soft_columns = JAM_SOFT_SECONDS + 1;
using SoftRow = std::array<double, soft_columns>;

// A soft packing beside the jammed one that a crunch made from just below contact; unknown where that did not end.
struct SoftComparison {
  int32_t same_network = -1;
  int64_t common_contacts = -1;
  double packing_fraction = std::numeric_limits<double>::quiet_NaN(), force_difference = packing_fraction;
  double seconds = 0.0;
};

struct DecompressionResult {
  SoftResult soft;  // the last minimum
  std::vector<SoftRow> history;
  jam_decompress_report report{};
  jam_status status = JAM_OK;
};

// compare: called at a 1SS network; empty: not asked.
DecompressionResult decompress(const Packing &start, const jam_decompress_options &o, Monitor &monitor,
                               const std::function<SoftComparison(const SoftResult &)> &compare);

// ---- parts

// What is known of a soft packing, in the report of a crunch.
jam_crunch_report soft_certificate(const SoftResult &soft, double seconds);
// With the largest diameters at which no pair overlaps.
Packing just_below_contact(const SoftResult &soft);
// Contacts that both have, and the largest difference of their forces where all are the same. report: of the crunch
// that made `hard`.
SoftComparison compare_with_jammed(const ContactNetwork &soft, const ContactNetwork &hard,
                                   const jam_crunch_report &report);
// Measures a state at its minimum: report without what was spent, network.
SoftResult measure(SoftState &state, int32_t minimiser);
// The state of a start; its search for pairs may be left by Cancelled.
SoftState first_state(const Packing &p, const PairEnergy &energy, int32_t precision);
// Minimises by a jam_minimiser. near_minimum, convex: as of hybrid().
DescentEnd minimise(Relaxation &r, int32_t minimiser, double tolerance, bool near_minimum, bool *convex = nullptr);
// The same, and measures what is handed out: balanced means that its residuals are below the tolerance.
DescentEnd minimise_and_measure(Relaxation &r, int32_t minimiser, double tolerance, bool near_minimum, SoftResult &out);
// Whether forces balance and the energy falls in some direction. convex: the Hessian is known to be positive.
bool is_saddle(const Relaxation &r, const SoftResult &found, bool newton, bool convex);
// end: of the minimum in the fixed cell. Shrinks a cell without overlaps until spheres overlap, and lowers a pressure
// far above that of `cell` in steps, minimising to the tolerance or to RelaxTuning::before_strain at each.
DescentEnd approach_pressure(Relaxation &r, const FreeCell &cell, int32_t minimiser, double tolerance, DescentEnd end);
// Status and stop reason of a minimum.
jam_status status_of(DescentEnd end, const Monitor &monitor, int32_t &stop_reason);
// Overlaps, relative to the contact distance, that the rounding of positions hides.
double overlap_resolution(const Packing &p);
// Multiplies all diameters by exp(growth) and moves spheres by the part of the linear response that lowers the energy
// most.
void follow_growth(SoftState &state, double growth, Effort &effort);

}  // namespace jam::inside
