// Header section "molecular dynamics": what is recorded while it runs.
#include <memory>

#include "capi/table.hpp"

using namespace jam::inside;

namespace {

template <class F>
jam_status with_observer(const jam_system *sys, F &&f) noexcept {
  return guard_const(sys, [&]() -> jam_status {
    if (!sys->observer) fail(JAM_E_STATE, "nothing was observed: call jam_observe first");
    return f(*sys->observer);
  });
}

}  // namespace

extern "C" {

jam_status jam_observe_options_init(jam_observe_options *o, size_t size) {
  return init_options(o, size, default_observe_options());
}

jam_status jam_observe(jam_system *sys, const jam_observe_options *o) {
  return guard_set(sys, [&]() -> jam_status {
    jam_observe_options full = default_observe_options();
    take_options(o, full);
    check_observe_options(full);
    sys->observer = std::make_unique<Observer>(sys->packing, full);
    sys->observing = true;
    return JAM_OK;
  });
}

jam_status jam_stop_observing(jam_system *sys) {
  return guard_set(sys, [&]() -> jam_status {
    sys->observing = false;
    return JAM_OK;
  });
}

jam_status jam_observed_series(const jam_system *sys, int32_t columns, double *table, size_t table_len,
                               size_t *needed) {
  return with_observer(sys, [&](const Observer &o) -> jam_status {
    const Table<JAM_SERIES_COLUMNS> made(columns, table, table_len);
    if (!made.wanted(o.samples().size(), needed)) return JAM_OK;
    made.give(o.samples().size(), [&](size_t k, auto &row) {
      const Sample &s = o.samples()[k];
      row[JAM_SERIES_TIME] = s.time;
      row[JAM_SERIES_COLLISIONS] = s.collisions;
      row[JAM_SERIES_FRACTION] = s.packing_fraction;
      row[JAM_SERIES_PRESSURE] = s.pressure;
      row[JAM_SERIES_ERROR] = s.error;
      row[JAM_SERIES_MSD] = s.displacement2;
    });
    return JAM_OK;
  });
}

jam_status jam_observed_stress(const jam_system *sys, double *out, size_t out_len, size_t *needed) {
  return with_observer(sys, [&](const Observer &o) -> jam_status {
    const std::vector<double> stress = o.reduced_stress();
    return give_array(stress.data(), stress.size(), out, out_len, needed);
  });
}

jam_status jam_observed_spheres(const jam_system *sys, int64_t *collisions, size_t collisions_len, double *displacement,
                                size_t displacement_len, size_t *needed) {
  return with_observer(sys, [&](const Observer &o) -> jam_status {
    if (collisions && o.collisions().empty())
      fail(JAM_E_STATE, "collisions were not observed: set jam_observe_options.collisions");
    outputs_wanted(sys->packing.n(), needed,
                   {{collisions, collisions_len, o.collisions().size(), "collisions"},
                    {displacement, displacement_len, o.travelled().size(), "displacement"}});
    put_output(o.collisions(), collisions, o.collisions().size());
    std::vector<double> way = o.travelled();
    for (double &x : way) x *= sys->packing.cell.side();
    put_output(way, displacement, way.size());
    return JAM_OK;
  });
}

jam_status jam_observed_pairs(const jam_system *sys, int32_t *pair, size_t pair_len, int64_t *collisions,
                              size_t collisions_len, double *momentum, size_t momentum_len, double *time,
                              size_t *needed) {
  return with_observer(sys, [&](const Observer &o) -> jam_status {
    if (o.collisions().empty()) fail(JAM_E_STATE, "collisions were not observed: set jam_observe_options.collisions");
    const std::vector<PairSums::Slot> slots = o.pairs().sorted();
    outputs_wanted(slots.size(), needed,
                   {{pair, pair_len, 2 * slots.size(), "pair"},
                    {collisions, collisions_len, slots.size(), "collisions"},
                    {momentum, momentum_len, slots.size(), "momentum"}},
                   time);
    for (size_t k = 0; k < slots.size(); ++k) {
      if (pair)
        pair[2 * k] = static_cast<int32_t>(slots[k].key >> 32),
                 pair[2 * k + 1] = static_cast<int32_t>(slots[k].key & 0xffffffffu);
      if (collisions) collisions[k] = slots[k].collisions;
      if (momentum) momentum[k] = slots[k].momentum;
    }
    if (time) *time = o.time;
    return JAM_OK;
  });
}

jam_status jam_observed_gaps(const jam_system *sys, int32_t columns, double *table, size_t table_len, size_t *needed) {
  return with_observer(sys, [&](const Observer &o) -> jam_status {
    const Table<JAM_GAP_COLUMNS> made(columns, table, table_len);
    const Histogram &h = o.gaps();
    if (!made.wanted(h.bins(), needed)) return JAM_OK;
    made.give(h.bins(), [&](size_t k, auto &row) {
      row[JAM_GAP_LOW] = h.edge[k];
      row[JAM_GAP_HIGH] = h.edge[k + 1];
      row[JAM_GAP_DENSITY] = h.mean(k);
      row[JAM_GAP_ERROR] = h.error(k);
    });
    return JAM_OK;
  });
}

jam_status jam_observed_correlation(const jam_system *sys, int32_t columns, double *table, size_t table_len,
                                    size_t *needed) {
  return with_observer(sys, [&](const Observer &o) -> jam_status {
    const Table<JAM_CORRELATION_COLUMNS> made(columns, table, table_len);
    const Histogram &h = o.correlation();
    if (!made.wanted(h.bins(), needed)) return JAM_OK;
    made.give(h.bins(), [&](size_t k, auto &row) {
      row[JAM_CORRELATION_R] = 0.5 * (h.edge[k] + h.edge[k + 1]);
      row[JAM_CORRELATION_G] = h.mean(k);
    });
    return JAM_OK;
  });
}

}  // extern "C"
