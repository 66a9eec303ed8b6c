// Header section "sizes".
#include "capi/guard.hpp"
#include "core/size_laws.hpp"
#include "io/files.hpp"

using namespace jam::inside;

extern "C" {

jam_status jam_diameters_options_init(jam_diameters_options *o, size_t size) {
  return init_options(o, size, default_diameters_options());
}

jam_status jam_diameters(const jam_diameters_options *o, const double *curve, size_t curve_len, double *out,
                         size_t out_len, size_t *needed) {
  return guard([&]() -> jam_status {
    jam_diameters_options full = default_diameters_options();
    take_options(o, full);
    if (curve_len && !curve) fail(JAM_E_NULL, "curve is NULL but its length is %zu", curve_len);
    const std::vector<double> s = draw_diameters(full, curve, curve_len);
    return give_array(s.data(), s.size(), out, out_len, needed);
  });
}

jam_status jam_parse_diameters(const char *text, jam_diameters_options *o, double *curve, size_t curve_len,
                               size_t *needed) {
  return guard([&]() -> jam_status {
    need(text, "text");
    need(o, "o");
    jam_diameters_options full = default_diameters_options();
    take_options(o, full);
    std::vector<double> rows;
    for (const std::string &file : parse_size_law(text, full, rows)) read_curve(file.c_str(), rows);
    give_struct(full, o);
    return give_array(rows.data(), rows.size(), curve, curve_len, needed);
  });
}

jam_status jam_get_size_report(int32_t dim, const double *diameters, size_t diameters_len, jam_size_report *report) {
  return guard([&]() -> jam_status {
    need(report, "report");
    check_out_struct(report, "report");
    if (diameters_len && !diameters) fail(JAM_E_NULL, "diameters is NULL but its length is %zu", diameters_len);
    give_struct(size_report(dim, std::vector<double>(diameters, diameters + diameters_len)), report);
    return JAM_OK;
  });
}

}  // extern "C"
