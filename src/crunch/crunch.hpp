// From any valid packing to a certified jammed one. Data flow:
//   packing -> [pairs -> LP -> checked answer -> safe step]* -> contact network -> polish -> certificate
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "core/monitor.hpp"
#include "core/packing.hpp"
#include "crunch/history.hpp"
#include "lp/newton_system.hpp"
#include "lp/packing_lp.hpp"
#include "network/certificate.hpp"
#include "network/contact_network.hpp"

namespace jam {

jam_crunch_options default_crunch_options();

struct CrunchResult {
  Packing packing;          // always valid: the last good state
  ContactNetwork contacts;  // of the last LP; empty if none was solved
  jam_crunch_report report{};
  jam_status status = JAM_OK;
  std::string text;  // why, when status < 0
};

// For tests alone: what no honest input does at will. Each may be empty.
struct CrunchSeams {
  std::function<void(LpSolution &, jam_lp_solver)> answer;  // an LP's answer before it is checked
  std::function<void(CrunchResult &)> attempt;              // of the path, before the chain is considered
  std::function<void(const Packing &, ContactNetwork &)> before_polish;
};

// options.cpp: throws for options that make no sense and for packings that cannot be crunched.
void check_options(const Packing &p, const jam_crunch_options &o);

// Throws for bad options, else never: the result carries the status. history may be NULL; it ends with the steps of the
// attempt that is returned.
CrunchResult crunch(const Packing &start, const jam_crunch_options &o, Monitor &monitor, History *history = nullptr,
                    const CrunchSeams *seams = nullptr);

// estimate.cpp: memory and work of a crunch before it runs. Throws for bad options.
jam_estimate estimate(const Packing &start, const jam_crunch_options &o);

// By how much the mean spacing of spheres, phi^(-1/d) diameters, exceeds that of a random jammed packing (0.84 in d =
// 2, about 0.64 * 0.7^(d-3) above): how far a sphere may have to travel. 0 when denser.
double free_spacing(const Packing &p);
// estimate.cpp: median gap of the d n nearest pairs, the contacts to be; 0.5 when there are not as many.
double contact_gap(const Packing &p);

// ---- parts, one file each

// step.cpp: moves p by alpha (s, g) with the largest alpha <= 1 for which no pair outside the list overlaps.
// Offsets follow when spheres are wrapped. s in units of sigma_unit. Returns alpha (0: even tiny steps overlap, which
// only bad input can do).
double take_step(Packing &p, PairList &pairs, double reach, const LpSolution &answer, double sigma_unit);

// network.cpp: rows of the LP that carry force in the answer, spheres with fewer than d + 1 of them removed again and
// again.
struct Network {
  std::vector<size_t> active;     // indices into the LP's pairs, between stable spheres
  std::vector<char> stable;       // n
  std::vector<int32_t> contacts;  // n, number of active pairs
  int64_t stable_count = 0;
};
std::vector<char> force_carrying(const PackingLp &lp, const LpSolution &answer);
Network find_network(const PackingLp &lp, const LpSolution &answer);
// Largest |s| over stable spheres after taking out their mean; over all spheres if none is stable.
double largest_step(const LpSolution &answer, const Network &network, int dim);
// Contacts with unit vectors, gaps and forces (from the multipliers) of the packing p.
ContactNetwork make_contacts(const Packing &p, const PairList &pairs, const LpSolution &answer, const Network &network);

// polish.cpp: closes the contacts by Newton steps on (positions, one common diameter factor) and projects the forces on
// the null space of S^T. Of more contacts than can close together it leaves out those that open when the others close;
// where they are too few to balance, a force turns negative or another pair would overlap it looks for the vertex
// (crossover.hpp). Changes nothing unless done: refuses when a contact does not close, and when no vertex is found.
// system is used anew: it need not hold the contacts' graph.
enum class PolishEnd { done, no_contacts, interrupted, open_contact, too_few, negative_force, overlap };
PolishEnd polish(Packing &p, ContactNetwork &contacts, NewtonSystem &system, int threads, Monitor *monitor = nullptr);

// Where a network has more contacts than one state of self-stress and the weakest carries less than 1e-5 of the mean
// force, that pair only touches as far as an LP can tell: takes it out. False when there is none.
bool drop_idle_contact(ContactNetwork &contacts, int dim);

}  // namespace jam
