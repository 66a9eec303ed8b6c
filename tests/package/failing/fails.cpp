// Calls that fail: exceptions of jam.hpp, out of a program that has classes of its own by the names of libjam's inside.
#include <cstdio>
#include <jam/jam.hpp>
#include <stdexcept>
#include <string>

namespace jam {  // a program may extend the namespace of jam.hpp
struct Packing {
  Packing();
  ~Packing();
  double held[3];
  std::string name;
};
Packing::Packing() : held{1.0, 2.0, 3.0}, name("of the program") {}
Packing::~Packing() = default;
[[noreturn]] void fail(jam_status, const char *text, ...) { throw std::logic_error(text); }
}  // namespace jam

int main() {
  const jam::Packing mine;
  int caught = 0;
  try {
    jam::System::random(64, 9);
  } catch (const jam::Error &e) {
    std::puts(e.what());
    if (e.status() == JAM_E_DIMENSION) ++caught;
  }
  try {
    jam::System::read("missing.xyz");
  } catch (const jam::Error &e) {
    if (e.status() == JAM_E_IO) ++caught;
  }
  try {
    jam::System::random(64, 2).forces();
  } catch (const std::runtime_error &e) {
    if (std::string(e.what()) == jam_last_error()) ++caught;
  }
  return caught == 3 && mine.name == "of the program" ? 0 : 1;
}
