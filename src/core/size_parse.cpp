// A law of diameters from text: `LAW:item,item...`.
#include <string_view>

#include "core/decimal.hpp"
#include "core/error.hpp"
#include "core/size_laws.hpp"

namespace jam::inside {
namespace {

std::string_view trimmed(std::string_view word) {
  while (!word.empty() && (word.front() == ' ' || word.front() == '\t')) word.remove_prefix(1);
  while (!word.empty() && (word.back() == ' ' || word.back() == '\t')) word.remove_suffix(1);
  return word;
}

// The whole word as a number, in every locale.
bool is_number(std::string_view word, double &x) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  const auto [end, error] = from_decimal(word, x);
  return error == std::errc() && end == word.data() + word.size();
}

[[noreturn]] void refuse(std::string_view item, const char *why) {
  fail(JAM_E_ARGUMENT, "'%.*s' of a law of sizes: %s", static_cast<int>(item.size()), item.data(), why);
}

int32_t one_of(std::string_view item, std::string_view value, const std::vector<const char *> &words, int32_t first) {
  for (size_t k = 0; k < words.size(); ++k)
    if (value == words[k]) return first + static_cast<int32_t>(k);
  std::string all;
  for (const char *word : words) all += std::string(all.empty() ? "it must be " : " or ") + word;
  refuse(item, all.c_str());
}

void take_item(std::string_view item, jam_diameters_options &o, std::vector<double> &curve,
               std::vector<std::string> &files) {
  const size_t equals = item.find('=');
  double x = 0.0, y = 0.0;
  if (equals == std::string_view::npos) {
    if (item.empty()) refuse(item, "an item is empty");
    if (is_number(item, x)) refuse(item, "a number needs its field, as in deviation=0.3, or its share, as in 0.5=0.12");
    const size_t colon = item.find(':');
    if (colon != std::string_view::npos && is_number(trimmed(item.substr(0, colon)), x))
      refuse(item, "a size and its share are joined by =, as in 0.5=0.12");
    files.emplace_back(item);
    return;
  }
  const std::string_view key = trimmed(item.substr(0, equals)), value = trimmed(item.substr(equals + 1));
  if (key == "share")
    o.share = one_of(item, value, {"number", "volume"}, JAM_SHARE_NUMBER);
  else if (key == "draw")
    o.draw = one_of(item, value, {"quantiles", "random"}, JAM_DRAW_QUANTILES);
  else if (!is_number(value, y))
    refuse(item, "the value after = must be a number");
  else if (is_number(key, x))
    curve.insert(curve.end(), {x, y});
  else if (double *const place = size_field(o, std::string(key).c_str()))
    *place = y;
  else
    refuse(item, ("there is no such field; there are " + size_field_names() + ", share and draw").c_str());
}

}  // namespace

std::vector<std::string> parse_size_law(const char *text, jam_diameters_options &o, std::vector<double> &curve) {
  const std::string_view all = text;
  const size_t colon = all.find(':');
  const std::string name(trimmed(all.substr(0, colon)));
  o.law = size_law_number(name.c_str());
  std::vector<std::string> files;
  if (colon == std::string_view::npos) return files;
  for (std::string_view rest = all.substr(colon + 1);;) {
    const size_t comma = rest.find(',');
    take_item(trimmed(rest.substr(0, comma)), o, curve, files);
    if (comma == std::string_view::npos) return files;
    rest.remove_prefix(comma + 1);
  }
}

}  // namespace jam::inside
