// The phases of a crunch. Each returns the phase that follows.
#pragma once
#include "crunch/state.hpp"

namespace jam::inside {

// ---- phase 1, approach: sequential LPs. Each LP maximises Gamma over displacements within a bound; the spheres move,
// and the pairs are listed again (Artiaco et al., Phys. Rev. E 106, 055310 (2022)).
Phase approach(CrunchState &s);
// A free cell: path and LPs with strain amplitudes start from the optimum at fixed cell. They end in a
// strictly jammed packing, with d (N' - 1) + d (d + 1) / 2 contacts when it is disordered (Torquato and Jiao, Phys.
// Rev. E 82, 061302 (2010)). Whether the cell is to be freed, after the packing has reached its optimum at fixed cell:
bool frees_cell(const CrunchState &s);
// The strains join the LPs.
Phase free_cell(CrunchState &s);

// ---- phase 2: the barrier path, from the LP before it to the LPs after it
Phase follow_path(CrunchState &s);
// The end of a crunch at a finite duality gap. On the path y c = mu for every row: a contact has much force and a small
// gap, another pair the reverse. The linear program at this point parts those in between, from the multipliers of the
// path in a few iterations. A curved path may still part some of them the other way: they are counted.
//
//   multipliers of the path -> LP -> contacts and forces -> forces that balance -> duality gap of these forces
//
// False where the forces of the LP do not balance or leave a larger gap than the options allow, or when interrupted.
bool ends_at_gap(CrunchState &s, const Multipliers &path);

// ---- phase 3, identify: which contacts carry force, their last digits, and the verdict
//
//   active set of the LP -> closed contacts, balanced forces (polish) -> test of collective jamming -> jammed, or a
//   flex
//
// A flex is a motion that opens contacts: the packing is a saddle of the density. A decompression leads away from it.
Phase identify(CrunchState &s);
// Narrow LPs find which contacts carry force when the tolerance of a wide LP hides a weak force or a narrow gap: the
// duality gap of an LP shrinks with its step bound. The bound follows the steps down to a motion whose square is
// rounding. No regularising diagonal is added: it would take the weak force of the third contact of a sphere between
// two nearly opposite ones.
Phase narrow_lps(CrunchState &s);
// Closes the contacts and balances the forces, as far as they do. False when the call was interrupted.
bool polish_contacts(CrunchState &s);
// Tests the packing. Where it is not shown to be jammed narrow LPs follow, then a decompression.
Phase decide_jamming(CrunchState &s);
// Decompresses the packing, displaces every sphere at random within the room that this gives, and lets LPs and path
// begin again. Each time it decompresses farther, so that the packing ends near the first one. False where no
// decompression is left.
bool recompress(CrunchState &s);
// Ends the crunch with its verdict, the one that jam_rigidity would return: collectively jammed or not, from positions
// alone; and in a free cell strictly. of_contacts: the test of its contacts, or nothing.
Phase give_verdict(CrunchState &s, const PackingVerdict &of_contacts);
// Narrow LPs and decompressions belong to the optimum of the wide LPs. A looser tolerance may end before it.
bool converged(const CrunchState &s);

}  // namespace jam::inside
