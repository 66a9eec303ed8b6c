// Calls of jam.h by the conventions of its arguments, from values of Octave: options by name, arrays (n, d) as matrices,
// indices from 1, count and then fill. emit_octave.py writes one function for each call out of these parts.
#pragma once
#include <octave/oct.h>
#include <octave/interpreter.h>
#include <octave/ov-struct.h>
#include <octave/parse.h>

#include <cmath>
#include <exception>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "jam/jam.h"

namespace jam_octave {

struct Word { const char *name; int32_t value; };  // a list ends with {nullptr, 0}
struct Member { const char *name; char kind; size_t at; const Word *words; };  // kinds: see read() below
extern const Word *const status_words;
extern const Member *const progress_members;

inline std::string word_of(const Word *words, int32_t value) {
  for (; words->name; ++words)
    if (words->value == value) return words->name;
  return std::to_string(value);
}

[[noreturn]] inline void refuse(const std::string &text) { error_with_id("jam:argument", "%s", text.c_str()); throw; }

inline bool is_numbers(const octave_value &value) { return (value.isnumeric() || value.islogical()) && value.isreal(); }

inline double real(const octave_value &value, const std::string &name) {
  if (!is_numbers(value) || value.numel() != 1) refuse(name + " must be a number");
  return value.double_value();
}

template <class T>
T whole(const octave_value &value, const std::string &name) {
  using Limits = std::numeric_limits<T>;
  const std::string wrong = name + " must be a whole number of " + std::to_string(8 * sizeof(T)) + " bits";
  if (!is_numbers(value) || value.numel() != 1) refuse(wrong);
  const double x = value.double_value();
  if (value.isinteger()) {  // conversions saturate: a number of 64 bits is exact in one of both
    const int64_t low = value.int64_scalar_value().value();
    const uint64_t high = value.uint64_scalar_value().value();
    if (low < 0 && Limits::is_signed && low >= static_cast<int64_t>(Limits::min())) return static_cast<T>(low);
    if (low >= 0 && high <= static_cast<uint64_t>(Limits::max())) return static_cast<T>(high);
  } else if (x == std::floor(x) && x >= static_cast<double>(Limits::min()) && x < std::ldexp(1.0, Limits::digits)) {
    return static_cast<T>(x);
  }
  refuse(wrong + ", not " + std::to_string(x));
}

inline int32_t number_of(const Word *words, const octave_value &value, const std::string &name) {
  if (!value.is_string()) return whole<int32_t>(value, name);
  const std::string text = value.string_value();
  std::string known;
  for (const Word *w = words; w->name; ++w) {
    if (text == w->name) return w->value;
    known += std::string(known.empty() ? "" : ", ") + w->name;
  }
  refuse(name + " is '" + text + "'; it may be " + known);
}

inline bool flag(const octave_value &value, const std::string &name) {
  const bool is = value.is_bool_scalar() || (value.is_real_scalar() && (value.double_value() == 0 || value.double_value() == 1));
  if (!is) refuse(name + " must be true or false");
  return value.is_true();
}

inline octave_value read(const void *data, const Member &m) {
  const char *at = static_cast<const char *>(data) + m.at;
  switch (m.kind) {
    case 'd': return *reinterpret_cast<const double *>(at);
    case 'b': return *reinterpret_cast<const int32_t *>(at) != 0;
    case 'w': return word_of(m.words, *reinterpret_cast<const int32_t *>(at));
    case 'i': return static_cast<double>(*reinterpret_cast<const int32_t *>(at));
    case 'u': return static_cast<double>(*reinterpret_cast<const uint32_t *>(at));
    case 'l': return static_cast<double>(*reinterpret_cast<const int64_t *>(at));
    default: return octave_uint64(*reinterpret_cast<const uint64_t *>(at));
  }
}

inline void write(void *data, const Member &m, const octave_value &value) {
  char *at = static_cast<char *>(data) + m.at;
  switch (m.kind) {
    case 'd': *reinterpret_cast<double *>(at) = real(value, m.name); break;
    case 'b': *reinterpret_cast<int32_t *>(at) = flag(value, m.name); break;
    case 'w': *reinterpret_cast<int32_t *>(at) = number_of(m.words, value, m.name); break;
    case 'i': *reinterpret_cast<int32_t *>(at) = whole<int32_t>(value, m.name); break;
    case 'u': *reinterpret_cast<uint32_t *>(at) = whole<uint32_t>(value, m.name); break;
    case 'l': *reinterpret_cast<int64_t *>(at) = whole<int64_t>(value, m.name); break;
    default: *reinterpret_cast<uint64_t *>(at) = whole<uint64_t>(value, m.name);
  }
}

inline octave_scalar_map map_of(const void *data, const Member *members) {
  octave_scalar_map made;
  for (; members->name; ++members) made.assign(members->name, read(data, *members));
  return made;
}

struct Fill;

// The arguments of one call: plain ones in their order, then options as names and values or in structs.
class Given {
 public:
  Given(const char *call, jam_system *sys, const octave_value_list &args, std::vector<const char *> plain, int needed,
        std::vector<const Member *> structs, std::vector<const char *> more)
      : call_(call), sys_(sys) {
    for (const Member *m : structs)
      for (; m->name; ++m) known_[m->name];
    for (const char *name : more) known_[name];
    int k = 0;
    const int most = static_cast<int>(plain.size());
    for (; k < args.length() && k < most; ++k) {
      const bool option = args(k).isstruct() || (args(k).is_string() && known_.count(args(k).string_value()));
      if (k >= needed && option) break;
      values_.push_back(args(k));
    }
    if (k < needed) refuse(call_ + " needs " + plain[k]);
    while (k < args.length())
      if (args(k).isstruct()) {
        const octave_scalar_map map = args(k++).scalar_map_value();
        for (octave_idx_type j = 0; j < map.nfields(); ++j) option(map.fieldnames()(j), map.contents(map.fieldnames()(j)));
      } else if (k + 1 < args.length() && args(k).is_string()) {
        option(args(k).string_value(), args(k + 1));
        k += 2;
      } else {
        refuse(call_ + ": argument " + std::to_string(k + 1) + " is neither the name of an option nor its value");
      }
  }

