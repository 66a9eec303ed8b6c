// The event-driven engine: spheres in the unit box (make_engine scales), asynchronous, one scheduled event per sphere.
//
// Numbers. Coordinates, radii and image shifts are integers with 2^64 to the box (2^61 with shifts). Differences wrap
// to the nearest image by themselves and are exact. A cell that is no cube always has shifts: lattice vectors, 2^58 to
// V^(1/d) unless the cell is very long (lattice.hpp). Gaps near contact are computed with 128-bit integers, so a gap is
// known to 5e-20 of the box; doubles in a unit box give 1e-16. Velocities are doubles in the same unit per time. Times
// are doubles from an origin that moves forward every few collisions per sphere.
//
// Events. Invariant: for each pair in the lists, the earlier of the two scheduled events is not later than the
// collision of the pair. The prediction of sphere i may therefore skip a partner k whose own event comes before their
// collision: k is predicted again by then. If the partner of an event has collided since, the event is stale and is
// predicted anew.
//
// Lists. Each sphere has a safe sphere around the place c where its list was made. It leaves the safe sphere by an
// event that remakes this list alone. Two spheres are neighbours when |c_i - c_k| < rho_i + rho_k, where rho = radius
// (1 + growth margin) + shell. Dilute systems have no lists: spheres meet those of the cells around their own, and
// leave their cell by an event. Donev, Torquato and Stillinger, J. Comput. Phys. 202, 737 (2005), in a simpler form.
//
// Files. events: prediction, collision, main loop; kernel/pair_kernel: its inner loops in vectors. lists: lists;
// list_cells: cells that find their candidates; images: the same with images; cell_mode: dilute systems; mari_kurchan:
// candidates in the Mari-Kurchan model. prefetch: loads memory ahead of its use. clock: origin of time, growth. state:
// what is read of it. archive: to bytes and back.
#pragma once
#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "core/archive.hpp"
#include "core/monitor.hpp"
#include "core/packing.hpp"
#include "core/pair_rule.hpp"
#include "dynamics/event_driven/calendar.hpp"
#include "dynamics/event_driven/kernel/pair_kernel.hpp"
#include "dynamics/event_driven/lattice.hpp"
#include "dynamics/event_driven/partner_table.hpp"
#include "dynamics/observer.hpp"

