// The Metropolis engine: trials, lists, energies.
#include "dynamics/monte_carlo.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/pair_rule.hpp"
#include "core/rng.hpp"

namespace jam {

double PairEnergy::value(double overlap) const { return scale * std::pow(overlap, alpha); }
double PairEnergy::slope(double overlap) const { return scale * alpha * std::pow(overlap, alpha - 1.0); }

namespace {

// x^alpha: the three exponents in use by roots, which take a third of the time of pow.
enum class Power { hard, three_halves, two, five_halves, any };
Power power_of(double alpha) {
  if (alpha == 0.0) return Power::hard;
  if (alpha == 1.5) return Power::three_halves;
  if (alpha == 2.0) return Power::two;
  return alpha == 2.5 ? Power::five_halves : Power::any;
}

template <int D, Power P>
class MonteCarloOf final : public MonteCarlo {
 public:
  MonteCarloOf(const Packing &p, const jam_monte_carlo_options &o, int64_t run)
      : p_(p),
        n_(static_cast<int32_t>(p.n())),
        swap_share_(o.swap_share),
        inverse_temperature_(1.0 / o.temperature),
        // Its own key a run; sweeps and spheres enter in sweep().
        key_(mix64(mix64(mix64(static_cast<uint64_t>(p.seed)) ^ static_cast<uint64_t>(Stream::monte_carlo) << 32) ^
                   mix64(static_cast<uint64_t>(run)))),
        x_(p.n()),
        radius_(p.n()),
        centre_(p.n()),
        displacement_(p.position.size(), 0.0),
        first_(p.n() + 1) {
    energy_.alpha = o.alpha;
    energy_.scale = o.energy_scale;
    energy_.relative = o.energy_unit == JAM_ENERGY_RELATIVE;
    for (int32_t i = 0; i < n_; ++i) {
      for (int c = 0; c < D; ++c)
        x_[i][c] = static_cast<uint64_t>(wrap(p.position[i * D + c] / p.cell.side(), 1.0) * scale);
      radius_[i] = 0.5 * p.diameter[i] / p.cell.side();
    }
    contact_max_ = contact_distance_max(p) / p.cell.side();
    set_step(o.step * diameter_mean(p) / p.cell.side());
  }

  void set_step(double step) override {
    step_ = step;
    // A trial from where the lists were made must stay within half the skin. Longer lists hold for longer; trials take
    // least time near 8 steps, and shorter ones than 0.35 diameters (tests/bench/monte_carlo).
    const double least = 2.02 * std::sqrt(static_cast<double>(D)) * step, room = widest_range - contact_max_;
    const double best = std::min(longest_skin, std::max(0.03, skin_steps * step / contact_max_)) * contact_max_;
    skin_ = std::max(least, std::min(best, room));
    if (skin_ > room) skin_ = everything;  // a small box: all pairs are listed, for ever
    make_lists();
  }

  void sweep(int64_t number) override {
    const uint64_t key = mix64(key_ ^ mix64(static_cast<uint64_t>(number)));
    for (int32_t i = 0; i < n_; ++i) {
      // 16 numbers of each sphere: components 0 .. 7, acceptance 8, kind of trial 9, partner 10.
      const uint64_t base = key + (static_cast<uint64_t>(i) << 4) * weyl;
      if (swap_share_ > 0.0 && uniform(base, 9) < swap_share_)
        try_swap(i, base);
      else
        try_move(i, base);
    }
  }

  double energy() const override {
    double sum = 0.0;
    if constexpr (P != Power::hard)
      each_pair([&](int32_t i, int32_t k, double r2) {
        const double sigma = contact(i, k);
        if (r2 < sigma * sigma) sum += pair_energy(std::sqrt(r2), sigma);
      });
    return sum;
  }

  double virial() const override {
    double sum = 0.0;
    if constexpr (P != Power::hard)
      each_pair([&](int32_t i, int32_t k, double r2) {
        const double sigma = contact(i, k), r = std::sqrt(r2);
        if (r >= sigma) return;
        const double x = energy_.relative ? 1.0 - r / sigma : (sigma - r) * p_.cell.side();
        sum += energy_.slope(x) * (energy_.relative ? r / sigma : r * p_.cell.side());
      });
    return sum;
  }