  octave_value plain(size_t k) const { return k < values_.size() ? values_[k] : octave_value(); }
  // Of an option that was given: its value, and whoever asks first has it.
  octave_value take(const std::string &name) {
    octave_value value = known_[name];
    known_[name] = octave_value();
    return value;
  }
  // Of an array by which a packing is made; n is 0 where the arrays tell it.
  octave_value take_start(const std::string &name, int32_t d, int64_t n) {
    d_ = d, n_ = n > 0 ? static_cast<double>(n) : -1;
    octave_value value = take(name);
    if (value.is_defined() && value.isempty()) refuse(name + " is empty: leave it out");
    return value;
  }
  jam_system *system() const { return sys_; }

  // A letter of the header's shapes, or a number; -1 where the call tells it.
  double extent(const std::string &text) const {
    if (std::isdigit(text[0])) return std::stod(text);
    if (!sys_) return text == "d" ? d_ : text == "n" ? n_ : -1;
    jam_info info = {};
    info.struct_size = sizeof info;
    jam_get_info(sys_, &info);
    size_t count = 0;
    if (text == "d") return info.dim;
    if (text == "n") return static_cast<double>(info.n);
    if (text == "N'" || text == "d N' + 1") {
      jam_hessian_map(sys_, nullptr, 0, &count);
      return text == "N'" ? static_cast<double>(count) : info.dim * static_cast<double>(count) + 1;
    }
    if (text != "n_c" && text != "contacts") return -1;
    jam_contact_gaps(sys_, nullptr, 0, &count);
    return static_cast<double>(count);
  }

  void *user() { return this; }
  static int32_t on_progress(const jam_progress *p, void *user) {
    Given &given = *static_cast<Given *>(user);
    try {
      octave_quit();  // Ctrl-C
      if (!given.progress_.is_defined()) return 0;
      const octave_value_list out = octave::feval(given.progress_, octave_value_list(map_of(p, progress_members)), 1);
      return out.length() > 0 && out(0).is_defined() && out(0).is_true();
    } catch (...) {
      given.caught_ = std::current_exception();
      return 1;
    }
  }

