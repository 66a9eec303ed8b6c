// Isoconfigurational ensemble: options, the moments of one run, and sums over runs.
#include <cmath>

#include "core/limits.hpp"
#include "core/math.hpp"
#include "dynamics/isoconfigurational/isoconfigurational.hpp"

namespace jam::inside {

jam_isoconf_options default_isoconf_options() {
  jam_isoconf_options o{};
  o.struct_size = sizeof o;
  o.threads = 1;
  o.runs = 100;
  o.block = 20;
  o.density_ratio = o.temperature = 1.0;
  o.wave_number = 7.0;
  o.overlap_length = 0.3;
  o.memory_limit = 2e9;
  o.wall_time = std::numeric_limits<double>::infinity();
  return o;
}

namespace {

constexpr int64_t most_runs = int64_t{1} << 27;  // so many streams of 2^36 numbers there are

}  // namespace

void check_isoconf_options(const jam_isoconf_options &o) {
  check_threads(o.threads);
  check_flag(o.resume, "resume");
  check_enum(o.clock, JAM_CLOCK_COLLISIONS, JAM_CLOCK_TIME, "clock", "jam_clock");
  if (o.runs < 1 || o.first_run < 0 || o.first_run > most_runs - o.runs || o.runs > most_runs)
    fail(JAM_E_ARGUMENT, "%lld runs from number %lld on: numbers go from 0 to %lld", static_cast<long long>(o.runs),
         static_cast<long long>(o.first_run), static_cast<long long>(most_runs) - 1);
  check_at_least(o.block, 1, "block");
  if (!(o.density_ratio > 0.0 && o.density_ratio <= 1.0))
    fail(JAM_E_ARGUMENT, "density_ratio is %g, it must be in (0, 1]", o.density_ratio);
  check_range("temperature", o.temperature, limits::velocity_min * limits::velocity_min,
              limits::velocity_max * limits::velocity_max);
  check_positive(o.wave_number, "wave_number");
  check_range("wave_number", o.wave_number, 0.0, limits::wave_max);
  check_positive_finite(o.overlap_length, "overlap_length");
  check_positive(o.memory_limit, "memory_limit");
  check_positive(o.wall_time, "wall_time");
}

// ---- sums

void RunSums::start(size_t instants, size_t n, size_t dim) {
  runs = 0;
  displacement.assign(instants * n * dim, 0.0);
  square = displacement;
  distance2.assign(instants * n, 0.0);
  distance4 = distance2;
  series.assign(instants * isoconf_columns, 0.0);
}

void RunSums::add(const RunRecord &run, size_t dim) {
  ++runs;
  for (size_t k = 0; k < distance2.size(); ++k) {
    double r2 = 0.0;
    for (size_t c = 0; c < dim; ++c) {
      const double x = run.displacement[k * dim + c], x2 = x * x;
      displacement[k * dim + c] += x;
      square[k * dim + c] += x2;
      r2 += x2;
    }
    distance2[k] += r2;
    distance4[k] += r2 * r2;
  }
  for (size_t k = 0; k < series.size(); ++k) series[k] += run.series[k];
}

void RunSums::add(const RunSums &other) {
  const auto add_all = [](std::vector<double> &to, const std::vector<double> &from) {
    for (size_t k = 0; k < to.size(); ++k) to[k] += from[k];
  };
  runs += other.runs;
  add_all(displacement, other.displacement);
  add_all(square, other.square);
  add_all(distance2, other.distance2);
  add_all(distance4, other.distance4);
  add_all(series, other.series);
}

void RunSums::archive(Archive &a) {
  a(runs);
  for (std::vector<double> *v : {&displacement, &square, &distance2, &distance4, &series}) a(*v);
}

void take_moments(const RunPlan &plan, size_t m, RunRecord &record) {
  const size_t n = plan.start.n(), d = static_cast<size_t>(plan.start.dim);
  const double q = plan.options.wave_number / plan.length, reach = plan.options.overlap_length * plan.length;
  const double *x = &record.displacement[m * n * d];
  double msd = 0.0, scattering = 0.0;
  size_t near = 0;
  for (size_t i = 0; i < n; ++i) {
    double r2 = 0.0;
    for (size_t c = 0; c < d; ++c) {
      r2 += x[i * d + c] * x[i * d + c];
      scattering += math::cos(q * x[i * d + c]);
    }
    msd += r2;
    near += r2 < reach * reach;
  }
  double *series = &record.series[m * isoconf_columns];
  const double spheres = static_cast<double>(n);
  const auto with_square = [&](int32_t column, double value) {
    series[column] = value;
    series[column + 1] = value * value;
  };
  series[JAM_ISOCONF_TIME2] = series[JAM_ISOCONF_TIME] * series[JAM_ISOCONF_TIME];
  with_square(JAM_ISOCONF_MSD, msd / spheres);
  with_square(JAM_ISOCONF_SCATTERING, scattering / (spheres * static_cast<double>(d)));
  with_square(JAM_ISOCONF_OVERLAP, static_cast<double>(near) / spheres);
}

}  // namespace jam::inside
