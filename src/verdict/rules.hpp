// The rules of a verdict. Each examines one packing and one kind of jamming, and gives an answer or nothing.
#pragma once
#include <optional>
#include <vector>

#include "verdict/verdict.hpp"

namespace jam::inside {

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

// by_proof.cpp. A yes that rests on weak forces, of more contacts than one state of self-stress has: doubles cannot
// distinguish such forces from gaps. Where contacts do not all close, the network of those that close together, and
// hold their spheres, takes its place. Where they do not hold them, or exchanges come to no end, nothing is decided: a
// saddle, as far as two doubles show.
Says recheck_weak_forces(JammingCase &c);
// Undecided contacts that carry force: a yes where theorem.hpp proves that their spheres are trapped. Soft modes that
// doubles cannot distinguish from flexes are decided so.
Says raise_if_trapped(JammingCase &c);

}  // namespace jam::inside
