#include "crunch/crunch.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>

#include "core/archive.hpp"
#include "core/call_scope.hpp"
#include "core/limits.hpp"
#include "core/pair_rule.hpp"
#include "crunch/phases.hpp"
#include "network/resolution.hpp"
#include "verdict/text.hpp"

namespace jam::inside {
Spread spread(const std::vector<double> &x, int dim, double unit, const std::vector<int32_t> *coordination,
              uint32_t closed_axes) {
  const size_t n = x.size() / static_cast<size_t>(dim);
  const auto counts = [&](size_t i) { return !coordination || (*coordination)[i] > 0; };
  std::array<double, JAM_MAX_DIM> mean{};
  double number = 0.0;
  for (size_t i = 0; i < n; ++i) number += counts(i);
  for (size_t k = 0; k < x.size(); ++k)
    if (counts(k / dim) && !(closed_axes >> k % dim & 1)) mean[k % dim] += x[k] / number;
  Spread out;
  double sum = 0.0;
  for (size_t i = 0; i < n; ++i) {
    if (!counts(i)) continue;
    double r2 = 0.0;
    for (int c = 0; c < dim; ++c) r2 += (x[i * dim + c] - mean[c]) * (x[i * dim + c] - mean[c]);
    sum += r2, out.largest = std::max(out.largest, r2);
  }
  out.largest = std::sqrt(out.largest) / unit;
  out.mean_square = sum / (number * unit * unit);  // not a number without a sphere
  return out;
}

void History::begin(const Packing &start, bool details, int64_t most) {
  details_ = details;
  rows_.clear();
  rows_.reserve(64);
  reached_ = start, start_ = start.position;
  total_.assign(start.position.size(), 0.0);
  last_ = total_;
  kept_.clear(), kept_every_ = 1;
  most_kept_ = std::min(most, std::max<int64_t>(1, limits::kept_coordinates / static_cast<int64_t>(last_.size())));
  keep(start);
  seconds_ = 0.0, factorisations_ = 0;
  step_ = CrunchStep();
}

std::vector<double> History::by_strain(const Packing &now, std::vector<double> x) const {
  const size_t d = static_cast<size_t>(now.dim);
  const bool same = now.cell.rows() == reached_.cell.rows();
  Cell::Vector to{};
  for (size_t k = 0; k < x.size(); k += d) {
    reached_.cell.fraction(&x[k], to.data());
    now.cell.combine(to.data(), to.data());
    for (size_t c = 0; c < d; ++c) x[k + c] = same ? 0.0 : to[c] - x[k + c];
  }
  return x;
}

std::vector<double> History::by_strain(const Packing &now) const {
  std::vector<double> image(start_);
  for (size_t k = 0; k < image.size(); ++k) image[k] += total_[k];
  return by_strain(now, std::move(image));
}

std::vector<double> History::since_last_row(const Packing &now) const {
  const std::vector<double> moved = by_strain(now, reached_.position), whole = by_strain(now);
  std::vector<double> x(now.position);
  for (size_t k = 0; k < x.size(); ++k) x[k] -= reached_.position[k] + moved[k];
  for (size_t i = 0; i < now.n(); ++i) now.cell.nearest(&x[i * static_cast<size_t>(now.dim)]);
  for (size_t k = 0; k < x.size(); ++k) x[k] += whole[k];
  return x;
}

void History::turn(const Packing &now, const NormalCell &cell) {
  cell.turn(start_), cell.turn(total_);
  reached_ = now;
}

HistoryRow &History::moved(const Packing &now, jam_step_phase phase, double seconds, int factorisations,
                           const double *displacement) {
  last_ = displacement ? by_strain(now) : since_last_row(now);
  for (size_t k = 0; displacement && k < last_.size(); ++k) last_[k] += displacement[k];
  for (size_t k = 0; k < last_.size(); ++k) total_[k] += last_[k];
  HistoryRow row;
  row.fill(std::numeric_limits<double>::quiet_NaN());
  const double unit = diameter_mean(now);
  const Spread step = spread(last_, now.dim, unit), total = spread(total_, now.dim, unit);
  row[JAM_HISTORY_STEP_MAX] = step.largest, row[JAM_HISTORY_STEP_MSD] = step.mean_square;
  row[JAM_HISTORY_TOTAL_MAX] = total.largest, row[JAM_HISTORY_TOTAL_MSD] = total.mean_square;
  row[JAM_HISTORY_PHASE] = phase;
  const double before = reached_.diameter.front();
  row[JAM_HISTORY_GAIN] = (now.diameter.front() - before) / before;
  row[JAM_HISTORY_PHI] = packing_fraction(now);
  row[JAM_HISTORY_SECONDS] = seconds - seconds_;
  row[JAM_HISTORY_FACTORISATIONS] = row[JAM_HISTORY_ITERATIONS] = factorisations - factorisations_;
  rows_.push_back(row);
  keep(now);
  reached_ = now;
  seconds_ = seconds, factorisations_ = factorisations;
  if (details_) {
    step_.displacement = last_;
    if (phase != JAM_STEP_LP) step_.pair.clear(), step_.vector.clear(), step_.multiplier.clear();
  }
  return rows_.back();
}

void History::displaced(const Packing &now, const std::vector<int32_t> *coordination, double &largest,
                        double &rms) const {
  std::vector<double> x = since_last_row(now);
  for (size_t k = 0; k < x.size(); ++k) x[k] += total_[k];
  const Spread s = spread(x, now.dim, diameter_mean(now), coordination);
  largest = s.largest, rms = std::sqrt(s.mean_square);
}

void History::over_stable(const std::vector<int32_t> &coordination) {
  HistoryRow &row = rows_.back();
  const int dim = reached_.dim;
  const double unit = diameter_mean(reached_);
  row[JAM_HISTORY_STEP_MSD_STABLE] = spread(last_, dim, unit, &coordination).mean_square;
  row[JAM_HISTORY_TOTAL_MSD_STABLE] = spread(total_, dim, unit, &coordination).mean_square;
}

void History::take_network(const Packing &p, const PackingLp &lp, const LpSolution &answer) {
  const std::vector<char> on = force_carrying(lp, answer, 0.0);
  const PairList &pairs = *lp.pairs;
  double r[JAM_MAX_DIM];
  step_.pair.clear(), step_.vector.clear(), step_.multiplier.clear();
  for (size_t k = 0; k < on.size(); ++k) {
    if (!on[k] || !(answer.y[k] > 0.0)) continue;  // Clp's vertices may have contacts without force
    const double sigma = contact_distance(p, pairs.i[k], pairs.j[k]);
    pair_vector(p, pairs, k, r);
    step_.pair.push_back(pairs.i[k]), step_.pair.push_back(pairs.j[k]);
    step_.vector.insert(step_.vector.end(), r, r + p.dim);
    step_.multiplier.push_back(answer.y[k] / (sigma * sigma));
  }
}

void History::keep(const Packing &now) {
  const int64_t step = static_cast<int64_t>(rows_.size());
  if (most_kept_ == 0 || step % kept_every_ != 0) return;
  kept_.push_back({step, now.diameter.front(), packing_fraction(now), now.cell,
                   std::vector<float>(now.position.begin(), now.position.end())});
  while (static_cast<int64_t>(kept_.size()) > most_kept_) {
    kept_every_ *= 2;
    const auto left_out = [&](const KeptStep &k) { return k.step % kept_every_ != 0; };
    kept_.erase(std::remove_if(kept_.begin(), kept_.end(), left_out), kept_.end());
  }
}

static void archive(CrunchStage &s, Archive &a) {
  a(s.path.mu), a(s.path.first_mu), a(s.path_taken), a(s.cell_free);
  if (a.reading() ? a.more() : s.decompressions > 0) a(s.decompressions);  // files of 1.0.0 end before it
  Archive::check(s.path.mu >= 0.0 && s.path.mu <= s.path.first_mu && std::isfinite(s.path.first_mu));
}

std::string CrunchStage::bytes() const {
  CrunchStage copy = *this;
  Archive a;
  archive(copy, a);
  return a.bytes();
}

CrunchStage CrunchStage::of(const std::string &bytes) {
  CrunchStage stage;
  Archive a(bytes);
  archive(stage, a);
  a.end();
  return stage;
}

Touching find_touching(const Packing &start) {
  const GapResolution resolution = gap_resolution(start);
  const PairList pairs = resolution.pairs_in_reach(start, contact_gap_limit);
  const std::vector<double> gap = relative_gaps(start, pairs);
  Touching found;
  found.total = 0;
  for (size_t k = 0; k < pairs.size(); ++k) {
    const double sigma = contact_distance(start, pairs.i[k], pairs.j[k]);
    if (!(gap[k] < contact_gap_limit || gap[k] * sigma < resolution.reach(sigma))) continue;
    ++found.images[{pairs.i[k], pairs.j[k]}], ++found.total;
  }
  return found;
}

void report_changes(CrunchState &s) {
  Touching &start = s.touching;
  jam_crunch_report &r = s.out.report;
  r.packing_fraction_start = packing_fraction(s.start);
  r.contacts_start = start.total;
  r.contacts_kept = -1;
  r.displacement_max = r.displacement_rms = r.displacement_max_stable = r.displacement_rms_stable = std::nan("");
  try {
    const std::vector<int32_t> &coordination = s.out.contacts.coordination;
    s.history.displaced(s.out.packing, nullptr, r.displacement_max, r.displacement_rms);
    if (stable_spheres(coordination) > 0)
      s.history.displaced(s.out.packing, &coordination, r.displacement_max_stable, r.displacement_rms_stable);
  } catch (const std::exception &) {  // out of memory: the rest of the report is kept
  }
  if (r.rattlers < 0 || start.total < 0) return;
  r.contacts_kept = 0;
  const PairList &contacts = s.out.contacts.pairs;
  for (size_t k = 0; k < contacts.size(); ++k) {
    const auto at = start.images.find({contacts.i[k], contacts.j[k]});
    if (at != start.images.end() && at->second > 0) --at->second, ++r.contacts_kept;
  }
}

// The cause of a status above 0. A sphere that fills a round container stands in its middle, where the wall has no
// normal; LPs get within 1e-12 to 1e-8.
static void explain(CrunchState &s) {
  const Packing &p = s.out.packing;
  const auto largest = std::max_element(p.diameter.begin(), p.diameter.end());
  const bool round = p.container.curved() != 0;
  if (s.out.status <= 0 || (p.container && !round) || s.o.strain != JAM_STRAIN_NONE ||
      *largest <
          (round ? p.container.widest() * (1.0 - undecided_gap_limit) : p.cell.shortest() * (1.0 - contact_gap_limit)))
    return;
  s.out.text = "sphere " + std::to_string(largest - p.diameter.begin()) +
               (round ? " fills the width of the container, nothing can grow here; spheres are free along its axis"
                      : " touches its own image, nothing can grow here; a free cell (strain) gives way");
  s.monitor.log(JAM_LOG_WARNING, "%s", s.out.text.c_str());
}

// The work that was done. A crunch that was stopped where no LP has named contacts says nothing of them.
static void report_work(CrunchState &s) {
  jam_crunch_report &r = s.out.report;
  r.method = s.history.stage.path_taken ? JAM_CRUNCH_BARRIER_PATH : JAM_CRUNCH_SEQUENTIAL_LP;
  r.decompressions = s.history.stage.decompressions;
  r.factorisations = s.system.factorisations;
  r.seconds = s.monitor.seconds();
  const bool unknown = r.stop_reason == JAM_STOP_CANCELLED || r.stop_reason == JAM_STOP_WALL_TIME ||
                       r.stop_reason == JAM_STOP_SOLVER ||
                       (r.stop_reason == JAM_STOP_LP_LIMIT && s.last.active.coordination.empty());
  if (!unknown || s.out.contacts.size() > 0) return;
  r.contacts = r.rattlers = r.bucklers = r.isostatic_contacts = r.flexes = r.zero_force_contacts =
      r.undecided_contacts = r.undercoordinated = r.strict_contacts_needed = -1;
  r.stable = r.excess_contacts = 0;
  r.rigidity_margin = r.force_residual = r.min_force = r.min_gap = r.max_contact_gap = r.force_scale =
      std::numeric_limits<double>::quiet_NaN();
}

void report_end(CrunchState &s) {
  jam_crunch_report &r = s.out.report;
  certify(s.out.packing, s.out.contacts, r, s.next.strain.count() > 0);
  r.strictly_jammed = s.found.strictly_jammed;
  const bool balanced = r.force_residual < (s.o.polish ? least_rest : InteriorPointTuning::balance);
  if (s.found.verdict.jammed == Verdict::yes && !(balanced && r.min_force >= 0.0)) {
    s.found.verdict.hear(Rule::unbalanced, Verdict::undecided);
    report_verdict(s.found.verdict, r);
    stop(s, JAM_STOP_SOLVER, JAM_NOT_CONVERGED);
  }
  report_work(s);
  r.seconds_factor = s.system.seconds_factor;
  r.seconds_assemble = s.system.seconds_assemble;
  r.seconds_solve = s.system.seconds_solve;
  explain(s);
}

void report_failure(CrunchState &s) {
  wrap_positions(s.out.packing);
  ContactNetwork &c = s.out.contacts;
  c.pairs.clear(), c.vector.clear(), c.gap.clear(), c.force.clear();
  std::fill(c.coordination.begin(), c.coordination.end(), 0);
  try {
    certify(s.out.packing, c, s.out.report);
  } catch (const std::exception &) {  // out of memory, or over its limit
    s.out.report.packing_fraction = packing_fraction(s.out.packing);
  }
  report_work(s);
}

}  // namespace jam::inside
