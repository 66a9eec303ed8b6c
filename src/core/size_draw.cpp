// Diameters drawn from a law.
#include <algorithm>
#include <cmath>

#include "core/call_scope.hpp"
#include "core/decimal.hpp"
#include "core/limits.hpp"
#include "core/rng.hpp"
#include "core/size_laws.hpp"
#include "core/tuning.hpp"

namespace jam::inside {
namespace {

// A law of diameters from text: `LAW:item,item...`.
std::string_view trimmed(std::string_view word) {
  while (!word.empty() && (word.front() == ' ' || word.front() == '\t')) word.remove_prefix(1);
  while (!word.empty() && (word.back() == ' ' || word.back() == '\t')) word.remove_suffix(1);
  return word;
}

// The whole word as a number, in every locale.
bool is_number(std::string_view word, double &x) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  const auto [end, error] = from_decimal(word, x);
  return error == std::errc() && end == word.data() + word.size();
}

[[noreturn]] void refuse(std::string_view item, const char *why) {
  fail(JAM_E_ARGUMENT, "'%.*s' of a law of sizes: %s", static_cast<int>(item.size()), item.data(), why);
}

int32_t one_of(std::string_view item, std::string_view value, const std::vector<const char *> &words, int32_t first) {
  for (size_t k = 0; k < words.size(); ++k)
    if (value == words[k]) return first + static_cast<int32_t>(k);
  std::string all;
  for (const char *word : words) all += std::string(all.empty() ? "it must be " : " or ") + word;
  refuse(item, all.c_str());
}

void take_item(std::string_view item, jam_diameters_options &o, std::vector<double> &curve,
               std::vector<std::string> &files) {
  const size_t equals = item.find('=');
  double x = 0.0, y = 0.0;
  if (equals == std::string_view::npos) {
    if (item.empty()) refuse(item, "an item is empty");
    if (is_number(item, x)) refuse(item, "a number needs its field, as in deviation=0.3, or its share, as in 0.5=0.12");
    const size_t colon = item.find(':');
    if (colon != std::string_view::npos && is_number(trimmed(item.substr(0, colon)), x))
      refuse(item, "a size and its share are joined by =, as in 0.5=0.12");
    files.emplace_back(item);
    return;
  }
  const std::string_view key = trimmed(item.substr(0, equals)), value = trimmed(item.substr(equals + 1));
  if (key == "share")
    o.share = one_of(item, value, {"number", "volume"}, JAM_SHARE_NUMBER);
  else if (key == "draw")
    o.draw = one_of(item, value, {"quantiles", "random"}, JAM_DRAW_QUANTILES);
  else if (!is_number(value, y))
    refuse(item, "the value after = must be a number");
  else if (is_number(key, x))
    curve.insert(curve.end(), {x, y});
  else if (double *const place = size_field(o, std::string(key).c_str()))
    *place = y;
  else
    refuse(item, ("there is no such field; there are " + size_field_names() + ", share and draw").c_str());
}

using Options = jam_diameters_options;

class Drawing {
 public:
  Drawing(const Options &o, const SizeDistribution &law)
      : law_(law), dim_(o.dim), seed_(o.seed), random_(o.draw == JAM_DRAW_RANDOM) {}
  double volume(double s) const { return unit_sphere_volume(dim_) * math::pow(s, dim_); }
  std::vector<double> of(int64_t n) const {
    std::vector<double> out(static_cast<size_t>(n));
    if (random_)
      random_from(out, 0);
    else if (law_.by_volume() && law_.single_sizes().empty())
      volume_quantiles(out);
    else
      for (int64_t k = 0; k < n; ++k)
        out[static_cast<size_t>(k)] = law_.quantile((static_cast<double>(k) + 0.5) / static_cast<double>(n));
    return out;
  }
  // So many that their volume comes nearest to `wanted`.
  std::vector<double> filling(double wanted) const {
    return random_ ? random_filling(wanted) : quantiles_filling(wanted);
  }
  double total(const std::vector<double> &s) const {
    double sum = 0.0, lost = 0.0;  // Kahan's sum
    for (const double x : s) {
      const double next = volume(x) - lost, now = sum + next;
      lost = (now - sum) - next;
      sum = now;
    }
    return sum;
  }

