// Numbers as text by C's functions: the answers of std::from_chars and std::to_chars, whatever the locale.
#include <cmath>
#include <cstring>
#include <limits>
#include <string>

#include "comma.h"
#include "core/decimal.hpp"
#include "test.h"

using namespace jam::inside;

namespace {

// Doubles of all magnitudes: random bits, and those at the ends.
template <class Check>
void for_many_doubles(Check check) {
  const double most = std::numeric_limits<double>::max(), least = std::numeric_limits<double>::denorm_min();
  for (const double x : {0.0, -0.0, 0.1, 1.0, 1e17, 1e16, 123456789.0, 1e-5, 1e-4, 5e-324, most, -most, least})
    check(x);
  uint64_t bits = 12345;
  for (int k = 0; k < 20000; ++k) {
    bits = bits * 6364136223846793005u + 1442695040888963407u;
    double x = 0.0;
    std::memcpy(&x, &bits, sizeof x);
    if (std::isfinite(x)) check(x);
  }
}

void compare_all() {
  for_many_doubles([](double x) {
    char one[32], two[32];
    const std::string text(one, to_decimal(one, x)), other(two, to_decimal_by_c(two, x));
    assert_string_equal(text.c_str(), other.c_str());
    double back = 0.0;
    const auto end = from_decimal_by_c(text, back);
    assert_true(end.ec == std::errc() && end.ptr == text.data() + text.size());
    assert_memory_equal(&back, &x, sizeof x);
  });
  for (const char *text :
       {"",     "-",   "+1",    " 1",     ".5",     "5.", "1e", "1e5x",     "0x10", "1,5",   "inf",
        "-inf", "nan", "1e999", "-1e999", "1e-999", "e5", ".",  "infinity", "in",   "1.5.5", "--1"}) {
    double x = 7.0, y = 7.0;
    const auto one = from_decimal(text, x), two = from_decimal_by_c(text, y);
    if (one.ec != two.ec || one.ptr != two.ptr) fail_msg("'%s' is read in another way", text);
    assert_true(std::isnan(x) ? std::isnan(y) : x == y);
  }
}

CASE(c_gives_the_answers_of_std) { compare_all(); }

CASE(so_it_does_with_a_decimal_comma) {
  char folder[] = "/tmp/jam-comma-XXXXXX";
  assert_non_null(mkdtemp(folder));
  const bool found = set_comma_locale(folder) != nullptr;
  const std::string remove = std::string("rm -r ") + folder;
  assert_int_equal(system(remove.c_str()), 0);
  if (!found) {
    print_message("no locale with a decimal comma is installed: skipped\n");
    skip();
  }
  compare_all();
  setlocale(LC_ALL, "C");
}

}  // namespace
