#include "core/size_laws.hpp"

#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "core/limits.hpp"
#include "core/math.hpp"

namespace jam::inside {
namespace {

using Options = jam_diameters_options;
constexpr double not_given = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

class Normal final : public SmoothLaw {
 public:
  Normal(double mean, double deviation) : mean_(mean), deviation_(deviation) {}
  double share(double s) const override { return math::normal_share((s - mean_) / deviation_); }
  double quantile(double u) const override { return mean_ + deviation_ * math::normal_quantile(u); }

 private:
  double mean_, deviation_;
};

// ln s is normal with mean mu and deviation w. With a negative w shares count from above.
class LogNormal final : public SmoothLaw {
 public:
  LogNormal(double mu, double w) : mu_(mu), w_(w) {}
  static std::unique_ptr<SmoothLaw> of(double mean, double deviation) {
    const double square = math::log1p((deviation / mean) * (deviation / mean));
    return std::make_unique<LogNormal>(math::log(mean) - 0.5 * square, std::sqrt(square));
  }
  double share(double s) const override { return math::normal_share((math::log(s) - mu_) / w_); }
  double quantile(double u) const override { return math::exp(mu_ + w_ * math::normal_quantile(u)); }
  // Hatch and Choate, J. Franklin Inst. 207, 369 (1929). Above the mean, shares from above keep their digits.
  Counted counted(int dim, double low) const override {
    const double mu = mu_ - dim * w_ * w_;
    return {std::make_unique<LogNormal>(mu, low > math::exp(mu) ? -w_ : w_),
            math::exp(0.5 * dim * dim * w_ * w_ - dim * mu_)};
  }

 private:
  double mu_, w_;
};

class Weibull final : public SmoothLaw {
 public:
  Weibull(double scale, double shape) : scale_(scale), shape_(shape) {}
  double share(double s) const override { return -math::expm1(-math::pow(s / scale_, shape_)); }
  double quantile(double u) const override { return scale_ * math::pow(-math::log1p(-u), 1.0 / shape_); }