  double gap_range() const override { return std::min(skin_, widest_range - contact_max_) / contact_max_; }
  void count_gaps(double h_max, std::vector<double> &bins) override {
    make_lists();  // after it the lists hold all pairs within the skin
    each_pair([&](int32_t i, int32_t k, double r2) {
      const double h = std::sqrt(r2) / contact(i, k) - 1.0;
      if (h < h_max) bins[h > 0.0 ? static_cast<size_t>(h / h_max * static_cast<double>(bins.size())) : 0] += 1.0;
    });
  }

  void write_state(Packing &p) const override {
    for (int32_t i = 0; i < n_; ++i) {
      for (int c = 0; c < D; ++c)
        p.position[i * D + c] = wrap(static_cast<double>(x_[i][c]) * unit * p.cell.side(), p.cell.side());
      p.diameter[i] = p_.diameter[i];
    }
  }
  const std::vector<double> &displacement() const override { return displacement_; }
  // The lists too: the order in them is the order of sums of energies.
  void archive(Archive &a) override {
    a(x_);
    a(centre_);
    a(displacement_);
    a(p_.diameter);
    a(first_);
    a(neighbour_);
    a(counts);
    if (!a.reading()) return;
    const size_t n = static_cast<size_t>(n_);
    Archive::check(x_.size() == n && centre_.size() == n && displacement_.size() == n * D && p_.diameter.size() == n);
    Archive::check(first_.size() == n + 1 && first_[0] == 0 && first_[n] == static_cast<int64_t>(neighbour_.size()));
    for (size_t i = 0; i < n; ++i) {
      Archive::check(p_.diameter[i] > 0.0 && 0.5 * p_.diameter[i] / p_.cell.side() <= contact_max_ &&
                     first_[i] <= first_[i + 1]);
      radius_[i] = 0.5 * p_.diameter[i] / p_.cell.side();
    }
    for (const int32_t k : neighbour_) Archive::check(k >= 0 && k < n_);
  }

 private:
  using Place = std::array<uint64_t, D>;
  static constexpr double scale = 0x1p64, unit = 0x1p-64, skin_steps = 12.0, longest_skin = 0.7, widest_range = 0.499,
                          everything = 1e3;
  static constexpr uint64_t weyl = 0x9e3779b97f4a7c15ull;

  static double uniform(uint64_t base, uint64_t which) {
    return static_cast<double>(mix64(base + which * weyl) >> 11) * 0x1.0p-53;
  }
  double contact(int32_t i, int32_t k) const {
    const double sum = radius_[i] + radius_[k];
    return p_.non_additivity == 0.0 || radius_[i] == radius_[k] ? sum : (1.0 + p_.non_additivity) * sum;
  }
  static double distance2(const Place &a, const Place &b) {
    double r2 = 0.0;
    for (int c = 0; c < D; ++c) {
      const double r = static_cast<double>(static_cast<int64_t>(a[c] - b[c])) * unit;
      r2 += r * r;
    }
    return r2;
  }
  double pair_energy(double r, double sigma) const {
    const double x = energy_.relative ? 1.0 - r / sigma : (sigma - r) * p_.cell.side();
    if constexpr (P == Power::three_halves) return energy_.scale * x * std::sqrt(x);
    if constexpr (P == Power::two) return energy_.scale * x * x;
    if constexpr (P == Power::five_halves) return energy_.scale * x * x * std::sqrt(x);
    return energy_.value(x);
  }
  template <class F>
  void each_pair(F &&f) const {
    for (int32_t i = 0; i < n_; ++i)
      for (int32_t e = first_[i]; e < first_[i + 1]; ++e)
        if (neighbour_[e] > i) f(i, neighbour_[e], distance2(x_[i], x_[neighbour_[e]]));
  }
  // Energy of sphere i at a place; +infinity where hard spheres overlap.
  double energy_at(int32_t i, const Place &at) const {
    double sum = 0.0;
    for (int32_t e = first_[i]; e < first_[i + 1]; ++e) {
      const int32_t k = neighbour_[e];
      const double r2 = distance2(at, x_[k]), sigma = contact(i, k);
      if (r2 >= sigma * sigma) continue;
      if constexpr (P == Power::hard) return never;
      sum += pair_energy(std::sqrt(r2), sigma);
    }
    return sum;
  }
  // Change of the energy of sphere i when it moves from its place; +infinity where hard spheres would overlap.
  double change(int32_t i, const Place &to) const {
    if constexpr (P == Power::hard) return energy_at(i, to);
    const Place &from = x_[i];
    double sum = 0.0;
    for (int32_t e = first_[i]; e < first_[i + 1]; ++e) {
      const int32_t k = neighbour_[e];
      const double sigma = contact(i, k), sigma2 = sigma * sigma;
      const double r2 = distance2(to, x_[k]), old2 = distance2(from, x_[k]);
      if (r2 < sigma2) sum += pair_energy(std::sqrt(r2), sigma);
      if (old2 < sigma2) sum -= pair_energy(std::sqrt(old2), sigma);
    }
    return sum;
  }
  bool accept(double energy_change, uint64_t base) const {
    if (energy_change <= 0.0) return true;
    return P != Power::hard && uniform(base, 8) < std::exp(-energy_change * inverse_temperature_);
  }

