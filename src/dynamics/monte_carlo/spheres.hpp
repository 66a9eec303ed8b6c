// Places of the spheres in a Monte Carlo run and the lists of their neighbours: what does not depend on the energy.
#pragma once
#include <algorithm>
#include <cmath>

#include "core/call_scope.hpp"
#include "core/cell_reduction.hpp"
#include "core/pair_rule.hpp"
#include "dynamics/monte_carlo/geometry.hpp"
#include "dynamics/monte_carlo/levels.hpp"
#include "dynamics/monte_carlo/monte_carlo.hpp"

namespace jam::inside {

template <int D, bool Cube>
class MonteCarloSpheres : public MonteCarlo {
 public:
  MonteCarloSpheres(const Packing &p, const jam_monte_carlo_options &o)
      : p_(p),
        n_(static_cast<int32_t>(p.n())),
        swap_share_(o.swap_share),
        hard_(o.alpha == 0.0),
        geometry_(search_cell(p), contact_distance_max(p) / p.cell.side()),
        x_(p.n()),
        radius_(p.n()),
        centre_(p.n()),
        displacement_(p.position.size(), 0.0),
        first_(p.n() + 1) {
    for (int32_t i = 0; i < n_; ++i) {
      x_[i] = geometry_.place(&p.position[static_cast<size_t>(i) * D]);
      radius_[i] = 0.5 * p.diameter[i] / p.cell.side();
    }
    contact_max_ = contact_distance_max(p) / p.cell.side();
    if (swap_share_ == 0.0) levels_ = MonteCarloLevels<D>(radius_);
    by_size_ = levels_.count() > 1;
    skin_unit_ = by_size_ ? diameter_mean(p) / p.cell.side() : contact_max_;
    set_step(o.step * diameter_mean(p) / p.cell.side());
  }

  void set_step(double step) final {
    step_ = step;
    // A trial from where the lists were made must stay within half the skin.
    using Tuning = MonteCarloTuning;
    const double least = 2.0 * Tuning::half_skin_kept * std::sqrt(static_cast<double>(D)) * step,
                 room = geometry_.widest() - contact_max_;
    const double longest = by_size_ ? Tuning::longest_skin_by_size : Tuning::longest_skin;
    const double best =
        std::min(longest, std::max(Tuning::shortest_skin, Tuning::skin_steps * step / skin_unit_)) * skin_unit_;
    skin_ = std::max(least, std::min(best, room));
    choose_cells();
    // A trial may leave any list: then all pairs are listed permanently. Cells need lists for gaps alone.
    if (skin_ > room) skin_ = in_cells() ? std::min(best, room) : everything;
    if (!in_cells()) make_lists();
  }

  double gap_range() const final {
    const double listed = by_size_ ? MonteCarloTuning::gaps_by_size : skin_ / contact_max_;
    return std::min(listed, (geometry_.widest() - contact_max_) / contact_max_);
  }
  void count_gaps(double h_max, std::vector<double> &bins) final {
    make_lists(by_size_ ? h_max : 0.0);  // after it the lists hold all pairs within the skin
    if (by_size_) choose_cells();
    const auto count = [&](double h) {
      if (h < h_max) bins[h > 0.0 ? static_cast<size_t>(h / h_max * static_cast<double>(bins.size())) : 0] += 1.0;
    };
    if (p_.container) return count_beside_walls(count);
    each_pair([&](int32_t i, int32_t k, double r2) { count(std::sqrt(r2) / contact(i, k) - 1.0); });
  }

  void write_state(Packing &p) const final {
    for (int32_t i = 0; i < n_; ++i) {
      geometry_.position(x_[i], &p.position[static_cast<size_t>(i) * D]);
      p.diameter[i] = p_.diameter[i];
    }
  }
  const std::vector<double> &displacement() const final { return displacement_; }
  // The lists too: the order in them is the order of sums of energies.
  void archive(Archive &a) final {
    a(x_), a(centre_), a(displacement_), a(p_.diameter);
    a(first_), a(neighbour_), a(counts);
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
    choose_cells();
  }

