// All parts of the engine, for the files that compile it (copies of engine.cpp.in, one a dimension).
#pragma once
#include "dynamics/event_driven/archive.hpp"
#include "dynamics/event_driven/cell_mode.hpp"
#include "dynamics/event_driven/clock.hpp"
#include "dynamics/event_driven/events.hpp"
#include "dynamics/event_driven/images.hpp"
#include "dynamics/event_driven/list_cells.hpp"
#include "dynamics/event_driven/lists.hpp"
#include "dynamics/event_driven/mari_kurchan.hpp"
#include "dynamics/event_driven/prefetch.hpp"
#include "dynamics/event_driven/state.hpp"
