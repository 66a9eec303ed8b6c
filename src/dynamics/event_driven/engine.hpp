// The event-driven engine: spheres in the unit box (make_engine scales), asynchronous, one scheduled event per sphere.
//
// Numbers. Coordinates, radii and image shifts are integers with 2^64 to the box (2^61 with offsets). Differences wrap
// to the nearest image by themselves and are exact. A cell that is no cube always has offsets: lattice vectors, 2^58 to
// V^(1/d) unless the cell is very long (lattice.hpp). Gaps near contact are computed with 128-bit integers, so a gap is
// known to 5e-20 of the box; doubles in a unit box give 1e-16. Velocities are doubles in the same unit per time. Times
// are doubles from an origin that moves forward every few collisions per sphere.
//
// Events. Invariant: for each pair in the lists, the earlier of the two scheduled events is not later than the
// collision of the pair. The prediction of sphere i may therefore skip a partner k whose own event comes before their
// collision: k is predicted again by then. If the partner of an event has collided since, the event is stale and is
// predicted again.
//
// Lists. Each sphere has a safe sphere around the place c where its list was made. It leaves the safe sphere by an
// event that remakes this list alone. Two spheres are neighbours when |c_i - c_k| < rho_i + rho_k, where rho = radius
// (1 + growth margin) + shell. Dilute systems have no lists: spheres meet those of the cells around their own, and
// leave their cell by an event. Donev, Torquato and Stillinger, J. Comput. Phys. 202, 737 (2005), in a simpler form.
//
// Parts, each a file with its own state: spheres; clock (time, growth); calendar (events); lists; levels (who finds the
// candidates of a list, by size) of cell_grid or image_grid (cells without and with images) and list_cells; cell_mode
// (dilute systems); mari_kurchan (candidates there); walls (of a container, which core/container.hpp describes); pace
// (chooses the shell and the width of a bucket). What works on several parts, engine_of.hpp: events (prediction,
// collision, main loop; kernel/pair_kernel has its inner loops in vectors); rebuild (all lists, or that of one sphere);
// growth (begin, origin of time, rates); prefetch (loads memory ahead of its use); state (what is read of it); archive.
#pragma once
#include <memory>

#include "core/instruction_set.hpp"
#include "core/monitor.hpp"
#include "dynamics/event_driven/calendar.hpp"
#include "dynamics/observer.hpp"

namespace jam::inside {

// Why Engine::advance came back.
enum class Halt { window, packing_fraction, time, box_full, stalled, interrupted, needs_images };

// In box units and masses of 1. Checkpoints hold it as it is.
struct MdSums {
  PressureSums of_pressure;  // the code that runs the engine may set them to 0
  int64_t collisions = 0;    // since construction, never reset
  int64_t events = 0;        // likewise
  double time = 0.0;         // likewise
};

class Engine {
 public:
  virtual ~Engine() = default;
  // Makes `collisions` more, unless something else halts it; the monitor says when the call must stop.
  virtual Halt advance(int64_t collisions, const Monitor &monitor) = 0;
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
  // From now on (or, with nullptr, no more) the observer gets collisions and places of lists. Not part of the archive.
  virtual void observe(Observer *observer) = 0;
  virtual void displacements(std::vector<double> &out) const = 0;  // user's order, unit box, since observe()
  virtual void archive(Archive &a) = 0;                            // everything: the run continues to the same bits
  virtual double twice_kinetic() const = 0;
  virtual double packing_fraction() const = 0;
  virtual double mean_diameter() const = 0;
  virtual double resolution() const = 0;     // of coordinates, in V^(1/d)
  virtual double worst_overlap() const = 0;  // largest -h over all listed pairs, and walls, now
  // Momentum that each wall received since construction, without the growth part; empty without walls.
  virtual std::vector<double> wall_momentum() const = 0;
  MdSums sums;
  double max_overlap =
      0.0;  // largest -h of any pair in the lists, whenever a list was made or a sphere of the pair had an event
};

struct EngineOptions {
  double growth = 0.0;             // G
  double target_fraction = never;  // stop exactly there
  int64_t relative = 0;            // 1: keep the relative rate of growth, d ln sigma / dt
  int64_t cells = 0;  // 1: cells alone wherever they hold, -1: lists always, 0: what is faster at this density
  InstructionSet instruction_set = InstructionSet::best;  // changes no bit; for tests and benchmarks
};

std::unique_ptr<Engine> make_engine(const Packing &p, const EngineOptions &o);
// One that continues where another was archived; p is the packing that it was made from. Null where `not_begun`
// (dynamics.hpp) is in its place.
std::unique_ptr<Engine> make_engine(const Packing &p, Archive &from);

}  // namespace jam::inside
