#include "core/size_laws.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.hpp"
#include "core/math.hpp"
#include "core/tuning.hpp"

namespace jam::inside {
namespace {

// Integral of s^exponent over a class up to s, in units of low^(exponent + 1).
double integral(const SizeClass &c, double exponent, double s) {
  const double length = math::log(s / c.low), power = exponent + 1.0;
  return power == 0.0 ? length : math::expm1(power * length) / power;
}
double inverse_integral(const SizeClass &c, double exponent, double value) {
  const double power = exponent + 1.0;
  return c.low * math::exp(power == 0.0 ? value : math::log1p(power * value) / power);
}

class Classes final : public SizeDistribution {
 public:
  Classes(std::vector<SizeClass> classes, int dim, bool by_volume) : class_(std::move(classes)) {
    std::stable_sort(class_.begin(), class_.end(),
                     [](const SizeClass &a, const SizeClass &b) { return a.low < b.low; });
    double all = 0.0;
    for (const SizeClass &c : class_) all += c.share;
    for (SizeClass &c : class_) c.share /= all;
    if (by_volume) {
      volume_ = class_;
      double spheres = 0.0;  // a unit of volume has
      for (SizeClass &c : class_) {
        const double count = c.share * math::pow(c.low, -dim);
        c.share =
            c.low == c.high ? count : count * integral(c, c.exponent - dim, c.high) / integral(c, c.exponent, c.high);
        c.exponent -= dim;
        spheres += c.share;
      }
      for (SizeClass &c : class_) c.share /= spheres;
      mean_power_ = 1.0 / spheres;
    }
  }
  double quantile(double u) const override {
    const Place at = place(u);
    const SizeClass &c = class_[at.k];
    if (c.low == c.high || !(at.part > 0.0)) return c.low;
    const double s = inverse_integral(c, c.exponent, at.part * integral(c, c.exponent, c.high));
    return std::min(std::max(s, c.low), c.high);
  }
  double volume_of_smallest(double u, double s) const override {
    const Place at = place(u);
    double sum = 0.0;
    for (size_t k = 0; k < at.k; ++k) sum += volume_[k].share;
    const SizeClass &c = volume_[at.k];
    if (c.low == c.high) return sum + c.share * at.part;
    return sum + c.share * integral(c, c.exponent, s) / integral(c, c.exponent, c.high);
  }
  double mean_power() const override { return mean_power_; }
  std::vector<SingleSize> single_sizes() const override {
    std::vector<SingleSize> all;
    for (const SizeClass &c : class_)
      if (c.low == c.high) all.push_back({c.low, c.share});
    return all;
  }

 private:
  struct Place {
    size_t k;
    double part;  // of the spheres of class k
  };
  Place place(double u) const {
    size_t k = 0;
    while (k + 1 < class_.size() && !(u < class_[k].share)) u -= class_[k++].share;
    return {k, std::min(u / class_[k].share, 1.0)};
  }
  std::vector<SizeClass> class_, volume_;  // in ascending order; shares by number, by volume
  double mean_power_ = 0.0;
};

// The number of spheres below s of a law by volume: the integral of s^-d over it.
class Count {
 public:
  virtual ~Count() = default;
  virtual double inverse(double u) const = 0;  // where a share u of the number lies below
  virtual double all() const = 0;
};

class CountByFormula final : public Count {
 public:
  CountByFormula(SmoothLaw::Counted counted, double low, double high)
      : law_(std::move(counted.law)), low_(law_->share(low)), all_(law_->share(high) - low_), factor_(counted.factor) {}
  double inverse(double u) const override { return law_->quantile(low_ + u * all_); }
  double all() const override { return factor_ * std::fabs(all_); }

 private:
  std::unique_ptr<SmoothLaw> law_;
  double low_, all_, factor_;
};

// By parts in x = ln(s / low): with F the share of volume, N = F e^(-d x) + d times the integral of F e^(-d x). Gauss's
// rule of eight points on panels that are narrow in F and in x.
class CountByQuadrature final : public Count {
 public:
  CountByQuadrature(const SmoothLaw &law, double low, double high, int dim)
      : law_(law), low_(low), dim_(dim), share_low_(law.share(low)), share_all_(law.share(high) - share_low_) {
    x_.push_back(0.0);
    for (int k = -SizeTuning::normal_steps; k <= SizeTuning::normal_steps; ++k)
      panels_to(law.quantile(share_low_ + share_all_ * math::normal_share(SizeTuning::normal_step * k)), high);
    panels_to(high, high);
    sum_.push_back(0.0);
    for (size_t k = 0; k + 1 < x_.size(); ++k) sum_.push_back(sum_[k] + panel(x_[k], x_[k + 1]));
    all_ = at(x_.back(), sum_.back());
  }
  double inverse(double u) const override {
    const double target = u * all_;
    size_t first = 0, last = x_.size() - 1;  // the panel
    while (last - first > 1) {
      const size_t middle = (first + last) / 2;
      (at(x_[middle], sum_[middle]) <= target ? first : last) = middle;
    }
    double a = x_[first], b = x_[last], fa = at(a, sum_[first]) - target, fb = at(b, sum_[last]) - target;
    for (int step = 0; step < 200 && b - a > 1e-16; ++step) {  // false position, every third time the middle
      double x = step % 3 == 2 || !(fb > fa) ? 0.5 * (a + b) : a - fa * (b - a) / (fb - fa);
      if (!(x > a && x < b)) x = 0.5 * (a + b);
      const double f = at(x, sum_[first] + panel(x_[first], x)) - target;
      if (std::fabs(f) <= SizeTuning::same_share * target) return low_ * math::exp(x);
      (f < 0.0 ? a : b) = x;
      (f < 0.0 ? fa : fb) = f;
    }
    return low_ * math::exp(0.5 * (a + b));
  }
  double all() const override { return share_all_ * all_ * math::pow(low_, -dim_); }

