// The Metropolis trials: energies, moves and swaps. Copies of trials.cpp.in compile them,
// one a dimension.
#pragma once
#include "core/pair_energy.hpp"
#include "core/rng.hpp"
#include "dynamics/monte_carlo/spheres.hpp"

namespace jam::inside {

template <int D, bool Soft, bool Cube>
class MonteCarloOf final : public MonteCarloSpheres<D, Cube> {
  using Base = MonteCarloSpheres<D, Cube>;

 public:
  MonteCarloOf(const Packing &p, const jam_monte_carlo_options &o, int64_t run)
      : Base(p, o),
        inverse_temperature_(1.0 / o.temperature),
        // Its own key a run; sweeps and spheres enter in sweep().
        key_(mix64(mix64(mix64(static_cast<uint64_t>(p.seed)) ^ static_cast<uint64_t>(Stream::monte_carlo) << 32) ^
                   mix64(static_cast<uint64_t>(run)))),
        energy_(o.alpha, o.energy_scale, o.energy_unit == JAM_ENERGY_RELATIVE) {}

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
    if constexpr (Soft)
      each_pair([&](int32_t i, int32_t k, double r2) {
        const double sigma = contact(i, k);
        if (r2 < sigma * sigma) sum += energy_.value(overlap(std::sqrt(r2), sigma));
      });
    for (int32_t i = 0; see_walls && p_.container && i < n_; ++i) sum += wall_energy(i, nullptr);
    return sum;
  }

  double virial() const override {
    double sum = 0.0;
    if constexpr (Soft)
      each_pair([&](int32_t i, int32_t k, double r2) {
        const double sigma = contact(i, k), r = std::sqrt(r2);
        if (r >= sigma) return;
        sum += energy_.slope(overlap(r, sigma)) * (energy_.relative() ? r / sigma : r * p_.cell.side());
      });
    for (int32_t i = 0; see_walls && p_.container && i < n_; ++i)
      each_wall(i, nullptr, [&](double r, double radius) {
        sum += energy_.slope(overlap(r, radius)) * (energy_.relative() ? r / radius : r * p_.cell.side());
      });
    return sum;
  }

 private:
  using Base::contact;
  using Base::counts;
  using Base::displacement_;
  using Base::each_pair;
  using Base::first_;
  using Base::geometry_;
  using Base::leaves_walls;
  using Base::n_;
  using Base::neighbour_;
  using Base::overlaps;
  using Base::p_;
  using Base::prepare;
  using Base::put;
  using Base::radius_;
  using Base::step_;
  using Base::swap_share_;
  using Base::x_;
  using typename Base::Place;
  static constexpr bool see_walls = Soft && !Cube;  // make_monte_carlo_of chooses so where soft spheres meet walls
  static constexpr uint64_t weyl = 0x9e3779b97f4a7c15ull;

  static double uniform(uint64_t base, uint64_t which) {
    return static_cast<double>(mix64(base + which * weyl) >> 11) * 0x1.0p-53;
  }
  // In the unit of the energy; r and sigma are in units of the box side.
  double overlap(double r, double sigma) const {
    return energy_.relative() ? 1.0 - r / sigma : (sigma - r) * p_.cell.side();
  }
  // Energy of sphere i at a place; +infinity where hard spheres overlap.
  double energy_at(int32_t i, const Place &at) const {
    if constexpr (!Soft) return overlaps(i, at) ? never : 0.0;
    return energy_.with_value([&](auto value) {
      double sum = 0.0;
      for (int32_t e = first_[i]; e < first_[i + 1]; ++e) {
        const int32_t k = neighbour_[e];
        const double sigma = contact(i, k);
        geometry_.each_image2(at, x_[k], [&](double r2) {
          if (r2 < sigma * sigma) sum += value(overlap(std::sqrt(r2), sigma));
        });
      }
      return sum;
    });
  }
  // Change of the energy of sphere i when it moves from its place; +infinity where hard spheres would overlap.
  double change(int32_t i, const Place &to) const {
    if constexpr (!Soft) return energy_at(i, to);
    return energy_.with_value([&](auto value) {
      const Place &from = x_[i];
      double sum = 0.0;
      for (int32_t e = first_[i]; e < first_[i + 1]; ++e) {
        const int32_t k = neighbour_[e];
        const double sigma = contact(i, k), sigma2 = sigma * sigma;
        geometry_.each_image2(to, x_[k], [&](double r2) {
          if (r2 < sigma2) sum += value(overlap(std::sqrt(r2), sigma));
        });
        geometry_.each_image2(from, x_[k], [&](double r2) {
          if (r2 < sigma2) sum -= value(overlap(std::sqrt(r2), sigma));
        });
      }
      return sum;
    });
  }
  // f(distance, radius) of each wall that sphere i overlaps after a step of V^(1/d) times dx (NULL: where it is), in
  // units of the box side.
  template <class F>
  void each_wall(int32_t i, const double *dx, F &&f) const {
    double x[D];
    geometry_.position(x_[i], x);
    for (int c = 0; dx && c < D; ++c) x[c] += dx[c] * p_.cell.side();
    for (int w = 0; w < p_.container.count(); ++w) {
      const double r = p_.container[w].distance(x) / p_.cell.side();
      if (r < radius_[i]) f(r, radius_[i]);
    }
  }
  // Soft spheres overlap walls: sum of their energies after a step dx (NULL: where sphere i is).
  [[gnu::noinline]] double wall_energy(int32_t i, const double *dx) const {
    double sum = 0.0;
    each_wall(i, dx, [&](double r, double radius) { sum += energy_.value(overlap(r, radius)); });
    return sum;
  }
  bool accept(double energy_change, uint64_t base) const {
    if (energy_change <= 0.0) return true;
    return Soft && uniform(base, 8) < math::exp(-energy_change * inverse_temperature_);
  }

