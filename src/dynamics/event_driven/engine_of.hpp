// The engine of D dimensions, made of its parts (engine.hpp). Its functions are in the files that the comments name.
#pragma once
#include "dynamics/event_driven/cell_mode.hpp"
#include "dynamics/event_driven/levels.hpp"
#include "dynamics/event_driven/mari_kurchan.hpp"
#include "dynamics/event_driven/pace.hpp"
#include "dynamics/event_driven/walls.hpp"

namespace jam::inside {

template <int D, Offsets O>
class EngineOf final : public Engine, private Units<O> {
 public:
  EngineOf(const Packing &p, const EngineOptions &o, Archive *from = nullptr);
  Halt advance(int64_t collisions, const Monitor &monitor) override;
  void thermalise() override;
  void write_state(Packing &p, double ahead = 0.0) const override;
  void set_growth(double growth) override;
  void set_time_limit(double left) override { clock_.time_end = clock_.now + left; }
  double growth() const override { return clock_.rate * 2.0 * spheres_.mean_radius() * unit; }
  double elapsed() const override { return sums.time + clock_.now; }
  bool with_images() const override { return listed; }
  bool cells_alone() const override { return in_cell_mode(); }
  void observe(Observer *observer) override;
  void displacements(std::vector<double> &out) const override;
  void archive(Archive &a) override;
  double twice_kinetic() const override { return kinetic_.twice; }
  double packing_fraction() const override;
  double mean_diameter() const override { return 2.0 * spheres_.mean_radius() * unit * clock_.grown(); }
  double resolution() const override { return Units<O>::resolution; }
  double worst_overlap() const override;
  std::vector<double> wall_momentum() const override { return walls_ ? walls_->momentum : std::vector<double>(); }

 private:
  static constexpr bool listed = O == Offsets::listed;
  using Level = typename Levels<D, O>::Level;
  using Place = std::array<uint64_t, D>;
  using Offset = std::array<int64_t, D>;
  using Units<O>::scale;
  using Units<O>::unit;

  bool in_cell_mode() const { return !listed && cell_mode_.on != 0; }

  // -- hot path, here and in events.hpp
  void move(Body<D> &b) {
    const double dt = clock_.now - b.time;
    for (int c = 0; c < D; ++c) b.x[c] += static_cast<uint64_t>(std::llrint(b.v[c] * dt));
    b.time = clock_.now;
  }
  // a - b; the components of an offset are lists_.capacity apart, nullptr: zero.
  int64_t difference(const Body<D> &a, const Body<D> &b, int c, const int64_t *offset) const {
    const auto d = static_cast<int64_t>(a.x[c] - b.x[c]);
    return listed && offset ? wrapping_sum(d, offset[static_cast<size_t>(c) * lists_.capacity]) : d;
  }
  double exact_gap(const Body<D> &a, const Body<D> &b, const int64_t *offset) const;
  void note_overlap(const Body<D> &a, const Body<D> &b, const int64_t *offset);
  double exit_time(int32_t i) const;
  double collision_time(const Body<D> &self, const Body<D> &other, const int64_t *offset);
  void predict(int32_t i);
  void collide(int32_t i, int32_t k);
  void hit_wall(int32_t i, int w);
  void first_wall(const Body<D> &self, double &time, int32_t &partner);
  void separation(int32_t i, int32_t k, double *r) const;
  void next_event(int32_t i);
  double longest_wait() const;

  // -- prefetch.hpp
  void look_ahead() const;
  void prefetch_neighbours(int32_t i) const;
  void prefetch_lists(int32_t i) const;
  void prefetch_search(int32_t i) const;

  // -- growth.hpp
  void begin(const Packing &p);
  void move_origin();
  void rebase();
  void sort_calendar() { pace_.sort(calendar_, sums, spheres_.n); }
  void refresh(double velocity_factor, bool lists);
  void renew(double velocity_factor, bool lists);

  // -- rebuild.hpp
  void build_lists();
  void choose_margin(double sigma);
  void place_centres(double largest);
  [[gnu::cold]] void choose_levels();
  bool choose_cell_mode(double sigma);
  void rebuild_done();
  void recentre(int32_t i);
  template <class F>
  void candidates(int32_t i, F &&f) const;
  template <class F>
  void each_image(int32_t i, int32_t k, const Offset &shift, F &&f) const;
  template <class F>
  void search(int32_t i, const Level &level, F &&f) const;
  template <class F>
  void try_all(int32_t i, const std::vector<int32_t> &spheres, F &&f) const;
  void note_centre(int32_t i) { mari_kurchan_->note_centre(spheres_.user[i], lists_.centre[i], lists_.rho[i] * unit); }
  int32_t gather(int32_t i) const {
    if constexpr (!listed) return cell_mode_.gather(i, lattice_, found_.data());
    return (void)i, 0;
  }
  template <class F>
  void each_neighbour(int32_t i, F &&f) const;

  // -- state.hpp
  double way(int32_t i, int c) const;
  void note_path(int32_t i) const;
  void count_momenta() const;
  void count_momentum(const Body<D> &b, int32_t i, double sign);
  void check_pairs() const;
  void check_archive();

  EngineOptions options_;
  PairKernel<D> kernel_;
  Cell cell_of_packing_;
  Lattice<D> lattice_;
  Spheres<D> spheres_;
  Clock clock_;
  Kinetic kinetic_;
  Calendar calendar_;
  Lists<D, O> lists_;
  Levels<D, O> levels_;
  CellMode<D> cell_mode_;
  std::unique_ptr<MariKurchan<D>> mari_kurchan_;  // in this model
  std::unique_ptr<Walls<D>> walls_;               // of a container
  Pace pace_;
  Observer *observer_ = nullptr;
  bool wants_images_ = false;
  mutable std::vector<int32_t> found_, turn_;  // scratch: spheres that a search finds, and their images
  mutable ImageCells image_cells_;             // likewise, where there are images
#ifdef JAM_CHECK_PAIRS
  Packing start_;  // what a state is written into to be checked
  mutable int64_t next_check_ = 0;
  jam_status check_code_ = JAM_E_INTERNAL;  // JAM_E_FORMAT of an archive, which may have been changed on purpose
#endif
};

}  // namespace jam::inside
