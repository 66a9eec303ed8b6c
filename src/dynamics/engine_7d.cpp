// Engines of 7 dimensions. One file a dimension keeps each compilation short.
#include "dynamics/engine_all.hpp"

namespace jam {

template class Engine<7, false>;
template class Engine<7, true>;

}  // namespace jam
