// Isoconfigurational ensemble: checks, results, what resumes.
#include "dynamics/isoconfigurational/isoconfigurational.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/call_scope.hpp"
#include "core/limits.hpp"
#include "core/rng.hpp"
#include "dynamics/tuning.hpp"

namespace jam::inside {

namespace {

uint64_t mark_of(const Packing &p) {
  uint64_t mark = mix64(p.n() ^ static_cast<uint64_t>(p.seed));
  for (const std::vector<double> *list : {&p.position, &p.diameter})
    for (const double x : *list) {
      uint64_t bits;
      std::memcpy(&bits, &x, sizeof bits);
      mark = mix64(mark ^ bits);
    }
  return mark;
}

}  // namespace

Isoconfigurational::Isoconfigurational(const Packing &p, bool jammed, const jam_isoconf_options &o,
                                       const jam_monte_carlo_options *mc, std::vector<double> instants,
                                       std::vector<int32_t> kept)
    : packing_(p), mark_(mark_of(p)), kept_instants_(std::move(kept)) {
  plan_.start = p;
  plan_.options = o;
  plan_.instants = std::move(instants);
  if (plan_.instants.empty()) fail(JAM_E_ARGUMENT, "there are no instants");
  for (size_t m = 0; m < plan_.instants.size(); ++m) {
    const double before = m ? plan_.instants[m - 1] : 0.0;
    if (!(plan_.instants[m] > before) || std::isinf(plan_.instants[m]))
      fail(JAM_E_ARGUMENT, "instants must be positive and ascending: instant[%zu] is %g after %g", m, plan_.instants[m],
           before);
  }
  for (const int32_t m : kept_instants_)
    if (m < 0 || static_cast<size_t>(m) >= plan_.instants.size() ||
        std::count(kept_instants_.begin(), kept_instants_.end(), m) > 1)
      fail(JAM_E_ARGUMENT, "kept instant %d is none of the %zu instants, or there twice", m, plan_.instants.size());
  take_diameters();
  check_memory();
  if (!mc || mc->alpha == 0.0) check_resolution(jammed);
  if (mc) {
    plan_.metropolis = true;
    plan_.monte_carlo = *mc;
    check_monte_carlo(plan_.start, plan_.monte_carlo);
  }
  kept_.resize(kept_instants_.size());
  report_.struct_size = sizeof report_;
  report_.first_run = o.first_run;
  report_.instants = static_cast<int64_t>(plan_.instants.size());
  report_.step = plan_.metropolis ? plan_.monte_carlo.step : 0.0;
}

void Isoconfigurational::take_diameters() {
  if (plan_.options.density_ratio != 1.0) {
    const double factor = math::pow(plan_.options.density_ratio, 1.0 / plan_.start.dim);
    for (double &s : plan_.start.diameter) s *= factor;
    try {
      check_diameters(plan_.start.diameter, plan_.start.cell);
    } catch (const Error &e) {
      fail(e.code(), "density_ratio is %g: %s", plan_.options.density_ratio, e.what());
    }
  }
  plan_.length = diameter_mean(plan_.start) / plan_.start.cell.side();
  plan_.fraction = packing_fraction(plan_.start);
}

// What all requested runs will take; reported before anything is run.
void Isoconfigurational::check_memory() const {
  const double spheres = static_cast<double>(n()), d = static_cast<double>(dim()),
               m = static_cast<double>(plan_.instants.size());
  const jam_isoconf_options &o = plan_.options;
  const double blocks = static_cast<double>((o.first_run + o.runs - 1) / o.block - o.first_run / o.block + 1);
  const double sums = 8.0 * m * spheres * (2.0 * d + 2.0) * (blocks + 1.0);
  const double sets = 8.0 * spheres * d * static_cast<double>(o.runs) * static_cast<double>(kept_instants_.size());
  const double records = 8.0 * m * spheres * d * static_cast<double>(o.threads > 1 ? EnsembleTuning::runs_ahead : 1);
  const double limit = std::min(o.memory_limit, CallScope::memory_limit());
  if (sums + sets + records > limit)
    fail(JAM_E_MEMORY, "%s are needed (sums of %g blocks %s, displacement sets %s), memory_limit is %s",
         bytes_text(sums + sets + records).c_str(), blocks, bytes_text(sums).c_str(), bytes_text(sets).c_str(),
         bytes_text(limit).c_str());
}

// Positions are doubles, so a contact is closed to a few 1e-16 of the box. Gaps opened by less than some hundred times
// that would be rounding.
void Isoconfigurational::check_resolution(bool jammed) const {
  const double ratio = plan_.options.density_ratio;
  const double smallest = *std::min_element(plan_.start.diameter.begin(), plan_.start.diameter.end());
  const double rounding = 4.0 * std::numeric_limits<double>::epsilon() * plan_.start.cell.side() / smallest;
  const double opened = (1.0 - ratio) / static_cast<double>(dim()), least = EnsembleTuning::roundings_of_gap * rounding;
  if ((jammed || ratio < 1.0) && opened < least)
    fail(JAM_E_ARGUMENT,
         "density_ratio is %.17g, which opens contacts by %.2g of a diameter: positions are rounded to %.1g of it, so "
         "give "
         "at most 1 - %.2g",
         ratio, opened, rounding, least * static_cast<double>(dim()));
}

void Isoconfigurational::continue_with(const Packing &p, const jam_isoconf_options &o,
                                       const jam_monte_carlo_options *mc, const std::vector<double> &instants,
                                       const std::vector<int32_t> &kept) {
  const jam_isoconf_options &mine = plan_.options;
  const jam_monte_carlo_options &own = plan_.monte_carlo;
  const bool same_dynamics =
      (mc != nullptr) == plan_.metropolis &&
      (!mc || (mc->alpha == own.alpha && mc->energy_scale == own.energy_scale && mc->energy_unit == own.energy_unit &&
               mc->temperature == own.temperature && (mc->step == own.step || mc->step == 0.0) &&
               mc->acceptance == own.acceptance && mc->swap_share == own.swap_share));
  // A checkpoint of an earlier version may lack the packing that its runs began from.
  if (mark_of(p) != mark_ || mark_of(packing_) != mark_ || p.cell.rows() != packing_.cell.rows())
    fail(JAM_E_STATE, "resume is 1 but the packing is not the one that the runs began from");
  if (instants != plan_.instants || kept != kept_instants_ || o.clock != mine.clock || o.first_run != mine.first_run ||
      o.block != mine.block || o.density_ratio != mine.density_ratio || o.temperature != mine.temperature ||
      o.wave_number != mine.wave_number || o.overlap_length != mine.overlap_length || !same_dynamics)
    fail(JAM_E_STATE, "resume is 1 but instants or options are not those that the runs began with");
  const jam_isoconf_options before = plan_.options;
  plan_.options.runs = o.runs;
  plan_.options.threads = o.threads;
  plan_.options.memory_limit = o.memory_limit;
  try {
    check_memory();
  } catch (...) {
    plan_.options = before;
    throw;
  }
}

// ---- results, archive

RunSums Isoconfigurational::sums(int64_t block) const {
  if (block < -1 || block >= static_cast<int64_t>(blocks_.size()))
    fail(JAM_E_ARGUMENT, "block is %lld, there are %zu; -1 is all of them", static_cast<long long>(block),
         blocks_.size());
  if (block >= 0) return blocks_[static_cast<size_t>(block)];
  RunSums all;
  all.start(plan_.instants.size(), n(), dim());
  for (const RunSums &one : blocks_) all.add(one);
  return all;
}

const std::vector<double> &Isoconfigurational::kept(int32_t m) const {
  for (size_t k = 0; k < kept_.size(); ++k)
    if (kept_instants_[k] == m) return kept_[k];
  fail(JAM_E_STATE, "displacements of instant %d were not kept", m);
}

Isoconfigurational::Isoconfigurational(const Packing &p, Archive &from) : packing_(p) {
  plan_.start = p;
  archive(from);
}

void Isoconfigurational::archive(Archive &a) {
  a(plan_.options);
  a(plan_.monte_carlo);
  a(plan_.metropolis);
  a(plan_.instants);
  a(mark_);
  a(kept_instants_);
  a(report_);
  uint64_t blocks = blocks_.size(), sets = kept_.size();
  a(blocks);
  a(sets);
  if (a.reading()) {
    Archive::check(sets == kept_instants_.size());
    check_isoconf_options(plan_.options);
    if (plan_.metropolis) {
      check_monte_carlo_options(plan_.monte_carlo);
      check_monte_carlo(plan_.start, plan_.monte_carlo);
      Archive::check(plan_.monte_carlo.step > 0.0 || report_.runs == 0);
    }
    Archive::check(!plan_.instants.empty() && plan_.instants[0] > 0.0 &&
                   std::is_sorted(plan_.instants.begin(), plan_.instants.end()));
    for (const int32_t m : kept_instants_) Archive::check(m >= 0 && static_cast<size_t>(m) < plan_.instants.size());
    kept_.resize(sets);
    take_diameters();
  }
  for (uint64_t k = 0; k < blocks; ++k) {
    if (a.reading()) blocks_.emplace_back();  // one by one: a file with too large a count ends first
    blocks_[k].archive(a);
  }
  for (std::vector<double> &set : kept_) a(set);
  if (plan_.metropolis && plan_.monte_carlo.step == 0.0) tuner_.archive(a, plan_.start, plan_.monte_carlo);
  if (!a.reading()) return;
  const size_t spheres = plan_.instants.size() * n();
  int64_t runs = 0;
  for (const RunSums &block : blocks_) {
    Archive::check(block.distance2.size() == spheres && block.distance4.size() == spheres &&
                   block.displacement.size() == spheres * dim() && block.square.size() == spheres * dim() &&
                   block.series.size() == plan_.instants.size() * isoconf_columns && block.runs > 0);
    runs += block.runs;
  }
  Archive::check(runs == report_.runs);
  for (const std::vector<double> &set : kept_)
    Archive::check(set.size() == static_cast<size_t>(report_.runs) * n() * dim());
}

}  // namespace jam::inside
