#include "soft/shear.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/cell_change.hpp"
#include "core/create.hpp"
#include "core/error.hpp"
#include "soft/tuning.hpp"

namespace jam::inside {
namespace {

// Root mean square of what two packings differ by beyond an affine change of the cell, over spheres that contacts hold
// in both, without their mean; in mean diameters.
double nonaffine(const ShearPoint &from, const ShearPoint &to) {
  const Packing &p = from.at.packing, &q = to.at.packing;
  const size_t d = static_cast<size_t>(p.dim);
  std::vector<double> all, mean(d, 0.0);
  double diameter = 0.0;
  for (size_t i = 0; i < p.n(); ++i) {
    diameter += q.diameter[i] / static_cast<double>(p.n());
    if (from.at.contacts.coordination[i] == 0 || to.at.contacts.coordination[i] == 0) continue;
    Cell::Vector s{}, x{};
    p.cell.fraction(&p.position[i * d], s.data());
    q.cell.combine(s.data(), x.data());
    for (size_t c = 0; c < d; ++c) x[c] = q.position[i * d + c] - x[c];
    q.cell.nearest(x.data());
    for (size_t c = 0; c < d; ++c) all.push_back(x[c]), mean[c] += x[c];
  }
  const double count = static_cast<double>(all.size() / d);
  double sum = 0.0;
  for (size_t k = 0; k < all.size(); ++k) {
    const double x = all[k] - mean[k % d] / count;
    sum += x * x;
  }
  return count > 0.0 ? std::sqrt(sum / count) / diameter : 0.0;
}

class Shear {
 public:
  Shear(const jam_shear_options &o, const ShearPath &path, const FindMinimum &minimum, Effort &effort, Monitor &monitor)
      : o_(o), path_(path), minimum_(minimum), effort_(effort), monitor_(monitor) {
    effort_.monitor = &monitor;
    effort_.phase = JAM_PHASE_SHEAR;
    effort_.pressure = std::nan("");
    jam_shear_report &r = out_.report;
    r.stress = r.pressure = r.energy = r.first_event = r.peak_stress = r.peak_strain = std::nan("");
    r.contacts = r.rattlers = -1;
  }

  ShearResult run(const Packing &start) {
    effort_.packing_fraction = packing_fraction(start);
    out_.last = minimum_(start, true);
    refuse_wider_than_periods(out_.last.at.packing, JAM_E_OVERLAP);  // a cell that a load presses
    bool ended = !out_.last.found;
    if (ended) {
      fail_with(out_.last);
    } else {
      add_row(out_.last, 0.0, false);
      ended = at_end(false);
    }
    double from = 0.0;
    for (size_t k = 0; !ended && k < path_.turns.size(); ++k) {
      ended = leg(from, path_.turns[k]);
      from = path_.turns[k];
    }
    if (!ended) end_with(JAM_OK, JAM_STOP_STRAIN);
    finish();
    return std::move(out_);
  }

 private:
  bool end_with(jam_status status, int32_t reason) {
    out_.status = status, out_.report.stop_reason = reason;
    return true;
  }
  bool fail_with(const ShearPoint &p) {
    out_.why = p.why;
    return end_with(p.at.status, p.stop_reason);
  }

  // From one turn to the next by equal steps, the last one what is left. Every step has the same bits wherever it is.
  bool leg(double from, double to) {
    const double way = to - from, step = std::copysign(o_.step, way);
    const double whole = std::floor(std::fabs(way) / o_.step * (1.0 + 4.0 * std::numeric_limits<double>::epsilon()));
    const double rest = way - whole * step;
    for (double k = 0.0; k < whole; ++k)
      if (advance(from + k * step, step)) return true;
    const double rounding = whole > 0.0 ? ShearTuning::rounding_of_turns * o_.step : 0.0;  // of the turns
    if (std::fabs(rest) <= rounding) return false;
    return advance(from + whole * step, rest);
  }

  // One step. A cancel or the wall time takes back its part, so that the next call makes the same steps to the same
  // bits.
  bool advance(double strain, double step) {
    const Begun begun{out_.last, out_.rows.size(), out_.report};  // a row, too
    if (!go_through(strain, step)) return false;
    const int32_t reason = out_.report.stop_reason;
    if (at_.done == 0.0 || (reason != JAM_STOP_CANCELLED && reason != JAM_STOP_WALL_TIME)) return true;
    out_.last = begun.last, out_.report = begun.report, has_row_ = true;
    out_.rows.resize(begun.rows);
    at_.done = 0.0, out_.report.stop_reason = reason;
    return true;
  }

