// Stages of molecular dynamics: windows of pressure, thermostat, limits, report.
#include <algorithm>

#include "core/error.hpp"
#include "core/rng.hpp"
#include "edmd/engine.hpp"
#include "edmd/md.hpp"

namespace jam {
namespace {

double sum_squares(const std::vector<double> &v) {
  double sum = 0.0;
  for (double x : v) sum += x * x;
  return sum;
}

// Maxwell-Boltzmann with zero total momentum and exactly kT/m = 1.
void draw_velocities(Packing &p) {
  const size_t n = p.n(), d = static_cast<size_t>(p.dim);
  Rng rng(p.seed, Stream::velocities);
  for (double &v : p.velocity) v = rng.normal();
  if (n > 1)
    for (size_t c = 0; c < d; ++c) {
      double mean = 0.0;
      for (size_t i = 0; i < n; ++i) mean += p.velocity[i * d + c];
      mean /= static_cast<double>(n);
      for (size_t i = 0; i < n; ++i) p.velocity[i * d + c] -= mean;
    }
  const double factor = std::sqrt(static_cast<double>(n * d) / sum_squares(p.velocity));
  for (double &v : p.velocity) v *= factor;
  p.has_velocity = true;
}

template <int D>
std::unique_ptr<EngineBase> make_engine_of(const Packing &p, const EngineOptions &o) {
  if (p.model == JAM_MODEL_EUCLID && Engine<D, false>::fits(diameter_max(p) / p.box)) return std::make_unique<Engine<D, false>>(p, o);
  return std::make_unique<Engine<D, true>>(p, o);
}

// The stage as it runs; keeps what must survive a change of engine.
class Stage {
 public:
  Stage(Packing &p, const MdStage &stage, Monitor &monitor, jam_md_report &report)
      : p_(p), stage_(stage), monitor_(monitor), report_(report), growing_(stage.growth > 0.0), n_(static_cast<double>(p.n())) {}

  jam_status run() {
    const double begin = now_seconds();
    prepare();
    engine_ = make_engine(p_, options());
    if (engine_->max_overlap > 1e-10)
      fail(JAM_E_OVERLAP, "spheres overlap by %g of sigma at the start of molecular dynamics", engine_->max_overlap);
    const double kinetic = engine_->twice_kinetic();
    int32_t reason = already_there() ? JAM_STOP_PACKING_FRACTION : JAM_STOP_NONE;
    const double wall_end = begin + stage_.wall_time;
    while (reason == JAM_STOP_NONE) reason = window(wall_end);
    finish(reason, begin, kinetic);
    return status_of(reason);
  }

 private:
  EngineOptions options() const {
    EngineOptions o;
    o.growth = stage_.growth;
    if (growing_) o.target_fraction = stage_.packing_fraction;
    return o;
  }

  void prepare() {
    if (!p_.has_velocity || (growing_ && sum_squares(p_.velocity) == 0.0)) draw_velocities(p_);
    if (growing_) {
      const double factor = std::sqrt(n_ * p_.dim / sum_squares(p_.velocity));
      for (double &v : p_.velocity) v *= factor;
    }
    goal_ = stage_.collisions_per_particle * n_ / 2.0;  // each collision is one for two spheres
    // A window is so long that its noise is small and so short that p changes little in it: d ln p = G / 1.63 a collision.
    const double most = growing_ ? std::min(2.0, std::max(0.25, 0.03 / stage_.growth)) * n_ : std::min(goal_ / 20.0, 20.0 * n_);
    window_ = static_cast<int64_t>(std::max(growing_ ? 32.0 : 4.0, most));
  }
  bool already_there() const { return growing_ && jam::packing_fraction(p_) >= stage_.packing_fraction; }

