// When the barrier path cools and when it is warmed up: what mu is multiplied by before the next Newton step.
#pragma once
#include <limits>

namespace jam {

class BarrierSchedule {
 public:
  // What the last Newton step left.
  struct Step {
    double decrement;   // squared Newton decrement over mu at its start
    double rows;        // how many terms the barrier has
    double gap;         // duality gap
    double balance;     // largest force out of balance, relative
    double part;        // of the whole Newton step that was taken
    double trust;       // of the longest step allowed that was taken
    bool last = false;  // one cooling more would end the path
  };
  // The factor of mu before the next Newton step: 1; `shrink`, to cool; above 1, to warm up.
  double before(const Step &last);
  // True where the maximum at mu counts as reached: mu falls by `shrink`.
  bool centred(double decrement, double rows);

  // Each mu is followed to its maximum before mu falls.
  static constexpr double shrink = 0.2;
  int reheats() const { return reheats_; }

 private:
  double turn(const Step &last);

  double least_ = 0.0, mark_ = 0.0;  // lowest decrement at this mu; where the count of cuts began
  double saddle_ = std::numeric_limits<double>::infinity();  // duality gap of the last one
  int at_mu_ = 0, cuts_ = 0, reheats_ = 0, creeping_ = 0, warmed_ = 0;
  bool centred_once_ = false;
};

}  // namespace jam
