// What a caller says of a file that does not say it: the text of jam_read_as, and its use.
#include "core/checks.hpp"
#include "core/decimal.hpp"
#include "core/error.hpp"
#include "io/read_helpers.hpp"

namespace jam::inside {
namespace {

std::vector<std::string> parts_of(std::string_view list) {
  std::vector<std::string> parts;
  for (size_t k = 0; k <= list.size();) {
    const size_t stop = std::min(list.find(',', k), list.size());
    parts.emplace_back(list.substr(k, stop - k));
    k = stop + 1;
  }
  return parts;
}

std::vector<double> numbers_of(std::string_view name, std::string_view list) {
  std::vector<double> numbers;
  for (const std::string &part : parts_of(list)) {
    double x = 0.0;
    const auto [end, code] = from_decimal(part, x);
    if (part.empty() || code != std::errc() || end != part.data() + part.size() || !std::isfinite(x))
      fail(JAM_E_ARGUMENT, "%s is '%s', it must be finite numbers parted by commas", std::string(name).c_str(),
           shown(list).c_str());
    numbers.push_back(x);
  }
  return numbers;
}

}  // namespace

Layout layout_of(const std::string &text) {
  Layout layout;
  std::vector<std::string_view> words;
  split(text, words);
  for (const std::string_view word : words) {
    const size_t equals = std::min(word.find('='), word.size());
    const std::string_view name = word.substr(0, equals), value = word.substr(std::min(equals + 1, word.size()));
    if (name == "cell" && layout.cell.empty())
      layout.cell = numbers_of(name, value);
    else if (name == "origin" && layout.origin.empty())
      layout.origin = numbers_of(name, value);
    else if (name == "columns" && layout.columns.empty())
      layout.columns = parts_of(value);
    else
      fail(JAM_E_ARGUMENT, "layout: '%s' is none of cell=, origin= and columns=, or there twice", shown(word).c_str());
  }
  return layout;
}

void take_layout(const char *path, const ReadOptions &options, FileContent &content) {
  const Layout &layout = options.layout;
  const size_t d = static_cast<size_t>(content.dim);
  if (!layout.cell.empty()) {
    if (content.has_box()) fail(JAM_E_ARGUMENT, "%s gives its cell: leave the option out, cell or box", path);
    if (options.box != 1.0) fail(JAM_E_ARGUMENT, "the options box and cell both give the cell: leave one out");
    if (layout.cell.size() != d && layout.cell.size() != d * d)
      fail(JAM_E_ARGUMENT, "cell has %zu numbers, in d = %zu it needs %zu sides or %zu components of vectors",
           layout.cell.size(), d, d, d * d);
    std::vector<double> rows(d * d, 0.0);
    for (size_t k = 0; k < layout.cell.size(); ++k) rows[layout.cell.size() == d ? k * (d + 1) : k] = layout.cell[k];
    take_rows(std::move(rows), content);
  }
  if (layout.origin.empty()) return;
  if (content.knows_origin)
    fail(JAM_E_ARGUMENT, "%s says where the corner of its cell is: leave the option origin out", path);
  if (layout.origin.size() != d)
    fail(JAM_E_ARGUMENT, "origin has %zu numbers, in d = %zu it needs %zu", layout.origin.size(), d, d);
  measure_from_corner(layout.origin.data(), content);
}

}  // namespace jam::inside