  // Refuses options that nothing took, then calls f; `changes`: the system takes a progress function.
  template <class F>
  void run(bool changes, F f) {
    progress_ = known_.count("progress") ? take("progress") : octave_value();
    for (const auto &[name, value] : known_)
      if (value.is_defined()) refuse(call_ + " does not take " + name + " here");
    const bool reports = changes && sys_;
    if (reports) jam_set_progress(sys_, &Given::on_progress, this);
    status_ = f();
    if (reports) jam_set_progress(sys_, nullptr, nullptr);
    if (caught_) std::rethrow_exception(caught_);
    const std::string word = status();
    if (status_ < 0) error_with_id(("jam:" + word).c_str(), "%s", jam_last_error());
  }
  // The same for arrays: counted first, then filled. rows: the count is that of rows, else of elements.
  template <class F>
  void fill(bool changes, F f, const size_t &counted, bool rows, std::vector<Fill *> arrays);

  // Without a report a stop is an error and any other status above zero a warning.
  void without_report() const {
    if (status_ == JAM_CANCELLED || status_ == JAM_LIMIT) error_with_id(("jam:" + status()).c_str(), "%s", jam_last_error());
    if (status_ > 0) warning_with_id(("jam:" + status()).c_str(), "%s", jam_last_error());
  }
  std::string status() const { return word_of(status_words, status_); }
  octave_value reported(const void *report, const Member *members, const std::string &text) const {
    octave_scalar_map made = map_of(report, members);
    made.assign("status", status());
    made.assign("status_text", status_ == JAM_OK ? "" : jam_last_error());
    if (!text.empty()) made.assign("text", text);
    return made;
  }

 private:
  void option(const std::string &name, const octave_value &value) {
    if (!known_.count(name)) {
      std::string list;
      for (const auto &[key, unused] : known_) list += (list.empty() ? "" : ", ") + key;
      refuse(call_ + " has no option " + name + "; it has " + (list.empty() ? "none" : list));
    }
    known_[name] = value;
  }