 private:
  void random_from(std::vector<double> &out, size_t first) const {
    Rng rng(seed_, Stream::sizes, first);
    for (size_t k = first; k < out.size(); ++k)
      out[k] = law_.quantile(std::min(rng.uniform() + 0x1p-54, 1.0 - 0x1p-53));
  }
  // Each sphere has the mean volume of its share of the number: the sums of volume at the ends of the shares are those
  // of the law. Rounding of these sums takes no sphere beyond the ends of its share.
  void volume_quantiles(std::vector<double> &out) const {
    const double n = static_cast<double>(out.size());
    double below = 0.0, least = law_.quantile(0.0);
    for (size_t k = 0; k < out.size(); ++k) {
      if (k % 1024 == 0) CallScope::look();
      const double u = static_cast<double>(k + 1) / n, most = std::max(least, law_.quantile(u));
      const double next = k + 1 == out.size() ? 1.0 : law_.volume_of_smallest(u, most);
      const double power = std::max(0.0, (next - below) * n * law_.mean_power());
      out[k] = std::min(std::max(math::pow(power, 1.0 / dim_), least), most);
      below = next, least = most;
    }
  }
  std::vector<double> random_filling(double wanted) const {
    std::vector<double> s;
    double sum = 0.0;
    while (sum < wanted) {
      const size_t first = s.size();
      check_count(static_cast<double>(first + SizeTuning::first_draw), wanted);
      s.resize(first + std::max(SizeTuning::first_draw, first));
      random_from(s, first);
      for (size_t k = first; k < s.size(); ++k) {
        const double v = volume(s[k]);
        if (sum + 0.5 * v >= wanted && k > 0) {
          s.resize(k);
          return s;
        }
        sum += v;
        if (sum >= wanted) {
          s.resize(k + 1);
          return s;
        }
      }
    }
    return s;
  }
  std::vector<double> quantiles_filling(double wanted) const {
    double n = 0.0, mean = unit_sphere_volume(dim_) * law_.mean_power();
    if (!law_.by_volume()) mean = total(of(SizeTuning::trial)) / static_cast<double>(SizeTuning::trial);
    std::vector<double> s;
    for (int turn = 0; turn < 32; ++turn) {
      const double next =
          turn == 0 ? std::floor(wanted / mean + 0.5) : n + std::floor((wanted - total(s)) / mean + 0.5);
      check_count(next, wanted);
      if (turn > 0 && next == n) break;
      n = next;
      s = of(static_cast<int64_t>(n));
    }
    return s;
  }
  static void check_count(double n, double wanted) {
    if (n < 1.0)
      fail(JAM_E_ARGUMENT, "the cell is too small: a volume of %g has room for less than half a mean sphere", wanted);
    if (n > static_cast<double>(limits::n_max))
      fail(JAM_E_ARGUMENT, "a volume of %g has room for %.3g spheres of this law, more than 2^31-1", wanted, n);
  }
  const SizeDistribution &law_;
  int dim_;
  int64_t seed_;
  bool random_;
};

// The last sphere makes up for what the volume differs from `wanted`: the largest one that stays below the largest of
// all, or that one itself.
void adjust_last(const Drawing &drawing, int dim, double wanted, std::vector<double> &s) {
  std::vector<size_t> order(s.size());
  for (size_t k = 0; k < s.size(); ++k) order[k] = k;
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return s[a] < s[b]; });
  const double more = wanted - drawing.total(s), most = drawing.volume(s[order.back()]);
  size_t taken = order.back();
  for (auto k = order.rbegin(); k != order.rend(); ++k)
    if (drawing.volume(s[*k]) + more <= most) {
      taken = *k;
      break;
    }
  std::rotate(s.begin() + static_cast<std::ptrdiff_t>(taken), s.begin() + static_cast<std::ptrdiff_t>(taken) + 1,
              s.end());
  const double volume = drawing.volume(s.back()) + more;
  if (!(volume > 0.0)) fail(JAM_E_ARGUMENT, "the cell is too small for the spheres of this law");
  s.back() = math::pow(volume / unit_sphere_volume(dim), 1.0 / dim);
}

