// The verdict on a packing: the one answer of jam_rigidity, the check, the report of a crunch, jam_flex, contacts from
// geometry and copies.
//
//   pairs that touch or may touch -> test of their rows -> rules (rules.cpp), in one order -> answer, rule, numbers
//
// Contacts are all pairs with gaps below contact_gap_limit, and those of a list below undecided_gap_limit. In doubt are
// those of the list below listed_gap_limit, and pairs that rounding or the digits of coordinates cannot distinguish
// from contacts. Each rule may lower a yes or no to undecided, or raise undecided by a proof.
//
// A sphere and its own image keep their distance in a fixed cell. The collective test takes such pairs as contacts
// where a network of a free cell lists them, or where no other contacts balance but these do, on the cell too.
#pragma once
#include <optional>
#include <string>

#include "network/contact_network.hpp"
#include "network/resolution.hpp"
#include "network/rigidity_test.hpp"

namespace jam::inside {

// The verdict on a packing as it is: from positions, diameters and cell alone, and nothing moves.

// Overlaps before a verdict. Every test of jamming is of hard spheres, so diameters are reduced until none is left.
struct TestedPacking {
  Packing packing;  // no pair overlaps
  GapResolution resolution;
  double nearest_gap = 0.0;  // of the diameters as given; infinite where no pair is near
  double diameter_factor = 1.0;
  bool overlapping = false;  // by more than rounding and digits: the packing is another one than the given one
};
// Fails with JAM_E_OVERLAP above one half of a contact distance.
TestedPacking without_overlaps(const Packing &p);

// The report of a check that was left before it had a verdict.
jam_check_report blank_report();

struct CheckResult {
  jam_check_report report{};
  TestedPacking tested;
  ContactNetwork carrying;  // contacts with force of the verdict
};
// known: the network that is stored with the packing, or NULL.
CheckResult check_as_it_is(const Packing &p, const ContactNetwork *known = nullptr);

// What the answer rests on. In the order in which rules are tried.
enum class Rule {
  rows,               // the test of the contacts, all taken as closed
  doubtful_pairs,     // pairs in doubt, taken as closed, change it
  clearance,          // another pair closes before the flex has opened the contacts by more than their gaps
  slow_opening,       // the motion opens contacts by less than their gaps may turn them
  tight_pairs,        // pairs whose gaps are not wider than rounding prove it alone
  digits,             // the numbers have too few digits for a no
  single_sphere,      // held by its own images: whether forces balance on the cell
  open_contacts,      // a contact with force is open
  all_around,         // a sphere touches a round wall in every direction
  weak_forces,        // contacts with weak forces do not close together in two doubles
  trapped,            // proved in two doubles
  nearly_closed,      // nearly closed pairs would hold it
  moves_at_rest,      // strict: spheres move in the fixed cell
  own_images,         // collective: contacts with own images hold it in every strain, or may
  loose_in_the_cell,  // strict: not held in the fixed cell, which contradicts a yes
  overlaps,           // spheres overlapped by more than rounding, and smaller ones were tested
  unbalanced          // a crunch: the forces of its network do not balance
};

// What an answer rests on.
struct Evidence {
  RigidityResult result;                              // of the contacts: forces, counts, motions
  ContactNetwork contacts;                            // all that the test examined, force as in result
  std::vector<int32_t> sphere;                        // node of result.flex -> sphere
  int64_t undecided_contacts = 0;                     // of `contacts` that are open by contact_gap_limit or more
  Verdict answer_if_all_closed = Verdict::undecided;  // with all pairs in doubt closed
  // The least force of an undecided packing whose contacts do not close together in two doubles; else 0.
  double unresolved = 0.0;
  std::string unresolved_because;  // what might decide it and could not be tried, as the end of a sentence; or empty
  // The carrying contacts and their forces: the network that crunch and analysis continue with.
  ContactNetwork carrying(int dim) const { return subset(contacts, result.carrying, dim); }
};

struct PackingVerdict : Evidence {
  Verdict jammed = Verdict::undecided;
  Rule rule = Rule::rows;  // of those that changed the answer the last one
  // What a rule says, if it says anything: it may undo an answer, or give one where there is none. Nothing else changes
  // the answer.
  void hear(Rule speaker, std::optional<Verdict> says);
};

// Whether a sphere may touch its own image.
bool may_touch_own_image(const Packing &p, const GapResolution &resolution);

// Both questions about one packing. They share their tests, each of which is made when it is needed.
class JammingTest {
 public:
  // known: the network that is stored with the packing, or NULL. Positions alone say which spheres touch, except for
  // own images. A "no" becomes "undecided" if some pairs touch and the packing would be jammed with its nearly closed
  // pairs closed (pairs of the known network, or those before the largest jump of gaps).
  JammingTest(const TestedPacking &tested, const ContactNetwork *known) : tested_(tested), known_(known) {}
  const PackingVerdict &verdict(Jamming kind) { return kind == Jamming::strict ? strict() : collective(); }

