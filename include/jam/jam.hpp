/* C++ layer of libjam, header only, C++17. SPDX-License-Identifier: MIT
 *
 *   jam::System packing = jam::System::random(1024, 3, 1);
 *   packing.compress();
 *   jam_crunch_report report = packing.crunch();
 *   for (double f : packing.forces()) ...
 *
 * System owns the C handle and moves but does not copy by accident (copy() does). A status below zero throws
 * jam::Error; above zero it is System::status() and the state is valid. Exceptions thrown by callbacks stop the call
 * and come out of it.
 */
#ifndef JAM_JAM_HPP
#define JAM_JAM_HPP

#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "jam/jam.h"

namespace jam {

// A status below zero with the text of the library.
#ifdef __clang__
#pragma clang diagnostic push
#pragma clang diagnostic ignored "-Wweak-vtables"  // a header alone has no unit for the table of this class
#endif
class Error : public std::runtime_error {
 public:
  explicit Error(jam_status status) : std::runtime_error(text(status)), status_(status) {}
  jam_status status() const noexcept { return status_; }

 private:
  static std::string text(jam_status status) {
    const char *last = jam_last_error();
    return last && *last ? last : jam_status_string(status);
  }
  jam_status status_;
};
#ifdef __clang__
#pragma clang diagnostic pop
#endif

// Throws for a status below zero, else returns it.
inline jam_status check(jam_status status) {
  if (status < 0) throw Error(status);
  return status;
}

// The same for a call that returns what it found, or only changes something: one that was cancelled has done neither.
inline void check_done(jam_status status) {
  if (check(status) == JAM_CANCELLED) throw Error(status);
}

// Read-only view of (rows, columns) numbers: as std::span, with rows. Good as long as its System lives.
class View {
 public:
  View() = default;
  View(const double *data, std::size_t size, std::size_t columns) : data_(data), size_(size), columns_(columns) {}
  const double *data() const { return data_; }
  std::size_t size() const { return size_; }
  std::size_t columns() const { return columns_; }
  std::size_t rows() const { return columns_ ? size_ / columns_ : 0; }
  const double *begin() const { return data_; }
  const double *end() const { return data_ + size_; }
  double operator[](std::size_t k) const { return data_[k]; }
  double operator()(std::size_t row, std::size_t column) const { return data_[row * columns_ + column]; }

 private:
  const double *data_ = nullptr;
  std::size_t size_ = 0, columns_ = 1;
};

// Option and report structs with struct_size set: jam::options<jam_crunch_options>(jam_crunch_options_init).
template <class T>
T options(jam_status (*init)(T *, std::size_t)) {
  T made;
  check(init(&made, sizeof made));
  return made;
}
template <class T>
T report() {
  T made{};
  made.struct_size = sizeof made;
  return made;
}
inline jam_create_options create_options() { return options(jam_create_options_init); }
inline jam_run_options run_options() { return options(jam_run_options_init); }
inline jam_compress_options compress_options() { return options(jam_compress_options_init); }
inline jam_crunch_options crunch_options() { return options(jam_crunch_options_init); }
inline jam_relax_options relax_options() { return options(jam_relax_options_init); }
inline jam_modes_options modes_options() { return options(jam_modes_options_init); }
inline jam_check_options check_options() { return options(jam_check_options_init); }

// Count, then fill: calls f(buffer, length, &needed) twice and returns the array.
template <class T, class F>
std::vector<T> fetch(F &&f) {
  std::size_t needed = 0;
  check_done(f(static_cast<T *>(nullptr), std::size_t{0}, &needed));
  std::vector<T> out(needed);
  if (needed) check_done(f(out.data(), out.size(), &needed));
  return out;
}

// N spheres in a periodic cell.
class System {
 public:
  // Returns true to stop the call.
  using Progress = std::function<bool(const jam_progress &)>;
  using Log = std::function<void(int level, const char *line)>;

