// Every number that steers the sparse factorisation. Work is in multiplications, sizes in numbers of a matrix.
#pragma once
#include <cstddef>
#include <cstdint>

namespace jam::inside {

// ---- the order of elimination: nested dissection by multilevel bisection
struct OrderingTuning {
  static constexpr int32_t leaf = 100;          // parts of at most so many nodes are ordered by minimum degree
  static constexpr int32_t coarsest = 40;       // nodes of the graph that is separated first
  static constexpr int starts = 4;              // first guesses there
  static constexpr int32_t several_runs = 600;  // graphs of more nodes are separated several times ...
  static constexpr int runs = 3;                // ... from the level that has a fraction 1 / run_level of them
  static constexpr int32_t run_level = 8;
  static constexpr int passes = 8;               // of the refinement on each level
  static constexpr double still_coarser = 0.95;  // a level that keeps more of its nodes is separated as it is
  // Refinement: a side of this share of both takes no more nodes; weight of the difference of the sides in the cost; a
  // pass ends when its cost is this times the least.
  static constexpr double heaviest_side = 0.6, unevenness = 0.02, give_up = 1.1;
};

// ---- supernodes: zeros cost work, small panels cost calls
struct SupernodeTuning {
  // Two neighbours of at most so many columns together become one if at most this share of it is zero.
  static constexpr size_t few = 12, some = 36, many = 96;
  static constexpr double zeros_of_some = 0.5, zeros_of_many = 0.15, zeros_of_more = 0.05;
  static constexpr int narrow = 48;               // columns of a front that are factored without splitting them
  static constexpr double splits_subtree = 0.05;  // of all work: heavier subtrees are divided among threads
  // In floats a pivot below this part of its entry in the matrix is rounding alone: 64 roundings
  // (tests/bench/tried.md).
  static constexpr double lost_in_floats = 4e-6;
};

// ---- threads of a process that are inside OpenBLAS at once, where it is linked; Debian's build allows 128
struct BlasTuning {
  static constexpr int shared = 64;  // that calls use together before a further call gets only one
  static constexpr int most = 120;   // of all calls together; the rest is left to the host
};

// ---- sizes of the parts that threads take, and of the work between two checks of the caller's callback
struct ThreadTuning {
  static constexpr int most_parts = 4;          // of one product: narrower ones take more time in all
  static constexpr double product = 1e7;        // multiplications of a part of a dense product
  static constexpr double vector = 1e6;         // numbers of a dense front that is read once: as slow as memory
  static constexpr double additions = 200000;   // numbers that are added to a front
  static constexpr size_t factor = 1000000;     // numbers of the factor in a triangular solution
  static constexpr double long_product = 2e9;   // takes some 0.1 s: callbacks are called meanwhile
  static constexpr size_t long_panel = 100000;  // takes some 0.1 ms to read: the call may be left between such panels
  static constexpr size_t columns_a_look = 64, blocks_a_look = 32;
};

}  // namespace jam::inside