  void try_move(int32_t i, uint64_t base) {
    ++counts.moves;
    Place to;
    double dx[D];
    for (int c = 0; c < D; ++c) {
      const double part =
          static_cast<double>(static_cast<int64_t>(mix64(base + static_cast<uint64_t>(c) * weyl)) >> 11);
      dx[c] = part * 0x1p-52 * step_;
    }
    // Places wrap beyond a wall: the centre of a soft sphere stays inside too.
    if (p_.container && leaves_walls(i, Soft ? 0.0 : radius_[i], dx)) return;
    // 2^63 is never reached: the step is less than half a cell vector, and the number is in [-1, 1).
    const std::array<int64_t, D> shift = geometry_.shift_of(dx);
    for (int c = 0; c < D; ++c) to[c] = x_[i][c] + static_cast<uint64_t>(shift[c]);
    prepare(i, to);
    double more = change(i, to);
    if (see_walls && p_.container) more += wall_energy(i, dx) - wall_energy(i, nullptr);
    if (!accept(more, base)) return;
    ++counts.moved;
    put(i, to);
    geometry_.add_step(shift, &displacement_[static_cast<size_t>(i) * D]);
  }

  void try_swap(int32_t i, uint64_t base) {
    ++counts.swaps;
    if (n_ < 2) return;
    int32_t k = static_cast<int32_t>(uniform(base, 10) * (n_ - 1));
    k += k >= i;
    if (radius_[i] == radius_[k]) return;
    if (!Soft && p_.container && (leaves_walls(i, radius_[k], nullptr) || leaves_walls(k, radius_[i], nullptr))) return;
    double before = 0.0;
    if constexpr (Soft) before = energy_of_both(i, k);
    std::swap(radius_[i], radius_[k]);
    if (accept(energy_of_both(i, k) - before, base)) {
      std::swap(p_.diameter[i], p_.diameter[k]);
      ++counts.swapped;
    } else {
      std::swap(radius_[i], radius_[k]);
    }
  }
  // The pair itself counts twice, before and after alike: its contact distance is the same.
  double energy_of_both(int32_t i, int32_t k) const {
    const double pairs = energy_at(i, x_[i]) + energy_at(k, x_[k]);
    return see_walls && p_.container ? pairs + wall_energy(i, nullptr) + wall_energy(k, nullptr) : pairs;
  }

  static constexpr double never = std::numeric_limits<double>::infinity();
  double inverse_temperature_;
  uint64_t key_;
  PairEnergy energy_;
};

template <int D>
std::unique_ptr<MonteCarlo> make_monte_carlo_of(const Packing &p, const jam_monte_carlo_options &o, int64_t run) {
  const bool walls = p.container && o.alpha > 0.0;  // soft spheres overlap them, and would meet across them
  const bool cube = p.cell.cube() && contact_distance_max(p) < MonteCarloTuning::range * p.cell.side() && !walls;
  if (o.alpha == 0.0) {
    if (cube) return std::make_unique<MonteCarloOf<D, false, true>>(p, o, run);
    return std::make_unique<MonteCarloOf<D, false, false>>(p, o, run);
  }
  if (cube) return std::make_unique<MonteCarloOf<D, true, true>>(p, o, run);
  return std::make_unique<MonteCarloOf<D, true, false>>(p, o, run);
}

}  // namespace jam::inside
