// Named laws of diameters: checked options to a distribution, diameters drawn from it, and what a set of diameters is.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "core/size_distribution.hpp"
#include "jam/jam.h"

namespace jam::inside {

jam_diameters_options default_diameters_options();
// Checks the fields of the law and its curve; curve: (rows, 2). Errors are JAM_E_ARGUMENT and name the field or the
// row.
std::unique_ptr<SizeDistribution> size_distribution(const jam_diameters_options &o, const double *curve,
                                                    size_t curve_len);
// By name; JAM_E_ARGUMENT lists all names where there is none.
int32_t size_law_number(const char *name);
// The number that is called so, or NULL.
double *size_field(jam_diameters_options &o, const char *name);
std::string size_field_names();
// A law from text (core/size_parse.cpp): fields go into o, rows into curve. Returns the files that hold more rows.
std::vector<std::string> parse_size_law(const char *text, jam_diameters_options &o, std::vector<double> &curve);

// Checks all options, then draws (core/size_draw.cpp).
std::vector<double> draw_diameters(const jam_diameters_options &o, const double *curve, size_t curve_len);

// What diameters are (core/size_report.cpp).
jam_size_report size_report(int dim, const std::vector<double> &diameters);
// Packing fraction where random sequential addition of equal spheres ends.
double sequential_fraction(int dim);
struct Reach {
  double fraction;
  int32_t source;  // jam_reach_source
};
// Estimate of the packing fraction at which these sizes jam in disorder.
Reach jammed_reach(int dim, const std::vector<double> &diameters);
// Throws JAM_E_UNPLACEABLE where `wanted` lies beyond the reach of a disordered packing of these sizes.
void check_reach(int dim, const std::vector<double> &diameters, double wanted);

}  // namespace jam::inside
