// Engines for d = 5..8.
#include "edmd/engine_archive.hpp"
#include "edmd/engine_cells.hpp"
#include "edmd/engine_events.hpp"
#include "edmd/engine_lists.hpp"
#include "edmd/engine_quenched.hpp"
#include "edmd/engine_time.hpp"

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