namespace jam {

// Lengths wrap as coordinates do, so that no number of a damaged checkpoint overflows.
inline int64_t wrapping_sum(int64_t a, int64_t b) {
  return static_cast<int64_t>(static_cast<uint64_t>(a) + static_cast<uint64_t>(b));
}

// Why Engine::advance came back.
enum class Halt { window, packing_fraction, time, box_full, stalled, cancelled, wall_time, needs_images };

// Sums since the last reset_sums; all in box units and masses of 1.
struct MdSums {
  double virial = 0.0;            // of momentum exchanged without the growth part, r . dp
  double kinetic_integral = 0.0;  // integral of sum v^2 over time
  int64_t collisions = 0;         // since construction, never reset
  int64_t events = 0;             // likewise
  double time = 0.0;              // likewise
};

class EngineBase {
 public:
  virtual ~EngineBase() = default;
  // Makes `collisions` more, unless something else halts it.
  virtual Halt advance(int64_t collisions, const Monitor &monitor, double wall_end) = 0;
  // Moves all spheres to the present and scales velocities to kT/m = 1.
  virtual void thermalise() = 0;
  // Positions, velocities, diameters (when growing) of this moment, or of one `ahead` of it and not later than the next
  // event; the run is not disturbed.
  virtual void write_state(Packing &p, double ahead = 0.0) const = 0;
  virtual void set_growth(double growth) = 0;
  virtual void set_time_limit(double left) = 0;  // Halt::time after so much more time
  virtual double growth() const = 0;             // d<sigma>/dt now
  virtual double elapsed() const = 0;            // since construction
  virtual bool with_images() const = 0;
  virtual bool cells_alone() const = 0;  // no lists now
  // From now on (or, with nullptr, no more) collisions and places of lists are reported to it. Not part of the archive.
  virtual void observe(Observer *observer) = 0;
  virtual void displacements(std::vector<double> &out) const = 0;  // user's order, unit box, since observe()
  virtual void archive(Archive &a) = 0;                            // everything: the run goes on to the same bits
  virtual double twice_kinetic() const = 0;
  virtual double packing_fraction() const = 0;
  virtual double mean_diameter() const = 0;
  virtual double resolution() const = 0;     // of coordinates, in V^(1/d)
  virtual double worst_overlap() const = 0;  // largest -h over all listed pairs, now
  MdSums sums;
  double max_overlap =
      0.0;  // largest -h of any pair in the lists, whenever a list was made or a sphere of the pair had an event
};

struct EngineOptions {
  double growth = 0.0;             // G
  double target_fraction = never;  // stop exactly there
  int64_t heap_only = 0;           // 1: one heap of all events instead of the calendar, for comparison
  int64_t relative = 0;            // 1: keep the relative rate of growth, d ln sigma / dt
  int64_t cells = 0;  // 1: cells alone wherever they hold, -1: lists always, 0: what is faster at this density
  InstructionSet instruction_set = InstructionSet::best;  // changes no bit; for tests and benchmarks
};

// Shift: list entries carry their own shift: an image when a pair can meet through several, the quenched shift in the
// Mari-Kurchan model.
std::unique_ptr<EngineBase> make_engine(const Packing &p, const EngineOptions &o);
// One that goes on where another was archived; p is the packing that it was made from. Null where `not_begun`
// (dynamics.hpp) stands in its place.
std::unique_ptr<EngineBase> make_engine(const Packing &p, Archive &from);

template <int D, bool Shift>
class Engine final : public EngineBase, private Units<Shift> {
 public:
  Engine(const Packing &p, const EngineOptions &o, Archive *from = nullptr);
  Halt advance(int64_t collisions, const Monitor &monitor, double wall_end) override;
  void thermalise() override;
  void write_state(Packing &p, double ahead = 0.0) const override;
  void set_growth(double growth) override;
  void set_time_limit(double left) override { time_end_ = now_ + left; }
  double growth() const override { return rate_ * 2.0 * mean_radius() * unit; }
  double elapsed() const override { return sums.time + now_; }
  bool with_images() const override { return Shift; }
  bool cells_alone() const override { return cells_alone_ != 0; }
  void observe(Observer *observer) override;
  void displacements(std::vector<double> &out) const override;
  void archive(Archive &a) override;
  double twice_kinetic() const override { return twice_kinetic_; }
  double packing_fraction() const override;
  double mean_diameter() const override { return 2.0 * mean_radius() * unit * (1.0 + rate_ * now_); }
  double resolution() const override { return Units<Shift>::resolution; }
  double worst_overlap() const override;

  // Whether lists without image shifts can hold for this largest contact distance, unit box.
  static bool fits(double sigma_max) { return sigma_max * (1.0 + 4.0 * smallest_shell + smallest_margin) < 0.4999; }

 private:
  using Place = std::array<uint64_t, D>;
  using Units<Shift>::scale;
  using Units<Shift>::unit;
  static constexpr double smallest_shell = 0.004, smallest_margin = 0.002;

