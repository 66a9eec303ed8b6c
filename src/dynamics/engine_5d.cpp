// Engines of 5 dimensions. One file a dimension keeps each compilation short.
#include "dynamics/engine_all.hpp"

namespace jam {

template class Engine<5, false>;
template class Engine<5, true>;

}  // namespace jam