  // cell: (d, d), one vector a row; empty: the cube of the options.
  explicit System(const jam_create_options &o, const std::vector<double> &positions = {},
                  const std::vector<double> &diameters = {}, const std::vector<double> &cell = {}) {
    adopt([&](jam_system **out) {
      jam_start start = report<jam_start>();
      start.positions = positions.empty() ? nullptr : positions.data();
      start.positions_len = positions.size();
      start.diameters = diameters.empty() ? nullptr : diameters.data();
      start.diameters_len = diameters.size();
      start.cell = cell.empty() ? nullptr : cell.data();
      start.cell_len = cell.size();
      return jam_create(&o, &start, out);
    });
  }
  // Takes ownership of a C handle.
  explicit System(jam_system *handle) : handle_(handle) {
    if (!handle) throw std::invalid_argument("jam::System: the handle is NULL");
  }
  static System random(std::int64_t n, int dim = 3, std::int64_t seed = 1, double packing_fraction = 0.0,
                       const std::vector<double> &diameters = {}) {
    jam_create_options o = create_options();
    o.n = n;
    o.dim = dim;
    o.seed = seed;
    o.packing_fraction = packing_fraction;
    return System(o, {}, diameters);
  }
  // positions (n, d) row by row; diameters: n values or one for all.
  static System from_arrays(int dim, const std::vector<double> &positions, const std::vector<double> &diameters,
                            double box = 1.0) {
    jam_create_options o = create_options();
    o.dim = dim;
    o.box = box;
    return System(o, positions, diameters);
  }
  static System from_arrays(int dim, const std::vector<double> &positions, const std::vector<double> &diameters,
                            const std::vector<double> &cell) {
    jam_create_options o = create_options();
    o.dim = dim;
    return System(o, positions, diameters, cell);
  }
  // layout: what the file does not say, as jam_read_as takes it.
  static System read(const std::string &path, const jam_create_options &o = create_options(),
                     const std::string &layout = "") {
    System made;
    made.adopt([&](jam_system **out) { return jam_read_as(path.c_str(), layout.c_str(), &o, nullptr, nullptr, out); });
    return made;
  }
  std::string notes() const { return jam_notes(get()); }
  // From a file of checkpoint(): dynamics continue to the same bits.
  static System from_checkpoint(const std::string &path) {
    System made;
    made.adopt([&](jam_system **out) { return jam_read_checkpoint(path.c_str(), nullptr, nullptr, out); });
    return made;
  }
  void checkpoint(const std::string &path) const { done(jam_write_checkpoint(get(), path.c_str())); }
  System copy() const {
    System made;
    made.adopt([&](jam_system **out) { return jam_copy(get(), out); });
    return made;
  }
  // Copies side by side: count[c] of them along each cell vector.
  System tile(const std::vector<std::int32_t> &count) const {
    System made;
    made.adopt([&](jam_system **out) { return jam_tile(get(), count.data(), count.size(), out); });
    return made;
  }

  jam_system *get() const {
    if (!handle_) throw std::logic_error("jam::System: moved from");
    return handle_.get();
  }
  jam_info info() const {
    jam_info made = report<jam_info>();
    check(jam_get_info(get(), &made));
    return made;
  }
  View positions() const { return view(JAM_VIEW_POSITIONS, static_cast<std::size_t>(info().dim)); }
  View velocities() const { return view(JAM_VIEW_VELOCITIES, static_cast<std::size_t>(info().dim)); }
  View diameters() const { return view(JAM_VIEW_DIAMETERS, 1); }
  // Cell vectors (d, d), one a row.
  std::vector<double> cell() const { return array<double>(jam_get_cell); }
  void set_positions(const std::vector<double> &x) { done(jam_set_positions(get(), x.data(), x.size())); }
  void set_velocities(const std::vector<double> &v) { done(jam_set_velocities(get(), v.data(), v.size())); }
  void scale_diameters(double factor) { done(jam_scale_diameters(get(), factor)); }
  void write(const std::string &path, jam_format format = JAM_FORMAT_AUTO) const {
    done(jam_write(get(), path.c_str(), format));
  }

  // Verbs. Without options: the library's defaults (compress: the two-stage protocol).
  jam_md_report run(const jam_run_options &o) { return verb<jam_md_report>(jam_run, &o); }
  jam_md_report run(double collisions_per_particle) {
    jam_run_options o = run_options();
    o.collisions_per_particle = collisions_per_particle;
    return run(o);
  }
  jam_md_report compress() {
    return verb<jam_md_report>(jam_compress, static_cast<const jam_compress_options *>(nullptr));
  }
  jam_md_report compress(const jam_compress_options &o) { return verb<jam_md_report>(jam_compress, &o); }
  jam_crunch_report crunch() {
    return verb<jam_crunch_report>(jam_crunch, static_cast<const jam_crunch_options *>(nullptr));
  }
  jam_crunch_report crunch(const jam_crunch_options &o) { return verb<jam_crunch_report>(jam_crunch, &o); }
  // Overlapping (soft) spheres: minimises their energy.
  jam_relax_report relax(const jam_relax_options &o = relax_options()) { return verb<jam_relax_report>(jam_relax, &o); }
  // Tests the packing as it is; jam_check_text gives the report as a paragraph.
  jam_check_report check_packing(const jam_check_options &o = check_options()) {
    return verb<jam_check_report>(jam_check_packing, &o);
  }
  // Vibrational modes of the network: table (m, jam_mode_column), vectors (m, stable spheres, d).
  struct Modes {
    std::vector<double> table, vectors;
  };
  Modes modes(const jam_modes_options &o = modes_options(), const jam_hessian_options *h = nullptr) {
    const auto stable = array<std::int32_t>(jam_hessian_map).size(), d = static_cast<std::size_t>(info().dim);
    std::size_t m = 0;
    check(jam_modes(get(), h, &o, JAM_MODE_COLUMNS, nullptr, 0, nullptr, 0, &m));
    Modes found{std::vector<double>(JAM_MODE_COLUMNS * m), std::vector<double>(m * stable * d)};
    const jam_status status = jam_modes(get(), h, &o, JAM_MODE_COLUMNS, found.table.data(), found.table.size(),
                                        found.vectors.data(), found.vectors.size(), &m);
    rethrow();
    status_ = check(status);
    return found;
  }
  // Status of the last verb: 0 done, > 0 stopped early.
  jam_status status() const { return status_; }
  // From any thread or signal handler.
  void cancel() const { check(jam_cancel(get())); }

