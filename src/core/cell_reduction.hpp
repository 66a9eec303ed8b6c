// Cell vectors as they are given, brought to the lower triangle of Cell; and other vectors of the same lattice, where a
// search for pairs needs them or the given ones are extreme.
#pragma once
#include "core/packing.hpp"

namespace jam::inside {

struct NormalCell {
  Cell cell;
  std::vector<int64_t> transform;  // (dim, dim) T: the vectors of `cell` are T times the rows given, then turned by Q
  std::vector<double> rotation;    // (dim, dim) Q: rows given = T^-1 (cell) Q, so a point x goes to Q x
  bool rotated = false;            // false: Q is exactly 1
  double most_defect = 0.0;        // rows given whose orthogonality defect is larger were not kept; 0: always reduced
  bool same_vectors() const;       // T is 1
  void turn(std::vector<double> &vectors) const;  // (n, dim), by Q
};

// The rows as given, turned to a lower triangle by Gram-Schmidt where they are none; lower-triangular rows stay as they
// are, to the last bit. Rows whose orthogonality defect exceeds `most_defect` give way to shorter vectors of the same
// lattice: those without tilts of more than half an edge, which leave the spheres where they are, or else those of
// reduce_cell. JAM_E_NONFINITE, JAM_E_ARGUMENT: a left-handed, singular or flat cell, or a size outside the limits.
NormalCell normal_cell(int dim, const double *rows, double most_defect);
NormalCell normal_cell(int dim, const double *rows);  // with the limit for the dimension, defect_max
// Lovasz' reduction (Lenstra, Lenstra, Lovasz, Math. Ann. 261, 515 (1982)). The same errors.
NormalCell reduce_cell(int dim, const double *rows);

// The product of the lengths of the vectors over the volume: 1 in a brick. What searches cost grows with it.
double orthogonality_defect(const Cell &cell);
double defect_max(int dim);
// The same lattice and the same brick by vectors whose tilts are at most half an edge; `cell` itself where they are.
Cell upright(const Cell &cell);
// The cell in which dynamics searches for pairs: upright, except for Mari-Kurchan shifts, which are fractions of the
// vectors.
Cell search_cell(const Packing &p);

}  // namespace jam::inside
