// Every number that steers the analysis of packings. Lengths are in mean diameters.
#pragma once
#include <cstddef>

namespace jam::inside {

// ---- modes
struct ModesTuning {
  // All modes are computed and cut where this costs less than iteration: few unknowns; a quarter of all wanted; the
  // lowest ones of at most so many unknowns.
  static constexpr size_t always_dense = 300, dense_for_lowest = 3000;
  static constexpr double dense_share = 0.25;
  static constexpr double dense_bytes = 24.0, krylov_vectors = 20.0;  // memory: a matrix entry; beside three a mode
  static constexpr double real_wave_bytes = 40.0;  // a matrix entry with the vectors at a real wave vector
  static constexpr double sparse_bytes = 12.0;     // an entry of a sparse matrix, with its row
  static constexpr int restarts = 300;             // of Lanczos
  // Over the norm: no mode is nearer to a shift, and its factor is that of a matrix this near. A shift moves by this
  // and by its doubles, up to so many times.
  static constexpr double near_shift = 1e-9, farthest_shift = 1e3;
  // Modes of one frequency are found one after the other: a probe of this tolerance from a new start asks whether one
  // was missed.
  static constexpr int probes = 200, probe_restarts = 20, at_once = 6;
  static constexpr double probe_tolerance = 1e-3;
  static constexpr double spent = 1e-3;  // what is left of a zero mode beside those found so far
  // Each frequency at a wave vector is found twice: frequencies this close, over the largest, may be mixed.
  static constexpr double mixed = 1e-11;
  static constexpr double leaning = 1e-2;  // and this close have products up to rounding over their distance
};

struct BlochTuning {
  static constexpr size_t unknowns_a_flex = 8;  // with more flexes all eigenvalues cost less than the search
};

// ---- S(q): sums over spheres, exact or by a grid to 1e-12 of their number
struct FourierTuning {
  static constexpr double products = 1e8;      // of wave vectors and spheres: fewer are summed exactly
  static constexpr double longest = 54.0;      // seconds
  static constexpr double coefficients = 5e8;  // along an axis: more take longer; twice as many fit an int
  static constexpr double second_a_product = 2.7e-9, second_a_cell = 1.5e-9, second_a_point = 6e-9;
  // Of the kernel: points across, grid points over waves, decay over the one at which aliases are as large as the cut.
  static constexpr int width = 16, fine_steps = 32;
  static constexpr double oversampling = 1.5, share_of_decay = 0.98;
};

// ---- dense eigenvalue problems
struct DenseTuning {
  // Doubles that are allocated behind each array: the dsymv of OpenBLAS 0.3.21 for Prescott reads up to 64 bytes
  // beyond its vectors, which crashes where an array ends with the memory that is mapped.
  static constexpr size_t read_behind = 16;
  static constexpr int panel = 32;               // columns whose reflections change the rest of the matrix at once
  static constexpr int strip = 16;               // rows of the vectors that a rotation turns at once
  static constexpr size_t most_waiting = 50000;  // rotations, which fit into the second cache with a strip
  static constexpr int most_iterations = 60;     // of QL for an eigenvalue; two are usual
  static constexpr int back_columns = 512;       // vectors that are turned back between two checks of the callback
  // Shares of the time: reduction, and product of the reflections, by own loops and by LAPACK; LAPACK's vectors.
  static constexpr double reduction = 0.4, reflections = 0.2, lapack_reduction = 0.6, lapack_vectors = 0.2;
};

// ---- density of states
struct DosTuning {
  static constexpr double above_largest = 1.05;  // bound over the Ritz value, to which two residuals are added
  static constexpr double rounding = 1e-9;       // squared length of signs that were a symmetry alone
};

// ---- pairs within a distance, and the blocks in which voro++ searches for neighbours
struct GapsTuning {
  static constexpr double bytes_a_pair = 48.0;  // beside d doubles
};
struct CellsTuning {
  static constexpr double spheres_a_block = 6.0;
  static constexpr int slices = 8;  // of a cell that a round wall cuts, between two heights where its shape changes
};

}  // namespace jam::inside
