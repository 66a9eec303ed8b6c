// The one verdict on a packing: jam_rigidity, the check, jam_flex and copies by wave vector come here.
//
//   contacts, gaps, digits -> test -> what two doubles add -> own images -> contacts that may have been closed
#pragma once
#include "network/rigidity_test.hpp"

namespace jam::inside {

// known: the network that is stored with the packing, or NULL. Positions alone say which spheres touch, but for own
// images, as a free cell makes them contacts. Where spheres touch, and would be held if nearly closed pairs were
// closed, those of the known network or those that stand out from all others, a no becomes undecided.
PackingVerdict judge(const Packing &p, const GapResolution &resolution, const ContactNetwork *known, Jamming kind);
// Without the strict test of own images, which are no contacts of the fixed cell: motions of its spheres alone.
PackingVerdict judge_without_images(const Packing &p, const GapResolution &resolution, const ContactNetwork *known,
                                    Jamming kind);

}  // namespace jam::inside
