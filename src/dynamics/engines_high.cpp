// Engines for d = 5..8.
#include "dynamics/engine_archive.hpp"
#include "dynamics/engine_cells.hpp"
#include "dynamics/engine_events.hpp"
#include "dynamics/engine_lists.hpp"
#include "dynamics/engine_quenched.hpp"
#include "dynamics/engine_time.hpp"

namespace jam {

template class Engine<5, false>;
template class Engine<5, true>;
template class Engine<6, false>;
template class Engine<6, true>;
template class Engine<7, false>;
template class Engine<7, true>;
template class Engine<8, false>;
template class Engine<8, true>;

}  // namespace jam
