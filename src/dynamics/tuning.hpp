// Every number that steers a dynamics: what is chosen for speed, and what separates noise from physics. Limits of the
// input are in core/limits.hpp, the numbers of a file's format and of physics where they belong.
#pragma once
#include <cstddef>
#include <cstdint>

namespace jam::inside {

// Overlaps of the start that a run takes as rounding, in contact distances.
constexpr double overlap_of_rounding = 1e-10;

// ---- event-driven: neighbour lists. Lengths in diameters; the unit of cost is one neighbour examined.
struct ListTuning {
  // The shell s: a sphere may go so far before its list is made again. At first it is `first_shell` less `per_fraction`
  // times the packing fraction; the Mari-Kurchan model, whose searches cost more, has a wider one.
  static constexpr double smallest_shell = 0.004, widest_shell = 1.5;
  static constexpr double first_shell = 0.4, per_fraction = 0.45, least_first = 0.06, most_first = 0.36,
                          mari_kurchan_shell = 0.2;
  // Growth uses up the margin: lists should hold for so many collisions a sphere, at first for a share of the shell.
  static constexpr double smallest_margin = 0.002, collisions = 20.0, first_margin = 0.3, most_margin = 0.5;
  static constexpr double without_growth = 1e-9, used_up = 0.999;  // share of the margin at which lists end
  // How far lists may reach, in V^(1/d): without images differences must not wrap, with them the integers must hold it.
  static constexpr double reach_wrapped = 0.4999, reach_cube = 1.4, reach_cell = 2.8;
  static constexpr double longest_distance = 12.0;  // of two spheres in each other's list: integers hold it in any cell
  // The shell is chosen again after so many collisions or exits a sphere. A collision costs 2 (14 + L) for a list of L;
  // each of the exits that come with it costs 30 + 4 L + the search. Exits fall as s^-1.6. With this the rate was
  // within 6 % of the best of fixed shells at packing fractions 0.27 to 0.6. A gain below 3 % does not pay for new
  // lists.
  static constexpr int64_t collisions_between = 4, exits_between = 2;
  static constexpr double collision = 14.0, exit = 30.0, exit_per_neighbour = 4.0, exits_by_shell = 1.6;
  static constexpr double least_gain = 0.97, most_change = 1.5, step = 1.1;
  // Cost of a sphere in a search of all: with images, and in vectors (tests/bench/tried.md).
  static constexpr double look = 4.0, look_in_vectors = 0.125;
  static constexpr size_t first_capacity = 16, spheres_between_looks = 64;
};

// ---- event-driven: cells that find the candidates of a list
struct CellTuning {
  static constexpr int longest_range = 3;                       // cells on either side
  static constexpr double per_sphere = 4.0, at_least = 64.0;    // at most so many cells, the sum of both
  static constexpr double rounding = 1e-6, cut_off_bits = 4.0;  // of floats and of coordinates of 32 bits
};

// ---- event-driven: cell mode. Cells alone are faster than lists where few spheres share the smallest possible cell:
// `crowded` (by dimension) is where both were equally fast at N = 1024 and 16384; from d = 5 on the cells around one
// are too many. With five cells a side spheres in adjacent cells are less than half a box apart.
struct CellModeTuning {
  static constexpr int highest_dimension = 4;
  static constexpr double crowded[] = {0.0, 0.0, 0.6, 0.52, 0.48}, fastest = 0.12;  // spheres per cell
  static constexpr double fewest = 5.0, largest_margin = 0.2;
};

// ---- event-driven: calendar and the origin of time
struct CalendarTuning {
  static constexpr size_t buckets_per_sphere = 6;
  static constexpr int64_t events_between = 8, more_events = 64;  // a sphere: then the origin of time moves
  static constexpr int64_t events_measured = 2;                   // a sphere: so many give the mean time between two
  // Before that: the median time to come, and at least a part of the mean. Buckets reach four times the earliest event.
  static constexpr double least_part_of_mean = 0.1, earliest_events = 4.0;
};

// ---- event-driven: loads ahead of their use. How many buckets (mean times between events) ahead;
// tests/bench/builds.py shows what it is worth. Below `smallest` spheres all stays in the cache.
struct LookAhead {
  static constexpr int32_t smallest = 8192, events = 48, bodies = 24, neighbours = 10;
};

// ---- event-driven: collisions
struct CollisionTuning {
  // Below this (r^2 - sigma^2) / sigma^2 doubles lose too many digits of the gap and integers take over.
  static constexpr double near_contact = 1e-3;
  static constexpr double overlap = -1e-14;  // a gap below this is an overlap and not rounding
  // The least velocity that a collision adds, V^(1/d) per time: less would be lost in the sum and the pair collide for
  // ever.
  static constexpr double least_push = 1e-14;
  static constexpr double receding_image = 1e6;  // an image that recedes is the partner only if so much nearer
  // A constant relative rate of growth is made of linear pieces of half a per cent: the mean rate is a quarter of a per
  // cent low.
  static constexpr double growth_step = 0.005;
  static constexpr uint64_t events_between_looks = 1024;  // at the limits of the call
  // Without a collision in so many events, and a hundred times the mean time between two collisions of an ideal gas,
  // none will come.
  static constexpr int64_t stalled_events = 1000000, stalled_events_per_sphere = 200;
  static constexpr double chances = 100.0, motion_as_one = 1e-28;
};

// ---- event-driven: windows of pressure. A window is long enough for small noise and short enough that p changes
// little: d ln p = G sqrt(pi) / d a collision of each sphere.
struct WindowTuning {
  static constexpr double longest_growing = 2.0, shortest_growing = 0.25,
                          growth_in_window = 0.03;         // collisions a sphere
  static constexpr double longest = 20.0, windows = 20.0;  // at constant volume: collisions a sphere, windows of a run
  static constexpr double fewest_growing = 32.0, fewest = 4.0;  // collisions of all
  static constexpr int64_t parts = 4;                           // of a window while growing
  static constexpr double steady = 0.25;          // no part of the last window below this share of the target pressure
  static constexpr size_t kept_parts = 16;        // while growing
  static constexpr size_t fewest_for_error = 5;   // windows at constant volume
  static constexpr size_t kept_windows = 4096;    // at constant volume: then two become one
  static constexpr int64_t frozen = 20;           // windows without time until the run counts as stalled
  static constexpr double touching_start = 20.0;  // collisions a sphere: growth that ends before had a touching start
  static constexpr double touching_pressure = 1e4;      // as without a density as aim a pressure above this
  static constexpr double same_density = 1e-6;          // relative; packings that are denser were so before growth
  static constexpr double units_of_gap = 40.0;          // smaller gaps are noise, in units of the coordinates
  static constexpr double as_good_as_touching = 0.999;  // its own image, of a sphere that fills the box
  static constexpr double growth_noise = 0.02;  // smaller changes of the rate of growth are noise of the pressure
};

// ---- event-driven: velocities while growing
struct ThermostatTuning {
  static constexpr double heat = 0.05;  // of kT/m: cooled beyond
  // Above this rate of growth not before so much growth, of a diameter, or so many collisions a sphere.
  static constexpr double fast = 0.5, grown = 0.01, collisions = 50.0;
};

// ---- event-driven: the protocol that avoids crystals in d = 3, fast where a fluid could order, slower near jamming
struct ProtocolTuning {
  static constexpr double first_rate = 1e-2, first_pressure = 500.0, last_rate = 3e-3;
};

// ---- Monte Carlo: lists and cells. Lengths in contact distances (tests/bench/monte_carlo).
struct MonteCarloTuning {
  // Pairs nearer than this share of the distance of two faces have one image in reach, the one that differences wrap
  // to.
  static constexpr double range = 0.499;
  // In between, lists would have no skin, and the pressure of hard spheres no gaps to count: of the range, over
  // contact.
  static constexpr double fullest = 0.8, beyond = 1.25;
  static constexpr double longest_step = 0.49;  // of the shortest distance of two faces
  // Longer lists hold for longer; trials take least time near 8 steps, and shorter ones than 0.35 diameters.
  static constexpr double skin_steps = 12.0, longest_skin = 0.7, shortest_skin = 0.03, half_skin_kept = 1.01;
  // Where sizes differ much, in mean diameters: there are no cells for long steps.
  static constexpr double longest_skin_by_size = 2.0, gaps_by_size = 0.1;
  static constexpr double longest_step_of_lists = 0.1;  // beyond it cells are faster
  static constexpr double cells_per_sphere = 2.0;
  static constexpr int64_t fewest_cells = 4, spheres_between_looks = 64;
};

// ---- Monte Carlo: choice of the step, by 260 sweeps at n = 1024, 25 from n = 12288 on
struct StepTuning {
  static constexpr int coarse = 60, fine = 20;
  // Of a round: as many sweeps as these trials take, at most so many.
  static constexpr int64_t coarse_trials = 4096, fine_trials = 12288, coarse_sweeps = 4, fine_sweeps = 12;
  static constexpr double settled = 0.2;                  // relative change of the step that ends the coarse rounds
  static constexpr double first = 0.1, smallest = 1e-12;  // mean diameters
  static constexpr double least_share = 1e-3, most_growth = 2.0, most_fall = 0.3;
};

// ---- samples of a run
struct SampleTuning {
  static constexpr int blocks = 8;        // of an observer's sample, for its error
  static constexpr int64_t sweeps = 10;   // between two samples of Monte Carlo, which take about the time of a sweep
  static constexpr size_t parts = 20;     // of a Monte Carlo run, for the errors of its means
  static constexpr size_t gap_bins = 16;  // the pressure of hard spheres is extrapolated from, of small gaps
  // Gaps up to about 1/(4 p): three quarters of a pair a sphere lie there.
  static constexpr double pairs_counted = 0.25;
  static constexpr size_t first_bins = 4096;
};

// ---- isoconfigurational ensemble
struct EnsembleTuning {
  // A run that has begun is at most so many numbers ahead of the sums; its record waits in memory.
  static constexpr int64_t runs_ahead = 32;
  static constexpr int64_t collisions_between_reports = 1 << 16;  // some 20 ms
  static constexpr double roundings_of_gap = 100.0;               // smaller gaps at the start would be rounding
};

}  // namespace jam::inside
