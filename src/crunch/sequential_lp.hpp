// One attempt at a crunch: LPs, the barrier path between them, the end. Its parts are in chain.cpp (LPs),
// chain_path.cpp and chain_end.cpp.
#pragma once
#include <vector>

#include "crunch/crunch.hpp"
#include "lp/interior_point.hpp"

namespace jam {

// Step bound of the last LPs, mean diameters.
constexpr double narrowest = 1e-6;
// After a longest step below this (mean diameters) the forces hardly change: the next LP starts from them, unless they
// leant on step bounds, without which they do not balance.
constexpr double settled = 1e-5;

class SequentialLp {
 public:
  SequentialLp(const Packing &start, const jam_crunch_options &o, Monitor &monitor, History &history,
               const CrunchSeams &seams);
  CrunchResult run();

 private:
  // chain.cpp
  void one_lp();
  void build_lp();
  void solve();
  bool ask(jam_lp_solver solver, const IpmControl &control);
  bool acceptable(const LpSolution &x, LpCheck &check) const;
  void keep(const LpCheck &check, jam_lp_solver solver);
  void lp_step(double alpha);
  void judge(double gain, double step, double alpha);
  // Tells the callback at once, with the step just finished to look at or without. True: stop.
  bool show(jam_phase phase, double gain, double step, bool finished = true);
  void stop(jam_stop_reason reason, jam_status status) { out_.report.stop_reason = reason, out_.status = status; }
  // Stops with the cause where the call was cancelled or its time is over. True: it was.
  bool cut_off();

  // chain_path.cpp
  double first_bound() const;
  bool in_valley(double gain, double step) const;
  void follow_path();
  void path_step(double gap, size_t pairs);

  // chain_end.cpp
  bool closes();
  bool wants_another_lp();
  bool last_digits();
  PolishEnd polished();
  void polish_step();
  void finish();
  void finish_failed();

  const jam_crunch_options o_;
  Monitor &monitor_;
  History &history_;
  const CrunchSeams &seams_;
  CrunchResult out_;
  NewtonSystem system_;
  InteriorPoint ipm_;
  PairList pairs_;
  PackingLp lp_;
  LpSolution answer_;
  Multipliers known_;           // of the last LP or path
  std::vector<double> forces_;  // the same for pairs_
  Network network_;
  double unit_ = 1.0, reach_ = 0.0, bound_ = 0.1, early_ = 0.0;
  double last_gain_ = 1.0;
  double moved_ = 1.0;  // longest step since known_, mean diameters; 0 after a path that reached its end
  int64_t held_ = 0;    // displacements that the last LP's bound ended
  int idle_ = 0;
  int paths_ = 0;         // barrier paths followed: another quench than LPs alone
  bool closed_ = false;   // polish ended the LPs
  bool retried_ = false;  // an LP more because polish refused
  bool kept_ = false;     // the last LP gave an answer that passed the checks
};

}  // namespace jam