  void on_progress(Progress f) {
    callbacks().progress = std::move(f);
    check(jam_set_progress(get(), callbacks_->progress ? &Callbacks::progress_c : nullptr, callbacks_.get()));
  }
  void on_log(Log f, jam_log_level level = JAM_LOG_INFO) {
    callbacks().log = std::move(f);
    check(jam_set_log(get(), callbacks_->log ? &Callbacks::log_c : nullptr, level, callbacks_.get()));
  }

  // The network of the last crunch.
  jam_crunch_report last_report() const {
    jam_crunch_report made = report<jam_crunch_report>();
    check(jam_get_crunch_report(get(), &made));
    return made;
  }
  std::vector<std::int32_t> contacts() const { return array<std::int32_t>(jam_contacts); }    // (contacts, 2)
  std::vector<double> contact_vectors() const { return array<double>(jam_contact_vectors); }  // (contacts, d)
  std::vector<double> contact_gaps() const { return array<double>(jam_contact_gaps); }
  std::vector<double> forces() const { return array<double>(jam_forces); }
  std::vector<std::int32_t> coordination() const { return array<std::int32_t>(jam_coordination); }

  // Any other count-then-fill call of the header: sys.array<int32_t>(jam_hessian_map).
  template <class T, class F>
  std::vector<T> array(F function) const {
    return fetch<T>([&](T *out, std::size_t length, std::size_t *needed) {
      const jam_status status = function(get(), out, length, needed);
      rethrow();
      return status;
    });
  }

 private:
  struct Free {
    void operator()(jam_system *s) const noexcept { jam_destroy(s); }
  };
  struct Callbacks {
    Progress progress;
    Log log;
    std::exception_ptr thrown;  // carried over the C frames and thrown again behind them

    static std::int32_t progress_c(const jam_progress *p, void *user) noexcept {
      auto *self = static_cast<Callbacks *>(user);
      if (self->thrown) return 1;
      try {
        return self->progress(*p) ? 1 : 0;
      } catch (...) {
        self->thrown = std::current_exception();
        return 1;
      }
    }
    static void log_c(std::int32_t level, const char *line, void *user) noexcept {
      auto *self = static_cast<Callbacks *>(user);
      if (self->thrown) return;
      try {
        self->log(level, line);
      } catch (...) {
        self->thrown = std::current_exception();
      }
    }
  };

  System() = default;
  Callbacks &callbacks() {
    if (!callbacks_) callbacks_ = std::make_unique<Callbacks>();
    return *callbacks_;
  }
  template <class F>
  void adopt(F &&make) {
    jam_system *made = nullptr;
    const jam_status status = check(make(&made));
    if (!made) throw Error(status);
    handle_.reset(made);
  }
  View view(jam_view_array array, std::size_t columns) const {
    const double *data = nullptr;
    std::size_t size = 0;
    check(jam_view(get(), array, &data, &size));
    return View(data, size, columns);
  }
  template <class R, class F, class O>
  R verb(F function, const O *o) {
    R made = report<R>();
    const jam_status status = function(get(), o, &made);
    rethrow();
    status_ = check(status);
    return made;
  }
  // What the callback of the last call threw.
  void rethrow() const {
    if (callbacks_ && callbacks_->thrown) std::rethrow_exception(std::exchange(callbacks_->thrown, nullptr));
  }
  void done(jam_status status) const {
    rethrow();
    check_done(status);
  }

  std::unique_ptr<Callbacks> callbacks_;  // before handle_: outlives it
  std::unique_ptr<jam_system, Free> handle_;
  jam_status status_ = JAM_OK;
};

}  // namespace jam

#endif  // JAM_JAM_HPP
