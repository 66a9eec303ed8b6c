// The verdict on a packing: the one answer of jam_rigidity, the check, the report of a crunch, jam_flex, contacts from
// geometry and copies.
//
//   pairs that touch or may touch -> test of their rows -> rules (rules.hpp), in one order -> answer, rule, numbers
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
#include <vector>

#include "core/packing.hpp"
#include "network/contact_network.hpp"
#include "network/resolution.hpp"
#include "network/rigidity_test.hpp"
#include "verdict/overlaps.hpp"

namespace jam::inside {

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

}  // namespace jam::inside
