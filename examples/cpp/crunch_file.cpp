// Brings a packing from a file to its jamming point and writes it again.  usage: crunch_file IN OUT
#include <cstdio>

#include <jam/jam.hpp>

int main(int argc, char **argv) try {
  if (argc != 3) throw std::invalid_argument("usage: crunch_file IN OUT");
  jam::System packing = jam::System::read(argv[1]);  // plain text or extended XYZ
  const jam_info before = packing.info();
  jam_crunch_options o = jam::crunch_options();
  o.wall_time = 600;  // seconds; what was reached by then is kept
  const jam_crunch_report r = packing.crunch(o);
  std::printf("phi %.6f -> %.12f, %s, %lld contacts (isostatic %+lld)\n", before.packing_fraction, r.packing_fraction,
              jam_stop_string(r.stop_reason), static_cast<long long>(r.contacts),
              static_cast<long long>(r.excess_contacts));
  std::printf("overlap %.1e, force imbalance %.1e\n", r.max_overlap, r.force_residual);
  packing.write(argv[2]);
  return r.jammed ? 0 : 1;
} catch (const std::exception &e) {
  std::fprintf(stderr, "%s\n", e.what());
  return 1;
}