  void try_move(int32_t i, uint64_t base) {
    ++counts.moves;
    Place to;
    std::array<int64_t, D> shift;
    for (int c = 0; c < D; ++c) {
      // 2^63 is never reached: the step is less than half the box, and the number is in [-1, 1).
      const double part =
          static_cast<double>(static_cast<int64_t>(mix64(base + static_cast<uint64_t>(c) * weyl)) >> 11);
      shift[c] = static_cast<int64_t>(part * 0x1p-52 * step_ * scale);
      to[c] = x_[i][c] + static_cast<uint64_t>(shift[c]);
    }
    if (distance2(to, centre_[i]) >= 0.25 * skin_ * skin_) make_lists();
    if (!accept(change(i, to), base)) return;
    ++counts.moved;
    x_[i] = to;
    double *moved = &displacement_[static_cast<size_t>(i) * D];
    for (int c = 0; c < D; ++c) moved[c] += static_cast<double>(shift[c]) * unit;
  }

  void try_swap(int32_t i, uint64_t base) {
    ++counts.swaps;
    if (n_ < 2) return;
    int32_t k = static_cast<int32_t>(uniform(base, 10) * (n_ - 1));
    k += k >= i;
    if (radius_[i] == radius_[k]) return;
    double before = 0.0;
    if constexpr (P != Power::hard) before = energy_of_both(i, k);
    std::swap(radius_[i], radius_[k]);
    if (accept(energy_of_both(i, k) - before, base)) {
      std::swap(p_.diameter[i], p_.diameter[k]);
      ++counts.swapped;
    } else {
      std::swap(radius_[i], radius_[k]);
    }
  }
  // The pair itself counts twice, before and after alike: its contact distance is the same.
  double energy_of_both(int32_t i, int32_t k) const { return energy_at(i, x_[i]) + energy_at(k, x_[k]); }

  // Longest distance at which a pair is listed, of all pairs and of this one. With swaps any two spheres can get the
  // largest diameters.
  double list_range() const { return contact_max_ + skin_; }
  double list_range(int32_t i, int32_t k) const { return (swap_share_ > 0.0 ? contact_max_ : contact(i, k)) + skin_; }

