// Engines of 6 dimensions. One file a dimension keeps each compilation short.
#include "dynamics/engine_all.hpp"

namespace jam {

template class Engine<6, false>;
template class Engine<6, true>;

}  // namespace jam