  std::string call_;
  jam_system *sys_;
  double d_ = -1, n_ = -1;  // of the packing that is made
  std::vector<octave_value> values_;
  std::map<std::string, octave_value> known_;
  octave_value progress_;
  std::exception_ptr caught_;
  jam_status status_ = JAM_OK;
};

// Place in an array whose first index runs fastest, as Octave's do, of element k of one whose last does, as C's.
inline octave_idx_type turned(octave_idx_type k, const dim_vector &dims, int rank) {
  octave_idx_type at = 0, step = dims.numel();
  for (int j = rank - 1; j >= 0; --j) {
    step /= dims(j);
    at += k % dims(j) * step;
    k /= dims(j);
  }
  return at;
}

template <class T>
struct In {
  std::vector<T> c;
  In(const Given &given, const octave_value &value, const char *name, std::vector<const char *> extents, bool index) {
    if (!value.is_defined() || value.isempty()) return;
    if (!is_numbers(value)) refuse(std::string(name) + " must be an array of numbers");
    const NDArray x = value.array_value();
    const int rank = static_cast<int>(extents.size());
    bool shaped = rank > 1 && x.ndims() == rank;
    for (int j = 0; shaped && j < rank; ++j) {
      const double wanted = given.extent(extents[j]);
      shaped = wanted < 0 || wanted == static_cast<double>(x.dims()(j));
    }
    if (!shaped && !x.dims().isvector()) refuse(std::string(name) + " cannot have the size " + x.dims().str());
    c.resize(static_cast<size_t>(x.numel()));
    for (octave_idx_type k = 0; k < x.numel(); ++k) {
      const double v = x(shaped ? turned(k, x.dims(), rank) : k);
      c[static_cast<size_t>(k)] = (std::is_integral<T>::value ? whole<T>(v, name) : static_cast<T>(v)) - static_cast<T>(index);
    }
  }
  const T *data() const { return c.empty() ? nullptr : c.data(); }
  size_t size() const { return c.size(); }
};

struct Fill {
  std::vector<std::string> extents;
  bool index;
  dim_vector dims;
  int rank = 1;
  Fill(std::vector<const char *> e, bool i) : extents(e.begin(), e.end()), index(i) {}
  virtual ~Fill() = default;
  virtual void resize(size_t size) = 0;
};

template <class T>
struct Out : Fill {
  std::vector<T> c;
  using Fill::Fill;
  void resize(size_t size) override { c.assign(size, std::is_integral<T>::value ? T(-1) : T(NAN)); }
  T *data() { return c.empty() ? nullptr : c.data(); }
  size_t size() const { return c.size(); }
  octave_value value() const {
    NDArray made(dims);
    for (octave_idx_type k = 0; k < made.numel(); ++k)
      made(turned(k, dims, rank)) = static_cast<double>(c[static_cast<size_t>(k)]) + (index && c[static_cast<size_t>(k)] >= 0);
    return made;
  }
  octave_value text() const { return std::string(c.begin(), c.begin() + std::max<std::ptrdiff_t>(0, static_cast<std::ptrdiff_t>(c.size()) - 1)); }
  // A table: a struct with a column of each name.
  octave_value table(const std::vector<const char *> &names) const {
    octave_scalar_map made;
    for (size_t j = 0; j < names.size(); ++j) {
      ColumnVector column(dims(0));
      for (octave_idx_type k = 0; k < dims(0); ++k) column(k) = static_cast<double>(c[static_cast<size_t>(k) * names.size() + j]);
      made.assign(names[j], column);
    }
    return made;
  }
};

template <class F>
void Given::fill(bool changes, F f, const size_t &counted, bool rows, std::vector<Fill *> arrays) {
  status_ = f();
  if (status_ < 0) error_with_id(("jam:" + status()).c_str(), "%s", jam_last_error());
  const double m = static_cast<double>(counted);
  for (Fill *a : arrays) {
    std::vector<double> sizes;
    double others = 1;
    for (const std::string &e : a->extents) {
      sizes.push_back(extent(e));
      if (sizes.back() >= 0) others *= sizes.back();
    }
    const double given = rows ? m : arrays.size() == 1 ? (others > 0 ? m / others : 0) : m / std::max(1.0, extent("n"));
    a->rank = static_cast<int>(sizes.size());
    a->dims = dim_vector::alloc(std::max(2, a->rank));
    a->dims(1) = 1;
    for (size_t j = 0; j < sizes.size(); ++j) a->dims(static_cast<int>(j)) = static_cast<octave_idx_type>(sizes[j] < 0 ? given : sizes[j]);
    a->resize(static_cast<size_t>(a->dims.numel()));
  }
  run(changes, f);
}

// Members of a struct of options that were given, on top of its defaults; of one struct inside where `apart` names it.
template <class T>
struct Options {
  T c;
  Options(Given &given, const Member *members, jam_status (*init)(T *, size_t), const std::string &apart = "") {
    init(&c, sizeof c);
    octave_value inner = apart.empty() ? octave_value() : given.take(apart);
    if (!apart.empty() && !inner.is_defined()) return;
    const octave_scalar_map map = inner.is_defined() ? inner.scalar_map_value() : octave_scalar_map();
    for (; members->name; ++members) {
      const octave_value value = apart.empty() ? given.take(members->name)
                                 : map.isfield(members->name) ? map.contents(members->name) : octave_value();
      if (value.is_defined()) write(&c, *members, value);
    }
  }
};

template <class T>
std::string text_of(const T &) { return ""; }
inline std::string text_of(const jam_check_report &r) { return jam_check_text(&r); }
inline std::string text_of(const jam_proof_report &r) {
  return jam_proof_text(r.theorem, r.cause, r.theorem == JAM_THEOREM_TRAPPED ? r.inner : r.radius, r.cause_value, r.cause_bound);
}

}  // namespace jam_octave
