// Engines of 8 dimensions. One file a dimension keeps each compilation short.
#include "dynamics/engine_all.hpp"

namespace jam {

template class Engine<8, false>;
template class Engine<8, true>;

}  // namespace jam