  // -- hot path, here and in events.hpp
  void move(Body<D> &b) {
    const double dt = now_ - b.time;
    for (int c = 0; c < D; ++c) b.x[c] += static_cast<uint64_t>(std::llrint(b.v[c] * dt));
    b.time = now_;
  }
  // Contact distance of two bodies at the origin of time, by the rule of core/pair_rule.hpp; kernel/loops.hpp has
  // the same in vectors.
  int64_t contact_sum(const Body<D> &a, const Body<D> &b) const {
    const int64_t sum = wrapping_sum(a.radius, b.radius);
    if (non_additivity_ == 0.0 || a.radius == b.radius) return sum;
    return wrapping_sum(sum, std::llrint(static_cast<double>(sum) * non_additivity_));
  }
  // a - b; the components of an offset are capacity_ apart.
  int64_t difference(const Body<D> &a, const Body<D> &b, int c, const int64_t *offset) const {
    const auto d = static_cast<int64_t>(a.x[c] - b.x[c]);
    if constexpr (Shift)
      return wrapping_sum(d, offset[static_cast<size_t>(c) * capacity_]);
    else
      return (void)offset, d;
  }
  double exact_gap(const Body<D> &a, const Body<D> &b, const int64_t *offset) const;
  void note_overlap(const Body<D> &a, const Body<D> &b, const int64_t *offset);
  double exit_time(int32_t i) const;
  double collision_time(const Body<D> &self, const Body<D> &other, const int64_t *offset);
  void predict(int32_t i);
  void collide(int32_t i, int32_t k);
  void separation(int32_t i, int32_t k, double *r) const;
  void next_event(int32_t i);
  double longest_wait() const;

  // -- prefetch.hpp
  void look_ahead() const;
  void prefetch_neighbours(int32_t i) const;
  void prefetch_lists(int32_t i) const;
  void prefetch_search(int32_t i) const;

  // -- time, clock.hpp
  void shift_origin();
  void rebase();
  void sort_calendar();
  void refresh(double velocity_factor, bool lists);
  bool tune_shell();
  void take_kinetic();
  void note_path(int32_t i) const;
  void check_pairs() const;
  void start_rate(double rate);
  double mean_radius() const;

  // -- archive, archive.hpp
  void check_archive() const;
  void check_cells() const;

  // -- lists, lists.hpp
  void choose_cells();
  void build_lists();
  void recentre(int32_t i);
  template <class F>
  void candidates(int32_t i, F &&f);
  template <class F>
  void each_neighbour(int32_t i, F &&f) const;
  template <class F>
  void each_image(int32_t i, int32_t k, double cutoff, std::array<int64_t, D> shift, F &&f) const;
  void append(int32_t i, int32_t k, const std::array<int64_t, D> *offset);
  void forget(int32_t i, int32_t k);
  void widen_lists();

  // -- cells of the lists, list_cells.hpp
  std::array<int64_t, D> home_of(int32_t i) const;
  size_t cell_of(const std::array<int64_t, D> &home) const;
  size_t cells_around(const std::array<int64_t, D> &home) const;
  void make_scratch();
  void build_blocks();
  void put(int32_t i, size_t cell);
  void drop(int32_t i, size_t cell);
  int32_t search(int32_t i) const;

  // -- cells of the lists with images, images.hpp
  void choose_image_cells();
  template <class F>
  void each_cell_around(int c, const std::array<int64_t, D> &home, size_t cell, const std::array<int64_t, D> &image,
                        F &&f) const;
  template <class F>
  void search_images(int32_t i, F &&f) const;

  // -- cells alone, cell_mode.hpp
  bool choose_cells_alone(double sigma);
  void build_cells_alone();
  void link(int32_t i, size_t cell);
  void unlink(int32_t i, size_t cell);
  int32_t gather(int32_t i) const;
  double crossing_time(int32_t i, int *axis) const;
  void cross(int32_t i);

  // -- Mari-Kurchan model, mari_kurchan.hpp
  struct Redrawn {
    int32_t number, attempt;  // of the user, of the shift of this pair
  };
  void prepare_partners();
  void note_centre(int32_t i);
  std::array<int64_t, D> shift_of(int32_t a, const Redrawn &partner) const;
  template <class F>
  void each_partner(int32_t i, F &&f) const;

