// From any valid packing to a certified jammed one.
#pragma once
#include <functional>

#include "core/cell_reduction.hpp"
#include "core/notes.hpp"
#include "crunch/tuning.hpp"
#include "lp/packing_lp.hpp"
#include "network/contact_network.hpp"

namespace jam::inside {

// On the barrier path multipliers are mu over gap, so mu alone brings them back. mu = 0: not on the path.
struct PathPoint {
  double mu = 0.0, first_mu = 0.0;
};

// Where a crunch stands between two steps. With the packing it is all that another call needs to continue.
struct CrunchStage {
  PathPoint path;
  bool path_taken = false, cell_free = false;
  uint8_t decompressions = 0;

  std::string bytes() const;
  static CrunchStage of(const std::string &bytes);  // throws JAM_E_FORMAT
};

// A state that the page shows behind its slider: few enough, and in floats, so that the file stays small.
struct KeptStep {
  int64_t step;                 // rows of the history before this state: 0 is the start
  double diameter;              // of the first sphere; all grow by one factor
  double fraction;              // packing fraction
  Cell cell;                    // a free cell changes from step to step
  std::vector<float> position;  // (n, dim)
};

constexpr size_t history_columns = JAM_HISTORY_TOTAL_MSD_STABLE + 1;
using HistoryRow = std::array<double, history_columns>;  // by jam_history_column

// Details of one step, kept only on request: they cost as much memory as the LP.
struct CrunchStep {
  bool shown = false;                // a callback runs and may read them
  std::vector<double> displacement;  // (n, dim), unit of box, images followed
  std::vector<int32_t> pair;         // (m, 2) rows of the LP that carry force; empty for other steps
  std::vector<double> vector;        // (m, dim) r_ij before the step, unit of box
  std::vector<double> multiplier;    // m: lambda_ij, sum lambda sigma_ij^2 = 1
};

// What each step of a crunch did.
class History {
 public:
  // From here on displacements count. details: fill step() too. keep: states to keep at most, the start with them;
  // large packings keep fewer.
  void begin(const Packing &start, bool details, int64_t keep = 0);
  // A row for the move since the last call. displacement, unit of box, without that by a strain of the cell, may be
  // NULL when no sphere moved by half a box beside it: then nearest images give it. seconds, factorisations: totals so
  // far. Unknown columns are NaN.
  HistoryRow &moved(const Packing &now, jam_step_phase phase, double seconds, int factorisations,
                    const double *displacement = nullptr);
  // The cell has other vectors now, and the spheres turned with it: so do their displacements.
  void turn(const Packing &now, const NormalCell &cell);
  // Mean squares of the last row over stable spheres alone: those with a contact.
  void over_stable(const std::vector<int32_t> &coordination);
  // From begin() to `now`, over the mean diameter, without the mean displacement: the largest, and the root of the mean
  // square; with `coordination` of the spheres that have contacts.
  void displaced(const Packing &now, const std::vector<int32_t> *coordination, double &largest, double &rms) const;
  // The packing at the last row: valid also while a step is being made.
  const Packing &reached() const { return reached_; }
  CrunchStage stage;  // where a crunch continues from there
  // Did any sphere move, or grow, since the last row?
  bool behind(const Packing &now) const {
    return now.position != reached_.position || now.diameter.front() != reached_.diameter.front();
  }
  // Did any of this happen since the start?
  bool left_start(const Packing &now) const { return !rows_.empty() || behind(now); }
  // The linear network of an LP before its step is made.
  void take_network(const Packing &p, const PackingLp &lp, const LpSolution &answer);

  bool details() const { return details_; }
  CrunchStep &step() { return step_; }
  const CrunchStep &step() const { return step_; }
  const std::vector<HistoryRow> &rows() const & { return rows_; }
  std::vector<HistoryRow> rows() && { return std::move(rows_); }
  std::vector<KeptStep> kept() && { return std::move(kept_); }

 private:
  // Where there is no more room every other state goes.
  void keep(const Packing &now);
  // By what the strain of the cell since the last row moves these points, or the images that are followed: those of
  // the start.
  std::vector<double> by_strain(const Packing &now, std::vector<double> points) const;
  std::vector<double> by_strain(const Packing &now) const;
  // Displacements by the images that are nearest beside a strain.
  std::vector<double> since_last_row(const Packing &now) const;

  bool details_ = false;
  std::vector<HistoryRow> rows_;
  std::vector<KeptStep> kept_;
  int64_t most_kept_ = 0, kept_every_ = 1;
  Packing reached_;
  std::vector<double> start_, total_, last_;  // where begin() was; moved since then; moved in the last row
  double seconds_ = 0.0;
  int factorisations_ = 0;
  CrunchStep step_;
};

jam_crunch_options default_crunch_options();
// Throws for options that make no sense and for packings that cannot be crunched.
void check_options(const Packing &p, const jam_crunch_options &o);

struct CrunchResult {
  Packing packing;          // always valid: the last good state
  ContactNetwork contacts;  // of the last LP; empty if none was solved
  jam_crunch_report report{};
  jam_status status = JAM_OK;
  Notes notes;       // what became of the vectors of a free cell
  std::string text;  // why, when status is not JAM_OK; empty where the stop reason says it all
};

// For tests and benches alone: what no input does at will. Each may be empty.
struct CrunchHooks {
  Tuning tuning;
  std::function<void(LpSolution &, jam_lp_solver)> answer;  // an LP's answer before it is checked
  std::function<void(const Packing &, ContactNetwork &)> before_polish;
};

// Throws for bad options, and where the estimate exceeds the memory of the call, else never: the result carries the
// status. history may be NULL; its stage says where a stopped crunch begins, and where this one stopped.
CrunchResult crunch(const Packing &start, const jam_crunch_options &o, Monitor &monitor, History *history = nullptr,
                    const CrunchHooks *hooks = nullptr);

// Memory and work of a crunch, from the particle graph and its elimination tree alone. Throws for bad options.
[[gnu::cold]] jam_estimate_report estimate(const Packing &start, const jam_crunch_options &o);

}  // namespace jam::inside
