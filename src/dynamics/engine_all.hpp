// All parts of the engine, for the files that compile it (copies of engine.cpp.in, one a dimension).
#pragma once
#include "dynamics/engine_archive.hpp"
#include "dynamics/engine_blocks.hpp"
#include "dynamics/engine_cells.hpp"
#include "dynamics/engine_events.hpp"
#include "dynamics/engine_images.hpp"
#include "dynamics/engine_lists.hpp"
#include "dynamics/engine_prefetch.hpp"
#include "dynamics/engine_quenched.hpp"
#include "dynamics/engine_state.hpp"
#include "dynamics/engine_time.hpp"
