// The page to view: one HTML file with the packing in it. Its text and scripts are in io/page.
#pragma once
#include <string>

#include "network/contact_network.hpp"

namespace jam::inside {

// The page before and behind the data; made by io/page/embed.cmake.
extern const char *const page_head;
extern const char *const page_tail;

// A state on the way to the packing.
struct PageStep {
  int64_t number = 0;  // of the step that led here; 0: the start
  const char *kind = "";
  double packing_fraction = 0.0;
  std::vector<std::pair<const char *, double>> numbers{};  // what is shown of the step
  // Of the last step they are those of the packing.
  double growth = 1.0;  // diameters over those of the packing
  const Cell *cell = nullptr;
  const std::vector<float> *position = nullptr;  // (n, dim)
};

struct PageContent {
  const Packing &packing;
  const ContactNetwork *network = nullptr;    // NULL before a crunch, like the report
  bool by_distance = false;                   // its contacts have no forces, and there is no report
  std::string text_of_network{};              // shown in place of the certificate where there is no report
  const jam_crunch_report *report = nullptr;  // its numbers are shown as the certificate
  bool crunched = false;                      // the report is of a crunch
  std::vector<double> stress{};               // (dim, dim), of its forces
  std::string stop_reason{};
  std::string proof{};            // what was proved; empty where nothing was requested
  std::vector<double> gaps{};     // of pairs that are no contacts, ascending
  std::vector<double> history{};  // relative growth of the diameters in each step of the crunch
  std::vector<PageStep> steps{};  // the slider: the last one is the packing itself; empty: no slider
  std::string title{};
  bool small = false;                                             // the picture alone
  std::vector<std::pair<std::string, const double *>> columns{};  // name and n values that spheres can be coloured by
  std::vector<std::pair<std::string, const double *>> motions{};  // name and displacements: d rows of n numbers
};

[[gnu::cold]] void write_page(const PageContent &content, const char *path);

}  // namespace jam::inside