 private:
  double scale_, shape_;
};

struct Field {
  const char *name;
  double Options::*member;
  bool needed_above_zero;  // otherwise any finite number
};
constexpr Field mean{"mean", &Options::mean, true}, deviation{"deviation", &Options::deviation, true},
    low{"low", &Options::low, true}, high{"high", &Options::high, true},
    exponent{"exponent", &Options::exponent, false}, scale{"scale", &Options::scale, true},
    shape{"shape", &Options::shape, true};
constexpr const Field *numbers[] = {&mean, &deviation, &low, &high, &exponent, &scale, &shape};

// Where a row of a curve is wrong, the text says which.
[[noreturn]] void refuse_row(size_t row, const double *curve, const char *why) {
  fail(JAM_E_ARGUMENT, "curve row %zu (%g, %g): %s", row, curve[2 * row], curve[2 * row + 1], why);
}

std::vector<SizeClass> classes_of_list(const double *curve, size_t rows) {
  std::vector<SizeClass> classes;
  for (size_t k = 0; k < rows; ++k) {
    if (!(curve[2 * k + 1] > 0.0)) refuse_row(k, curve, "a share must be above 0");
    classes.push_back({curve[2 * k], curve[2 * k], curve[2 * k + 1], 0.0});
  }
  return classes;
}

// From the finest sieve to the coarsest, or the other way round, as test sheets list them.
std::vector<SizeClass> classes_of_sieve(const double *curve, size_t rows) {
  if (rows < 2) fail(JAM_E_ARGUMENT, "a sieve curve of %zu row(s): it needs 2 or more", rows);
  const bool coarse_first = curve[0] > curve[2 * rows - 2];
  const auto row = [&](size_t k) { return coarse_first ? rows - 1 - k : k; };
  const auto size = [&](size_t k) { return curve[2 * row(k)]; };
  const auto passing = [&](size_t k) { return curve[2 * row(k) + 1]; };
  const auto refuse = [&](size_t k, const char *why) { refuse_row(row(k), curve, why); };
  for (size_t k = 1; k < rows; ++k)
    if (!(passing(k) >= passing(k - 1)))
      refuse(k, "the sieve curve falls: less passes this sieve than the next finer one");
  const double whole = passing(rows - 1);
  if (whole != 1.0 && whole != 100.0)
    refuse(rows - 1, "a sieve curve must end at 1, or at 100 for per cent: add the size that all passes");
  if (passing(0) != 0.0)
    refuse(0, "a sieve curve must begin at 0: add the size of the finest spheres, that nothing passes");
  std::vector<SizeClass> classes;
  for (size_t k = 1; k < rows; ++k) {
    if (!(size(k) > size(k - 1))) refuse(k, "sizes of a sieve curve must rise, or all fall");
    const double part = passing(k) - passing(k - 1);
    if (part > 0.0) classes.push_back({size(k - 1), size(k), part / whole, -1.0});
  }
  return classes;
}

using Made = std::unique_ptr<SizeDistribution>;
// What one law makes of its checked fields.
struct Given {
  const Options &o;
  const double *curve;
  size_t rows;
  bool by_volume;
  Made classes(std::vector<SizeClass> c) const { return classes_of_sizes(std::move(c), o.dim, by_volume); }
  Made cut(std::unique_ptr<SmoothLaw> law) const { return cut_law(std::move(law), o.low, o.high, o.dim, by_volume); }
};

struct Law {
  int32_t number;
  const char *name;
  int32_t usual;              // jam_size_share
  const Field *needs[4];      // NULL behind the last
  bool takes_curve, can_cut;  // can_cut: low and high may be given
  Made (*make)(const Given &);
};
// Densities of uniform, power and sieve are powers s^exponent in the law's own measure.
Made equal_sizes(const Given &g) { return g.classes({{g.o.mean, g.o.mean, 1.0, 0.0}}); }
Made listed_sizes(const Given &g) { return g.classes(classes_of_list(g.curve, g.rows)); }
Made uniform_law(const Given &g) { return g.classes({{g.o.low, g.o.high, 1.0, 0.0}}); }
Made normal_law(const Given &g) { return g.cut(std::make_unique<Normal>(g.o.mean, g.o.deviation)); }
Made lognormal_law(const Given &g) { return g.cut(LogNormal::of(g.o.mean, g.o.deviation)); }
Made power_law(const Given &g) { return g.classes({{g.o.low, g.o.high, 1.0, g.o.exponent}}); }
Made weibull_law(const Given &g) { return g.cut(std::make_unique<Weibull>(g.o.scale, g.o.shape)); }
Made sieve_curve(const Given &g) { return g.classes(classes_of_sieve(g.curve, g.rows)); }
// The one table of laws.
const Law laws[] = {
    {JAM_SIZES_EQUAL, "equal", JAM_SHARE_NUMBER, {&mean}, false, false, equal_sizes},
    {JAM_SIZES_LIST, "list", JAM_SHARE_NUMBER, {}, true, false, listed_sizes},
    {JAM_SIZES_UNIFORM, "uniform", JAM_SHARE_NUMBER, {&low, &high}, false, false, uniform_law},
    {JAM_SIZES_NORMAL, "normal", JAM_SHARE_NUMBER, {&mean, &deviation}, false, true, normal_law},
    {JAM_SIZES_LOGNORMAL, "lognormal", JAM_SHARE_NUMBER, {&mean, &deviation}, false, true, lognormal_law},
    {JAM_SIZES_POWER, "power", JAM_SHARE_NUMBER, {&exponent, &low, &high}, false, false, power_law},
    {JAM_SIZES_WEIBULL, "weibull", JAM_SHARE_VOLUME, {&scale, &shape}, false, true, weibull_law},
    {JAM_SIZES_SIEVE, "sieve", JAM_SHARE_VOLUME, {}, true, false, sieve_curve},
};

const Law &law_of(int32_t number) {
  for (const Law &law : laws)
    if (law.number == number) return law;
  fail(JAM_E_ARGUMENT, "law is %d, not a jam_size_law", number);
}

bool takes(const Law &law, const Field &field) {
  for (const Field *const *f = law.needs; f != law.needs + 4 && *f; ++f)
    if (*f == &field) return true;
  return false;
}

void check_field(const Law &law, const Field &field, const Options &o) {
  const double value = o.*field.member, unset = default_diameters_options().*field.member;
  const bool given = !(value == unset || (value != value && unset != unset));
  const bool edge = &field == &low || &field == &high;
  if (!takes(law, field) && !(edge && law.can_cut)) {
    if (given) fail(JAM_E_ARGUMENT, "%s is %g, and the law %s has no such field", field.name, value, law.name);
    return;
  }
  if (!given && law.can_cut && edge) return;
  const bool fine = std::isfinite(value) && (!field.needed_above_zero || value > 0.0);
  if (!given && !fine) fail(JAM_E_ARGUMENT, "the law %s needs %s", law.name, field.name);
  if (fine && (edge || &field == &mean || &field == &scale))
    check_range(field.name, value, limits::size_min, limits::size_max);
  if (!fine)
    fail(std::isfinite(value) ? JAM_E_ARGUMENT : JAM_E_NONFINITE, "%s is %g, it must be %sfinite", field.name, value,
         field.needed_above_zero ? "positive and " : "");
}

}  // namespace

jam_diameters_options default_diameters_options() {
  jam_diameters_options o{};
  o.struct_size = sizeof o;
  o.dim = 3;
  o.seed = 1;
  o.mean = o.scale = 1.0;
  o.high = infinity;
  o.deviation = o.exponent = o.shape = not_given;
  return o;
}

int32_t size_law_number(const char *name) {
  std::string all;
  for (const Law &law : laws) {
    if (!std::strcmp(law.name, name)) return law.number;
    all += std::string(all.empty() ? "" : ", ") + law.name;
  }
  fail(JAM_E_ARGUMENT, "'%.40s' is no law of sizes; there are %s", name, all.c_str());
}

double *size_field(Options &o, const char *name) {
  for (const Field *field : numbers)
    if (!std::strcmp(field->name, name)) return &(o.*field->member);
  return nullptr;
}

std::string size_field_names() {
  std::string all;
  for (const Field *field : numbers) all += std::string(all.empty() ? "" : ", ") + field->name;
  return all;
}

std::unique_ptr<SizeDistribution> size_distribution(const Options &o, const double *curve, size_t curve_len) {
  const Law &law = law_of(o.law);
  check_dim(o.dim);
  check_enum(o.share, JAM_SHARE_USUAL, JAM_SHARE_VOLUME, "share", "jam_size_share");
  for (const Field *field : numbers) check_field(law, *field, o);
  if (!(o.low < o.high)) fail(JAM_E_ARGUMENT, "low is %g and high is %g: low must be below high", o.low, o.high);
  if (law.takes_curve != (curve_len > 0))
    fail(JAM_E_ARGUMENT, law.takes_curve ? "the law %s needs a curve" : "the law %s has no curve", law.name);
  if (curve_len % 2) fail(JAM_E_ARGUMENT, "curve has %zu numbers: a curve has rows of two", curve_len);
  if (o.law == JAM_SIZES_POWER &&
      !((std::fabs(o.exponent) + JAM_MAX_DIM + 1.0) * math::log(o.high / o.low) <= limits::size_power_max))
    fail(JAM_E_ARGUMENT, "exponent is %g: between low %g and high %g the density changes by more than exp(%g)",
         o.exponent, o.low, o.high, limits::size_power_max);
  const size_t rows = curve_len / 2;
  for (size_t k = 0; k < rows; ++k) {
    if (!std::isfinite(curve[2 * k]) || !std::isfinite(curve[2 * k + 1]))
      fail(JAM_E_NONFINITE, "curve row %zu is (%g, %g)", k, curve[2 * k], curve[2 * k + 1]);
    if (!(curve[2 * k] > 0.0)) refuse_row(k, curve, "a size must be above 0");
    check_range("a size of the curve", curve[2 * k], limits::size_min, limits::size_max);
    if (!(curve[2 * k + 1] >= 0.0)) refuse_row(k, curve, "a share must not be negative");
  }
  const int32_t share = o.share == JAM_SHARE_USUAL ? law.usual : o.share;
  return law.make({o, curve, rows, share == JAM_SHARE_VOLUME});
}

}  // namespace jam::inside
