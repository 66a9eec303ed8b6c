// Numbers of bytes in texts have the unit that fits.
#include "core/error.hpp"
#include "test.h"

using namespace jam::inside;

namespace {

CASE(three_digits_and_the_unit_that_fits) {
  const struct {
    double bytes;
    const char *text;
  } cases[] = {{0.0, "0 bytes"},   {10.0, "10 bytes"},   {999.4, "999 bytes"}, {1000.0, "1 kB"},
               {112e3, "112 kB"},  {999499.0, "999 kB"}, {999501.0, "1 MB"},   {1.25e6, "1.25 MB"},
               {14.04e9, "14 GB"}, {2e12, "2 TB"},       {999.7, "1 kB"},      {999.5e9, "1 TB"}};
  for (const auto &c : cases) assert_string_equal(bytes_text(c.bytes).c_str(), c.text);
}

}  // namespace
