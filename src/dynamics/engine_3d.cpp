// Engines of 3 dimensions. One file a dimension keeps each compilation short.
#include "dynamics/engine_all.hpp"

namespace jam {

template class Engine<3, false>;
template class Engine<3, true>;

}  // namespace jam
