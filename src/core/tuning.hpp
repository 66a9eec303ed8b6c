// Every number that steers what core does. Limits of the input are in limits.hpp, series and constants of functions
// in math.cpp and math_normal.cpp, fits to packings and quantiles of reports in size_report.cpp.
#pragma once
#include <cstddef>
#include <cstdint>
#include <limits>

namespace jam::inside {

// ---- a random start: its packing fraction by default, halved for each dimension above 3
constexpr double start_fraction_3d = 0.2;

struct PlaceTuning {
  static constexpr int64_t tries_between_looks = 16, tries_between_reports = 4096;
  // After so many tries for one sphere its free room is listed, and after as many again the list is refined. Well below
  // saturation about one point in 100 is free.
  static constexpr int listed_dim = 3;  // in more dimensions trials alone, up to these numbers
  static constexpr int64_t most_tries = 200000, tries_per_sphere = 20000;
  static constexpr int64_t tries_of_one_list = 1000, most_refinements = 60;
  static constexpr double voxel = 0.5;                                    // of the first list, over the diameter
  static constexpr double voxels_per_sphere = 32.0, fewest_voxels = 1e6;  // that a list may have
  static constexpr double serves = 0.95;       // diameters above this part of another share a list
  static constexpr int32_t most_draws = 2000;  // of the shift of a planted pair
};

// ---- reports of progress, in seconds
struct ReportTuning {
  static constexpr double shortest_interval = 0.05;
  static constexpr double longest_silence = 0.1;  // callers are granted one of 0.2 at most, between two checks
};

// ---- the time that is left: records that are kept, and how many are needed
struct TimeLeftTuning {
  static constexpr size_t most_kept = 64, fewest = 4;
  // At least two thirds of the true times lie within these, measured on calls of 1 to 20 s: work of steady pace, and a
  // crunch, which may wait long at a saddle.
  static constexpr double steady = 1.2, crunch = 3.0;
};

// ---- how many digits numbers have
struct DigitsTuning {
  // Rounding of a coordinate may be this part of a step: then fewer than 1 of 100 other numbers pass as multiples.
  static constexpr double most_noise = 0.005;
  static constexpr size_t sample = 64, large_sample = 1024;
  // Numbers that show that they are multiples of a step: so many at least, and more than this part. A number of three
  // significant digits, 0.25 or 1.4 say, may have been chosen; one of four was rounded.
  static constexpr double rounded = 1000.0, most_part = 0.5, some_part = 0.05;
  static constexpr size_t most_count = 1, some_count = 8;
  // One of ten multiples of a step, or one of two, is a multiple of the next coarser one. The step is the coarsest that
  // has more than this part of the multiples of the next finer one.
  static constexpr double kept = 0.75;
};

// ---- reduction of a cell: no crystal meets the first exactly, so rounding does not decide. The steps are far more
// than 8 vectors need: rounding must not turn in circles.
struct ReductionTuning {
  static constexpr double lovasz = 0.7;
  static constexpr int64_t most_steps = 100000;
};

// ---- lists of pairs
struct PairListTuning {
  // One list may take this part of a call's memory. What is made from it takes about ten times as much.
  static constexpr double share_of_memory = 1.0 / 8.0;
  // The closest pair is searched within this over the contact distance, and where that gives more pairs a sphere than
  // the second, within a part of it.
  static constexpr double first_slope = 1.1, pairs_per_sphere = 100.0;
  // From so many spheres on, a search visits them along a space-filling curve: at 1e5 the sort costs more than it
  // saves. Pairs that are only visited come in parts of about so many.
  static constexpr size_t along_curve_from = 300000, part = 16384;
  static constexpr uint64_t spheres_between_looks = 16;  // one large sphere may have many small ones in its cells
};

// ---- overlaps of spheres that met from across the cell: so many times (L / sigma)^2, at most `most`. Up to
// 1e-17 (L / sigma)^2 were seen for L / sigma = 2e3, 2e4 and 2e5.
struct FlightTuning {
  static constexpr double sharp = 0.25 * std::numeric_limits<double>::epsilon(), most = 1e-6;
};

// ---- laws of diameters
struct SizeTuning {
  static constexpr double least_share_left = 1e-6;  // of a cut law: shares are known to 1e-16 of the whole
  // Panels of a quadrature: quantiles of the normal law in these steps, and no panel longer than this in ln s.
  static constexpr double normal_step = 0.1, longest_panel = 0.05;
  static constexpr int normal_steps = 80;
  static constexpr double same_share = 2e-16;             // at which an inverse ends
  static constexpr size_t first_draw = 64, trial = 4096;  // spheres drawn at once, and to find the mean volume
};

// ---- g(r) between walls
struct ShellsTuning {
  static constexpr size_t size_classes = 8;   // spheres of more diameters are taken in so many classes
  static constexpr double least_room = 1e-6;  // of the container, where centres can be
};

}  // namespace jam::inside
