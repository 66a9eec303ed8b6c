// The page to look at: one HTML file with the packing in it. Its text and scripts are in io/page.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "core/packing.hpp"
#include "network/contact_network.hpp"

namespace jam {

// The page before and behind the data; made by io/page/embed.cmake.
extern const char *const page_head;
extern const char *const page_tail;

struct PageContent {
  const Packing &packing;
  const ContactNetwork *network = nullptr;    // NULL before a crunch, like the report
  const jam_crunch_report *report = nullptr;  // its numbers are shown as the certificate
  std::string stop_reason{};
  std::vector<double> gaps{};     // of pairs that are no contacts, ascending
  std::vector<double> history{};  // relative growth of the diameters in each step of the crunch
  std::string title{};
  bool small = false;                                             // the picture alone
  std::vector<std::pair<std::string, const double *>> columns{};  // name and n values that spheres can be coloured by
};

void write_page(const PageContent &content, const char *path);

}  // namespace jam