  // Runs one window; JAM_STOP_NONE to go on.
  int32_t window(double wall_end) {
    const int parts = growing_ ? 4 : 1;
    double virial = 0.0, action = 0.0;
    bool steady = true;  // no part of the window is far below the target: a stop is not made of noise
    for (int part = 0; part < parts; ++part) {
      int64_t todo = std::max<int64_t>(1, window_ / parts);
      const double left = goal_ - static_cast<double>(total_collisions());
      if (left < static_cast<double>(todo)) todo = static_cast<int64_t>(std::ceil(std::max(1.0, left)));
      const MdSums before = engine_->sums;
      const Halt halt = engine_->advance(todo, monitor_, wall_end);
      const double dv = engine_->sums.virial - before.virial, da = engine_->sums.action - before.action;
      steady = steady && da > 0.0 && 1.0 + dv / da > 0.25 * stage_.pressure;
      if (da > 0.0) note(1.0 + dv / da, dv, da), virial += dv, action += da;
      if (halt == Halt::needs_images) {
        change_engine();
        continue;
      }
      if (halt != Halt::window) {
        if (halt == Halt::packing_fraction && action > 0.0) pressure_ = 1.0 + virial / action;
        return reason_of(halt);
      }
    }
    if (action > 0.0) pressure_ = 1.0 + virial / action;
    if (action <= 0.0 && virial > 0.0) return ++frozen_ > 20 ? JAM_STOP_STALLED : JAM_STOP_NONE;
    if (report_progress()) return JAM_STOP_CANCELLED;
    if (growing_ && steady && pressure_ >= stage_.pressure) return JAM_STOP_PRESSURE;
    // Gaps are about sigma / p; below some tens of units of the integers they are noise.
    if (growing_ && pressure_ > 1.0 && engine_->mean_diameter() / pressure_ < 40.0 * 0x1p-61) return JAM_STOP_PRECISION;
    if (static_cast<double>(total_collisions()) >= goal_) return JAM_STOP_COLLISIONS;
    thermostat();
    return JAM_STOP_NONE;
  }

  // Cooling takes away the speed with which spheres make room for each other. When they grow faster than they fly it must
  // wait until they have grown by a per cent or collided many times, or time would stop.
  void thermostat() {
    if (!growing_ || std::fabs(engine_->twice_kinetic() / (n_ * p_.dim) - 1.0) < 0.05) return;
    const double time = old_time_ + engine_->sums.time;
    if (stage_.growth > 0.5 && (time - cooled_) * stage_.growth < 0.01 * engine_->mean_diameter() &&
        total_collisions() - cooled_collisions_ < static_cast<int64_t>(50.0 * n_)) return;
    cooled_ = time;
    cooled_collisions_ = total_collisions();
    engine_->thermalise();
  }

  void note(double p, double virial, double action) {
    all_virial_ += virial;
    all_action_ += action;
    windows_.push_back(p);
    if (growing_ && windows_.size() > 16) windows_.erase(windows_.begin());
  }

  int64_t total_collisions() const { return old_collisions_ + engine_->sums.collisions; }

  void change_engine() {
    engine_->write_state(p_);
    old_collisions_ += engine_->sums.collisions;
    old_events_ += engine_->sums.events;
    old_time_ += engine_->sums.time;
    worst_ = std::max(worst_, engine_->max_overlap);
    engine_ = make_engine(p_, options());
  }

  bool report_progress() {
    jam_progress q{};
    q.phase = growing_ ? JAM_PHASE_COMPRESS : JAM_PHASE_RUN;
    q.packing_fraction = engine_->packing_fraction();
    q.pressure = pressure_;
    q.gain = q.max_step = std::numeric_limits<double>::quiet_NaN();
    q.collisions = report_.collisions + total_collisions();
    q.fraction = goal_ < never ? static_cast<double>(total_collisions()) / goal_ : std::numeric_limits<double>::quiet_NaN();
    return monitor_.report(q);
  }

  static int32_t reason_of(Halt halt) {
    switch (halt) {
      case Halt::packing_fraction: return JAM_STOP_PACKING_FRACTION;
      case Halt::cancelled: return JAM_STOP_CANCELLED;
      case Halt::wall_time: return JAM_STOP_WALL_TIME;
      default: return JAM_STOP_STALLED;
    }
  }
  jam_status status_of(int32_t reason) const {
    switch (reason) {
      case JAM_STOP_PRESSURE:
      case JAM_STOP_PACKING_FRACTION: return JAM_OK;
      case JAM_STOP_COLLISIONS: return growing_ ? JAM_LIMIT : JAM_OK;
      case JAM_STOP_WALL_TIME: return JAM_LIMIT;
      case JAM_STOP_CANCELLED: return JAM_CANCELLED;
      case JAM_STOP_PRECISION: return JAM_PRECISION;
      default: return JAM_NOT_CONVERGED;
    }
  }

