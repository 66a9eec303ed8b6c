// The motion that shows that spheres are not held: of all nodes, from one of those that could be held.
#pragma once
#include <functional>

#include "network/constraint_rows.hpp"
#include "network/rattlers.hpp"
#include "network/rigidity_test.hpp"

namespace jam::inside {

// Whether a motion, of this flex and strain (empty without one), overlaps at no contact beyond rounding. gap: what
// contacts are open by; empty: nothing.
bool keeps_contacts(const RigidityMatrix &g, const std::vector<double> &gap, const std::vector<double> &flex,
                    const std::vector<double> &strain);

// Writes to out.flex and out.strain a motion of all nodes: x on the spheres of `sub` (empty: none of them moves), and
// each released sphere moved off its contacts, last released first. The motion is changed a little where that keeps
// contacts closed. Both stay empty if a contact would close faster than rounding allows, or by more than the widest
// contact with force is open.
void complete_flex(const RigidityMatrix &g, const RigidityMatrix &sub, const ConstraintRows &sub_rows,
                   const std::vector<double> &x, const std::vector<Release> &released, bool strain,
                   RigidityResult &out);

// Motions of parts of a network that keep all distances at any amplitude: two parts that no contact joins slide past
// each other.

// Independent ones beyond the motions of the whole, and one of them (nodes, dim). A part translates along an axis
// on which it touches no wall, or rotates about the centre of a round wall: there all contacts with a sphere in the
// middle stay closed too.
struct Slides {
  int64_t count = 0;
  std::vector<double> motion;
};
Slides find_slides(const RigidityMatrix &g);

// Those of them that are translations, without round walls: exact and as many as there are, so that a search for other
// flexes need not find them.
class PartTranslations {
 public:
  PartTranslations() = default;  // none
  explicit PartTranslations(const RigidityMatrix &g);
  int64_t count() const { return static_cast<int64_t>(slides_.size()); }  // independent, beyond those of the whole
  void remove(double *x) const;                // x (nodes, dim): those of the whole too. Nothing where count() is 0
  std::vector<double> motion(size_t k) const;  // k < count(): (nodes, dim), of length 1

 private:
  struct Slide {
    int32_t root;
    size_t axis;
  };
  size_t dim_ = 0;
  std::vector<int32_t> part_;               // root of each node
  std::vector<std::vector<char>> stopped_;  // by axis and root: the part touches a wall there
  std::vector<Slide> slides_;
  uint32_t open_axes_ = 0;
};

// The softest motions of a contact network, by block inverse iteration: flexes, and the smallest eigenvalue above them.

struct SoftestModes {
  PartTranslations slides;                  // flexes that need no search, of any number
  std::vector<std::vector<double>> flexes;  // the others: orthonormal motions x with |A x|^2 < `limit`, no symmetries
  double margin = 0.0;                      // smallest eigenvalue of A^T A above them; infinity without another motion
  bool complete = true;                     // false: there are more of the others than were requested
  int64_t count() const { return slides.count() + static_cast<int64_t>(flexes.size()); }
};
// Rows A whose softest motions are searched for.
struct SoftRows {
  size_t rows, columns;
  size_t known;                                              // independent motions of length 0 that `remove` takes out
  std::function<void(const double *x, double *y)> multiply;  // y = A x
  std::function<void(double *x)> remove;
  std::function<void(double *x, int count)> solve;  // x := (A^T A + shift)^-1 x for `count` vectors, shift near `limit`
};
SoftestModes softest_modes(const SoftRows &rows, double limit, size_t most_flexes);
// solver: factored with unit weights and a shift near `limit`.
SoftestModes softest_modes(const ConstraintRows &rows, const NormalSolver &solver, double limit, size_t most_flexes);

}  // namespace jam::inside