  int64_t side_of_cells(int c) const {
    if constexpr (Shift)
      return image_cells_[c];
    else
      return (void)c, cells_;
  }
  const int32_t *list_of(int32_t i) const { return &neighbour_[static_cast<size_t>(i) * capacity_]; }
  int32_t *list_of(int32_t i) { return &neighbour_[static_cast<size_t>(i) * capacity_]; }
  size_t offset_at(int32_t i, int32_t entry) const {
    return static_cast<size_t>(i) * D * capacity_ + static_cast<size_t>(entry);
  }
  const int64_t *offset_of(int32_t i, int32_t entry) const {
    if constexpr (Shift)
      return &offset_[offset_at(i, entry)];
    else
      return (void)i, (void)entry, nullptr;
  }

  std::unique_ptr<MkShifts> quenched_;  // Mari-Kurchan model
  Lattice<D> lattice_;
  int32_t n_;
  EngineOptions options_;
  PairKernel<D> kernel_;
  Cell cell_of_packing_;
  double non_additivity_;
  double reach_factor_;  // largest contact distance over the sum of the radii
  std::vector<Body<D>> body_;
  Calendar calendar_;
  std::vector<int32_t> user_;  // number of each sphere for the user; here they are sorted along a curve

  double now_ = 0.0;               // relative to the origin
  double rate_ = 0.0;              // growth of radii: R(t) = R (1 + rate t)
  double relative_rate_ = 0.0;     // rate_ at each step of a constant relative rate; 0: the diameters grow linearly
  std::vector<double> left_over_;  // of radii, less than one unit
  std::vector<double> mass_;       // empty: all 1
  Observer *observer_ = nullptr;
  // When something special happens.
  double lists_end_ = never, fraction_time_ = never, full_time_ = never, time_end_ = never, step_end_ = never;
  double target_radius_ = 0.0;  // of sphere 0 at the target packing fraction
  double kinetic_time_ = 0.0, twice_kinetic_ = 0.0;
  bool wants_images_ = false;

  // neighbour lists
  double shell_ = 0.1, margin_ = 0.05;  // relative to sigma
  std::vector<Place> centre_;
  std::vector<double> rho_, safe_;               // list radius, safe radius
  std::vector<int32_t> neighbour_, neighbours_;  // (n, capacity), counts
  std::vector<int64_t> offset_;                  // Shift: (n, D, capacity)
  size_t capacity_ = 0;                          // a multiple of the length of a vector
  double rho_max_ = 0.0;
  int64_t cells_ = 0;  // per side; 0: brute force
  int cell_range_ = 1;
  std::array<int64_t, D> image_cells_{}, image_range_{};  // Shift: along each cell vector
  std::vector<Block<D>> block_;                           // one of each cell, and further ones of overfull cells
  mutable std::vector<size_t> around_;                    // scratch: cells that are searched
  mutable std::vector<int32_t> found_;                    // scratch: spheres found in them

  // cells alone: no lists; a sphere looks at the cells around its own, leaving which is an event
  int64_t cells_alone_ = 0;  // 1: now
  std::vector<int32_t> cell_first_, cell_next_;
  std::vector<std::array<int32_t, D>> cell_;  // of each sphere

  // Mari-Kurchan model
  std::vector<int32_t> internal_;  // inverse of user_
  std::vector<Redrawn> redrawn_;   // partners of each sphere with a shift drawn again
  std::vector<size_t> redrawn_first_;
  std::unique_ptr<PartnerTable<D>> partner_table_;

#ifdef JAM_CHECK_PAIRS
  Packing start_;  // what a state is written into to be checked
  mutable int64_t next_check_ = 0;
#endif

  // shell and bucket tuning
  int64_t exits_ = 0, exits_before_ = 0, collisions_before_ = 0, events_before_ = 0, rebase_at_ = 0;
  double search_cost_ = 0.0, widest_shell_ = 1.5, tuned_time_ = 0.0, time_before_ = 0.0, bucket_width_ = 0.0,
         collision_time_ = 0.0;
};

}  // namespace jam