 protected:
  using Place = std::array<uint64_t, D>;
  static constexpr double everything = 1e9;

  double contact(int32_t i, int32_t k) const {
    const double sum = radius_[i] + radius_[k];
    return p_.non_additivity == 0.0 || radius_[i] == radius_[k] ? sum : (1.0 + p_.non_additivity) * sum;
  }
  template <class F>
  void each_pair(F &&f) const {
    for (int32_t i = 0; i < n_; ++i)
      for (int32_t e = first_[i]; e < first_[i + 1]; ++e)
        if (const int32_t k = neighbour_[e]; k > i)
          geometry_.each_image2(x_[i], x_[k], [&](double r2) { f(i, k, r2); });
  }
  // Gaps up to `gap` of the contact distance are listed besides, where the skin may be less.
  void make_lists(double gap = 0.0) {
    found_.clear();
    stretch_ = 1.0 + gap;
    const auto cells = static_cast<int64_t>(geometry_.height() / list_range());
    if (by_size_ && skin_ < everything)
      levels_.each_pair(
          x_, geometry_.height(), (1.0 + std::max(0.0, p_.non_additivity)) * stretch_, skin_,
          [this](int32_t i, int32_t k) { note_pair(i, k); }, [this](int32_t i) { look_at_limits(i); });
    else if (cells >= MonteCarloTuning::fewest_cells && math::pow(3.0, D) < n_)
      find_in_cells(std::min<int64_t>(
          cells, static_cast<int64_t>(math::pow(MonteCarloTuning::cells_per_sphere * n_, 1.0 / D)) + 1));
    else
      for (int32_t i = 0; i < n_; ++i) {
        look_at_limits(i);
        for (int32_t k = i + 1; k < n_; ++k) note_pair(i, k);
      }
    if (found_.size() > size_t{1} << 30)
      fail(JAM_E_MEMORY, "neighbour lists of %zu pairs: Monte Carlo counts up to 2^30", found_.size());
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

  // f(h) of pairs, none of which sees the other across a wall, and of spheres and walls: to the virial a wall is one
  // partner more.
  template <class F>
  void count_beside_walls(F &&count) const {
    double a[D], b[D];
    const double range = gap_range() * contact_max_;  // finite, also where the lists hold all pairs
    for (int32_t i = 0; i < n_; ++i) {
      geometry_.position(x_[i], a);
      for (int w = 0; w < p_.container.count(); ++w)
        count(p_.container[w].distance(a) / (radius_[i] * p_.cell.side()) - 1.0);
      for (int32_t e = first_[i]; e < first_[i + 1]; ++e) {
        const int32_t k = neighbour_[e];
        if (k < i) continue;
        geometry_.position(x_[k], b);
        for (int c = 0; c < D; ++c) b[c] = a[c] - b[c];
        const double sigma = contact(i, k) * p_.cell.side();
        p_.cell.images(b, sigma + range * p_.cell.side(), [&](const double *shift) {
          double r2 = 0.0;
          for (int c = 0; c < D; ++c) r2 += (b[c] + shift[c]) * (b[c] + shift[c]);
          count(std::sqrt(r2) / sigma - 1.0);
        });
      }
    }
  }
  // Whether sphere i would overlap a wall with this radius after a step of V^(1/d) times dx; NULL: where it is.
  bool leaves_walls(int32_t i, double radius, const double *dx) const {
    double x[D];
    geometry_.position(x_[i], x);
    for (int c = 0; dx && c < D; ++c) x[c] += dx[c] * p_.cell.side();
    return !p_.container.holds(x, radius * p_.cell.side());
  }

  // Whether sphere i would overlap another at a place.
  bool overlaps(int32_t i, const Place &at) const {
    if (in_cells()) return overlaps_in_cells(i, at);
    for (int32_t e = first_[i]; e < first_[i + 1]; ++e)
      if (touches(i, at, neighbour_[e])) return true;
    return false;
  }
  // Before a trial that takes sphere i there.
  void prepare(int32_t i, const Place &to) {
    if (!in_cells() && geometry_.distance2(to, centre_[i]) >= 0.25 * skin_ * skin_) make_lists();
  }
  void put(int32_t i, const Place &to) {
    x_[i] = to;
    if (cells_.in_use()) cells_.move(i, to);
    if (levels_.kept()) levels_.move(i, to);
  }

  Packing p_;  // diameters of now; positions of the last lists
  int32_t n_;
  double swap_share_, step_ = 0.0, skin_ = 0.0;
  bool hard_;
  MonteCarloGeometry<D, Cube> geometry_;
  std::vector<Place> x_;
  std::vector<double> radius_;
  std::vector<Place> centre_;
  std::vector<double> displacement_;
  std::vector<int32_t> first_, neighbour_;
  double contact_max_ = 0.0, skin_unit_ = 0.0;
  bool by_size_ = false;  // sizes differ so much that each has cells of its own

 private:
  bool touches(int32_t i, const Place &at, int32_t k) const {
    const double sigma = contact(i, k);
    return geometry_.nearest2(at, x_[k]) < sigma * sigma;
  }
  // Not a part of the loop over lists, which is slower with this code in it.
  [[gnu::noinline]] bool overlaps_in_cells(int32_t i, const Place &at) const {
    const auto touched = [&](int32_t k) { return k != i && touches(i, at, k); };
    return levels_.kept() ? levels_.any(i, at, radius_[i], touched) : cells_.any(at, touched);
  }
  // Sums of soft energies need the order of a list, which the archive keeps; an overlap needs no order.
  bool in_cells() const { return cells_.in_use() || levels_.kept(); }
  void choose_cells() {
    cells_.clear();
    levels_.drop();
    if (by_size_) {
      if (!hard_ || !(step_ > MonteCarloTuning::longest_step_of_lists * skin_unit_)) return;
      skin_ = 0.0;  // of lists that count gaps
      return levels_.keep(x_, geometry_.height(), 1.0 + std::max(0.0, p_.non_additivity));
    }
    const auto side = static_cast<int64_t>(geometry_.height() / contact_max_);
    if (hard_ && step_ > MonteCarloTuning::longest_step_of_lists * contact_max_ &&
        side >= MonteCarloTuning::fewest_cells && math::pow(3.0, D) < n_)
      cells_.build(x_,
                   static_cast<size_t>(std::min<int64_t>(
                       side, static_cast<int64_t>(math::pow(MonteCarloTuning::cells_per_sphere * n_, 1.0 / D)) + 1)));
  }
  // Longest distance at which a pair is listed, of all pairs and of this one. With swaps any two spheres can get the
  // largest diameters.
  double list_range() const { return contact_max_ + skin_; }
  double list_range(int32_t i, int32_t k) const {
    return (swap_share_ > 0.0 ? contact_max_ : stretch_ * contact(i, k)) + skin_;
  }
  void note_pair(int32_t i, int32_t k) {
    const double range = list_range(i, k);
    if (geometry_.nearest2(x_[i], x_[k]) < range * range) found_.push_back({i, k});
  }
  void look_at_limits(int64_t step) const {
    if (step % MonteCarloTuning::spheres_between_looks == 0) CallScope::look();
    // A pair found is two entries of the lists besides.
    CallScope::need_memory(static_cast<double>(found_.size()) * 4.0 * sizeof(int32_t), "neighbour lists");
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
      look_at_limits(static_cast<int64_t>(cell));
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

  MonteCarloCells<D> cells_;  // not in use: lists are
  // to make lists
  MonteCarloLevels<D> levels_{{}};
  double stretch_ = 1.0;
  std::vector<std::array<int32_t, 2>> found_;
  std::vector<int32_t> cell_first_, cell_of_, in_cell_, at_;
};

}  // namespace jam::inside
