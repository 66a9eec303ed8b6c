// Every number that steers the verdict on a packing. Limits of gaps are in network/resolution.hpp, those of
// eigenvalues in network/rigidity_test.hpp: they are part of what a verdict means.
#pragma once

namespace jam::inside {

struct VerdictTuning {
  // Gaps below so many roundings of a gap are those of closed contacts.
  static constexpr double roundings_of_tight_pairs = 4.0;
  // A sphere that touches a round wall farther from its axis, in radii, has one contact there.
  static constexpr double off_axis = 1e-5;
  // Where a flex overlaps at pairs that touch, this part of it is tried, and again.
  static constexpr double shorter_flex = 0.1;
  // Contacts that are open by h may turn by sqrt(h) as they close, and trap spheres over that length. A motion that
  // leads so many times as far, in diameters, leaves any such trap.
  static constexpr double far_beyond_gaps = 10.0;
  // Two spheres overlap along it by no more than this part of their distance.
  static constexpr double rounding_of_a_motion = 1e-14;
  // A strain whose largest coefficient is 1 brings two spheres of mean size nearer by this at most, over a displacement
  // of 1: its norm in d = 2 ... 8, of up to 35 coefficients, is below 6.
  static constexpr double strained = 6.0;
};

}  // namespace jam::inside
