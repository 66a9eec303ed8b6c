// Engines of 4 dimensions. One file a dimension keeps each compilation short.
#include "dynamics/engine_all.hpp"

namespace jam {

template class Engine<4, false>;
template class Engine<4, true>;

}  // namespace jam
