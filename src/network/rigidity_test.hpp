// Jammed or not: the tests of collective and strict jamming, and the spheres and contacts that carry force.
//
//   contacts -> [largest support of a self-stress] -> carrying contacts K+, spheres B -> rank on K+ -> verdict, flex
//
// Rows: S holds n_ij on sphere i and -n_ij on sphere j; E holds n_ij . (eps r_ij) for a symmetric strain eps.
// Collectively jammed (fixed cell): S v >= 0 on all contacts implies that v is a translation of B. Equivalent: a stress
// f with S^T f = 0 is positive on all of K+, and rank S on K+ is d (N' - 1), N' = |B| (Roth and Whiteley, Trans. Amer.
// Math. Soc. 265, 419 (1981)). Strictly jammed: the same with S v + E eps >= 0 and tr eps <= 0; then E^T f is
// proportional to the unit matrix, and the rank with the traceless strains is d (N' - 1) + d (d + 1) / 2 - 1 (Donev,
// Torquato, Stillinger, Connelly, J. Comput. Phys. 197, 139 (2004); Connelly, Shen, Smith, arXiv:1301.0664). Between
// walls eps has components along the axes that repeat alone: d is their number in its counts.
// For spheres this first-order test is exact: |r + t v|^2 = r^2 + 2 t r.v + t^2 v^2, so every flex opens contacts
// (Connelly 1988). A round wall closes along a flex, as its distance has the second derivative -1/|r| across the
// normal. There a flex u opens no contact where sum_k f_k b_k |u_k|^2 < 0, with the second derivatives b_k of the
// distances across the normals and the parts u_k of u_i - u_j there: that is prestress stability (R. Connelly and W.
// Whiteley, SIAM J. Discrete Math. 9, 453 (1996)). Where the sum is 0 as parts of the network slide past each other,
// the spheres are not jammed, though their diameters cannot grow. d (N' - 1) is d N' less the symmetries of the scene
// where there are walls. A rattler is a sphere that no contact of K+ touches; the number of its contacts does not
// matter.
#pragma once
#include <cmath>

#include "network/rigidity_matrix.hpp"
#include "network/stress_cone.hpp"

namespace jam::inside {

// Eigenvalues of S^T S on K+: a smaller one is a flex, up to the second one it is undecided.
constexpr double flex_eigenvalue = 1e-12, undecided_eigenvalue = 1e-10;

enum class Jamming { collective, strict };
enum class Verdict { no = 0, yes = 1, undecided = 2 };

// Of a fixed list of contacts, all taken as closed. The verdict on a packing, whose contacts may be open: verdict.hpp.
struct RigidityResult {
  Verdict rigid = Verdict::no;      // jammed, if these are its contacts
  Verdict stressed = Verdict::no;   // K+ is not empty: no motion grows the diameters to first order (stationary)
  std::vector<char> carrying;       // K+, one flag a contact
  std::vector<double> force;        // in the middle of all non-negative states, mean 1 over K+, 0 on all others
  double force_residual = 0.0;      // largest |sum_j f_ij n_ij| over the mean force
  int64_t spheres = 0;              // N'
  int64_t contacts = 0;             // |K+|
  int64_t zero_force_contacts = 0;  // contacts without force in every state
  int64_t contacts_needed = 0;      // collective: d (N' - 1) + 1; strict: d (N' - 1) + d (d + 1) / 2
  int64_t self_stresses = 0;        // states of self-stress on K+
  int64_t flexes = 0;            // motions of B with S v = 0 on K+ beyond symmetries; 0 without a stress. Of a jammed
                                 // packing the curvature of a round wall stabilises them
  int64_t slides = 0;            // of these flexes, if no other flex is free (flex.hpp)
  int64_t undercoordinated = 0;  // spheres of B with d contacts of K+ or fewer
  // Smallest eigenvalue on K+ of S^T S of motions that are neither symmetries nor flexes, with strains in the strict
  // test and where own images alone hold a sphere; 0 where there is no other motion.
  double margin = 0.0;
  double curvature = 0.0;      // where a round wall fixes flexes u: least -sum f b(u, u) over the mean |f b|
  std::vector<double> flex;    // (nodes, dim), largest |v_i| is 1: opens contacts; empty when jammed or not found
  std::vector<double> strain;  // (dim, dim) that goes with it; strict only
  // Least rate at which the flex opens contacts of spheres that their contacts could hold. Without a stress and with
  // contacts that are open by h, it is a proof above sqrt(h) alone: as they close, spheres move that far aside, and
  // contacts turn by as much.
  double opening = 0.0;
  bool opens_clearly(double h) const { return opening > std::sqrt(h); }
};
RigidityResult test_rigidity(const RigidityMatrix &contacts, Jamming kind);

// Whether the curvature of a round wall holds the flexes of a network with a positive stress.

// carrying: K+ of `out`, with its forces and flexes. The first flex becomes that which curvature holds least.
void test_prestress_stability(const RigidityMatrix &carrying, const std::vector<double> &force,
                              std::vector<std::vector<double>> &flexes, RigidityResult &out);

// Whether forces times second derivatives of distances are positive along a motion of the nodes of the matrix of which
// `carrying` is a part, a flex of that part.
bool opens_by_curvature(const RigidityMatrix &carrying, const std::vector<double> &force,
                        const std::vector<double> &motion);

// Jamming from a part of the contacts: a set K with a positive self-stress whose rows hold their spheres B rigidly.
// B then balances any load, so that every contact within B carries force too, however weak. The rest is tested with B
// as one body. This decides networks with forces of 1e-8 of the mean, where no certificate of all contacts at once
// is above rounding.

// sub: contacts of spheres that may carry force. cone: undecided, with its positive set. False: K is not rigid. True:
// the verdict on sub is in `out`, its flags, forces and flex on contacts and nodes of sub.
bool test_from_rigid_part(const RigidityMatrix &sub, const StressCone &cone, Jamming kind, RigidityResult &out);

}  // namespace jam::inside
