// The inner loops of the engine: the earliest collision of one sphere with those of a list, the spheres of some cells
// near a place, and those that a shift of the Mari-Kurchan model brings near. Each is compiled for several instruction
// sets (portable.cpp, avx2.cpp, avx512.cpp), which give the same bits.
#pragma once
#include <cstddef>

#include "core/instruction_set.hpp"

namespace jam::inside {

// One sphere. Loops load it as words of 64 bits, so the members are in this order without gaps.
template <int D>
struct alignas(64) Body {
  uint64_t x[D];
  double v[D];
  double time;     // when x holds
  int64_t radius;  // at the origin of time
};

// Eight centres of a cell, upper 32 bits of each coordinate; id < 0: free. In a cell of more than eight the last lane
// holds link_to(number of a further block) instead of a centre.
template <int D>
struct alignas(32) Block {
  static constexpr int lanes = 8;
  int32_t id[lanes];
  int32_t x[D][lanes];
  static constexpr int32_t free = -1;
  static constexpr int32_t link_to(int32_t block) { return -2 - block; }  // its own inverse
};

// How the difference of two places becomes that of the images that meet: `wrapped`, integers wrap to the nearest image
// by themselves; `listed`, each entry of a list carries an offset to be added, an image or, in the Mari-Kurchan model,
// the quenched shift of the pair.
enum class Offsets { wrapped, listed };

// Pairs of sphere `self`, which is at `now`, with those of `list`.
template <int D>
struct PairBatch {
  const Body<D> *body;
  const Body<D> *self;
  const int32_t *list;
  int32_t count;
  const int64_t *offset;  // (D, stride): added to self - other; nullptr: all zero
  size_t stride;
  const double *event_time;  // of each sphere: a collision counts if it is before the event of the other sphere
  double now, rate, non_additivity;
};

// The blocks of `count` cells, seen from the place x (units of 2^-32 box); with images, cell k from place turn[k] of x.
template <int D>
struct CellSearch {
  const Block<D> *block;
  const size_t *cells;
  size_t count;
  float reach;
  const int32_t *x;     // (images, D)
  const int32_t *turn;  // nullptr: no images
};

// The earliest collision found so far: `time` from now, entry of the list (-1: none).
struct Earliest {
  double time;
  int32_t entry;
};

// Spheres of the Mari-Kurchan model by the user's numbers. Whole vectors are read: x and reach have `stride` places, a
// multiple of 8, for n spheres.
template <int D>
struct Partners {
  const int32_t *x;    // (D, stride): components along the cell vectors in units of 2^-32
  const float *reach;  // two spheres are partners within the sum of theirs; in units of 2^-32 V^(1/d)
  size_t stride;
  float height[D];  // distance of two faces of the cell, V^(1/d)
  bool cube;
  uint64_t key;  // of all shifts, as MkShifts::pair_key takes it
  bool uniform;  // shifts; else zeta is their strength, at most 1e15
  double zeta;
  int32_t n;
};

template <int D>
struct PairKernel {
  static constexpr int32_t batch = 64;  // longest list
  // Lowers `earliest` to the first entry with the smallest time. Returns a bit for each entry left out, of which the
  // caller computes the time itself: pairs that overlap, and pairs whose diameters grow faster than the spheres fly.
  uint64_t (*collisions)(const PairBatch<D> &pairs, Earliest &earliest);
  // Writes the spheres within reach to `found`, with images the `turn` of each too; returns their number.
  int32_t (*search)(const CellSearch<D> &query, int32_t *found, int32_t *turn);
  // Writes the partners of sphere `self` in order, and a few other spheres, to `found`; returns their number. It takes
  // the first shift that each pair drew.
  int32_t (*partners)(const Partners<D> &spheres, int32_t self, int32_t *found);
};

// The kernels of an instruction set. The choice changes no bit.
template <int D>
PairKernel<D> pair_kernel(InstructionSet set);

}  // namespace jam::inside