 private:
  const PackingVerdict &collective();
  const PackingVerdict &strict();
  const PackingVerdict &alone(Jamming kind);

  const TestedPacking &tested_;
  const Packing &p_ = tested_.packing;
  const GapResolution &resolution_ = tested_.resolution;
  const ContactNetwork *known_;
  std::optional<PackingVerdict> alone_[2], final_[2];
};
PackingVerdict verdict_of(const TestedPacking &tested, const ContactNetwork *known, Jamming kind);

// The verdict of the rules up to `last` on the contacts that a list names, as closed as they are: what a phase of a
// crunch follows from. listed: may be NULL.
PackingVerdict test_packing(const Packing &p, const GapResolution &resolution, const ContactNetwork *listed,
                            Jamming kind, Rule last = Rule::all_around);
PackingVerdict test_packing(const Packing &p, const ContactNetwork *listed, Jamming kind, Rule last = Rule::all_around);

// Copies of a packing side by side: what their rows say at all wave vectors.
struct CopiesEvidence {
  bool empty = false;         // no contact carries force
  int64_t flexes_of_one = 0;  // at the wave vector 0
  int64_t flexes = 0;         // at all
  bool clear = false;         // a flex opens its contacts before other pairs close
  bool closed = false;        // all contacts are
  double margin = 0.0;        // least eigenvalue that is no translation
};
Verdict verdict_of_copies(const PackingVerdict &one_cell, const CopiesEvidence &evidence);

// The clearance of a flex. Contacts that carry force open by the square of its length alone. A flex proves "not jammed"
// only if, before another pair closes, it opens the force-bearing contacts by more than their present gaps.

// Pairs that a flex of `carrying` contacts can close before it is as long as it must be, none of them one of `taken`.
// That length is the square root of the widest gap of the carrying contacts, or of a rounding. strain: of the cell,
// too; own_images: of a sphere with itself, which a fixed cell keeps apart.
ContactNetwork blocking_pairs(const Packing &p, const ContactNetwork &carrying, const ContactNetwork &taken,
                              bool strain, bool own_images);

// Whether no pair blocks the flex of a no, `taken` being the contacts of v that count as closed. If one does, a flex
// that keeps these pairs as well is searched for, and replaces it.
bool find_unblocked_flex(const Packing &p, const std::vector<char> &taken, Jamming kind, PackingVerdict &v);

// A motion of some spheres and a strain (empty: none), the largest displacement 1.
struct StraightMotion {
  const std::vector<int32_t> &sphere;
  const std::vector<double> &flex, &strain;
};
// Whether it leads in a straight line over this length, in mean diameters, without an overlap beyond rounding. False
// between round walls and for no motion.
bool leads_free(const Packing &p, const StraightMotion &motion, double length);

// The fraction of the flex of v along which no pair that touches overlaps beyond rounding: 1, or less where positions
// are noisy and the flex closes contacts at the rate of that noise. 0 where it is shorter than the flex must be.
double unblocked_fraction(const Packing &p, const PackingVerdict &v);

// The rules of a verdict. Each examines one packing and one kind of jamming, and gives an answer or nothing.

// One flag a pair of PackingVerdict::contacts.
struct PairFlags {
  std::vector<char> closed;        // taken as a contact
  std::vector<char> maybe_closed;  // that, or in doubt
  std::vector<char> listed;        // by the list that was given
};

// What rules work on: the packing, the pairs that were tested, and the verdict so far.
struct JammingCase {
  const Packing &p;
  const GapResolution &resolution;
  const ContactNetwork *known;  // stored with the packing, or NULL
  const Jamming kind;
  const bool overlapping;
  PairFlags pairs;
  RigidityMatrix rows;  // of all pairs
  PackingVerdict v;
  const PackingVerdict *other = nullptr;  // the verdict of the other kind, for the rules between them
};

using Says = std::optional<Verdict>;
struct RuleOf {
  Rule rule;
  Says (*says)(JammingCase &);
};
// Tries those of the table between two rules, these included, in order.
void try_rules(JammingCase &c, Rule first, Rule last);

// A yes that rests on weak forces, of more contacts than one state of self-stress has: doubles cannot
// distinguish such forces from gaps. Where contacts do not all close, the network of those that close together, and
// hold their spheres, takes its place. Where they do not hold them, or exchanges come to no end, nothing is decided: a
// saddle, as far as two doubles show.
Says recheck_weak_forces(JammingCase &c);
// Undecided contacts that carry force: a yes where proof/newton.hpp proves that their spheres are trapped. Soft modes
// that doubles cannot distinguish from flexes are decided so.
Says raise_if_trapped(JammingCase &c);

}  // namespace jam::inside