void check_sizes(const std::vector<double> &s) {
  const auto [least, most] = std::minmax_element(s.begin(), s.end());
  if (!(*least > 0.0) || !std::isfinite(*most) || !(*most <= limits::size_ratio_max * *least))
    fail(JAM_E_ARGUMENT, "the law gives diameters from %g to %g: ratios up to %g are supported; cut it by low and high",
         *least, *most, limits::size_ratio_max);
}

// Quantiles of few spheres pass over a small share. A random draw may have none of it.
void check_shares(const SizeDistribution &law, const std::vector<double> &s) {
  for (const SingleSize &size : law.single_sizes())
    if (std::find(s.begin(), s.end(), size.diameter) == s.end())
      fail(JAM_E_ARGUMENT,
           "n is %zu, and no sphere has the diameter %g, whose share of the number is %.3g: %.0f have one", s.size(),
           size.diameter, size.share, std::ceil(1.0 / size.share));
}

void check_amount(const Options &o) {
  check_enum(o.draw, JAM_DRAW_QUANTILES, JAM_DRAW_RANDOM, "draw", "jam_size_draw");
  if (!(o.cell_volume >= 0.0) || !std::isfinite(o.cell_volume))
    fail(JAM_E_ARGUMENT, "cell_volume is %g, it must be positive and finite, or 0", o.cell_volume);
  if (!(o.packing_fraction >= 0.0 && o.packing_fraction < 1.0))
    fail(JAM_E_ARGUMENT, "packing_fraction is %g, it must be above 0 and below 1, or 0 for none", o.packing_fraction);
  const bool follows = o.packing_fraction > 0.0;
  if (follows && o.cell_volume == 0.0) fail(JAM_E_ARGUMENT, "packing_fraction needs cell_volume");
  if (follows && o.n != 0)
    fail(JAM_E_ARGUMENT, "n is %lld beside packing_fraction, from which n follows", static_cast<long long>(o.n));
  if (!follows) check_n(o.n);
}

}  // namespace

std::vector<double> draw_diameters(const Options &o, const double *curve, size_t curve_len) {
  const std::unique_ptr<SizeDistribution> law = size_distribution(o, curve, curve_len);
  check_amount(o);
  const Drawing drawing(o, *law);
  if (o.packing_fraction == 0.0) {
    std::vector<double> s = drawing.of(o.n);
    if (o.draw == JAM_DRAW_QUANTILES) check_shares(*law, s);
    check_sizes(s);
    if (const double volume = drawing.total(s); o.cell_volume > 0.0 && volume > o.cell_volume)
      fail(JAM_E_ARGUMENT, "the spheres add up to a volume of %g, the cell has %g", volume, o.cell_volume);
    return s;
  }
  check_reach(o.dim, drawing.of(1024), o.packing_fraction);
  const double wanted = o.packing_fraction * o.cell_volume;
  std::vector<double> s = drawing.filling(wanted);
  if (o.draw == JAM_DRAW_QUANTILES) check_shares(*law, s);
  if (law->single_sizes().empty()) adjust_last(drawing, o.dim, wanted, s);  // else it would be the only one of its size
  check_sizes(s);
  return s;
}

std::vector<std::string> parse_size_law(const char *text, jam_diameters_options &o, std::vector<double> &curve) {
  const std::string_view all = text;
  const size_t colon = all.find(':');
  const std::string name(trimmed(all.substr(0, colon)));
  o.law = size_law_number(name.c_str());
  std::vector<std::string> files;
  if (colon == std::string_view::npos) return files;
  for (std::string_view rest = all.substr(colon + 1);;) {
    const size_t comma = rest.find(',');
    take_item(trimmed(rest.substr(0, comma)), o, curve, files);
    if (comma == std::string_view::npos) return files;
    rest.remove_prefix(comma + 1);
  }
}

}  // namespace jam::inside