  // Where a step does not add up, bisection finds two strains within the resolution: up to the first it does, from
  // there to the second it does not. Then the step goes on from the second.
  bool go_through(double strain, double step) {
    double bad = step, trial = step;
    bool bracketed = false, located = false;  // bracketed: from here to `bad` it does not add up
    for (at_.done = 0.0, at_.strain = strain; at_.done != step;) {
      ShearPoint next = at(out_.last, trial - at_.done);
      if (!next.found && bracketed && !located && next.at.status != JAM_CANCELLED && !monitor_.interrupted()) {
        located = true, trial = bad;  // so near to jamming minima cannot be found
        continue;
      }
      if (!next.found) return fail_with(next);
      const bool jump = suspicious(out_.last, next, trial - at_.done);
      const double middle = at_.done + 0.5 * (trial - at_.done);
      if (jump && !located && std::fabs(trial - at_.done) > o_.resolution && middle != at_.done) {
        bad = trial, trial = middle, bracketed = true;
        continue;
      }
      bool event = false;
      if (jump && !is_event(next, trial - at_.done, event)) return true;
      if ((event || out_.last.rigid != next.rigid) && !has_row_) add_row(out_.last, strain + at_.done, false);
      out_.last = std::move(next), has_row_ = false;
      at_.done = trial;
      if (trial == bad) bracketed = located = false;
      trial = !bracketed ? step : std::fabs(bad - at_.done) > o_.resolution ? at_.done + 0.5 * (bad - at_.done) : bad;
      if (event || at_.done == step || out_.last.rigid != row_.rigid) add_row(out_.last, strain + at_.done, event);
      if (at_end(event)) return true;
    }
    return false;
  }

  // Whether a step of the resolution's size cannot be taken back. False where a minimum was not found.
  bool is_event(const ShearPoint &next, double step, bool &event) {
    if (!out_.last.rigid || !next.rigid) return true;
    const ShearPoint back = at(next, -step);
    if (!back.found) return !fail_with(back);
    event = !back.rigid || nonaffine(out_.last, back) > ShearTuning::irreversible * nonaffine(out_.last, next);
    return true;
  }

  ShearPoint at(const ShearPoint &from, double step) {
    ++effort_.steps;
    Packing p = from.at.packing;
    try {
      if (strain_affinely(p, finite_strain(path_.mode, step, p.dim).data()).rotated)
        fail(JAM_E_UNSUPPORTED, "the cell has become so long that it must be rotated, and with it the strain");
      refuse_wider_than_periods(p, JAM_E_OVERLAP);
      const ShearPoint to = minimum_(p, false);
      refuse_wider_than_periods(to.at.packing, JAM_E_OVERLAP);  // a free cell
      return to;
    } catch (const Error &e) {  // beyond the limits of cells: what was reached is kept
      ShearPoint none;
      none.at.status = JAM_NOT_CONVERGED, none.stop_reason = JAM_STOP_STALLED;
      none.why = std::string("the shear ends before its last strain: ") + e.what();
      return none;
    }
  }

  // (1 / V) d enthalpy / dstrain.
  double stress(const ShearPoint &p) const {
    double sum = 0.0;
    const size_t d = static_cast<size_t>(p.at.packing.dim);
    for (size_t c = 0; c < d * d && p.rigid; ++c) sum -= path_.mode[c] * p.stress[c];
    return sum;
  }
  // The logarithm of the deformation from a to b, to third order. Products of the mode with the strain of free
  // components are of second order, as is the work that a step may miss.
  std::vector<double> log_strain(const ShearPoint &b, double step) const {
    const size_t d = static_cast<size_t>(b.at.packing.dim);
    std::vector<double> e(d * d), out(d * d);
    for (size_t k = 0; k < d * d; ++k) out[k] = step * path_.mode[k];
    if (b.strain.empty()) return out;
    const auto product = [&](const std::vector<double> &x, const std::vector<double> &y) {
      std::vector<double> sum(d * d, 0.0);
      for (size_t k = 0; k < d * d; ++k)
        for (size_t c = 0; c < d; ++c) sum[k] += x[k / d * d + c] * y[c * d + k % d];
      return sum;
    };
    const std::vector<double> affine = finite_strain(path_.mode, step, b.at.packing.dim);
    const std::vector<double> both = product(b.strain, affine);
    for (size_t k = 0; k < d * d; ++k) e[k] = affine[k] + b.strain[k] + both[k];
    const std::vector<double> square = product(e, e), cube = product(square, e);
    for (size_t k = 0; k < d * d; ++k) out[k] = e[k] - square[k] / 2.0 + cube[k] / 3.0;
    return out;
  }

  // The enthalpy must change by the work of the mean stress on the whole strain, held stresses and pressure too.
  bool suspicious(const ShearPoint &a, const ShearPoint &b, double step) const {
    if (a.rigid != b.rigid || !a.rigid) return a.rigid != b.rigid;
    const size_t d = static_cast<size_t>(b.at.packing.dim);
    const std::vector<double> strain = log_strain(b, step);
    double work = 0.0, change = 0.0;
    for (size_t k = 0; k < d * d; ++k) {
      const double on = k % (d + 1) == 0 ? 1.0 : 0.0;
      const double before = a.volume * (on * a.confining - a.stress[k]);
      const double after = b.volume * (on * b.confining - b.stress[k]);
      work += 0.5 * strain[k] * (before + after), change += strain[k] * (after - before);
    }
    const double departs = std::fabs(b.enthalpy - a.enthalpy - work);
    const double noise = ShearTuning::energy_digits * (std::fabs(a.enthalpy) + std::fabs(b.enthalpy));
    return departs > ShearTuning::suspicious * std::fabs(change) + noise;
  }

