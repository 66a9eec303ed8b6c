#include "io/page.hpp"

#include <cmath>
#include <cstring>
#include <limits>

#include "core/byte_order.hpp"
#include "core/error.hpp"
#include "io/output_file.hpp"
#include "io/text.hpp"

namespace jam::inside {
namespace {

// A string of JSON inside a script element: nothing in it can end the element. Bytes that are not UTF-8, as names of
// files may have them, show as \xff.
void put_string(std::string &out, const std::string &text) {
  out += '"';
  for (size_t k = 0, length = 0; k < text.size(); k += length) {
    const char c = text[k];
    length = character_length(std::string_view(text).substr(k));
    if (length == 0) {
      char code[8];
      std::snprintf(code, sizeof code, "\\\\x%02x", static_cast<unsigned>(static_cast<unsigned char>(c)));
      out += code;
      length = 1;
    } else if (length > 1) {
      out.append(text, k, length);
    } else if (c == '"' || c == '\\')
      (out += '\\') += c;
    else if (static_cast<unsigned char>(c) < ' ' || c == '<') {
      char code[8];
      std::snprintf(code, sizeof code, "\\u%04x", static_cast<unsigned>(c));
      out += code;
    } else {
      out += c;
    }
  }
  out += '"';
}

// JSON has no NaN and no infinity.
void put_number(std::string &out, double x) {
  if (std::isfinite(x))
    append_number(out, x);
  else
    out += "null";
}

// Numbers as base64 of their bytes, which a page decodes faster than digits.
template <class T>
void put_numbers(OutputFile &file, const T *values, size_t count) {
  static const char digit[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const unsigned char *bytes = reinterpret_cast<const unsigned char *>(values);
  const size_t size = count * sizeof(T);
  std::string &out = file.text();
  out += '"';
  for (size_t k = 0; k < size; k += 3) {
    const size_t have = size - k < 3 ? size - k : 3;
    unsigned word = 0;
    for (size_t b = 0; b < 3; ++b) word = word << 8 | (b < have ? bytes[byte_in_memory<T>(k + b)] : 0u);
    for (size_t b = 0; b < 4; ++b) out += b <= have ? digit[word >> (18 - 6 * b) & 63u] : '=';
    file.flush_if_full();
  }
  out += '"';
}
template <class T, class From>
void put_as(OutputFile &file, const std::vector<From> &values) {
  const std::vector<T> as(values.begin(), values.end());
  put_numbers(file, as.data(), as.size());
}

void put_network(OutputFile &file, const ContactNetwork &net, bool by_distance) {
  std::vector<int32_t> pair;
  for (size_t k = 0; k < net.size(); ++k) {
    pair.push_back(net.pairs.i[k]);
    pair.push_back(net.pairs.j[k]);
  }
  file.text() += ",\n\"contacts\": {\"pair\": ";
  put_numbers(file, pair.data(), pair.size());
  file.text() += ", \"vector\": ";
  put_as<float>(file, net.vector);
  file.text() += ", \"gap\": ";
  put_as<float>(file, net.gap);
  if (!by_distance) {
    file.text() += ", \"force\": ";
    put_as<float>(file, net.force);
  }
  file.text() += "}";
}

void put_named(std::string &out, const std::vector<std::pair<const char *, double>> &rows) {
  out += "{";
  for (const auto &[name, value] : rows) {
    if (out.back() != '{') out += ", ";
    put_string(out, name);
    out += ": ";
    put_number(out, value);
  }
  out += "}";
}

// |S / P - 1| of a stress S (dim, dim) with the mean normal stress P.
double deviator(const std::vector<double> &stress, size_t dim) {
  double pressure = 0.0, sum = stress.empty() ? std::numeric_limits<double>::quiet_NaN() : 0.0;
  for (size_t c = 0; c < stress.size(); c += dim + 1) pressure += stress[c] / static_cast<double>(dim);
  for (size_t k = 0; k < stress.size(); ++k) {
    const double x = stress[k] / pressure - (k % (dim + 1) == 0 ? 1.0 : 0.0);
    sum += x * x;
  }
  return std::sqrt(sum);
}

// Without a crunch rows of the way to the packing are left out.
void put_report(std::string &out, const PageContent &content) {
  const jam_crunch_report &r = *content.report;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto known = [&](int64_t count) { return r.rattlers < 0 ? nan : static_cast<double>(count); };
  std::vector<std::pair<const char *, double>> rows = {
      {"contacts", known(r.contacts)},
      {"contacts above isostatic", known(r.excess_contacts)},
      {"rattlers", known(r.rattlers)},
      {"bucklers", known(r.bucklers)},
      {"flexes", known(r.flexes)},
      {"largest overlap", r.max_overlap},
      {"force imbalance over mean force", r.force_residual},
      {"largest gap of a contact", r.max_contact_gap},
      {"smallest force", r.min_force},
      {"smallest gap of no contact", r.min_gap},
      {"rigidity margin", r.rigidity_margin},
      {"deviatoric stress over pressure", deviator(content.stress, static_cast<size_t>(content.packing.dim))},
  };
  const std::vector<std::pair<const char *, double>> way = {
      {"duality gap of the last LP", r.duality_gap},
      {"packing fraction before the crunch", r.packing_fraction_start},
      {"largest displacement in it (diameters)", r.displacement_max},
      {"rms displacement in it (diameters)", r.displacement_rms},
      {"largest of spheres with contacts (diameters)", r.displacement_max_stable},
      {"contacts before it", r.contacts_start < 0 ? nan : static_cast<double>(r.contacts_start)},
      {"of these kept", r.contacts_kept < 0 ? nan : static_cast<double>(r.contacts_kept)},
      {"seconds of the crunch", r.seconds},
  };
  if (content.crunched) rows.insert(rows.end(), way.begin(), way.end());
  out += ",\n\"report\": {\"jammed\": ";
  out += r.jammed ? "true" : "false";
  out += ", \"stop_reason\": ";
  put_string(out, content.stop_reason);
  out += ", \"proof\": ";
  put_string(out, content.proof);
  out += ", \"numbers\": ";
  put_named(out, rows);
  out += "}";
}

// How many gaps are at most as long as each of some, about evenly spaced on a logarithmic axis.
void put_gaps(std::string &out, const std::vector<double> &gaps) {
  constexpr double ratio = 1.05;
  out += ",\n\"gaps\": [";
  double last = 0.0;
  bool first = true;
  for (size_t k = 0; k < gaps.size(); ++k) {
    if (gaps[k] <= 0.0 || (gaps[k] < ratio * last && k + 1 < gaps.size())) continue;
    last = gaps[k];
    out += first ? "[" : ", [";
    first = false;
    append_number(out, gaps[k]);
    out += ", " + std::to_string(k + 1) + "]";
  }
  out += "]";
}

void put_cell(std::string &out, const Cell &cell) {
  out += "[";
  for (int row = 0; row < cell.dim(); ++row) {
    out += row ? ", [" : "[";
    for (int c = 0; c < cell.dim(); ++c) {
      if (c) out += ", ";
      append_number(out, cell.row(row)[c]);
    }
    out += "]";
  }
  out += "]";
}

// What encloses the spheres: its shape, the axes on which nothing repeats, and circles of a curved wall.
void put_container(std::string &out, const Packing &p) {
  out += std::string(",\n\"container\": \"") + p.container.word() + "\", \"closed\": [";
  for (int c = 0; c < p.dim; ++c) out += std::string(c ? ", " : "") + (p.cell.repeats(c) ? "false" : "true");
  out += "], \"rings\": [";
  bool first = true;
  for (const Container::Ring &ring : p.container.rings()) {
    out += std::string(first ? "" : ", ") + "{\"axes\": [" + std::to_string(ring.axes[0]) + ", " +
           std::to_string(ring.axes[1]) + "], \"centre\": [";
    for (int c = 0; c < p.dim; ++c) {
      if (c) out += ", ";
      append_number(out, ring.centre[static_cast<size_t>(c)]);
    }
    out += "], \"radius\": ";
    append_number(out, ring.radius);
    out += "}";
    first = false;
  }
  out += "]";
}

void put_steps(OutputFile &file, const std::vector<PageStep> &steps) {
  std::string &out = file.text();
  out += ",\n\"steps\": [";
  for (const PageStep &s : steps) {
    out += "{\"number\": " + std::to_string(s.number) + ", \"kind\": ";
    put_string(out, s.kind);
    out += ", \"packing_fraction\": ";
    put_number(out, s.packing_fraction);
    out += ", \"numbers\": ";
    put_named(out, s.numbers);
    if (s.position) {
      out += ", \"growth\": ";
      append_number(out, s.growth);
      out += ", \"cell\": ";
      put_cell(out, *s.cell);
      out += ", \"position\": ";
      put_numbers(file, s.position->data(), s.position->size());
    }
    out += &s == &steps.back() ? "}]" : "},\n";
  }
}

}  // namespace

void write_page(const PageContent &content, const char *path) {
  const Packing &p = content.packing;
  OutputFile file(path);
  std::string &out = file.text();
  out += page_head;
  out += "{\"title\": ";
  put_string(out, content.title);
  out += std::string(", \"small\": ") + (content.small ? "true" : "false");
  out += ", \"dim\": " + std::to_string(p.dim) + ", \"n\": " + std::to_string(p.n()) + ", \"seed\": \"" +
         std::to_string(p.seed) +  // as text: JavaScript rounds numbers above 2^53
         "\", \"non_additivity\": ";
  append_number(out, p.non_additivity);
  out += ", \"packing_fraction\": ";
  put_number(out, packing_fraction(p));
  out += ",\n\"cell\": ";
  put_cell(out, p.cell);
  put_container(out, p);
  out += std::string(", \"shifted\": ") + (p.model == JAM_MODEL_MK ? "true" : "false");
  out += ",\n\"position\": ";
  put_numbers(file, p.position.data(), p.position.size());
  out += ",\n\"diameter\": ";
  put_numbers(file, p.diameter.data(), p.diameter.size());
  out += ",\n\"network\": ";
  put_string(out, content.text_of_network);
  if (content.network) put_network(file, *content.network, content.by_distance);
  if (content.report) put_report(out, content);
  put_gaps(out, content.gaps);
  out += ",\n\"history\": [";
  for (size_t k = 0; k < content.history.size(); ++k) {
    if (k) out += ", ";
    put_number(out, content.history[k]);
  }
  out += "]";
  if (!content.steps.empty()) put_steps(file, content.steps);
  out += ",\n\"values\": [";
  for (size_t k = 0; k < content.columns.size(); ++k) {
    out += k ? ", {\"name\": " : "{\"name\": ";
    put_string(out, content.columns[k].first);
    out += ", \"values\": ";
    put_numbers(file, content.columns[k].second, p.n());
    out += "}";
  }
  out += "],\n\"motions\": [";
  for (size_t k = 0; k < content.motions.size(); ++k) {
    out += k ? ", {\"name\": " : "{\"name\": ";
    put_string(out, content.motions[k].first);
    out += ", \"rows\": ";
    const double *from = content.motions[k].second;
    put_as<float>(file, std::vector<double>(from, from + static_cast<size_t>(p.dim) * p.n()));
    out += "}";
  }
  out += "]}";
  out += page_tail;
  file.commit();
}

}  // namespace jam::inside
