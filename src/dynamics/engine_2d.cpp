// Engines of 2 dimensions. One file a dimension keeps each compilation short.
#include "dynamics/engine_all.hpp"

namespace jam {

template class Engine<2, false>;
template class Engine<2, true>;

}  // namespace jam