  bool at_end(bool event) {
    if (o_.until == JAM_UNTIL_EVENT && event) return end_with(JAM_OK, JAM_STOP_EVENT);
    if (o_.until == JAM_UNTIL_JAMMED && out_.last.rigid) return end_with(JAM_OK, JAM_STOP_JAMMED);
    if (o_.until == JAM_UNTIL_UNJAMMED && !out_.last.rigid) return end_with(JAM_OK, JAM_STOP_UNJAMMED);
    if (effort_.steps >= o_.max_steps) return end_with(JAM_LIMIT, JAM_STOP_STEPS);
    return false;
  }

  void add_row(const ShearPoint &p, double strain, bool event) {
    const size_t d = static_cast<size_t>(p.at.packing.dim);
    double trace = 0.0;
    for (size_t c = 0; c < d && p.rigid; ++c) trace += p.stress[c * (d + 1)] / static_cast<double>(d);
    ShearRow row{};
    row[JAM_SHEAR_STRAIN] = strain;
    row[JAM_SHEAR_STRESS] = stress(p);
    row[JAM_SHEAR_PRESSURE] = trace;
    row[JAM_SHEAR_ENERGY] = p.at.report.energy / static_cast<double>(p.at.packing.n());
    row[JAM_SHEAR_PHI] = p.at.report.packing_fraction;
    row[JAM_SHEAR_CONTACTS] = static_cast<double>(p.at.contacts.size());
    row[JAM_SHEAR_RATTLERS] = static_cast<double>(p.at.report.rattlers);
    row[JAM_SHEAR_EVENT] = event;
    if (!out_.rows.empty()) {
      const double common = static_cast<double>(common_contacts(row_.at.contacts, p.at.contacts).size());
      row[JAM_SHEAR_MADE] = static_cast<double>(p.at.contacts.size()) - common;
      row[JAM_SHEAR_BROKEN] = static_cast<double>(row_.at.contacts.size()) - common;
      row[JAM_SHEAR_NONAFFINE] = nonaffine(row_, p);
    }
    row[JAM_SHEAR_EVALUATIONS] = static_cast<double>(effort_.evaluations - spent_.evaluations);
    row[JAM_SHEAR_FACTORISATIONS] = static_cast<double>(effort_.factorisations - spent_.factorisations);
    jam_shear_report &r = out_.report;
    if (event && r.events++ == 0) r.first_event = out_.rows.back()[JAM_SHEAR_STRAIN];
    if (p.rigid && !(std::fabs(row[JAM_SHEAR_STRESS]) <= std::fabs(r.peak_stress)))
      r.peak_stress = row[JAM_SHEAR_STRESS], r.peak_strain = strain;
    monitor_.log(JAM_LOG_INFO, "shear: strain %.9g stress %.6e%s, %lld evaluations", strain, row[JAM_SHEAR_STRESS],
                 event ? ", event" : "", static_cast<long long>(effort_.evaluations - spent_.evaluations));
    effort_.packing_fraction = p.at.report.packing_fraction, effort_.pressure = trace;
    row_ = p, spent_ = effort_, has_row_ = true;
    out_.rows.push_back(row);
  }

  void finish() {
    jam_shear_report &r = out_.report;
    const ShearPoint &p = out_.last;
    r.rigid = p.found && p.rigid;
    if (!out_.rows.empty()) {
      if (!has_row_) add_row(p, at_.strain + at_.done, false);
      const ShearRow &row = out_.rows.back();
      r.strain = row[JAM_SHEAR_STRAIN];
      if (p.rigid) r.stress = row[JAM_SHEAR_STRESS], r.pressure = row[JAM_SHEAR_PRESSURE];
      r.energy = p.at.report.energy;
      r.contacts = static_cast<int64_t>(p.at.contacts.size());
      r.rattlers = p.at.report.rattlers;
    }
    r.packing_fraction = out_.rows.empty() ? packing_fraction(p.at.packing) : p.at.report.packing_fraction;
    r.steps = effort_.steps;
    r.evaluations = effort_.evaluations;
    r.factorisations = effort_.factorisations;
    r.seconds = monitor_.seconds();
  }

  struct Begun {  // what a step began from
    ShearPoint last;
    size_t rows;
    jam_shear_report report;
  };

  const jam_shear_options &o_;
  const ShearPath &path_;
  const FindMinimum &minimum_;
  Effort &effort_;
  Monitor &monitor_;
  struct {
    double strain = 0.0, done = 0.0;
  } at_;                  // of the last minimum: at the begin of its step, and behind that
  bool has_row_ = false;  // the last minimum
  ShearPoint row_;        // of the last row
  Effort spent_;          // until it
  ShearResult out_;
};

}  // namespace

ShearResult shear(const Packing &start, const jam_shear_options &o, const ShearPath &path, const FindMinimum &minimum,
                  Effort &effort, Monitor &monitor) {
  monitor.wall_time = o.wall_time;
  return Shear(o, path, minimum, effort, monitor).run(start);
}

}  // namespace jam::inside
