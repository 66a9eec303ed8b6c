// The contact network: contacts between force-carrying spheres, their unit vectors, gaps and forces.
#pragma once
#include <utility>

#include "core/pairs.hpp"
#include "jam/jam.h"

namespace jam::inside {

struct ContactNetwork {
  PairList pairs;              // contacts between stable spheres
  std::vector<double> vector;  // (contacts, dim) unit n_ij
  std::vector<double> gap;     // h of each contact
  std::vector<double> force;   // mean 1
  // Of soft spheres alone, else empty: d2v / dr2 and force over distance, in units of their energy.
  std::vector<double> stiffness, prestress;
  double force_scale = 0.0;           // mean of lambda |r| with sum lambda sigma^2 = 1
  std::vector<int32_t> coordination;  // n; 0 for rattlers
  size_t size() const { return pairs.size(); }
};

// Appends pair k of a list with its direction and gap, without a force. Returns its length.
double add_contact(const Packing &p, const PairList &pairs, size_t k, ContactNetwork &net);
// Directions and gaps at the positions of p, in extended precision.
void measure_contacts(const Packing &p, ContactNetwork &net);

// All pairs of a search (core/pairs.hpp), with forces 0.
ContactNetwork unforced_pairs(const Packing &p, double reach, double slope);
ContactNetwork unforced_network(const Packing &p, PairList pairs);

// Sets the force scale of forces of mean 1: that of lambda r with lambda = c f / r and sum lambda sigma^2 = 1.
void set_force_scale(const Packing &p, ContactNetwork &net);

// Of each wall: the force of its contacts per area, over the pressure sum f r / (d V); NaN without forces.
std::vector<double> wall_stress(const Packing &p, const ContactNetwork &net);

// sum of f r n_a n_b / V (dim, dim), r to the wall where it is one. Soft spheres: in units of their energy; hard ones:
// of trace dim. NaN without contacts, and of soft spheres where no two touch each other.
std::vector<double> stress_tensor(const Packing &p, const ContactNetwork &net);

// Contacts k of `a` and q of `b` between the same two spheres, in the order of b. Of several images as many as both
// have.
std::vector<std::pair<size_t, size_t>> common_contacts(const ContactNetwork &a, const ContactNetwork &b);

// Spheres with a contact.
int64_t stable_spheres(const std::vector<int32_t> &coordination);
// Contacts of one state of self-stress on this many spheres: d stable - (symmetries of the scene) + 1, and 0 without
// spheres. Without walls that is d (stable - 1) + 1.
inline int64_t isostatic_contacts(int64_t stable, int dim, const Container &walls) {
  return stable > 0 ? dim * stable - symmetries(walls, dim) + 1 : 0;
}
// Contacts above those; an empty network has none too many and none too few.
int64_t excess_contacts(const ContactNetwork &net, const Packing &p);

// Whether pairs of a list are contacts of a network, image by image. Both are sorted by (i, j); pairs come in order.
class ContactLookup {
 public:
  ContactLookup(const Packing &p, const ContactNetwork &net);
  bool holds(const PairList &pairs, size_t k);

 private:
  const ContactNetwork &net_;
  const int dim_;
  const double apart_;  // offsets of two images differ by more in one component at least
  size_t at_ = 0;
};

// Only those that are `on`, one flag a contact.
ContactNetwork subset(const ContactNetwork &net, const std::vector<char> &on, int dim);

// Contacts of a sphere with its own image that a network does not list. In a fixed cell they hold no motion, and the
// cell does not determine their force, so a crunch and contacts from geometry omit them. Copies of the cell and
// strains of it move them: there they are contacts as any other.

// Those with gaps below `limit`, without forces.
ContactNetwork unlisted_own_images(const Packing &p, const ContactNetwork &net, double limit);
// Those with gaps of closed contacts, or of the widest contact of the network. Soft spheres touch by overlaps alone,
// and their networks hold all of these.
ContactNetwork unlisted_own_images(const Packing &p, const ContactNetwork &net);

// JAM_E_UNSUPPORTED for a quantity that would be computed without the first of `own`.
void refuse_own_images(const ContactNetwork &own, const char *quantity);

// The certificate: everything in the report that follows from positions, diameters, contacts and forces alone.

// free_cell: the gaps of spheres and their own images count too.
void certify(const Packing &p, const ContactNetwork &contacts, jam_crunch_report &report, bool free_cell = false);

}  // namespace jam::inside
