#include <algorithm>

#include "core/decimal.hpp"
#include "io/formats.hpp"
#include "io/read_helpers.hpp"

namespace jam::inside {
namespace {

// What a caller says of a file that does not say it: the text of jam_read_as, and its use.

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

// Counts the spheres outside the smallest brick that holds the cell and its normal form: they will be wrapped.
void note_wrapped(FileContent &content, double box) {
  const size_t d = static_cast<size_t>(content.dim);
  std::vector<double> low(d, 0.0), high(d, content.box > 0.0 ? content.box : box);
  if (!content.cell.empty())
    for (size_t c = 0; c < d; ++c) {
      high[c] = 0.0;
      for (size_t r = 0; r < d; ++r) (content.cell[r * d + c] < 0.0 ? low : high)[c] += content.cell[r * d + c];
    }
  int64_t outside = 0;
  for (size_t i = 0; i < content.position.size(); i += d) {
    bool inside = true;
    for (size_t c = 0; c < d; ++c)
      inside = inside && content.position[i + c] >= low[c] && content.position[i + c] <= high[c];
    outside += !inside;
  }
  if (outside > 0)
    content.notes.say("%lld of %lld spheres lay outside the cell and were wrapped into it",
                      static_cast<long long>(outside), static_cast<long long>(content.position.size() / d));
}

// A file that does not name its walls has those of the caller. If neither names walls, the packing is taken as
// periodic, and a note says so.
void assign_walls(const char *path, const Enclosure &given, FileContent &content) {
  if (!content.knows_walls) {
    content.enclosure = given;
    if (!given.any())
      content.notes.say(
          "the file does not say which directions are periodic: all are taken as periodic; the options walls and "
          "container name walls");
  } else if (given.any() && !(given == content.enclosure)) {
    fail(JAM_E_ARGUMENT, "%s: the options container and walls close other axes than the file: leave them out", path);
  }
}

}  // namespace

GivenDigits FileContent::given() const {
  std::vector<double> x(position);
  for (size_t k = 0; k < x.size() && !origin.empty(); ++k) x[k] += origin[k % origin.size()];
  return digits_of(dim, x, diameter, cell);
}

FileContent read_file(const char *path, const ReadOptions &options) {
  LineReader in(path);
  const char *const shown_as = in.path().c_str();
  if (in.head().find_first_not_of(" \t\r\n") == std::string_view::npos) fail(JAM_E_FORMAT, "%s is empty", shown_as);
  const std::string ending = file_ending(path);
  const Head head(in.head(), ending);
  const KnownFile *const known = recognise(head);
  if (!known) {
    const std::string_view line = head.lines[std::min(head.first, head.lines.size() - 1)];
    fail(JAM_E_FORMAT,
         "%s line %zu: '%s' begins no file that is read: plain text, extended XYZ, data and dumps of LAMMPS, tables of "
         "columns x y z radius, data of MercuryDPM; jam.files.read_ase of Python reads more",
         shown_as, head.first + 1, shown(line).c_str());
  }
  if (known->way_out) fail(JAM_E_FORMAT, "%s is %s: %s", shown_as, known->name, known->way_out);
  const Format &format = format_of_name(known->name);
  if (!format.frames && options.frame != -1 && options.frame != 0)
    fail(JAM_E_ARGUMENT, "%s: frame is %lld, but %s contains one packing", shown_as,
         static_cast<long long>(options.frame), known->name);
  FileContent content = format.read(in, options);
  if (!options.layout.columns.empty() && format.read != read_table)
    fail(JAM_E_ARGUMENT, "%s is %s: the option columns is for tables", shown_as, format.name);
  take_layout(shown_as, options, content);
  assign_walls(shown_as, options.enclosure, content);
  note_wrapped(content, options.box);
  return content;
}

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