  // Adds to the report, so that stages run one after the other give one.
  void finish(int32_t reason, double begin, double kinetic) {
    engine_->write_state(p_);
    worst_ = std::max(std::max(worst_, engine_->max_overlap), engine_->worst_overlap());
    if (!growing_ && all_action_ > 0.0) pressure_ = 1.0 + all_virial_ / all_action_;
    p_.pressure = pressure_;
    report_.stop_reason = reason;
    report_.collisions += total_collisions();
    report_.events += old_events_ + engine_->sums.events;
    report_.seconds += now_seconds() - begin;
    report_.collisions_per_second = static_cast<double>(report_.collisions) / std::max(report_.seconds, 1e-9);
    report_.pressure = pressure_;
    report_.pressure_error = standard_error();
    report_.packing_fraction = jam::packing_fraction(p_);
    report_.time += old_time_ + engine_->sums.time;
    report_.energy_drift = kinetic > 0.0 && !growing_ ? std::fabs(sum_squares(p_.velocity) / kinetic - 1.0) : 0.0;
    report_.max_overlap = std::max(report_.max_overlap, worst_);
  }
  // jam_run: of the mean over all windows. jam_compress: the last window is the mean of the last four parts.
  double standard_error() const {
    if (windows_.size() < (growing_ ? 8u : 5u)) return std::numeric_limits<double>::quiet_NaN();
    double mean = 0.0, square = 0.0;
    const double m = static_cast<double>(windows_.size());
    for (double p : windows_) mean += p / m;
    for (double p : windows_) square += (p - mean) * (p - mean) / (m - 1.0);
    return std::sqrt(square / (growing_ ? 4.0 : m));
  }

  Packing &p_;
  const MdStage &stage_;
  Monitor &monitor_;
  jam_md_report &report_;
  const bool growing_;
  const double n_;
  std::unique_ptr<EngineBase> engine_;
  double goal_ = 0.0, pressure_ = std::numeric_limits<double>::quiet_NaN();
  double all_virial_ = 0.0, all_action_ = 0.0, worst_ = 0.0, old_time_ = 0.0, cooled_ = 0.0;
  int64_t window_ = 1, cooled_collisions_ = 0, old_collisions_ = 0, old_events_ = 0;
  int frozen_ = 0;
  std::vector<double> windows_;
};

void positive(double value, const char *name) {
  if (!(value > 0.0)) fail(JAM_E_ARGUMENT, "%s is %g, it must be positive", name, value);
}

}  // namespace

std::unique_ptr<EngineBase> make_engine(const Packing &p, const EngineOptions &o) {
  switch (p.dim) {
    case 2: return make_engine_of<2>(p, o);
    case 3: return make_engine_of<3>(p, o);
    case 4: return make_engine_of<4>(p, o);
    case 5: return make_engine_of<5>(p, o);
    case 6: return make_engine_of<6>(p, o);
    case 7: return make_engine_of<7>(p, o);
    case 8: return make_engine_of<8>(p, o);
    default: fail(JAM_E_DIMENSION, "dim is %d", p.dim);
  }
}

jam_run_options default_run_options() {
  jam_run_options o{};
  o.struct_size = sizeof o;
  o.collisions_per_particle = 100.0;
  o.wall_time = never;
  return o;
}

jam_compress_options default_compress_options() {
  jam_compress_options o{};
  o.struct_size = sizeof o;
  o.growth_rate = 1e-2;
  o.pressure = 500.0;
  o.packing_fraction = o.collisions_per_particle = o.wall_time = never;
  return o;
}

void check_run_options(const jam_run_options &o) {
  positive(o.collisions_per_particle, "collisions_per_particle");
  positive(o.wall_time, "wall_time");
  if (o.collisions_per_particle == never && o.wall_time == never)
    fail(JAM_E_ARGUMENT, "collisions_per_particle and wall_time are both infinite: the run would not end");
}

void check_compress_options(const jam_compress_options &o) {
  positive(o.growth_rate, "growth_rate");
  if (o.growth_rate == never) fail(JAM_E_ARGUMENT, "growth_rate is %g", o.growth_rate);
  if (!(o.pressure > 1.0)) fail(JAM_E_ARGUMENT, "pressure is %g, it must be greater than 1", o.pressure);
  positive(o.packing_fraction, "packing_fraction");
  positive(o.collisions_per_particle, "collisions_per_particle");
  positive(o.wall_time, "wall_time");
}

jam_status run_stage(Packing &p, const MdStage &stage, Monitor &monitor, jam_md_report &report) {
  return Stage(p, stage, monitor, report).run();
}

jam_status run_default_protocol(Packing &p, Monitor &monitor, jam_md_report &report) {
  const MdStage first{1e-2, 500.0, never, never, never}, second{3e-3, 1e7, never, never, never};
  const jam_status status = run_stage(p, first, monitor, report);
  return status == JAM_OK ? run_stage(p, second, monitor, report) : status;
}

}  // namespace jam