  void make_lists() {
    ++counts.lists;
    found_.clear();
    const auto cells = static_cast<int64_t>(1.0 / list_range());
    if (cells >= 4 && std::pow(3.0, D) < n_)
      find_in_cells(std::min<int64_t>(cells, static_cast<int64_t>(std::pow(2.0 * n_, 1.0 / D)) + 1));
    else
      for (int32_t i = 0; i < n_; ++i)
        for (int32_t k = i + 1; k < n_; ++k) note_pair(i, k);
    std::fill(first_.begin(), first_.end(), 0);
    for (const auto &pair : found_) ++first_[pair[0] + 1], ++first_[pair[1] + 1];
    for (int32_t i = 0; i < n_; ++i) first_[i + 1] += first_[i];
    neighbour_.resize(2 * found_.size());
    at_.assign(first_.begin(), first_.end() - 1);
    for (const auto &pair : found_) {
      neighbour_[at_[pair[0]]++] = pair[1];
      neighbour_[at_[pair[1]]++] = pair[0];
    }
    centre_ = x_;
  }
  void note_pair(int32_t i, int32_t k) {
    const double range = list_range(i, k);
    if (distance2(x_[i], x_[k]) < range * range) found_.push_back({i, k});
  }
  // Pairs of each cell with itself and with half of the cells around it.
  void find_in_cells(int64_t cells) {
    size_t total = 1;
    for (int c = 0; c < D; ++c) total *= static_cast<size_t>(cells);
    cell_first_.assign(total + 1, 0);
    cell_of_.resize(x_.size());
    for (int32_t i = 0; i < n_; ++i) {
      size_t cell = 0;
      for (int c = 0; c < D; ++c)  // the upper 32 bits of x times cells, over 2^32
        cell = cell * static_cast<size_t>(cells) + ((x_[i][c] >> 32) * static_cast<uint64_t>(cells) >> 32);
      cell_of_[i] = static_cast<int32_t>(cell);
      ++cell_first_[cell + 1];
    }
    for (size_t k = 0; k < total; ++k) cell_first_[k + 1] += cell_first_[k];
    in_cell_.resize(x_.size());
    at_.assign(cell_first_.begin(), cell_first_.end() - 1);
    for (int32_t i = 0; i < n_; ++i) in_cell_[at_[cell_of_[i]]++] = i;
    int steps = 1;
    for (int c = 0; c < D; ++c) steps *= 3;
    for (size_t cell = 0; cell < total; ++cell) {
      const int32_t begin = cell_first_[cell], end = cell_first_[cell + 1];
      for (int32_t a = begin; a < end; ++a)
        for (int32_t b = a + 1; b < end; ++b) note_pair(in_cell_[a], in_cell_[b]);
      if (begin == end) continue;
      for (int step = steps / 2 + 1; step < steps; ++step) {
        const size_t other = cell_beside(cell, step, static_cast<size_t>(cells));
        for (int32_t a = begin; a < end; ++a)
          for (int32_t b = cell_first_[other]; b < cell_first_[other + 1]; ++b) note_pair(in_cell_[a], in_cell_[b]);
      }
    }
  }
  // The digits of `step` in base 3, less 1, are the steps along the axes.
  static size_t cell_beside(size_t cell, int step, size_t cells) {
    size_t other = 0, weight = 1;
    for (int c = 0; c < D; ++c, step /= 3, cell /= cells, weight *= cells) {
      const size_t place = cell % cells;
      const int by = step % 3 - 1;
      other += weight * (by < 0   ? (place ? place - 1 : cells - 1)
                         : by > 0 ? (place + 1 < cells ? place + 1 : 0)
                                  : place);
    }
    return other;
  }

  static constexpr double never = std::numeric_limits<double>::infinity();
  Packing p_;  // diameters of now; positions of the last lists
  int32_t n_;
  double swap_share_, inverse_temperature_, step_ = 0.0, skin_ = 0.0;
  uint64_t key_;
  PairEnergy energy_;
  std::vector<Place> x_;
  std::vector<double> radius_;
  std::vector<Place> centre_;
  std::vector<double> displacement_;
  std::vector<int32_t> first_, neighbour_;
  double contact_max_ = 0.0;
  // to make lists
  std::vector<std::array<int32_t, 2>> found_;
  std::vector<int32_t> cell_first_, cell_of_, in_cell_, at_;
};

template <int D>
std::unique_ptr<MonteCarlo> make_of(const Packing &p, const jam_monte_carlo_options &o, int64_t run) {
  switch (power_of(o.alpha)) {
    case Power::hard:
      return std::make_unique<MonteCarloOf<D, Power::hard>>(p, o, run);
    case Power::three_halves:
      return std::make_unique<MonteCarloOf<D, Power::three_halves>>(p, o, run);
    case Power::two:
      return std::make_unique<MonteCarloOf<D, Power::two>>(p, o, run);
    case Power::five_halves:
      return std::make_unique<MonteCarloOf<D, Power::five_halves>>(p, o, run);
    default:
      return std::make_unique<MonteCarloOf<D, Power::any>>(p, o, run);
  }
}

}  // namespace

double largest_monte_carlo_step(const Packing &p) {
  const double reach = contact_distance_max(p) / p.cell.side();
  return reach < 0.499 ? 0.49 * p.cell.side() / diameter_mean(p) : 0.0;
}

std::unique_ptr<MonteCarlo> make_monte_carlo(const Packing &p, const jam_monte_carlo_options &o, int64_t run) {
  switch (p.dim) {
    case 2:
      return make_of<2>(p, o, run);
    case 3:
      return make_of<3>(p, o, run);
    case 4:
      return make_of<4>(p, o, run);
    case 5:
      return make_of<5>(p, o, run);
    case 6:
      return make_of<6>(p, o, run);
    case 7:
      return make_of<7>(p, o, run);
    case 8:
      return make_of<8>(p, o, run);
    default:
      fail(JAM_E_DIMENSION, "dim is %d", p.dim);
  }
}

}  // namespace jam
