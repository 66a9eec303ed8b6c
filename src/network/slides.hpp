// Motions of parts of a network that keep all distances at any amplitude: two parts that no contact joins slide past
// each other.
#pragma once
#include <cstdint>
#include <vector>

#include "network/rigidity_matrix.hpp"

namespace jam::inside {

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

}  // namespace jam::inside