 private:
  void panels_to(double s, double high) {
    const double last = x_.back(), step = math::log(std::min(s, high) / low_) - last;
    if (!(step > 1e-12)) return;
    const int parts = static_cast<int>(std::ceil(step / SizeTuning::longest_panel));
    for (int k = 1; k <= parts; ++k) x_.push_back(last + step * k / parts);
  }
  double share(double x) const { return std::max(0.0, (law_.share(low_ * math::exp(x)) - share_low_) / share_all_); }
  double at(double x, double integral) const { return share(x) * math::exp(-dim_ * x) + dim_ * integral; }
  double panel(double a, double b) const {
    static constexpr double node[] = {0.18343464249564980, 0.52553240991632899, 0.79666647741362674,
                                      0.96028985649753623};
    static constexpr double weight[] = {0.36268378337836198, 0.31370664587788729, 0.22238103445337447,
                                        0.10122853629037626};
    const double middle = 0.5 * (a + b), half = 0.5 * (b - a);
    double sum = 0.0;
    for (int k = 0; k < 4; ++k)
      for (const double x : {middle - half * node[k], middle + half * node[k]})
        sum += weight[k] * share(x) * math::exp(-dim_ * x);
    return sum * half;
  }
  const SmoothLaw &law_;
  double low_;
  int dim_;
  double share_low_, share_all_, all_ = 0.0;
  std::vector<double> x_, sum_;
};

class CutLaw final : public SizeDistribution {
 public:
  CutLaw(std::unique_ptr<SmoothLaw> law, double low, double high, int dim, bool by_volume)
      : law_(std::move(law)), low_(low), high_(high), share_low_(law_->share(low)) {
    share_all_ = law_->share(high) - share_low_;
    if (!(share_all_ >= SizeTuning::least_share_left))
      fail(JAM_E_ARGUMENT, "low %g and high %g keep a share of %.2g of the law, at least %g is needed", low, high,
           share_all_, SizeTuning::least_share_left);
    if (!by_volume) return;
    SmoothLaw::Counted counted = law_->counted(dim, low);
    if (counted.law) {
      count_ = std::make_unique<CountByFormula>(std::move(counted), low, high);
    } else {
      if (!(low > 0.0))
        fail(JAM_E_ARGUMENT, "low is 0: by volume this law has fines without end; give the size of the finest spheres");
      count_ = std::make_unique<CountByQuadrature>(*law_, low, std::min(high, law_->quantile(1.0 - 0x1p-53)), dim);
    }
    mean_power_ = share_all_ / count_->all();
    if (!(mean_power_ > 0.0) || std::isinf(mean_power_))
      fail(JAM_E_ARGUMENT, "low %g and high %g: the number of spheres of this law by volume is beyond doubles", low,
           high);
  }
  double quantile(double u) const override {
    const double s = count_ ? count_->inverse(u) : law_->quantile(share_low_ + u * share_all_);
    return std::min(std::max(s, low_), high_);
  }
  double volume_of_smallest(double u, double s) const override {
    if (!(u > 0.0 && u < 1.0)) return u > 0.0 ? 1.0 : 0.0;
    return (law_->share(s) - share_low_) / share_all_;
  }
  double mean_power() const override { return mean_power_; }

 private:
  std::unique_ptr<SmoothLaw> law_;
  std::unique_ptr<Count> count_;
  double low_, high_, share_low_, share_all_ = 1.0, mean_power_ = 0.0;
};

}  // namespace

std::unique_ptr<SizeDistribution> classes_of_sizes(std::vector<SizeClass> classes, int dim, bool by_volume) {
  return std::make_unique<Classes>(std::move(classes), dim, by_volume);
}

std::unique_ptr<SizeDistribution> cut_law(std::unique_ptr<SmoothLaw> law, double low, double high, int dim,
                                          bool by_volume) {
  return std::make_unique<CutLaw>(std::move(law), low, high, dim, by_volume);
}

}  // namespace jam::inside
